// Calls C functions by their declarations, and owns the objects of C.
import { Env } from './env.js';
import { IccError } from './error.js';
import { functions } from './layouts.js';
import { Address, Memory, arrayOf, numeric, pointee } from './memory.js';

const isCreated = ([name, type]) => name === 'out' && type.endsWith('**');
const isImplicit = (parameter) => isCreated(parameter) || parameter[0] === 'env' || parameter[0] === 'err';
/** Marks an argument that the call writes to: it is copied back. */
const isWritten = (type) => type.endsWith('*') && !type.startsWith('const ');

/** Refuses an argument that C would write to, but that cannot receive what C writes. */
function checkWritten({ type, key }, value, name) {
  const Type = arrayOf(type);
  if (value === null || value === undefined || Type === undefined || value instanceof Type) return;
  if (Type === Uint8Array && value instanceof Uint8ClampedArray) return;
  throw new TypeError(`${name}: ${key} must be a ${Type.name}`);
}

/** How the arguments of a function are passed; computed on its first call. */
function plan(name) {
  const [result, parameters] = functions[name];
  return {
    result,
    steps: parameters.map(([key, type]) => ({
      key, type, implicit: isImplicit([key, type]), copied: type.endsWith('*') && Memory.copies(type),
      written: isWritten(type), handle: /^(const )?icc_\w+\*$/.test(type) && !Memory.copies(type),
      handles: /^(const )?icc_\w+\*(const)?\*$/.test(type), kind: pointee(type).replace(/(const)?\*$/, ''),
    })),
  };
}

export class Core {
  #c; #plans = new Map(); #registry = new FinalizationRegistry((drop) => drop());

  constructor(exports) {
    this.#c = exports;
    this.memory = new Memory(exports);
    this.env = new Env(exports, this.memory);
  }

  /** Bytes of memory that the instance has. */
  get bytes() { return this.#c.memory.buffer.byteLength; }

  /**
   * Calls a C function. Its arguments are those of C without `out`, `env` and `err`: numbers, handles,
   * typed arrays and objects for structs; arrays and objects that C writes to are written to. Throws
   * IccError unless the status is OK. Returns the address that a creator wrote, or what C returned.
   */
  call(name, ...args) {
    let p = this.#plans.get(name);
    if (!p) this.#plans.set(name, p = plan(name));
    return this.memory.scope(() => this.#run(name, p, args));
  }

  #run(name, { result, steps }, args) {
    const m = this.memory;
    const written = [];
    let next = 0, created = 0, failure = 0;
    const values = steps.map((step) => {
      if (step.implicit) {
        if (step.key === 'out') return created = m.put('uint32_t*', [0]);
        return step.key === 'err' ? failure = m.put('icc_error*', {}) : this.env.address;
      }
      const value = args[next++];
      if (step.handle) return this.#addressOf(name, step, value);
      if (step.handles) return m.put('uint32_t*', Uint32Array.from(value, (v) => this.#addressOf(name, step, v)));
      if (!step.copied) return step.type === 'uint64_t' ? BigInt(value) : numeric(step.type, value, `${name}: ${step.key}`);
      if (step.written) checkWritten(step, value, name);
      const at = m.put(step.type, value);
      if (step.written && at !== 0) written.push([step.type, at, value]);
      return at;
    });
    const returned = this.#c[name](...values);
    if (result !== 'icc_status') return returned;
    if (returned !== 0) this.env.rethrow();
    if (returned !== 0) throw new IccError(returned, failure === 0 ? {} : m.read('icc_error', failure));
    for (const [type, at, value] of written) m.get(type, at, value);
    return created === 0 ? undefined : m.view.getUint32(created, true);
  }

  /** The address of an argument that is an object of C. It must have the right class and belong to this instance. */
  #addressOf(name, { key, kind }, value) {
    if (value === null || value === undefined) return 0;
    if (value.kind === kind && value.core === this) return value.address;
    const given = value instanceof Handle ? `a ${value.constructor.name}` : String(value);
    throw new TypeError(`${name}: ${key} is ${given}${value.kind === kind ? ' of another instance' : `, but has to be of ${kind}`}`);
  }

  /** Calls a creator, for the constructor of a Handle. */
  made(name, ...args) { return new Address(this.call(name, ...args)); }

  /** Returns the members that a function such as icc_map_get_info() fills in. */
  info(name, ...args) {
    const out = {};
    this.call(name, ...args, out);
    return out;
  }

  /** Returns the bytes that a function such as icc_map_save() writes in two calls. */
  save(name, handle) {
    const size = new Uint32Array(1);
    this.call(name, handle, 0, null, size);
    const data = new Uint8Array(size[0]);
    this.call(name, handle, data.length, data, size);
    return data;
  }

  /** Frees `address` by `free` when `owner` is collected, unless forget(owner) comes first. */
  own(owner, free, address) { this.#registry.register(owner, () => this.#c[free](address), owner); }
  forget(owner) { this.#registry.unregister(owner); }
  release(free, address) { this.#c[free](address); }
}

// Node and browsers of before 2024 have no Symbol.dispose.
const dispose = Symbol.dispose ?? Symbol.for('Symbol.dispose');

/** An object of C. If it is owned, free() frees it, or the garbage collector does. If it is borrowed from another
 *  object, it keeps that one alive. */
export class Handle {
  #core; #address; #free; #lender; #kind; #dim;

  /** first: an Address, or the first argument of `create`. */
  constructor(core, first, create, free, lender = null) {
    const address = first instanceof Address ? first.value : create();
    this.#core = core;
    this.#address = address;
    this.#free = free;
    this.#lender = lender;
    this.#kind = free.slice(0, -'_free'.length);
    if (lender === null) core.own(this, free, address);
  }

  get core() { return this.#core; }

  /** The type in C. */
  get kind() { return this.#kind; }

  /** The dimension, of classes that have an info; read once. */
  get dim() { return (this.#dim ??= this.info.dim); }

  get address() {
    if (this.#address === 0) throw new TypeError(`this ${this.constructor.name} has been freed`);
    if (this.#lender !== null) void this.#lender.address;
    return this.#address;
  }

  /** Frees the memory now. Objects that were made from this one stay. */
  free() {
    if (this.#address === 0) return;
    if (this.#lender === null) {
      this.#core.forget(this);
      this.#core.release(this.#free, this.#address);
    }
    this.#address = 0;
  }

  [dispose]() { this.free(); }
}

/** An array of n doubles: the caller's `out`, or a new one. */
export const room = (out, n) => optional(out, n, 'out') ?? new Float64Array(n);

/** The caller's array that receives n numbers, or null if there is none. `what` names it in messages. */
export function optional(array, n, what, Type = Float64Array) {
  if (array === undefined || array === null) return null;
  if (array instanceof Type && array.length === n) return array;
  const given = ArrayBuffer.isView(array) || Array.isArray(array) ? `a ${array.constructor.name} of length ${array.length}` : String(array);
  throw new TypeError(`${what} must be a ${Type.name} of length ${n}, not ${given}`);
}
