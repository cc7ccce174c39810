// Runs a WebAssembly command with the arguments given, as a program of this machine.
import fs from 'node:fs';
import { WASI } from 'node:wasi';

const [file, ...args] = process.argv.slice(2);
const wasi = new WASI({ version: 'preview1', args: [file, ...args], preopens: { '/': '/', '.': '.' } });
const module = await WebAssembly.compile(fs.readFileSync(file));
process.exit(wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject())));
