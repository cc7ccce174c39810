// Describes the C interface for the binding: constants, functions and layouts of structs, as icc/api.json has them. The
// compiler confirms the layouts.
// usage: node describe.js INCLUDE OUTPUT COMPILER [FLAG ...]
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';

const [include, output, compiler, ...flags] = process.argv.slice(2);
const MODEL = 'ilp32';
const api = JSON.parse(fs.readFileSync(`${include}/icc/api.json`, 'utf8'));
const mapped = (object, convert) =>
  Object.fromEntries(Object.entries(object).map(([key, item]) => [key, convert(item)]));

// "const double *" -> "const double*"
const type = (text) => text.replace(/\s*\*\s*/g, '*').trim();
const member = (m) => [m.offset[MODEL], type(m.type) + (m.length ? `[${m.length}]` : '')];

const constants = Object.assign({}, ...Object.values(api.enums).map((item) => item.values));
const functions = mapped(api.functions, (f) => [type(f.returns), f.parameters.map((p) => [p.name, type(p.type)])]);
const structs = mapped(api.structs, (s) => ({
  size: s.size[MODEL], members: Object.fromEntries(s.members.map((m) => [m.name, member(m)])),
}));

// Members that hold a number of an enumeration: struct, member, prefix of the constants.
const enumerations = Object.entries(api.structs).flatMap(([name, s]) => s.members.filter((m) => m.enum)
  .map((m) => [name, m.name, api.enums[m.enum].prefix]));

const same = (is, value) => `_Static_assert(${is} == ${value}, "${is}");`;
const source = ['#include <icc/icc.h>', ...Object.entries(structs).flatMap(([name, s]) => [
  same(`sizeof(${name})`, s.size),
  ...Object.entries(s.members).map(([key, [offset]]) => same(`offsetof(${name}, ${key})`, offset)),
])].join('\n');
execFileSync(compiler, [...flags, `-I${include}`, '-fsyntax-only', '-x', 'c', '-'], { input: source, encoding: 'utf8' });

const json = (value) => JSON.stringify(value).replaceAll('],"', '],\n"').replaceAll('}},"', '}},\n"');
fs.writeFileSync(output, `// Made by tools/describe.js from icc/api.json.
export const constants = ${json(constants).replaceAll(',"', ',\n"')};
export const functions = ${json(functions)};
export const structs = ${json(structs)};
export const enumerations = ${json(enumerations)};
`);
