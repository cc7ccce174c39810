// What the page asks of its engine in mode handles, written down while it is used, and what tests/golden/poses.c, a
// program of the native library, gives for the same.
import { execFileSync } from 'node:child_process';

/** Begins to write down. */
export const record = (page) => page.evaluate(() => {
  const { remote } = studio, call = remote.call.bind(remote);
  globalThis.tape = [];
  remote.call = async (name, argument, ...rest) => {
    const result = await call(name, argument, ...rest);
    if (name.startsWith('handles.')) globalThis.tape.push({ name: name.slice(8), argument, result });
    return result;
  };
});

/** The tape as text for the program, the poses that the page had for it, and the errors. In the page: numbers are
 *  written there, so that no sign of a zero is lost. */
function written() {
  const METHODS = { qp: 1, equality: 2, l1: 3 };
  const text = (x) => (Object.is(x, -0) ? '-0' : String(Number(x)));
  const list = (numbers) => [numbers.length, ...numbers].map(text).join(' ');
  const rings = (regions) => list(regions.flatMap((ring) => [2 * ring.length, ...ring.flat()]));
  const changes = (all = []) => list(all.flatMap(({ handle, offset, angle }) => [handle, ...offset, angle]));
  const painting = (number, { handle, radius, amount, rigid, strokes }) =>
    `paint ${[number, handle, radius, amount, rigid].map(text).join(' ')} ${list(strokes.flat())}`;
  const weights = {
    make: ({ number, method, spacing, grid, outline, handles, bones, lines, regions, paintings }) => [
      `make ${[number, METHODS[method], spacing, grid].map(text).join(' ')} ${list(outline.flat())} ${list(handles.flat())} ${
        list(bones.flat())} ${list(lines.flatMap((l) => [...l.from, ...l.to, l.parallel]))} ${rings(regions)}`,
      ...paintings.map((p) => painting(number, p))],
    paint: ({ number, paintings }) => [painting(number, paintings.at(-1))],
    method: ({ number, method, regions }) => [`method ${number} ${METHODS[method]} ${rings(regions)}`],
    recall: ({ number }) => [`recall ${number}`],
  };
  const lines = [], seen = [], errors = [];
  for (const { name, argument, result } of globalThis.tape) {
    if (result.error) { errors.push(`${name}: ${result.error.message}`); continue; }
    if (weights[name]) lines.push(...weights[name](argument), `bind ${list(result.vertices)}`);
    else if (name !== 'pose') continue;
    lines.push(`pose ${list(argument.transforms)} ${changes(argument.changes)}`);
    seen.push([result.transforms ?? argument.transforms, result.images].map((all) => [...all].map(text).join(' ')));
  }
  globalThis.tape = [];
  return { lines, seen, errors };
}

const bitsOf = (text) => [...new BigUint64Array(Float64Array.from(text.split(' '), Number).buffer)];

/** What was written down since the last time: { errors, frames, different }, the number of poses whose transforms and
 *  images are not those of the program, to the bit. */
export async function compare(page, program) {
  const { lines, seen, errors } = await page.evaluate(written);
  const output = execFileSync(program, { input: `${lines.join('\n')}\n`, encoding: 'utf8', maxBuffer: 1 << 30 });
  const given = output.trim().split('\n').map((line) => line.slice(line.indexOf(' ') + 1));
  const alike = (a, b) => { const [x, y] = [bitsOf(a), bitsOf(b)]; return x.length === y.length && x.every((v, i) => v === y[i]); };
  const different = seen.flat().filter((text, k) => !alike(text, given[k] ?? '')).length;
  return { errors, frames: seen.length, different: different + Math.abs(given.length - seen.flat().length) };
}
