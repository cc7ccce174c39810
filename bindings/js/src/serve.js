// The worker's side of remote.js: an instance of the library, and operations over it.
import { IccError } from './error.js';
import { load } from './instance.js';

const REPORT_MS = 16;          // between two reports of progress

/** The first message to a worker: { port, module, flag }. In browsers the worker must listen for it at once. */
async function told() {
  if ('onmessage' in globalThis)
    return new Promise((resolve) => { globalThis.onmessage = ({ data }) => resolve(data); });
  const { parentPort } = await import('node:worker_threads');
  return new Promise((resolve) => { parentPort.once('message', resolve); });
}

/** The buffers of a result and of its members, which are transferred instead of copied. */
function buffersOf(result) {
  if (ArrayBuffer.isView(result)) return [result.buffer];
  const views = Object.values(result ?? {}).filter((value) => ArrayBuffer.isView(value));
  return [...new Set(views.map((view) => view.buffer))];
}

const failureOf = (error) => (error instanceof IccError ? { icc: error.plain } : { text: `${error?.stack ?? error}` });

/**
 * Answers the calls of a Remote. make(icc) returns the operations, { name: (argument) => result }. Buffers of
 * a result are transferred. start: { port, module, flag }; left out in a worker, which gets it as a message.
 */
export async function serve(make, start) {
  const { port, module, flag } = start ?? await told();
  const begun = (async () => {
    const icc = await load(module);
    return { icc, operations: make(icc) };
  })();

  /** Reports a call's progress, and asks whether it has been cancelled. */
  const envOf = (id, watched) => {
    let last = -Infinity;
    return {
      progress: (stage, share) => {
        if (flag && Atomics.load(flag, 0) === id) return true;
        const now = performance.now();
        if (watched.progress && (share === 1 || now - last >= REPORT_MS)) {
          last = now;
          port.postMessage({ id, stage, share });
        }
        return false;
      },
      log: watched.log ? (line) => port.postMessage({ id, line }) : null,
    };
  };

  port.onmessage = async ({ data: { id, name, argument, watched } }) => {
    try {
      const { icc, operations } = await begun;
      const result = name === null ? icc.version : icc.during(envOf(id, watched), () => operations[name](argument));
      port.postMessage({ id, result }, buffersOf(result));
    } catch (error) {
      port.postMessage({ id, failure: failureOf(error) });
    }
  };
}
