// The memory of an instance: arguments of calls, and structs in both directions.
import { structs as layouts } from './layouts.js';
import { IccError } from './error.js';
import { camel, numberOf, textOf } from './names.js';
import { numbersOf } from './points.js';

/** The layouts, with the members' names in camel case. */
const structs = Object.fromEntries(Object.entries(layouts).map(([name, { size, members }]) => [name,
  { size, members: Object.fromEntries(Object.entries(members).map(([key, at]) => [camel(key), at])) }]));

const ARENA_BYTES = 1 << 16;
const ALIGN = 8;
const OUT_OF_MEMORY = 2;

/** The typed array for a C type; void means bytes. */
const ARRAYS = {
  double: Float64Array, int32_t: Int32Array, icc_status: Int32Array, uint32_t: Uint32Array,
  size_t: Uint32Array, int64_t: BigInt64Array, uint8_t: Uint8Array, void: Uint8Array,
};

/** The typed array for what a type of C points to, or undefined for structs and handles. */
export const arrayOf = (type) => ARRAYS[pointee(type)];

const LARGEST = { int32_t: 2 ** 31 - 1, icc_status: 2 ** 31 - 1, uint32_t: 2 ** 32 - 1, size_t: 2 ** 32 - 1 };

/** A number as C takes it. Refuses what the type cannot hold; it would become another number without a word. */
export function numeric(type, value, what) {
  const number = typeof value === 'boolean' ? Number(value) : value;
  const most = LARGEST[type], least = type === 'int32_t' || type === 'icc_status' ? -most - 1 : 0;
  if (typeof number !== 'number') throw new TypeError(`${what} is ${String(value)}, but has to be a number`);
  if (most !== undefined && !(Number.isInteger(number) && number >= least && number <= most))
    throw new TypeError(`${what} is ${value}, but has to be a whole number from ${least} to ${most}`);
  return number;
}

/** An address from C. A plain number is never used as an address. */
export class Address {
  constructor(value) { this.value = value; }
}

/** "const double*" -> "double". */
export const pointee = (type) => type.replace(/^const /, '').replace(/(const)?\*$/, '').trim();

export class Memory {
  #c; #arena; #used = 0; #taken = []; #depth = 0; #view; #text = new TextDecoder();

  constructor(exports) {
    this.#c = exports;
    this.#arena = exports.malloc(ARENA_BYTES);
    this.#view = new DataView(exports.memory.buffer);
  }

