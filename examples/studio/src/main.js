// The page: unpacks the library, starts the engine in a worker, shows one mode at a time.
import { $, button, make } from './dom.js';
import { CageMode } from './cage.js';
import { HandleMode } from './handles.js';
import { PairMode } from './pairs.js';
import { PinMode } from './pins.js';
import { StageMode } from './stages.js';
import { SpaceMode } from './space.js';
import { readLink } from './link.js';
import { Remote, serve } from 'libicc';
import { operationsOf } from './engine.js';

const UNDO = 'M8 5L4 9l4 4M4 9h9a6 6 0 0 1 0 12h-3', REDO = 'M16 5l4 4-4 4M20 9h-9a6 6 0 0 0 0 12h3';
const MODES = { cage: ['Cage', CageMode], pins: ['Pins', PinMode], points: ['Points', PairMode], handles: ['Handles', HandleMode],
  stages: ['Stages', StageMode], space: ['Space', SpaceMode] };
const SHOWN_MS = 5000;

async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** The engine in a worker that is made from the page's own text, so that it works from file://, too; on
 *  this thread where there are no workers. */
async function startEngine(module, text) {
  try {
    const worker = new Worker(URL.createObjectURL(new Blob([text], { type: 'text/javascript' })));
    return Object.assign(await Remote.start(worker, module), { place: 'worker' });
  } catch {
    return Object.assign(await Remote.start(operationsOf, module), { place: 'page' });
  }
}

class Page {
  #timer; #mode = null;
  modes = {};

  constructor(remote) {
    this.remote = remote;
    const keys = { undo: [UNDO, 'Undo', 'Ctrl+Z'], redo: [REDO, 'Redo', 'Ctrl+Y'] };
    $('history').append(...Object.entries(keys).map(([id, [path, text, key]]) =>
      button(text, path, () => this.#mode[id](), { id, title: `${text} (${key})` })));
    $('modes').append(...Object.entries(MODES).map(([key, [text]]) =>
      button(text, null, () => this.show(key), { 'data-mode': key })));
    document.addEventListener('keydown', (event) => this.#key(event));
    this.#takeFiles();
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.#mode?.render());
  }

  say(text) {
    clearTimeout(this.#timer);
    $('toast').textContent = text;
    if (text) this.#timer = setTimeout(() => { $('toast').textContent = ''; }, SHOWN_MS);
  }

  #make(key) {
    const tools = { say: (text) => this.say(text), changed: () => this.#changed(), modes: this.modes };
    return new MODES[key][1](this.remote, tools);
  }

  show(key, rig) {
    try { this.modes[key] ??= this.#make(key); } catch (error) { this.say(error.message); return null; }
    const mode = this.modes[key];
    for (const b of $('modes').children) b.toggleAttribute('aria-current', false);
    $('modes').querySelector(`[data-mode=${key}]`).setAttribute('aria-current', 'page');
    $('main').replaceChildren(mode.element);
    this.#mode = mode;
    mode.enter?.(rig);
    this.#changed();
    return mode;
  }

  #changed() {
    $('undo').disabled = !this.#mode?.canUndo;
    $('redo').disabled = !this.#mode?.canRedo;
  }

  #key(event) {
    const key = event.key.toLowerCase();
    if (event.key === 'Escape') this.#mode.tool?.('move');
    if (!(event.ctrlKey || event.metaKey) || event.altKey || !['z', 'y'].includes(key)) return;
    event.preventDefault();
    if (key === 'y' || event.shiftKey) this.#mode.redo(); else this.#mode.undo();
  }

  /** Files that are dropped or pasted. */
  #takeFiles() {
    const give = async (data) => {
      const file = data.files[0];
      if (file) await this.#mode.take?.(file);
      else if (data.getData('text')) await this.#mode.take?.(new File([data.getData('text')], 'the text', { type: 'text/plain' }));
    };
    document.addEventListener('dragover', (e) => { e.preventDefault(); document.body.classList.add('dropping'); });
    document.addEventListener('dragleave', (e) => e.relatedTarget ?? document.body.classList.remove('dropping'));
    document.addEventListener('drop', (e) => {
      e.preventDefault();
      document.body.classList.remove('dropping');
      give(e.dataTransfer);
    });
    document.addEventListener('paste', (e) => give(e.clipboardData));
  }
}

async function start() {
  try {
    const module = await WebAssembly.compile(await unpack($('wasm').textContent));
    const remote = await startEngine(module, $('program').textContent);
    const page = new Page(remote);
    const state = await readLink(location.hash);
    const cage = page.show('cage');
    if (state?.source) await cage.restore(state); else cage.first();
    if (Object.hasOwn(MODES, state?.mode ?? '')) page.show(state.mode, state.rig === 'cage' ? 'cage' : undefined);
    globalThis.studio = { page, remote, cage, modes: page.modes };
  } catch (error) {
    $('main').replaceChildren(make('p', { class: 'loading' }, `${error.message}`));
    throw error;
  }
}

if (typeof document === 'undefined') serve(operationsOf); else start();
