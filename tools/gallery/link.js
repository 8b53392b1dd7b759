// SPDX-License-Identifier: Apache-2.0
// @ts-check
// The link to an object's full model, seen from where its thumbnail is seen.

/** @param {number[]} vector */
const list = (vector) => vector.map((x) => Number(x.toPrecision(6))).join(',');

/**
 * The link with the camera: in place of {azimuth}, {elevation}, {zoom}, {eye}, {target} and {up}, where it has any of these, else as
 * its fragment, where it has none. Only http, https and relative links are followed; anything else is null.
 * @param {string} link
 * @param {Record<string, any>} camera  of a <vitrine-thumbnail>
 * @param {string} base  address of the page
 */
export function linkWithCamera(link, camera, base) {
  const values = Object.entries(camera).map(([name, value]) => [name, Array.isArray(value) ? list(value) : String(Number(value.toPrecision(6)))]);
  let address = link;
  for (const [name, value] of values) address = address.replaceAll(`{${name}}`, value);
  if (address === link && !link.includes('#')) address += `#${values.map(([name, value]) => `${name}=${value}`).join('&')}`;
  try {
    const { protocol, href } = new URL(address, base);
    return protocol === 'http:' || protocol === 'https:' ? href : null;
  } catch {
    return null;
  }
}
