// What is computed: one instance of the library and the objects of the page, in a worker where there is
// one. Operations take plain values and give plain values; see remote.js.
import { load } from 'libicc';
import { plain } from './errors.js';
import { cageOperations } from './cage_engine.js';
import { handleOperations } from './handle_engine.js';
import { stageOperations } from './stage_engine.js';
import { spaceOperations } from './space_engine.js';

/** Runs operations by their names. An error of the library is a result, too: { error }. */
export async function startEngine(module) {
  const icc = await load(module);
  const operations = {
    ...cageOperations(icc), ...handleOperations(icc), ...stageOperations(icc), ...spaceOperations(icc),
    version: () => ({ version: icc.version }),
  };
  return (name, args) => {
    const started = performance.now();
    try {
      return { ...operations[name](args), ms: performance.now() - started };
    } catch (error) {
      if (!(error instanceof icc.IccError)) throw error;
      return { error: plain(error), ms: performance.now() - started };
    }
  };
}

/** The buffers of a result, which change hands rather than being copied. */
export const buffersOf = (result) => [...new Set(Object.values(result)
  .filter((value) => ArrayBuffer.isView(value)).map((value) => value.buffer))];
