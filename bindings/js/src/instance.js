// An instance of the library: its module, memory and classes.
import { chartOf } from './chart.js';
import { Core } from './core.js';
import { coverageOf } from './coverage.js';
import { domainOf, shapesOf } from './domain.js';
import { IccError, codeOf } from './error.js';
import { fitOf } from './fit.js';
import { kernelOf } from './kernel.js';
import { certifierOf, mapOf } from './map.js';
import { matchOf } from './match.js';
import { stagesOf } from './stages.js';

/** The bytes of the module beside this file, in node and in browsers. */
async function nearby() {
  const url = new URL('./libicc.wasm', import.meta.url);
  if (url.protocol !== 'file:') return fetch(url);
  const { readFile } = await import('node:fs/promises');
  return readFile(url);
}

/** Makes a WebAssembly.Module from the argument of load(). */
export async function compiled(source) {
  const given = await (source ?? nearby());
  if (given instanceof WebAssembly.Module) return given;
  if (typeof Response !== 'undefined' && given instanceof Response)
    return WebAssembly.compile(await given.arrayBuffer());
  return WebAssembly.compile(given);
}

/** The classes over a core. Without a core they are only descriptions. */
export function classesOf(core) {
  const Domain = domainOf(core), Chart = chartOf(core, Domain), Map = mapOf(core, Domain, Chart);
  const Match = matchOf(core, Domain), Coverage = coverageOf(core, Domain), Fit = fitOf(core, Domain, Map);
  return { Domain, Chart, Map, Match, Coverage, Fit, ...kernelOf(core), ...stagesOf(core) };
}

/**
 * Makes an instance of the library, with its own memory. Objects of two instances do not mix.
 * source: nothing (the file beside this one), a WebAssembly.Module, its bytes, a Response, or a promise
 * of one of them.
 */
export async function load(source) {
  const module = await compiled(source);
  const { exports } = await WebAssembly.instantiate(module, { icc: { clock: () => performance.now() } });
  exports._initialize();
  const core = new Core(exports);
  return {
    module, ...classesOf(core), ...shapesOf(core), IccError,
    /** Calls any function of C by its name: see Core.call(). */
    call: (name, ...args) => core.call(name, ...args),
    /** Watches the calls in `work`, and can cancel them: see Env.during(). */
    during: (env, work) => core.env.during(env, work),
    get memoryBytes() { return core.bytes; },
    version: core.memory.string(core.call('icc_version')),
    versionNumber: core.call('icc_version_number'),
    certifyField: certifierOf(core),
    statusName: (status) => core.memory.string(core.call('icc_status_name', status)),
    codeOf,
  };
}
