// The same classes over a worker: methods return promises instead of values.
import { Handle } from './core.js';
import { classesOf } from './instance.js';
import { OBJECT } from './objects.js';
import { Remote } from './remote.js';

const FUNCTIONS = ['boundaryDefects', 'triangulate', 'statusName', 'codeOf'];

// Node and browsers of before 2024 have no Symbol.dispose.
const dispose = Symbol.dispose ?? Symbol.for('Symbol.dispose');

/** Browsers start workers of a page's own host only, so a file of another host is imported by one that the page makes. */
function workerOf(url) {
  if (url.origin === globalThis.location?.origin || url.protocol === 'file:') return new Worker(url, { type: 'module' });
  const program = URL.createObjectURL(new Blob([`import ${JSON.stringify(url.href)};`], { type: 'text/javascript' }));
  return new Worker(program, { type: 'module' });
}

async function workerBeside() {
  if (typeof Worker !== 'undefined') return workerOf(new URL('./worker.js', import.meta.url));
  const { Worker: NodeWorker } = await import('node:worker_threads');
  return new NodeWorker(new URL('./worker.js', import.meta.url));
}

/** An object that lives in the worker. */
class RemoteObject {
  #icc; #number;

  constructor(icc, number) { [this.#icc, this.#number] = [icc, number]; }

  /** The number that is sent in its place. */
  numberFor(icc) {
    if (icc !== this.#icc) throw new TypeError(`this ${this.constructor.name} belongs to another instance`);
    if (this.#number === 0) throw new TypeError(`this ${this.constructor.name} has been freed`);
    return this.#number;
  }

  async request(name, more) {
    return this.#icc.request(name, { object: this.numberFor(this.#icc), ...more }, this);
  }

  /** Frees the memory, after the calls that have begun. */
  free() {
    if (this.#number !== 0) this.#icc.release(this, this.#number);
    this.#number = 0;
  }

  [dispose]() { this.free(); }
}

/** Makes a class of RemoteObjects with the methods and members of one of the library's classes. */
function remoteClassOf(icc, name, Class) {
  const Made = { [name]: class extends RemoteObject {} }[name];
  const own = Object.getOwnPropertyDescriptors(Class.prototype);
  const { dim } = Object.getOwnPropertyDescriptors(Handle.prototype);
  for (const [key, { get }] of Object.entries({ dim, ...own })) {
    if (key === 'constructor') continue;
    Object.defineProperty(Made.prototype, key, get ? { get() { return this.request('get', { key }); } }
      : { value(...args) { return this.request('invoke', { key, args }); } });
  }
  Made.create = (...args) => icc.request('create', { name, args });
  for (const key of Object.getOwnPropertyNames(Class))
    if (typeof Class[key] === 'function' && key !== 'prototype')
      Made[key] = (...args) => icc.request('make', { name, key, args });
  return Made;
}

export class AsyncIcc {
  #remote; #classes; #now = {}; #registry;

  constructor(remote) {
    this.#remote = remote;
    this.#registry = new FinalizationRegistry((number) => this.#free(number));
    const pairs = Object.entries(classesOf(null)).map(([name, Class]) => [name, remoteClassOf(this, name, Class)]);
    this.#classes = Object.fromEntries(pairs);
    Object.assign(this, this.#classes);
    for (const key of FUNCTIONS) this[key] = (...args) => this.request('run', { key, args });
  }

  /** source: as for load(). worker: one that runs the package's worker.js, if that is not beside this file. */
  static async start({ source, worker } = {}) {
    return new AsyncIcc(await Remote.start(worker ?? await workerBeside(), source));
  }

  get stops() { return this.#remote.stops; }

  /** Watches the calls that `work` begins before it waits for any. They call progress(stage, share) and
   *  log(line), and an AbortSignal cancels them. */
  during(env, work) {
    const before = this.#now;
    this.#now = env;
    try { return work(); } finally { this.#now = before; }
  }

  /** See Remote.latest(). */
  latest(channel, work) { return this.#remote.latest(channel, work); }

  close() { this.#remote.close(); }

  /** Sends a call. Objects are passed by their numbers. `self` is the object that is called. */
  async request(name, argument, self = null) {
    const known = { self, object: argument.object };
    const lost = (result) => {
      const made = this.#received(result, known);
      if (made !== self) made?.free?.();
    };
    const args = argument.args?.map((value) => this.#sent(value));
    const result = await this.#remote.call(name, { ...argument, ...(args && { args }) }, { ...this.#now, lost });
    return this.#received(result, known);
  }

  #sent(value) {
    if (value instanceof RemoteObject) return { [OBJECT]: value.numberFor(this) };
    return Array.isArray(value) && value[0] instanceof RemoteObject ? value.map((v) => this.#sent(v)) : value;
  }

  #received(value, known) {
    if (value === null || typeof value !== 'object' || Object.getPrototypeOf(value) !== Object.prototype) return value;
    const { [OBJECT]: object, name } = value;
    if (object === undefined)
      return Object.fromEntries(Object.entries(value).map(([key, member]) => [key, this.#received(member, known)]));
    if (known.self && known.object === object) return known.self;
    const made = new this.#classes[name](this, object);
    this.#registry.register(made, object, made);
    return made;
  }

  #free(number) { this.#remote.call('free', { object: number }).catch(() => {}); }

  release(object, number) {
    this.#registry.unregister(object);
    this.#free(number);
  }
}
