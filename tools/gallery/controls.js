// SPDX-License-Identifier: Apache-2.0
// @ts-check
// The buttons of a card: pictures for the eye, words for a screen reader.

const ICONS = {
  mode: 'M8 1.5a6.5 6.5 0 1 0 0 13a6.5 6.5 0 1 0 0-13M8 1.5v13a6.5 6.5 0 0 0 0-13',
  rotation: 'M13.5 8a5.5 2.4 0 1 1-11 0a5.5 2.4 0 1 1 11 0M8 2.5a2.4 5.5 0 1 1 0 11a2.4 5.5 0 1 1 0-11',
  light: 'M8 5a3 3 0 1 0 0 6a3 3 0 1 0 0-6M8 1v2M8 13v2M1 8h2M13 8h2M3 3l1.4 1.4M11.6 11.6L13 13M13 3l-1.4 1.4M4.4 11.6L3 13',
  closer: 'M8 3v10M3 8h10',
  farther: 'M3 8h10',
  reset: 'M3.2 5.5A5.5 5.5 0 1 1 2.5 8M3 2v3.8h3.8',
};

/** @typedef {keyof typeof ICONS} Action */

/** @param {Action} name */
function icon(name) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  const path = document.createElementNS('http://www.w3.org/2000/svg', 'path');
  svg.setAttribute('viewBox', '0 0 16 16');
  svg.setAttribute('aria-hidden', 'true');
  path.setAttribute('d', ICONS[name]);
  svg.append(path);
  return svg;
}

/** @param {string} part @param {() => void} pressed */
function button(part, pressed) {
  const element = document.createElement('button');
  element.type = 'button';
  element.setAttribute('part', part);
  element.addEventListener('click', pressed);
  return element;
}

/** The tools over a picture. @param {(action: Action) => void} act */
export function toolbar(act) {
  const bar = document.createElement('div');
  bar.setAttribute('part', 'tools');
  /** @type {Map<Action, HTMLButtonElement>} */
  const buttons = new Map();
  for (const name of /** @type {Action[]} */ (Object.keys(ICONS))) {
    const element = button('tool', () => act(name));
    element.append(icon(name));
    buttons.set(name, element);
  }
  bar.append(...buttons.values());

  /**
   * What each does, and whether it is on.
   * @param {string} mode @param {boolean} free @param {boolean} lit
   */
  const show = (mode, free, lit) => {
    /** @type {[Action, string, boolean?][]} */
    const states = [
      ['mode', `Surface: ${mode}`, mode !== 'shaded'], ['rotation', 'Rotate freely', free], ['light', 'Light follows the pointer', lit],
      ['closer', 'Zoom in'], ['farther', 'Zoom out'], ['reset', 'Reset'],
    ];
    for (const [name, label, on] of states) {
      const element = /** @type {HTMLButtonElement} */ (buttons.get(name));
      element.setAttribute('aria-label', label);
      element.title = label;
      if (on !== undefined) element.setAttribute('aria-pressed', String(on));
    }
  };
  return { bar, show };
}

/** @typedef {'3d' | 'series' | 'series-2'} Showing */

/** The switch between the object and its pictures. @param {(showing: Showing) => void} choose */
export function switcher(choose) {
  const group = document.createElement('div');
  group.setAttribute('part', 'switch');
  group.setAttribute('role', 'group');
  group.setAttribute('aria-label', 'Shown as');
  /** @type {[Showing, string, string][]} */
  const choices = [['3d', '3D', '3D object'], ['series', '1 axis', 'Pictures, one axis'], ['series-2', '2 axes', 'Pictures, two axes']];
  const buttons = choices.map(([showing, text, label]) => {
    const element = button('choice', () => choose(showing));
    element.textContent = text;
    element.title = label;
    return element;
  });
  group.append(...buttons);

  /** @param {Showing} showing @param {boolean} series whether there is one @param {boolean} second whether it has a second axis */
  const show = (showing, series, second) => {
    group.hidden = !series;
    buttons.forEach((element, i) => element.setAttribute('aria-pressed', String(choices[i][0] === showing)));
    buttons[2].hidden = !second;
  };
  return { group, show };
}