  /** A view of all memory; made again after it has grown. */
  get view() {
    if (this.#view.buffer !== this.#c.memory.buffer) this.#view = new DataView(this.#c.memory.buffer);
    return this.#view;
  }

  array(Type, at, n) { return new Type(this.#c.memory.buffer, at, n); }

  /** Runs `work` and then frees what it has allocated. Small things come from an arena. */
  scope(work) {
    const used = this.#used, taken = this.#taken.length;
    ++this.#depth;
    try {
      return work();
    } finally {
      this.#used = used;
      while (this.#taken.length > taken) this.#c.free(this.#taken.pop());
      --this.#depth;
    }
  }

  take(bytes) {
    if (this.#depth === 0) throw new TypeError('memory is taken within a scope only');
    const rounded = Math.ceil(Math.max(bytes, 1) / ALIGN) * ALIGN;
    if (this.#used + rounded <= ARENA_BYTES) {
      const at = this.#arena + this.#used;
      this.#used += rounded;
      return at;
    }
    const at = this.#c.malloc(rounded) >>> 0;
    if (at === 0) throw new IccError(OUT_OF_MEMORY, { message: `there are no ${bytes} bytes of memory` });
    this.#taken.push(at);
    return at;
  }

  /** Copies an argument that C gets a pointer to: numbers, objects (structs) or handles. */
  put(type, value) {
    if (value === null || value === undefined) return 0;
    if (typeof value !== 'object') throw new TypeError(`${value} is no array, and no object`);
    const element = pointee(type);
    if (structs[element]) return this.#putStructs(element, Array.isArray(value) ? value : [value]);
    const Type = ARRAYS[element];
    const values = value instanceof Type ? value : Type === BigInt64Array ? Type.from(numbersOf(value), BigInt)
      : Type.from(Type === Uint8Array && Array.isArray(value) ? value.flat() : numbersOf(value));
    const at = this.take(values.byteLength);
    this.array(Type, at, values.length).set(values);
    return at;
  }

  #putStructs(name, values) {
    const { size } = structs[name];
    const at = this.take(size * values.length);
    this.array(Uint8Array, at, size * values.length).fill(0);
    values.forEach((value, i) => this.#putStruct(name, at + i * size, value));
    return at;
  }

  #putStruct(name, at, value) {
    const { size, members } = structs[name];
    if (members.size) this.view.setUint32(at, size, true);
    for (const [key, item] of Object.entries(value)) {
      if (item === undefined || item === null) continue;
      if (key === 'size' || !members[key]) {
        const known = Object.keys(members).filter((member) => member !== 'size');
        throw new TypeError(`${name} has no member ${key}, only ${known.join(', ')}`);
      }
      const [offset, type] = members[key];
      this.#putMember(type, at + offset, numberOf(name, key, item), `${name}.${key}`);
    }
  }

  #putMember(type, at, value, what) {
    const array = /^(\w+)\[(\d+)\]$/.exec(type);
    if (array) {
      const Type = ARRAYS[array[1]];
      this.array(Type, at, Number(array[2])).set(value);
    } else if (type.endsWith('*')) {
      const pointer = value instanceof Address ? value.value : this.put(type, value); // memory may grow here
      this.view.setUint32(at, pointer, true);
    } else if (type === 'double') this.view.setFloat64(at, numeric(type, value, what), true);
    else if (type === 'uint64_t') this.view.setBigUint64(at, BigInt(value), true);
    else if (type === 'int64_t') this.view.setBigInt64(at, BigInt(value), true);
    else this.view.setInt32(at, numeric(type, value, what), true);
  }

  /** The members of a struct that C has filled in; pointers are left out. */
  read(name, at) {
    const out = {};
    for (const [key, [offset, type]] of Object.entries(structs[name].members))
      if (key !== 'size' && !type.includes('*')) out[key] = textOf(name, key, this.#readMember(type, at + offset));
    return out;
  }

  #readMember(type, at) {
    const array = /^(\w+)\[(\d+)\]$/.exec(type);
    if (array?.[1] === 'char') return this.string(at);
    if (array) return Array.from(this.array(ARRAYS[array[1]], at, Number(array[2])), Number);
    switch (type) {
      case 'double': return this.view.getFloat64(at, true);
      case 'int64_t': return Number(this.view.getBigInt64(at, true));
      case 'uint64_t': return Number(this.view.getBigUint64(at, true));
      case 'size_t': case 'uint32_t': return this.view.getUint32(at, true);
      default: return this.view.getInt32(at, true);
    }
  }

  string(at) {
    const bytes = this.array(Uint8Array, at, this.#c.memory.buffer.byteLength - at);
    return this.#text.decode(bytes.slice(0, bytes.indexOf(0)));
  }

  /** Copies back what C has written into an argument that it got a pointer to. */
  get(type, at, value) {
    const element = pointee(type);
    if (structs[element]) this.#getStruct(element, at, value);
    else value.set(this.array(value.constructor, at, value.length));
  }

  /** Copies back the members of a struct, and the arrays that it points to. */
  #getStruct(name, at, value) {
    Object.assign(value, this.read(name, at));
    for (const [key, [offset, type]] of Object.entries(structs[name].members)) {
      const out = value[key];
      if (type.endsWith('*') && !type.startsWith('const ') && ArrayBuffer.isView(out))
        out.set(this.array(out.constructor, this.view.getUint32(at + offset, true), out.length));
    }
  }

  /** True if a pointer of this type points to the caller's values, which are copied. */
  static copies(type) {
    const element = pointee(type);
    return Boolean(ARRAYS[element] || structs[element] || element.endsWith('*'));
  }
}
