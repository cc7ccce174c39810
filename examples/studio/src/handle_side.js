// What stands beside the panels of mode handles.
import { button, choice, make, section, slider, toggle } from './dom.js';
import { certificateCard } from './cage_side.js';
import { RIGS } from './rigs.js';

export function handleSide(mode, files) {
  const card = certificateCard();
  const rig = make('select', { 'aria-label': 'Shape', id: 'rig' },
    ...Object.entries(RIGS).map(([key, [name]]) => make('option', { value: key }, name)),
    make('option', { value: 'cage' }, 'The cage of mode cage'));
  rig.addEventListener('change', () => mode.rig(rig.value));
  const method = choice('Weights by', 'method', { qp: 'QP', equality: 'Equality', l1: 'ℓ1' }, 'qp', (key) => mode.method(key));
  const spacing = slider('Spacing of samples', { min: 6, max: 24, step: 1, value: 12, text: (v) => `${v} px` }, (v) => mode.spacing(v));
  const grid = toggle('Samples on a grid', false, (on) => mode.grid(on), 'grid');
  const facts = make('dl');
  const element = make('aside', { 'aria-label': 'Handles' }, card,
    make('div', { class: 'row' },
      button('Make it certified', null, () => mode.certify(), { class: 'main', id: 'certify' }),
      button('Reset pose', null, () => mode.reset(), { class: 'framed', id: 'rest' })),
    toggle('Certified while it is dragged', false, (on) => mode.keep(on), 'keep'),
    method,
    choice('Colours', 'scale', { linear: 'Linear', log: 'Logarithmic' }, 'linear', (scale) => mode.setView({ scale })),
    make('div', {}, make('div', { class: 'scale' }), mode.ends = make('div', { class: 'ends' }, make('span', {}, '0'), make('span', {}, '1'))),
    section('Brush',
      slider('Radius', { min: 10, max: 200, step: 5, value: 60, text: (v) => `${v} px` }, (v) => mode.setBrush({ radius: v })),
      slider('Amount', { min: -1, max: 1, step: 0.05, value: 0.3, text: (v) => v.toFixed(2) }, (v) => mode.setBrush({ amount: v }))),
    section('Shape', rig, spacing, grid, facts),
    section('Files', make('div', { class: 'row' },
      button('Save pose', null, () => files.savePose(), { class: 'framed' }),
      button('Load pose …', null, () => files.loadPose(), { class: 'framed' }),
      button('Save sampling', null, () => files.saveSampling(), { class: 'framed' }),
      button('Load sampling …', null, () => files.loadSampling(), { class: 'framed' }))),
    make('p', { class: 'hint' }, 'Drag a handle to move it; drag with the right button, or with ', make('kbd', {}, 'Shift'),
      ', to turn it. Keys: arrows move, ', make('kbd', {}, ','), ' and ', make('kbd', {}, '.'), ' turn.'));
  const setState = (state) => {
    element.querySelector(`input[name=method][value=${state.method}]`).checked = true;
    spacing.set(state.spacing);
    grid.input.checked = state.grid;
  };
  const setFacts = (list) => facts.replaceChildren(...Object.entries(list).flatMap(([k, v]) => [make('dt', {}, k), make('dd', {}, v)]));
  return { element, card, rig, setState, setFacts };
}
