// Names: members in camel case, and words for the numbers of enumerations: 'disc' for ICC_METHOD_DISC.
import { constants } from './layouts.js';

/** "n_mesh_vertices" -> "nMeshVertices". */
export const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());

const enumerations = new Map();

/** The constants with a prefix: number -> name without it. */
export function constantNames(prefix) {
  if (!enumerations.has(prefix))
    enumerations.set(prefix, new Map(Object.entries(constants).filter(([name]) => name.startsWith(prefix))
      .map(([name, value]) => [value, name.slice(prefix.length)])));
  return enumerations.get(prefix);
}

/** Members that hold a number of an enumeration: struct, member, prefix of the constants. */
export const ENUMERATIONS = [
  ['icc_error', 'item', 'ICC_ITEM_'],
  ['icc_feature', 'kind', 'ICC_FEATURE_'], ['icc_feature_info', 'kind', 'ICC_FEATURE_'],
  ['icc_chart_options', 'method', 'ICC_METHOD_'], ['icc_chart_options', 'function', 'ICC_FUNCTION_'],
  ['icc_chart_options', 'tree', 'ICC_TREE_'], ['icc_chart_options', 'constraints', 'ICC_CONSTRAINTS_'],
  ['icc_chart_options', 'solver', 'ICC_SOLVER_'],
  ['icc_chart_info', 'method', 'ICC_METHOD_'], ['icc_chart_info', 'reason', 'ICC_REASON_'],
  ['icc_gradient_info', 'function', 'ICC_FUNCTION_'], ['icc_gradient_info', 'tree', 'ICC_TREE_'],
  ['icc_map_options', 'kind', 'ICC_MAP_'], ['icc_map_info', 'kind', 'ICC_MAP_'],
  ['icc_map_info', 'reason', 'ICC_REASON_'],
  ['icc_picture', 'interpolation', 'ICC_INTERPOLATION_'],
  ['icc_match_options', 'turning', 'ICC_TURNING_'], ['icc_match_options', 'between', 'ICC_BETWEEN_'],
  ['icc_tree_options', 'form', 'ICC_TREE_'],
  ['icc_function_options', 'function', 'ICC_FUNCTION_'],
  ['icc_function_options', 'constraints', 'ICC_CONSTRAINTS_'],
  ['icc_function_options', 'solver', 'ICC_SOLVER_'], ['icc_function_info', 'function', 'ICC_FUNCTION_'],
  ['icc_function_info', 'solver', 'ICC_SOLVER_'], ['icc_grow_report', 'method', 'ICC_GROW_'],
  ['icc_sampling_options', 'kind', 'ICC_SAMPLING_'], ['icc_sampling_info', 'kind', 'ICC_SAMPLING_'],
  ['icc_weights_options', 'kernel', 'ICC_KERNEL_'], ['icc_weights_options', 'initial', 'ICC_INITIAL_'],
  ['icc_weights_options', 'method', 'ICC_WEIGHTS_'], ['icc_weights_info', 'kernel', 'ICC_KERNEL_'],
  ['icc_weights_info', 'initial', 'ICC_INITIAL_'], ['icc_weights_info', 'method', 'ICC_WEIGHTS_'],
];
const PREFIXES = new Map(ENUMERATIONS.map(([struct, member, prefix]) => [`${struct}.${member}`, prefix]));

/** The number of a word of an enumeration: constantOf('ICC_WEIGHTS_', 'qp'). */
export function constantOf(prefix, word) {
  const value = constants[prefix + String(word).toUpperCase()];
  if (value !== undefined) return value;
  const words = [...constantNames(prefix).values()].map((name) => `'${name.toLowerCase()}'`);
  throw new TypeError(`'${word}' is none of ${words.join(', ')}`);
}

/** What C gets for a member's value: of a word, its number. */
export function numberOf(struct, member, value) {
  const prefix = typeof value === 'string' ? PREFIXES.get(`${struct}.${member}`) : undefined;
  return prefix === undefined ? value : constantOf(prefix, value);
}

/** What the caller gets for a member's value: of a number of an enumeration, its word. */
export function textOf(struct, member, value) {
  const prefix = PREFIXES.get(`${struct}.${member}`);
  if (prefix === undefined) return value;
  return constantNames(prefix).get(value)?.toLowerCase() ?? 'none';
}
