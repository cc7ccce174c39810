// Names: members in camel case, and words for the numbers of enumerations: 'disc' for ICC_METHOD_DISC.
import { constants, enumerations } from './layouts.js';

/** "n_mesh_vertices" -> "nMeshVertices". */
export const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

const named = new Map();

/** The constants with a prefix: number -> name without it. */
export function constantNames(prefix) {
  if (!named.has(prefix))
    named.set(prefix, new Map(Object.entries(constants).filter(([name]) => name.startsWith(prefix))
      .map(([name, value]) => [value, name.slice(prefix.length)])));
  return named.get(prefix);
}

const PREFIXES = new Map(enumerations.map(([struct, member, prefix]) => [`${struct}.${member}`, prefix]));

/** The number of a word of an enumeration: constantOf('ICC_WEIGHTS_', 'qp'). */
export function constantOf(prefix, word) {
  const value = constants[prefix + String(word).toUpperCase()];
  if (value !== undefined) return value;
  const words = [...constantNames(prefix).values()].map((name) => `'${name.toLowerCase()}'`);
  throw new TypeError(`'${word}' is none of ${words.join(', ')}`);
}

/** The value of a member for C: words become numbers. */
export function numberOf(struct, member, value) {
  const prefix = typeof value === 'string' ? PREFIXES.get(`${struct}.${member}`) : undefined;
  return prefix === undefined ? value : constantOf(prefix, value);
}

/** The value of a member for the caller: numbers of enumerations become words. */
export function textOf(struct, member, value) {
  const prefix = PREFIXES.get(`${struct}.${member}`);
  if (prefix === undefined) return value;
  return constantNames(prefix).get(value)?.toLowerCase() ?? 'none';
}
