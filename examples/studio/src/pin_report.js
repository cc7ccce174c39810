// What mode pins says of a figure: words and numbers.

const count = (n) => n.toLocaleString('en');
const pixels = (d) => `${d < 1 ? d.toFixed(2) : d.toFixed(0)} px`;
const isAre = (n) => (n === 1 ? '1 pin is' : `${n} pins are`);

/** Numbers of the pins that are not at their places, from 0. */
export const unreached = ({ distances }) => [...distances.keys()].filter((i) => distances[i] > 0);

/** How far they are from their places, in words beyond these. */
export const labelsOf = (mesh, targets, aside) => unreached(mesh).filter((i) => i < targets.length).map((i) => {
  const d = mesh.distances[i];
  return { text: pixels(d), at: targets[i].map((v, axis) => v - (mesh.off[2 * i + axis] / d) * aside) };
});

/** The card, and the badge [state, text]. */
export function reportOf(mesh, error) {
  if (error) {
    const lines = [`${error.message}.`, ...(mesh ? ['The last good picture stays.'] : [])];
    return { card: { state: 'bad', title: 'No map to here', lines }, badge: ['bad', 'refused'] };
  }
  const n = mesh.triangles.length / 3, folds = mesh.folded.length / 3, off = unreached(mesh), { length } = mesh.distances;
  const checked = `${count(n)} triangles, each checked exactly; ${count(folds)} folded`;
  if (!mesh.certified) return { card: { state: 'bad', title: 'Not certified', lines: [checked] }, badge: ['bad', 'not certified'] };
  const pins = off.length > 0
    ? [`${isAre(off.length)} not reached: the figure would overlap or fold on the way.`,
      ...off.map((i) => `Pin ${i + 1} is ${pixels(mesh.distances[i])} away from its place.`)]
    : [length === 0 ? 'There is no pin yet.' : `${isAre(length)} exactly in place.`];
  const badge = off.length > 0 ? ['bad', `certified, ${off.length} of ${length} pins not reached`] : ['good', `certified, ${count(folds)} folded`];
  return { card: { state: 'good', title: 'Certified one-to-one', lines: [checked, ...pins,
    `mean distortion ${(mesh.energy / 4).toFixed(2)} (1 is rigid), made in ${mesh.ms.toFixed(1)} ms`] }, badge };
}
