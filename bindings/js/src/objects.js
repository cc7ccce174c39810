// The operations behind async.js: the classes of an instance, and objects by number.
import { Handle } from './core.js';

/** The member of a value that is sent in place of an object. Values of users do not have it. */
export const OBJECT = 'libicc:object';

const isPlain = (value) => value !== null && typeof value === 'object' && Object.getPrototypeOf(value) === Object.prototype;
const mapped = (object, f) => Object.fromEntries(Object.entries(object).map(([key, value]) => [key, f(value)]));

export function objectOperations(icc) {
  const objects = new Map(), numbers = new WeakMap();
  let next = 0;

  function numberOf(object) {
    if (!numbers.has(object)) {
      numbers.set(object, ++next);
      objects.set(next, object);
    }
    return numbers.get(object);
  }

  /** Prepares a value for sending: objects, also those among the members of a plain one, become numbers. */
  function sent(value) {
    if (value instanceof Handle || value instanceof icc.Pose)
      return { [OBJECT]: numberOf(value), name: value.constructor.name };
    return isPlain(value) ? mapped(value, sent) : value;
  }

  function objectOf(number) {
    const object = objects.get(number);
    if (object === undefined) throw new TypeError('this object has been freed');
    return object;
  }

  const got = (value) => {
    if (isPlain(value) && value[OBJECT] !== undefined) return objectOf(value[OBJECT]);
    return Array.isArray(value) && isPlain(value[0]) && value[0][OBJECT] !== undefined ? value.map(got) : value;
  };
  const kept = (value) => (ArrayBuffer.isView(value) ? value.slice() : value);

  return {
    create: ({ name, args }) => sent(new icc[name](...args.map(got))),
    make: ({ name, key, args }) => sent(icc[name][key](...args.map(got))),
    invoke: ({ object, key, args }) => sent(objectOf(object)[key](...args.map(got))),
    get: ({ object, key }) => sent(kept(objectOf(object)[key])),
    run: ({ key, args }) => icc[key](...args.map(got)),
    free({ object }) {
      objects.get(object)?.free?.();
      objects.delete(object);
    },
  };
}
