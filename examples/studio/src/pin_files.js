// Pictures, outlines and pins that come in and go out of mode pins.
import { download, pick } from './dom.js';
import { isPicture, saveWarped, shapeFrom } from './files.js';

export class PinFiles {
  #mode; #remote; #say;

  constructor(mode, remote, say) { [this.#mode, this.#remote, this.#say] = [mode, remote, say]; }

  openPicture() { pick('image/*', (file) => this.take(file)); }
  openFigure() { pick('.txt,.json,.geojson,.svg', (file) => this.take(file)); }

  /** A file that was opened, dropped or pasted: a picture, pins, or an outline. Points in it become pins. */
  async take(file) {
    try {
      if (isPicture(file)) { this.#mode.open(await createImageBitmap(file)); return; }
      const { pins } = /json$/i.test(file.name) ? JSON.parse(await file.text()) : {};
      if (pins) { this.#mode.begin(this.#mode.state.figure, pins.map(({ at }) => at), pins.map(({ at, to = at }) => to)); return; }
      const shape = await shapeFrom(file, this.#mode.image), of = (...kinds) => shape.filter(({ kind }) => kinds.includes(kind));
      this.#mode.begin(of('outline', 'hole'), of('point').flatMap(({ points }) => points));
    } catch (error) {
      this.#say(`${file.name || 'What was pasted'} could not be read. ${error.message}`);
    }
  }

  /** Pins as `libicc pose --pins` reads them. */
  savePins() {
    const { pins, targets } = this.#mode.state, lines = pins.map((at, i) => `  ${JSON.stringify({ at, to: targets[i] })}`);
    download('pins.json', `{"pins": [\n${lines.join(',\n')}\n]}\n`, 'application/json');
  }

  savePicture() { return saveWarped(this.#remote, 'pins.warp', this.#mode.image, this.#say); }
}
