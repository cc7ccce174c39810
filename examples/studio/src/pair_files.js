// Pictures and control points that come in and go out of mode points.
import { download, pick } from './dom.js';
import { isPicture, saveWarped } from './files.js';
import { readPairs, writeCsv, writePoints } from './pair_formats.js';

export class PairFiles {
  #mode; #remote; #say;

  constructor(mode, remote, say) { [this.#mode, this.#remote, this.#say] = [mode, remote, say]; }

  openBefore() { pick('image/*', (file) => this.take(file)); }
  openAfter() { pick('image/*', (file) => this.take(file, 'after')); }
  openPairs() { pick('.csv,.points,.txt', (file) => this.take(file)); }

  /** A file that was opened, dropped or pasted: a picture, or points. */
  async take(file, side = 'before') {
    try {
      if (isPicture(file)) { this.#mode.open(side, await createImageBitmap(file)); return; }
      const { points, targets } = readPairs(await file.text());
      const away = (list, { width: w, height: h }) => list.some(([x, y]) => x < -w || x > 2 * w || y < -h || y > 2 * h);
      if (away(points, this.#mode.images.before) || away(targets, this.#mode.images.after))
        throw new Error('Its points are not pixels of these pictures.');
      this.#mode.edit({ points, targets });
    } catch (error) {
      this.#say(`${file.name || 'What was pasted'} could not be read. ${error.message}`);
    }
  }

  save(format) {
    const { points, targets, tolerance } = this.#mode.state;
    const [write, name] = format === 'csv' ? [writeCsv, 'points.csv'] : [writePoints, 'picture.points'];
    download(name, write(points, targets, tolerance), 'text/csv');
  }

  savePicture() {
    const { before, after } = this.#mode.images;
    return saveWarped(this.#remote, 'points.warp', before, this.#say, after);
  }
}
