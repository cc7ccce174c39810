// Describes the C interface for the binding: constants and functions as the headers declare them, and
// the layouts of structs as the compiler lays them out, so that no offset is written by hand.
// usage: node describe.js INCLUDE OUTPUT COMPILER [FLAG ...]
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';

const [include, output, compiler, ...flags] = process.argv.slice(2);
const headers = ['base', 'map', 'chart', 'stages', 'kernel'].map((name) => `icc/${name}.h`);
const text = headers.map((name) => fs.readFileSync(`${include}/${name}`, 'utf8')).join('\n')
  .replace(/\/\*[^]*?\*\//g, ' ');

const all = (pattern) => [...text.matchAll(pattern)];

// enum { ICC_NAME = 1, ... }
const constants = {};
for (const [, name, value] of all(/\b(ICC_[A-Z0-9_]+) = (\d+)\b/g)) constants[name] = Number(value);

// "const double *points" -> "const double *"
const type = (parameter) => parameter.replace(/\b\w+(\[\d*\])?\s*$/, (_, array) => (array ? '*' : ''))
  .replace(/\s+/g, ' ').replace(/\s*\*\s*/g, '*').trim();
const parameterName = (parameter) => /(\w+)(\[\d*\])?\s*$/.exec(parameter)[1];

const functions = {};
for (const [, result, name, list] of all(/\bICC_API ([\w\s*]*?)(icc_\w+)\(([^)]*)\);/g)) {
  const parameters = list.trim() === 'void' ? [] : list.split(',');
  functions[name] = [result.replace(/\s+/g, ' ').replace(/\s*\*\s*/g, '*').trim(),
    parameters.map((p) => [parameterName(p), type(p)])];
}

// The compiler prints the layout of every struct whose size it is asked for.
const names = all(/typedef struct (icc_\w+) \{/g).map(([, name]) => name);
const source = [...headers.map((name) => `#include <${name}>`),
  ...names.map((name) => `char size_of_${name}[sizeof(${name})];`)].join('\n');
const dump = execFileSync(compiler, [...flags, `-I${include}`, '-fsyntax-only', '-Xclang',
  '-fdump-record-layouts', '-x', 'c', '-'], { input: source, encoding: 'utf8' });

const structs = {};
let struct = null;
for (const line of dump.split('\n')) {
  let found;
  if ((found = /^\s*0 \| struct (icc_\w+)$/.exec(line))) {
    struct = { size: 0, members: {} };
    structs[found[1]] = struct;
  } else if (struct && (found = /\[sizeof=(\d+)/.exec(line))) {
    struct.size = Number(found[1]);
    struct = null;
  } else if (struct && (found = /^\s*(\d+) \| {3}(\S.*?) (\w+)$/.exec(line))) {
    struct.members[found[3]] = [Number(found[1]), found[2].replace(/\s*\*\s*/g, '*')];
  }
}
for (const name of names)
  if (!structs[name]?.size) throw new Error(`the compiler did not print the layout of ${name}`);

const json = (value) => JSON.stringify(value).replaceAll('],"', '],\n"').replaceAll('}},"', '}},\n"');
fs.writeFileSync(output, `// Made by tools/describe.js from the headers.
export const constants = ${json(constants).replaceAll(',"', ',\n"')};
export const functions = ${json(functions)};
export const structs = ${json(structs)};
`);
