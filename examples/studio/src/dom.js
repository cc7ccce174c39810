// The few things that are asked of a page.

export const $ = (id) => document.getElementById(id);

const SVG = 'http://www.w3.org/2000/svg';

function set(element, attributes) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith('on')) element.addEventListener(key.slice(2), value);
    else element.setAttribute(key, value === true ? '' : value);
  }
}

/** An element: make('button', { class: 'plain', onclick }, 'text', child, ...). */
export function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  set(element, attributes);
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** The same in a drawing. */
export function draw(name, attributes = {}, ...children) {
  const element = document.createElementNS(SVG, name);
  set(element, attributes);
  element.append(...children);
  return element;
}

/** A line icon of 24 x 24, by its path. */
export const icon = (path) => draw('svg', {
  viewBox: '0 0 24 24', class: 'icon', 'aria-hidden': 'true', focusable: 'false',
}, draw('path', { d: path }));

/** One of several: a group of radio buttons that look like one control. */
export function choice(label, name, options, value, change) {
  const inputs = Object.entries(options).map(([key, text]) => {
    const input = make('input', { type: 'radio', name, value: key, checked: key === value });
    input.addEventListener('change', () => change(key));
    return make('label', { class: 'segment' }, input, make('span', {}, text));
  });
  return make('fieldset', { class: 'choice' }, make('legend', {}, label), make('div', { class: 'segments' }, ...inputs));
}

export function toggle(label, value, change, id = null) {
  const input = make('input', { type: 'checkbox', role: 'switch', checked: value, id });
  input.addEventListener('change', () => change(input.checked));
  return Object.assign(make('label', { class: 'toggle' }, input, make('span', {}, label)), { input });
}

export function slider(label, { min, max, step, value, text = String }, change) {
  const output = make('output', {}, text(value));
  const input = make('input', { type: 'range', min, max, step, value, 'aria-label': label });
  input.addEventListener('input', () => {
    output.textContent = text(Number(input.value));
    change(Number(input.value));
  });
  const row = make('label', { class: 'slider' }, make('span', {}, label), output, input);
  const set = (v) => { input.value = v; output.textContent = text(v); };
  return Object.assign(row, { input, set });
}

export function button(text, path, onclick, attributes = {}) {
  return make('button', { type: 'button', onclick, ...attributes }, ...(path ? [icon(path)] : []),
    make('span', {}, text));
}

export const section = (title, ...children) => make('section', {}, make('h2', {}, title), ...children);

/** Gives a file to the user. */
export function download(name, content, type) {
  const url = URL.createObjectURL(content instanceof Blob ? content : new Blob([content], { type }));
  make('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Asks the user for a file. */
export function pick(accept, take) {
  const input = make('input', { type: 'file', accept, 'aria-label': 'file' });
  input.addEventListener('change', () => input.files[0] && take(input.files[0]));
  input.click();
}
