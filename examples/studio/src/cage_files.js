// Pictures, cages and links that come in and go out of mode cage.
import { download, pick } from './dom.js';
import { isPicture, saveWarped, shapeFrom } from './files.js';
import { writeGeoJson, writeText } from './formats.js';
import { writeLink } from './link.js';

export class CageFiles {
  #mode; #remote; #say;

  constructor(mode, remote, say) { [this.#mode, this.#remote, this.#say] = [mode, remote, say]; }

  openPicture() { pick('image/*', (file) => this.take(file)); }
  openCage() { pick('.txt,.json,.geojson,.svg', (file) => this.take(file)); }

  /** A file that was opened, dropped or pasted: a picture or a cage. */
  async take(file) {
    try {
      if (isPicture(file)) this.#mode.own(await createImageBitmap(file));
      else this.#mode.edit(await shapeFrom(file, this.#mode.image));
    } catch (error) {
      this.#say(`${file.name || 'What was pasted'} could not be read. ${error.message}`);
    }
  }

  saveCage(format) {
    const { source, target } = this.#mode.shapes;
    const [write, ending, type] = format === 'text' ? [writeText, 'txt', 'text/plain'] : [writeGeoJson, 'geojson', 'application/geo+json'];
    download(`before.${ending}`, write(source), type);
    download(`after.${ending}`, write(target), type);
  }

  savePicture() { return saveWarped(this.#remote, 'cage.warp', this.#mode.image, this.#say); }

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
