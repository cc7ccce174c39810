// What mode points says of a map: words, numbers, and the table of residuals.
import { make } from './dom.js';

const count = (n) => n.toLocaleString('en');
const length = (d) => (Number.isNaN(d) ? '–' : d.toFixed(d < 10 ? 2 : 1));

/** The number of the point that goes least with the others; -1 where that is not known. A mistake is most likely there. */
export function worst({ leftOuts }) {
  const most = Math.max(...leftOuts);
  return most > 0 ? leftOuts.indexOf(most) : -1;
}

export const WAITING = { state: 'open', title: 'No points yet', lines: ['Click a place on the left, then the same place on the right.'] };

/** The card. */
export function cardOf(mesh, error) {
  if (error) return { state: 'bad', title: 'No map', lines: [`${error.message}.`, ...(mesh ? ['The last good map stays.'] : [])] };
  const at = worst(mesh), folds = mesh.folded.length / 3, title = mesh.certified ? 'Certified one-to-one' : 'Not certified';
  const repaired = mesh.nFolded > 0 ? `, ${(100 * mesh.changed).toFixed(1)} % of the area was mapped anew because it folded` : '';
  return { state: mesh.certified ? 'good' : 'bad', title, lines: [
    `${count(mesh.nTriangles)} triangles, each checked exactly; ${count(folds)} folded${repaired}`,
    ...(Number.isNaN(mesh.leftOut) ? [] : [`accuracy between points ${length(mesh.leftOut)} px`]),
    ...(at < 0 ? [] : [`point ${at + 1} is ${length(mesh.leftOuts[at])} px from where the others would take it`]),
    `made in ${mesh.ms.toFixed(1)} ms`] };
}

/** [state, text] of the badge of the map, and of the thin plate's. */
export function badgesOf(mesh, error) {
  const folds = (list) => `${count(list.length / 3)} folded`;
  const ours = error ? ['bad', 'refused'] : [mesh.certified ? 'good' : 'bad', `${mesh.certified ? '' : 'not '}certified, ${folds(mesh.folded)}`];
  const theirs = mesh.refused ? ['', mesh.refused] : mesh.otherFolded ? [mesh.otherFolded.length > 0 ? 'bad' : 'good', folds(mesh.otherFolded)] : ['', ''];
  return [ours, theirs];
}

/** Rows of the table: how far each point is from where the others would take it, and in the map. The worst is red. */
export function rowsOf(mesh, choose) {
  const { leftOuts, residuals } = mesh, wrong = worst(mesh);
  return [...residuals.keys()].map((i) => make('tr', { class: i === wrong ? 'wrong' : null, onclick: () => choose(i) },
    make('th', { scope: 'row' }, `${i + 1}`), make('td', {}, length(leftOuts[i])), make('td', {}, length(residuals[i]))));
}
