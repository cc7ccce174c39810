// Progress, diagnostics and cancelling of calls: the callbacks of icc_env.
const I32 = 0x7f, F64 = 0x7c;
const text = (word) => [word.length, ...new TextEncoder().encode(word)];

/** Turns a JavaScript function into a WebAssembly one, because C's table of functions takes no others. The result is a
 *  module that imports and exports it. See the WebAssembly specification, section 5.5. */
function callable(parameters, results, work) {
  const section = (id, ...content) => [id, content.length, ...content];
  const bytes = [0, ...new TextEncoder().encode('asm'), 1, 0, 0, 0,
    ...section(1, 1, 0x60, parameters.length, ...parameters, results.length, ...results),
    ...section(2, 1, ...text('e'), ...text('f'), 0, 0), ...section(7, 1, ...text('f'), 0, 0)];
  return new WebAssembly.Instance(new WebAssembly.Module(Uint8Array.from(bytes)), { e: { f: work } }).exports.f;
}

export class Env {
  #memory; #table; #slots = null; #now = null; #address = 0; #thrown = null;

  constructor(exports, memory) {
    this.#memory = memory;
    this.#table = exports.__indirect_function_table;
  }

  /** The env of a call. */
  get address() { return this.#address; }

  /**
   * Runs `work`. The calls in it call progress(stage, share) and log(line). They are cancelled if progress
   * returns true, if an AbortSignal is aborted, or if a callback throws. The call then throws that error.
   */
  during({ progress = null, log = null, signal = null }, work) {
    signal?.throwIfAborted();
    return this.#memory.scope(() => {
      const before = [this.#now, this.#address];
      const slots = this.#slots ??= this.#makeSlots();
      this.#now = { progress, log, signal };
      this.#address = this.#memory.put('icc_env*', { progress: slots.progress, log: log === null ? 0 : slots.log });
      try {
        const result = work();
        this.rethrow();
        return result;
      } finally {
        this.#thrown = null;
        [this.#now, this.#address] = before;
      }
    });
  }

  /** Throws the error that a callback has thrown. */
  rethrow() {
    if (this.#thrown === null) return;
    const { error } = this.#thrown;
    this.#thrown = null;
    throw error;
  }

  #makeSlots() {
    const at = this.#table.grow(2), string = (address) => this.#memory.string(address);
    this.#table.set(at, callable([I32, I32, F64], [I32], (_, stage, share) => this.#ask(({ progress, signal }) => {
      signal?.throwIfAborted();
      return progress?.(string(stage), share) === true;
    })));
    this.#table.set(at + 1, callable([I32, I32], [], (_, line) => { this.#ask(({ log }) => log(string(line))); }));
    return { progress: at, log: at + 1 };
  }

  /** True if the call is to be cancelled. No error passes through C. Calls inside a callback report nothing. */
  #ask(callback) {
    if (this.#thrown !== null) return 1;
    const before = [this.#now, this.#address], [now] = before;
    [this.#now, this.#address] = [null, 0];
    try {
      return Number(callback(now));
    } catch (error) {
      this.#thrown = { error };
      return 1;
    } finally {
      [this.#now, this.#address] = before;
    }
  }
}
