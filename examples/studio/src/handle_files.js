// Poses and samplings that come in and go out of mode handles.
import { download, pick } from './dom.js';

export class HandleFiles {
  #mode; #remote; #say;

  constructor(mode, remote, say) { [this.#mode, this.#remote, this.#say] = [mode, remote, say]; }

  savePose() {
    const { outline, handles, bones, transforms } = this.#mode.state;
    download('pose.json', `${JSON.stringify({ outline, handles, bones, transforms: [...transforms] })}\n`, 'application/json');
  }

  loadPose() { pick('.json', (file) => this.takePose(file)); }

  async takePose(file) {
    try {
      const { transforms } = JSON.parse(await file.text());
      if (transforms?.length !== this.#mode.state.transforms.length || !transforms.every(Number.isFinite))
        throw new Error('It is for other handles.');
      this.#mode.edit({ transforms: Float64Array.from(transforms) });
    } catch (error) {
      this.#say(`${file.name} could not be read. ${error.message}`);
    }
  }

  async saveSampling() {
    const { sampling } = await this.#remote.call('handles.save');
    download('sampling.icc', sampling, 'application/octet-stream');
  }

  loadSampling() {
    pick('.icc', async (file) => this.#mode.edit({}, 'handles.load', { bytes: new Uint8Array(await file.arrayBuffer()) }));
  }
}
