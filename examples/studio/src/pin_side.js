// What stands beside the panels of mode pins.
import { button, choice, make, section, slider, toggle } from './dom.js';
import { certificateCard } from './cage_side.js';
import { FIGURES } from './pin_figures.js';

export function pinSide(mode, files) {
  const { view } = mode, card = certificateCard();
  const scale = make('div', { hidden: true }, make('div', { class: 'scale' }),
    make('div', { class: 'ends' }, make('span', {}, 'rigid'), make('span', {}, 'stretched ten times')));
  const figure = make('select', { 'aria-label': 'Figure', id: 'figure' },
    ...Object.entries(FIGURES).map(([key, [name]]) => make('option', { value: key }, name)),
    make('option', { value: 'cage' }, 'The cage of mode cage'), make('option', { value: 'frame' }, 'The whole picture'),
    make('option', { value: '', hidden: true }, 'Your own'));
  figure.addEventListener('change', () => mode.figure(figure.value));
  const reach = slider('Reach of a pin', { min: 0, max: 120, step: 10, value: 0, text: (v) => (v ? `${v} px` : 'a point') },
    (v) => mode.reach(v));
  const element = make('aside', { 'aria-label': 'Pins' }, card,
    make('section', {},
      choice('Inside', 'look', { picture: 'Picture', squares: 'Squares', heat: 'Distortion' }, view.look,
        (look) => { scale.hidden = look !== 'heat'; mode.setView({ look }); }),
      scale,
      toggle('Triangles', view.mesh, (mesh) => mode.setView({ mesh }))),
    section('Pins', reach, make('div', { class: 'row' },
      button('All pins back', null, () => mode.reset(), { class: 'framed', id: 'back' }),
      button('Save pins', null, () => files.savePins(), { class: 'framed', id: 'save-pins' }))),
    section('Figure', figure, make('div', { class: 'row' },
      button('Load outline or pins …', null, () => files.openFigure(), { class: 'framed' }))),
    section('Picture', make('div', { class: 'row' },
      button('Open …', null, () => files.openPicture(), { class: 'framed' }),
      button('Save PNG', null, () => files.savePicture(), { class: 'framed', id: 'save' }))),
    make('p', { class: 'hint' }, 'Only the pins are told where to go. The outline follows, and never overlaps itself. Keys: ',
      make('kbd', {}, 'Tab'), ' to a pin, ', make('kbd', {}, '←↑→↓'), ' to move it, ', make('kbd', {}, 'Del'), ' to remove it.'));
  return { element, card, select: figure, reach };
}
