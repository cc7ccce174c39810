// Shapes with handles to begin with: those of the thesis, and the cage of mode cage.
import { SAMPLES } from './samples.js';

const star = Array.from({ length: 10 }, (_, k) => {
  const r = k % 2 ? 112 : 262, a = (k * Math.PI) / 5 - Math.PI / 2;
  return [320 + r * Math.cos(a), 345 + r * Math.sin(a)];
});
const frame = [[64, 64], [576, 64], [576, 576], [64, 576]];
const joints = [[320, 112], [320, 230], [320, 388], [430, 230], [510, 229], [210, 230], [130, 229], [370, 482], [418, 566],
  [270, 482], [222, 566]];

const ring = (points) => points.map((_, i) => [i, (i + 1) % points.length]);
const caged = (sample, outline) => ({ sample, outline, handles: outline, bones: ring(outline) });

/** name -> [what it is called, { sample, outline, handles, bones, method, grid }] */
export const RIGS = {
  star: ['Star, 10 handles', { ...caged('squares', star), method: 'l1' }],
  figure: ['Stick figure, bones', { sample: 'squares', outline: SAMPLES.figure[2], handles: joints,
    bones: [[0, 1], [1, 2], [1, 3], [3, 4], [1, 5], [5, 6], [2, 7], [7, 8], [2, 9], [9, 10]] }],
  butterfly: ['Butterfly, a cage', { ...caged('butterfly', SAMPLES.butterfly[2]), method: 'l1' }],
  frame: ['Rectangle, 4 corners', { ...caged('squares', frame), grid: true }],
};
