// Declares options and infos for TypeScript: the structs of C as icc/api.json lists them, with the headers' comments.
// usage: node types.js INCLUDE OUTPUT
import fs from 'node:fs';

const [include, output] = process.argv.slice(2);
const api = JSON.parse(fs.readFileSync(`${include}/icc/api.json`, 'utf8'));
// Structs that the methods build by themselves.
const INTERNAL = ['icc_env', 'icc_error', 'icc_mesh', 'icc_picture', 'icc_field', 'icc_feature', 'icc_constraint', 'icc_nearest_options',
  'icc_layer', 'icc_coverage_options', 'icc_coverage_difference'];
// Structs that the caller fills in.
const INPUTS = { icc_tie: 'TieInput', icc_line: 'LineInput' };

const camel = (name) => name.replace(/_(\w)/g, (_, letter) => letter.toUpperCase());
const className = (name) => INPUTS[name] ?? camel(name.slice('icc'.length));
const isInput = (name) => name in INPUTS || name.endsWith('_options');

/** The text of a comment of a header, in lines. */
const linesOf = (comment) => comment.split('\n').map((line) => line.replace(/^\s*\*?\s*/, '').trimEnd()).join('\n').trim().split('\n');
const jsdoc = (comment, indent) => {
  if (!comment) return '';
  const lines = linesOf(comment);
  return lines.length === 1 ? `${indent}/** ${lines[0]} */\n` : `${indent}/**\n${lines.map((line) => `${indent} * ${line}\n`).join('')}${indent} */\n`;
};

/** The comments of a struct in its header, and of its members. */
function commentsOf(name, { header }) {
  const text = fs.readFileSync(`${include}/icc/${header}`, 'utf8');
  const found = new RegExp(`(?:/\\*\\*(?<doc>(?:(?!\\*/)[^])*)\\*/\\s*)?typedef struct ${name} \\{(?<body>[^]*?)\\n\\}`).exec(text);
  if (!found) throw new Error(`${header} has no struct ${name}`);
  const members = {}, pattern = /(?:\/\*\*(?!<)((?:(?!\*\/)[^])*)\*\/\s*)?([^;/]+;)(?:\s*\/\*\*<((?:(?!\*\/)[^])*)\*\/)?/g;
  for (const [, above, declaration, behind] of found.groups.body.matchAll(pattern))
    members[/(\w+)(?:\[\w+\])?;$/.exec(declaration)[1]] = above ?? behind;
  return { doc: found.groups.doc, members };
}

function wordsOf(name) {
  const { prefix, values } = api.enums[name];
  return Object.keys(values).filter((key) => key.startsWith(prefix)).map((key) => `'${key.slice(prefix.length).toLowerCase()}'`).join(' | ');
}

function typeOf({ type, enum: words, length }, input) {
  const plain = type.replace(/^const /, '').replace(/^struct /, '').trim();
  if (words) return input ? `${wordsOf(words)} | number` : [...new Set([...wordsOf(words).split(' | '), "'none'"])].join(' | ');
  if (plain === 'char') return 'string';
  if (length) return input ? 'readonly number[]' : 'number[]';
  if (plain.endsWith('*')) {
    const element = plain.slice(0, -1).trim();
    if (element === 'double') return 'Points';
    if (element === 'uint32_t' || element === 'int32_t') return 'Indices';
    if (element.endsWith('_options')) return className(element);
    if (INPUTS[element]) return `readonly ${className(element)}[]`;
    throw new Error(`a member of type ${type} has no type in TypeScript`);
  }
  return plain === 'uint64_t' && input ? 'number | bigint' : 'number';
}

function declarationOf([name, struct]) {
  const input = isInput(name), { doc, members } = commentsOf(name, struct), names = struct.members.map((member) => member.name);
  const counts = (member) => member.startsWith('n_') && names.includes(member.slice(2)); // lengths of arrays
  const lines = struct.members.filter((member) => member.name !== 'size' && !(input ? counts(member.name) : member.type.includes('*')))
    .map((member) => jsdoc(members[member.name], '  ')
      + `  ${input ? '' : 'readonly '}${camel(member.name)}${input ? '?' : ''}: ${typeOf(member, input)}${input ? ' | null | undefined' : ''};\n`);
  return `${jsdoc(doc, '')}export interface ${className(name)} {\n${lines.join('')}}\n`;
}

const declarations = Object.entries(api.structs).filter(([name]) => !INTERNAL.includes(name)).map(declarationOf);
fs.writeFileSync(output, `// Made by tools/types.js from icc/api.json and the headers.
import type { Indices, Points } from './index.js';

${declarations.join('\n')}`);
