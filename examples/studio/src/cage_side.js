// What stands beside the panels of mode cage: the certificate, the view, files.
import { button, choice, icon, make, section, slider, toggle } from './dom.js';
import { SAMPLES } from './samples.js';

const COMPARISONS = {
  none: 'Nothing', 'mean-value': 'Mean value coordinates', 'thin-plate': 'Thin-plate spline',
  gradient: 'The papers’ gradient lines',
};
const CHECK = 'M5 12.5l4.5 4.5L19 7.5', CROSS = 'M6 6l12 12M18 6L6 18', DOTS = 'M5 12h.01M12 12h.01M19 12h.01';

/** A card that says whether a map is certified: set({ state, title, lines }). */
export function certificateCard() {
  const card = make('section', { class: 'certificate', 'aria-live': 'polite', id: 'certificate' });
  let last = '';
  card.set = ({ state, title, lines = [] }) => {
    const text = JSON.stringify([state, title, lines]);
    if (text === last) return;
    last = text;
    card.dataset.state = state;
    card.replaceChildren(make('strong', {}, icon({ good: CHECK, bad: CROSS }[state] ?? DOTS), title),
      ...lines.map((line) => make('p', {}, line)));
  };
  return card;
}

export function cageSide(mode, files) {
  const view = mode.view, card = certificateCard();
  const scale = make('div', { hidden: true }, make('div', { class: 'scale' }),
    make('div', { class: 'ends' }, make('span', {}, 'rigid'), make('span', {}, 'stretched ten times')));
  const sample = make('select', { 'aria-label': 'Sample picture', id: 'sample' }, make('option', { value: '' }, 'Your own'),
    ...Object.entries(SAMPLES).map(([key, [name]]) => make('option', { value: key }, name)));
  sample.addEventListener('change', () => sample.value && mode.sample(sample.value));
  const compare = make('select', { 'aria-label': 'Compare with', id: 'compare' },
    ...Object.entries(COMPARISONS).map(([key, name]) => make('option', { value: key, selected: key === view.compare }, name)));
  compare.addEventListener('change', () => mode.setView({ compare: compare.value }));
  const pins = slider('Size of pins', { min: 0, max: 60, step: 2, value: 0, text: (v) => (v ? `${v} px` : 'points') },
    (v) => mode.pinSize(v));
  pins.hidden = true;
  const element = make('aside', { 'aria-label': 'Cage' }, card,
    make('section', {},
      choice('Inside', 'look', { picture: 'Picture', squares: 'Squares', heat: 'Distortion' }, view.look,
        (look) => { scale.hidden = look !== 'heat'; mode.setView({ look }); }),
      scale,
      toggle('Triangles', view.mesh, (mesh) => mode.setView({ mesh })),
      make('label', {}, make('span', { class: 'hint' }, 'Compare with'), compare)),
    section('Map', pins, make('div', { class: 'row' },
      button('Make fairer', null, () => mode.improve(), { class: 'framed', id: 'improve' }),
      button('Reset', null, () => mode.reset(), { class: 'framed', id: 'reset' }))),
    section('Picture', sample, make('div', { class: 'row' },
      button('Open …', null, () => files.openPicture(), { class: 'framed' }),
      button('Save PNG', null, () => files.savePicture(), { class: 'framed', id: 'save' }))),
    section('Cage', make('div', { class: 'row' },
      button('Load …', null, () => files.openCage(), { class: 'framed' }),
      button('Save text', null, () => files.saveCage('text'), { class: 'framed' }),
      button('Save GeoJSON', null, () => files.saveCage('geojson'), { class: 'framed' }),
      button('Copy link', null, () => files.copyLink(), { class: 'framed', id: 'link' }))),
    make('p', { class: 'hint' }, 'Drop or paste a picture, or a cage as text, GeoJSON or SVG. Keys: ',
      make('kbd', {}, 'Tab'), ' to a handle, ', make('kbd', {}, '←↑→↓'), ' to move it, ', make('kbd', {}, '+'), ' and ',
      make('kbd', {}, 'Del'), ' to add and remove.'));
  return { element, card, sample, compare, pins };
}
