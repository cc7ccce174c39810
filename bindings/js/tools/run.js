// Runs a WebAssembly command with the arguments given, as a program of this machine. It sees the current
// folder, and those of arguments that are absolute paths.
import fs from 'node:fs';
import path from 'node:path';
import v8 from 'node:v8';
import { WASI } from 'node:wasi';

// Node 20 drops the bytecode of what waits for a program that runs for a minute, and ends in a segmentation fault then.
v8.setFlagsFromString('--no-flush-bytecode');
const [file, ...args] = process.argv.slice(2);
const folders = args.filter((arg) => path.isAbsolute(arg)).flatMap((arg) => [arg, path.dirname(arg)])
  .filter((folder) => fs.existsSync(folder) && fs.statSync(folder).isDirectory());
const preopens = { '.': '.', ...Object.fromEntries(folders.map((folder) => [folder, folder])) };
const wasi = new WASI({ version: 'preview1', args: [file, ...args], env: process.env, preopens });
const module = await WebAssembly.compile(fs.readFileSync(file));
process.exit(wasi.start(await WebAssembly.instantiate(module, wasi.getImportObject())));
