// What mode cage says of a map: words and numbers.

const count = (n) => n.toLocaleString('en');
const isMeeting = ({ kind }) => kind === 'crossing' || kind === 'touch';

/** Edges of an outline that are in each other's way. */
export const meetingEdges = (defects) => (defects ?? []).filter(isMeeting).flatMap((d) => [d.a, d.b]);

function reason({ error, sourceDefects, targetDefects }) {
  const defect = [...sourceDefects, ...targetDefects].find(isMeeting);
  if (!defect) return `${error.message}.`;
  return `Edges ${defect.a + 1} and ${defect.b + 1} ${defect.kind === 'crossing' ? 'cross' : 'touch'}.`;
}

/** The certificate's card, and the badge [state, text]. */
export function reportOf(mesh, trouble) {
  if (trouble) {
    const lines = [reason(trouble), ...(mesh ? ['The last good picture stays.'] : [])];
    return { certificate: { state: 'bad', title: 'No map to here', lines }, badge: ['bad', 'refused'] };
  }
  if (!mesh) return { certificate: null, badge: ['', ''] };
  const n = mesh.simplices.length / 3, folds = mesh.folded.length / 3;
  if (!mesh.certified)
    return { certificate: { state: 'bad', title: 'Not certified', lines: [`${count(folds)} of ${count(n)} triangles folded`] },
      badge: ['bad', 'not certified'] };
  return {
    certificate: { state: 'good', title: 'Certified one-to-one', lines: [
      `${count(n)} triangles, each checked exactly; ${count(folds)} folded`,
      `mean distortion ${(mesh.energy / 4).toFixed(2)} (1 is rigid), made in ${mesh.ms.toFixed(1)} ms`] },
    badge: ['good', `certified, ${count(folds)} folded`],
  };
}

/** The badge of what is compared with. */
export function comparisonOf({ refused, otherFolded }) {
  if (refused) return ['', refused];
  if (!otherFolded) return ['', ''];
  const folds = otherFolded.length / 3;
  return [folds ? 'bad' : 'good', `${count(folds)} folded`];
}

/** Triangles all of whose corners have an image. */
export function reached(images, triangles) {
  const out = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const three = [triangles[t], triangles[t + 1], triangles[t + 2]];
    if (three.every((i) => !Number.isNaN(images[2 * i]))) out.push(...three);
  }
  return Uint32Array.from(out);
}
