// Joins the studio and the npm package into one HTML file that opens from disk: no bundler is needed.
// usage: node build.js PACKAGE OUTPUT
//
// Every module becomes a function that gives what it exports; imports become lookups among those before
// it. The WebAssembly module is gzipped and in base64.
import fs from 'node:fs';
import path from 'node:path';
import zlib from 'node:zlib';

const [packaged, output] = process.argv.slice(2);
const here = path.dirname(new URL(import.meta.url).pathname);
const entry = path.join(here, 'src/main.js');
// Sampled fields, the chain of solids and GeoJSON took 25,000 of these.
const LIMIT_BYTES = 1_142_000;

const names = (list) => list.split(',').map((s) => s.trim()).filter(Boolean);
const locate = (file, from) => (from === 'libicc' ? path.join(packaged, 'src/index.js')
  : path.resolve(path.dirname(file), from));
const modules = new Map();

/** Adds a module after those that it imports; its number. */
function add(file, above = []) {
  if (above.includes(file)) throw new Error(`${file} imports itself: ${above.join(', ')}`);
  if (modules.has(file)) return modules.get(file).number;
  const exported = [];
  const of = (from) => `$${add(locate(file, from), [...above, file])}`;
  const code = fs.readFileSync(file, 'utf8')
    .replace(/^import \{([^}]*)\} from '([^']+)';$/gm, (_, list, from) =>
      `const {${names(list).map((s) => s.replace(/ as /, ': ')).join(', ')}} = ${of(from)};`)
    .replace(/^export \{([^}]*)\} from '([^']+)';$/gm, (_, list, from) => {
      exported.push(...names(list).map((s) => `${s}: ${of(from)}.${s}`));
      return '';
    })
    .replace(/^export \{([^}]*)\};$/gm, (_, list) => (exported.push(...names(list)), ''))
    .replace(/^export ((?:async )?function\*?|const|let|class) ([\w$]+)/gm, (_, kind, name) => {
      exported.push(name);
      return `${kind} ${name}`;
    })
    .replaceAll('import.meta.url', 'location.href');
  if (/^(import|export) /m.test(code)) throw new Error(`${file}: an import or export that is not understood`);
  const number = modules.size;
  modules.set(file, { number, text: `const $${number} = (() => {\n${code}\nreturn {${exported.join(', ')}};\n})();` });
  return number;
}

add(entry);
const program = `'use strict';\n${[...modules.values()].map((m) => m.text).join('\n')}`;
const wasm = zlib.gzipSync(fs.readFileSync(path.join(packaged, 'src/libicc.wasm')), { level: 9 });
const read = (name) => fs.readFileSync(path.join(here, 'src', name), 'utf8');
const page = read('index.html')
  .replace('/*style*/', () => read('style.css'))
  .replace('/*wasm*/', () => wasm.toString('base64'))
  .replace('/*program*/', () => program.replaceAll('</script', '<\\/script'));
if (page.length > LIMIT_BYTES) throw new Error(`${page.length} bytes are more than ${LIMIT_BYTES}`);
fs.writeFileSync(output, page);
console.log(`${output}: ${page.length} bytes`);
