// What is computed: one instance of the library and the objects of the page. Operations take plain values
// and give plain values.
import { cageOperations } from './cage_engine.js';
import { handleOperations } from './handle_engine.js';
import { pairOperations } from './pair_engine.js';
import { pinOperations } from './pin_engine.js';
import { stageOperations } from './stage_engine.js';
import { spaceOperations } from './space_engine.js';

/** An operation that takes its time. An error of the library is a result, too: { error }. */
const answering = (icc, operation) => (argument) => {
  const started = performance.now();
  try {
    return { ...operation(argument), ms: performance.now() - started };
  } catch (error) {
    if (!(error instanceof icc.IccError)) throw error;
    return { error: error.plain, ms: performance.now() - started };
  }
};

/** The operations by their names, as serve() takes them. */
export function operationsOf(icc) {
  const all = {
    ...cageOperations(icc), ...handleOperations(icc), ...pinOperations(icc), ...pairOperations(icc),
    ...stageOperations(icc), ...spaceOperations(icc),
    version: () => ({ version: icc.version }),
  };
  return Object.fromEntries(Object.keys(all).map((name) => [name, answering(icc, (argument) => all[name](argument))]));
}
