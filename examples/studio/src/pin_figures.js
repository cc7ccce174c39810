// Figures with pins to begin with.
import { SAMPLES } from './samples.js';
import { outlineOf } from './shape.js';

const figureOf = (sample, pins, moved = {}) =>
  ({ sample, figure: outlineOf(SAMPLES[sample][2]), pins, targets: pins.map((p, k) => moved[k] ?? p) });

/** name -> [what it is called, { sample, figure, pins, targets }] */
export const FIGURES = {
  figure: ['Gingerbread figure', figureOf('figure',
    [[320, 112], [520, 218], [120, 218], [418, 566], [222, 566], [320, 318]], { 0: [338, 110], 1: [462, 66], 3: [500, 528] })],
  butterfly: ['Butterfly', figureOf('butterfly', [[320, 200], [320, 460], [580, 110], [60, 110], [520, 480], [120, 480]])],
  owl: ['Owl', figureOf('owl', [[455, 150], [185, 150], [320, 570], [490, 330], [150, 330]])],
};
