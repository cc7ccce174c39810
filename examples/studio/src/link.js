// The state in the part of the address after '#': it stays in the browser.

const base64 = (bytes) => btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
const bytesOf = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));

const through = async (bytes, stream) =>
  new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

const rounded = (key, value) => (typeof value === 'number' ? Math.round(value * 100) / 100 : value);

export async function writeLink(state) {
  const bytes = new TextEncoder().encode(JSON.stringify(state, rounded));
  return `#s=${base64(await through(bytes, new CompressionStream('deflate-raw')))}`;
}

/** The picture that a link has, as data: nothing is asked for elsewhere. Null where it is none. */
export async function pictureOf(url) {
  const found = /^data:(image\/(?:png|jpeg|webp));base64,(.*)$/.exec(url);
  if (!found) return null;
  const bytes = Uint8Array.from(atob(found[2]), (c) => c.charCodeAt(0));
  return createImageBitmap(new Blob([bytes], { type: found[1] })).catch(() => null);
}

/** The state of a link, or null where there is none that can be read. The name of a mode is one, too. */
export async function readLink(hash) {
  if (/^#[a-z]+$/.test(hash)) return { mode: hash.slice(1) };
  if (!hash.startsWith('#s=')) return null;
  try {
    const bytes = await through(bytesOf(hash.slice(3)), new DecompressionStream('deflate-raw'));
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    return null;
  }
}
