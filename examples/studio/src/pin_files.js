// Pictures and outlines that come in and go out of mode pins.
import { pick } from './dom.js';
import { isPicture, saveWarped, shapeFrom } from './files.js';

export class PinFiles {
  #mode; #remote; #say;

  constructor(mode, remote, say) { [this.#mode, this.#remote, this.#say] = [mode, remote, say]; }

  openPicture() { pick('image/*', (file) => this.take(file)); }
  openFigure() { pick('.txt,.json,.geojson,.svg', (file) => this.take(file)); }

  /** A file that was opened, dropped or pasted: a picture, or an outline. Points in it become pins. */
  async take(file) {
    try {
      if (isPicture(file)) { this.#mode.open(await createImageBitmap(file)); return; }
      const shape = await shapeFrom(file, this.#mode.image), of = (...kinds) => shape.filter(({ kind }) => kinds.includes(kind));
      this.#mode.begin(of('outline', 'hole'), of('point').flatMap(({ points }) => points));
    } catch (error) {
      this.#say(`${file.name || 'What was pasted'} could not be read. ${error.message}`);
    }
  }

  savePicture() { return saveWarped(this.#remote, 'pins.warp', this.#mode.image, this.#say); }
}
