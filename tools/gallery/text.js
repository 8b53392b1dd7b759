// SPDX-License-Identifier: Apache-2.0

/**
 * KB of 1000 bytes, as in the reports.
 * @param {number} bytes
 */
export function byteText(bytes) {
  return bytes < 1e6 ? `${(bytes / 1e3).toFixed(1)} KB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

/**
 * @param {number} count
 * @param {string} noun
 */
export function countText(count, noun) {
  return `${count.toLocaleString('en')} ${noun}${count === 1 ? '' : 's'}`;
}
