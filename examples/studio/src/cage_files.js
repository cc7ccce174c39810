// Pictures, cages and links that come in and go out of mode cage.
import { download, draw, pick } from './dom.js';
import { readShape, writeGeoJson, writeText } from './formats.js';
import { writeLink } from './link.js';
import { boxOf } from './shape.js';

const SMALL = 1 / 8;           // of the picture: a cage that is smaller is made larger

export class CageFiles {
  #mode; #remote; #say;

  constructor(mode, remote, say) { [this.#mode, this.#remote, this.#say] = [mode, remote, say]; }

  openPicture() { pick('image/*', (file) => this.take(file)); }
  openCage() { pick('.txt,.json,.geojson,.svg', (file) => this.take(file)); }

  /** A file that was opened, dropped or pasted: a picture or a cage. */
  async take(file) {
    try {
      if (file.type.startsWith('image/') && file.type !== 'image/svg+xml') this.#mode.own(await createImageBitmap(file));
      else this.#mode.edit(this.#fitted(readShape(await file.text(), draw)));
    } catch (error) {
      this.#say(`${file.name || 'What was pasted'} could not be read. ${error.message}`);
    }
  }

  /** A shape as it is, or scaled to the picture when it does not lie there. */
  #fitted(shape) {
    const { width: w, height: h } = this.#mode.image;
    const [left, top, right, bottom] = boxOf(shape.flatMap((part) => part.points));
    const away = left < -w || top < -h || right > 2 * w || bottom > 2 * h;
    if (!away && Math.max(right - left, bottom - top) > w * SMALL) return shape;
    const scale = 0.8 * Math.min(w / (right - left), h / (bottom - top));
    return shape.map((part) => ({ ...part, points: part.points.map(([x, y]) =>
      [w / 2 + (x - (left + right) / 2) * scale, h / 2 + (y - (top + bottom) / 2) * scale]) }));
  }

  saveCage(format) {
    const { source, target } = this.#mode.shapes;
    const [write, ending, type] = format === 'text' ? [writeText, 'txt', 'text/plain'] : [writeGeoJson, 'geojson', 'application/geo+json'];
    download(`before.${ending}`, write(source), type);
    download(`after.${ending}`, write(target), type);
  }

  /** The picture as the library warps it, in its own size. */
  async savePicture() {
    const { image } = this.#mode, { width, height } = image;
    const sheet = Object.assign(document.createElement('canvas'), { width, height }), g = sheet.getContext('2d');
    g.drawImage(image, 0, 0);
    const picture = g.getImageData(0, 0, width, height);
    const { pixels, error } = await this.#remote.call('cage.warp',
      { picture: { width, height, data: picture.data }, width, height });
    if (error) { this.#say(error.message); return; }
    g.putImageData(new ImageData(pixels, width, height), 0, 0);
    sheet.toBlob((blob) => download('warped.png', blob));
  }

  async copyLink() {
    location.hash = await writeLink(this.#mode.state);
    try {
      await navigator.clipboard.writeText(location.href);
      this.#say('The link is copied. It holds the cages; a picture of your own stays with you.');
    } catch {
      this.#say('The link is in the address bar.');
    }
  }
}
