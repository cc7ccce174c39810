// Calls operations that serve() answers, in a worker or on this thread. One call runs at a time. The others wait
// here, so a call that is cancelled or outdated before its turn costs nothing.
import { IccError } from './error.js';
import { compiled } from './instance.js';
import { serve } from './serve.js';

const errorOf = ({ icc, text }) => (icc ? IccError.fromPlain(icc) : new Error(text));

export class Remote {
  #port; #worker; #flag; #queue = []; #running = null; #next = 0; #channels = new Map(); #closed = null;

  constructor(port, worker, flag) {
    [this.#port, this.#worker, this.#flag] = [port, worker, flag];
    port.onmessage = ({ data }) => this.#take(data);
    const fail = (error) => this.#fail(error instanceof Error ? error : new Error(error.message));
    if (worker?.on) worker.on('error', fail);
    else if (worker) worker.onerror = (event) => { event.preventDefault(); fail(event); };
  }

  /** worker: a Worker whose program calls serve(), or operations for this thread (as for serve()).
   *  source: as for load(). */
  static async start(worker, source) {
    const module = await compiled(source), { port1, port2 } = new MessageChannel();
    const flag = typeof SharedArrayBuffer === 'undefined' ? null : new Int32Array(new SharedArrayBuffer(4));
    const here = typeof worker === 'function', remote = new Remote(port1, here ? null : worker, flag);
    if (here) serve(worker, { port: port2, module, flag });
    else worker.postMessage({ port: port2, module, flag }, [port2]);
    await remote.call(null);
    return remote;
  }

  /** True if a running call can be stopped from here. This needs shared memory. */
  get stops() { return this.#flag !== null && this.#worker !== null; }

  /**
   * The result of an operation, as a promise. An aborted AbortSignal rejects it at once. If `stops` is true,
   * the call itself stops. Otherwise it ends later, and `lost` gets its result.
   */
  call(name, argument, { progress, log, signal, lost } = {}) {
    if (this.#closed) return Promise.reject(this.#closed);
    if (signal?.aborted) return Promise.reject(signal.reason);
    return new Promise((resolve, reject) => {
      const call = { id: ++this.#next, name, argument, progress, log, lost, resolve, reject };
      if (signal) this.#heed(signal, call);
      this.#queue.push(call);
      this.#pump();
    });
  }

  #heed(signal, call) {
    const abort = () => {
      this.#queue = this.#queue.filter((other) => other !== call);
      if (call === this.#running && this.#flag) Atomics.store(this.#flag, 0, call.id);
      call.aborted = true;
      call.reject(signal.reason);
    };
    signal.addEventListener('abort', abort, { once: true });
    call.done = () => signal.removeEventListener('abort', abort);
  }

  /** Begins the next call. Node stays alive while a call runs, but not for an idle worker. */
  #pump() {
    if (this.#running) return;
    const call = this.#running = this.#queue.shift() ?? null;
    for (const part of [this.#port, this.#worker]) part?.[call ? 'ref' : 'unref']?.();
    if (!call) return;
    const { id, name, argument, progress, log } = call;
    try {
      this.#port.postMessage({ id, name, argument, watched: { progress: Boolean(progress), log: Boolean(log) } });
    } catch (error) {
      this.#end(() => call.reject(error));
    }
  }

  #take({ id, stage, share, line, result, failure }) {
    const call = this.#running;
    if (call?.id !== id) return;
    if (stage !== undefined || line !== undefined) {
      if (call.aborted) return;
      if (stage !== undefined) call.progress(stage, share);
      else call.log(line);
    } else this.#end(() => {
      if (failure) call.reject(errorOf(failure));
      else if (call.aborted) call.lost?.(result);
      else call.resolve(result);
    });
  }

  #end(settle) {
    this.#running.done?.();
    this.#running = null;
    settle();
    this.#pump();
  }

  /**
   * For work of which only the latest counts. One `work` of a channel runs at a time. Of those that come
   * meanwhile only the last is run. work() returns a promise. latest() returns one with the same result, or
   * undefined if a later work has replaced this one.
   */
  latest(channel, work) {
    const state = this.#channels.get(channel) ?? { busy: false, next: null };
    this.#channels.set(channel, state);
    return new Promise((resolve, reject) => {
      state.next?.resolve(undefined);
      state.next = { work, resolve, reject };
      if (!state.busy) this.#work(state);
    });
  }

  async #work(state) {
    state.busy = true;
    while (state.next) {
      const { work, resolve, reject } = state.next;
      state.next = null;
      try { resolve(await work()); } catch (error) { reject(error); }
      await null; // whoever waits for that goes on first
    }
    state.busy = false;
  }

  #fail(error) {
    const calls = [this.#running, ...this.#queue].filter(Boolean);
    this.#closed = error;
    this.#running = null;
    this.#queue = [];
    for (const call of calls) { call.done?.(); call.reject(error); }
    this.#port.close();
    this.#worker?.terminate();
  }

  /** Ends the worker with all its objects. Remaining calls are rejected. */
  close() { if (!this.#closed) this.#fail(new Error('this instance has been closed')); }
}
