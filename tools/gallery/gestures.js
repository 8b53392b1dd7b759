// SPDX-License-Identifier: Apache-2.0
// @ts-check
// Mouse, fingers, wheel and keys over a picture, as turns of its orbit.

const PER_WIDTH = Math.PI; // radians that a drag across the whole picture turns
const PER_KEY = Math.PI / 16;
const ZOOM_KEY = 1.25;
const ZOOM_WHEEL = 0.002;

/**
 * @typedef {object} Receiver
 * @property {import('./orbit.js').Orbit} orbit
 * @property {() => boolean} free  whether it is turned freely, not on a turntable
 * @property {(moving: boolean) => void} changed  the orbit was turned; more may follow
 * @property {(right: number, up: number) => void} pointed  the pointer is there, in the picture from -1 to 1
 * @property {() => void} left
 * @property {(key: string) => boolean} pressed  any other key; whether it meant something
 */

/** Listens on `picture`. @param {HTMLElement} picture @param {Receiver} to */
export function listen(picture, to) {
  /** @type {Map<number, { x: number, y: number }>} the fingers that are down */
  const down = new Map();

  const turn = (/** @type {number} */ right, /** @type {number} */ below) => {
    if (to.free()) to.orbit.roll(right, below);
    else to.orbit.drag(right, below);
  };

  const spread = () => {
    const [a, b] = [...down.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };

  const point = (/** @type {PointerEvent} */ { clientX, clientY }) => {
    const box = picture.getBoundingClientRect();
    to.pointed(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2);
  };

  picture.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    picture.setPointerCapture(event.pointerId);
    point(event);
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });

  picture.addEventListener('pointermove', (event) => {
    point(event);
    const before = down.get(event.pointerId);
    if (!before) return;
    const apart = down.size === 2 ? spread() : 0;
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const scale = PER_WIDTH / picture.clientWidth;
    if (down.size === 1) turn((event.clientX - before.x) * scale, (event.clientY - before.y) * scale);
    if (down.size === 2 && apart > 0) to.orbit.magnify(spread() / apart);
    to.changed(true);
  });

  for (const end of ['pointerup', 'pointercancel'])
    picture.addEventListener(end, (event) => {
      if (down.delete(/** @type {PointerEvent} */ (event).pointerId)) to.changed(false);
    });
  picture.addEventListener('pointerleave', () => to.left());

  // The page scrolls, unless the picture has been chosen; from there the way out is to zoom out, and then on.
  picture.addEventListener('wheel', (event) => {
    const chosen = /** @type {ShadowRoot} */ (picture.getRootNode()).activeElement === picture;
    if (!chosen && !event.ctrlKey) return;
    const before = to.orbit.zoom;
    to.orbit.magnify(Math.exp(-event.deltaY * (event.ctrlKey ? 5 : 1) * ZOOM_WHEEL));
    if (before === to.orbit.zoom && !event.ctrlKey) return;
    event.preventDefault();
    to.changed(true);
  }, { passive: false });

  /** @type {Record<string, () => void>} */
  const keys = {
    ArrowLeft: () => turn(-PER_KEY, 0),
    ArrowRight: () => turn(PER_KEY, 0),
    ArrowUp: () => turn(0, -PER_KEY),
    ArrowDown: () => turn(0, PER_KEY),
    '+': () => to.orbit.magnify(ZOOM_KEY),
    '=': () => to.orbit.magnify(ZOOM_KEY),
    '-': () => to.orbit.magnify(1 / ZOOM_KEY),
    Home: () => to.orbit.reset(),
  };
  picture.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = keys[event.key];
    if (act) {
      act();
      to.changed(false);
    } else if (!to.pressed(event.key)) {
      return;
    }
    event.preventDefault();
  });
}
