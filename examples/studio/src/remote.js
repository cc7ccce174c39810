// The engine in a worker that is made from the page's own text, so that it works from file://, too.
// Where there are no workers it runs on the main thread.
import { startEngine } from './engine.js';

export class Remote {
  #send; #waiting = new Map(); #next = 0; #channels = new Map(); #failed;

  /** module: a WebAssembly.Module; text: the program; failed: told of what nobody foresaw. */
  static async start(module, text, failed) {
    const remote = new Remote();
    remote.#failed = failed;
    try {
      remote.#useWorker(module, text);
      await remote.call('version');
      remote.place = 'worker';
    } catch {
      const run = await startEngine(module);
      remote.#send = async ({ id, name, args }) => remote.#take({ id, result: run(name, args) });
      remote.place = 'page';
    }
    return remote;
  }

  #useWorker(module, text) {
    const url = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
    const worker = new Worker(url);
    worker.onmessage = ({ data }) => this.#take(data);
    worker.onerror = (event) => {
      event.preventDefault();
      for (const { reject } of this.#waiting.values()) reject(new Error(event.message));
      this.#waiting.clear();
    };
    worker.postMessage({ module });
    this.#send = (message) => worker.postMessage(message);
  }

  #take({ id, result, failure }) {
    const { resolve, reject } = this.#waiting.get(id) ?? {};
    this.#waiting.delete(id);
    if (failure) {
      this.#failed?.(failure);
      reject?.(new Error(failure));
    } else resolve?.(result);
  }

  /** The result of an operation. */
  call(name, args = {}) {
    const id = ++this.#next;
    return new Promise((resolve, reject) => {
      this.#waiting.set(id, { resolve, reject });
      this.#send({ id, name, args });
    });
  }

  /**
   * The same where only the latest counts: one call of a channel is under way at a time, and of those
   * that come meanwhile only the last is made. `take` gets each result.
   */
  latest(channel, name, args, take) {
    const state = this.#channels.get(channel) ?? { busy: false, next: null };
    this.#channels.set(channel, state);
    state.next = { name, args, take };
    if (!state.busy) this.#pump(state);
  }

  /** Forgets what a channel has not begun yet. */
  drop(channel) { const state = this.#channels.get(channel); if (state) state.next = null; }

  async #pump(state) {
    state.busy = true;
    while (state.next) {
      const { name, args, take } = state.next;
      state.next = null;
      try { take(await this.call(name, args)); } catch (error) { this.#failed?.(String(error)); }
    }
    state.busy = false;
  }
}
