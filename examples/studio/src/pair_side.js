// What stands beside the panels of mode points.
import { button, make, section, slider, toggle } from './dom.js';
import { certificateCard } from './cage_side.js';

export function pairSide(mode, files) {
  const card = certificateCard(), rows = make('tbody'), code = make('code');
  const tolerance = slider('Points may be off by', { min: 0, max: 20, step: 1, value: 0, text: (v) => (v ? `about ${v} px` : 'nothing') },
    (v) => mode.edit({ tolerance: v }));
  const framed = (text, act, id = null) => button(text, null, act, { class: 'framed', id });
  const element = make('aside', { 'aria-label': 'Points' }, card,
    make('table', { class: 'residuals' },
      make('thead', {}, make('tr', {}, ...['Point', 'Left out', 'Residual'].map((text) => make('th', { scope: 'col' }, text)))), rows),
    make('p', { class: 'hint' }, 'In pixels. ', make('em', {}, 'Left out'), ' is how far a point is from where the other points would take it.'),
    section('Map', tolerance, toggle('Thin-plate spline beside it', mode.view.compare, (compare) => mode.setView({ compare }), 'plate')),
    section('Points', make('div', { class: 'row' }, framed('Save CSV', () => files.save('csv')), framed('Save QGIS .points', () => files.save('points')),
      framed('Load …', () => files.openPairs()), framed('Remove all', () => mode.edit({ points: [], targets: [] }), 'none'))),
    section('Pictures', make('div', { class: 'row' }, framed('Open left …', () => files.openBefore()), framed('Open right …', () => files.openAfter()),
      framed('Empty right', () => mode.empty(), 'empty'), framed('Save PNG', () => files.savePicture(), 'save'))),
    make('p', { class: 'hint' }, 'The same map from the file: ', code));
  const command = ({ width, height }) => { code.textContent = `libicc fit --box 0,0,${width},${height} points.csv`; };
  return { element, card, rows, tolerance, command };
}
