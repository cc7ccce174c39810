// libicc in WebAssembly: an instance of the library, and its classes.
import { chartOf } from './chart.js';
import { Core } from './core.js';
import { domainOf, shapesOf } from './domain.js';
import { IccError, codeOf } from './error.js';
import { kernelOf } from './kernel.js';
import { mapOf } from './map.js';
import { stagesOf } from './stages.js';

export { IccError };
export { constants } from './layouts.js';

/** The bytes of the module beside this file, in node and in browsers. */
async function nearby() {
  const url = new URL('./libicc.wasm', import.meta.url);
  if (url.protocol !== 'file:') return fetch(url);
  const { readFile } = await import('node:fs/promises');
  return readFile(url);
}

async function compiled(source) {
  const given = await (source ?? nearby());
  if (given instanceof WebAssembly.Module) return given;
  if (typeof Response !== 'undefined' && given instanceof Response)
    return WebAssembly.compile(await given.arrayBuffer());
  return WebAssembly.compile(given);
}

/**
 * Makes an instance of the library, with a memory of its own: objects of two instances do not mix.
 * source: nothing (the file beside this one), a WebAssembly.Module, its bytes, a Response, or a promise
 * of one of them.
 */
export async function load(source) {
  const module = await compiled(source);
  const { exports } = await WebAssembly.instantiate(module, { icc: { clock: () => performance.now() } });
  exports._initialize();
  const core = new Core(exports);
  const Domain = domainOf(core);
  const Chart = chartOf(core, Domain);
  const Map = mapOf(core, Domain, Chart);
  return {
    module, Domain, Chart, Map, ...kernelOf(core), ...stagesOf(core), ...shapesOf(core), IccError,
    /** Calls any function of C by its name: see Core.call(). */
    call: (name, ...args) => core.call(name, ...args),
    get memoryBytes() { return core.bytes; },
    version: core.memory.string(core.call('icc_version')),
    versionNumber: core.call('icc_version_number'),
    statusName: (status) => core.memory.string(core.call('icc_status_name', status)),
    codeOf,
  };
}
