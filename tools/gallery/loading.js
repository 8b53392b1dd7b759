// SPDX-License-Identifier: Apache-2.0
// @ts-check
// Which cards hold their model: those near the viewport or pointed at, a few loading at a time, the nearest first.

const AT_ONCE = 2;
const NEAR = '50%'; // of the viewport's height above and below

/**
 * @typedef {HTMLElement & { load(signal: AbortSignal): Promise<void>, free(): void, wanted(near: boolean): void }} Loadable
 */

/** @type {Set<Loadable>} */
const waiting = new Set();
/** @type {Map<Loadable, AbortController>} loading or loaded */
const held = new Map();
let loading = 0;

const observer = new IntersectionObserver(
  (entries) => { for (const entry of entries) /** @type {Loadable} */ (entry.target).wanted(entry.isIntersecting); },
  { rootMargin: `${NEAR} 0px` },
);

/** How far its middle is from the viewport's, in pixels. @param {Element} element */
function distance(element) {
  const box = element.getBoundingClientRect();
  return Math.abs(box.top + box.height / 2 - window.innerHeight / 2) + 0.01 * box.left;
}

function next() {
  while (loading < AT_ONCE && waiting.size > 0) {
    const [nearest] = [...waiting].map((card) => ({ card, at: distance(card) })).sort((a, b) => a.at - b.at);
    waiting.delete(nearest.card);
    start(nearest.card);
  }
}

/** @param {Loadable} card */
async function start(card) {
  const abort = new AbortController();
  held.set(card, abort);
  ++loading;
  try {
    await card.load(abort.signal);
  } finally {
    --loading;
    next();
  }
}

/** Tells the card when it comes near and when it leaves. @param {Loadable} card */
export const watch = (card) => observer.observe(card);

/** @param {Loadable} card */
export function unwatch(card) {
  observer.unobserve(card);
  release(card);
}

/** Loads it as soon as its turn comes; `now`: at once. @param {Loadable} card */
export function request(card, now = false) {
  if (held.has(card)) return;
  if (now) {
    waiting.delete(card);
    start(card);
    return;
  }
  waiting.add(card);
  queueMicrotask(next); // when all that are near have asked
}

/** @param {Loadable} card */
export function release(card) {
  waiting.delete(card);
  const abort = held.get(card);
  if (!abort) return;
  held.delete(card);
  abort.abort();
  card.free();
}
