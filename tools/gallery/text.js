// SPDX-License-Identifier: Apache-2.0
// @ts-check

/**
 * KB of 1000 bytes, as in the reports.
 * @param {number} bytes
 */
export function byteText(bytes) {
  return bytes < 999950 ? `${(bytes / 1e3).toFixed(1)} KB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

/**
 * Mean square error times 10^4, three digits.
 * @param {number | undefined} error
 */
export function errorText(error) {
  return error === undefined || !Number.isFinite(error) ? '' : `error ${error < 10 ? error.toFixed(2) : Math.round(error)}`;
}

/**
 * @param {number} count
 * @param {string} noun
 */
export function countText(count, noun) {
  return `${count.toLocaleString('en')} ${noun}${count === 1 ? '' : 's'}`;
}
