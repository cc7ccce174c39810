// Meshes of three.js: any object with the members of a BufferGeometry. three.js itself is not imported.

/** Numbers for the vertices of a geometry such that vertices at the same place get the same one: three.js repeats a vertex for each of its
 *  normals and places in the texture. Returns { vertices, number }. */
function merged(position) {
  const known = new Map(), vertices = [];
  const number = Uint32Array.from({ length: position.count }, (_, i) => {
    const at = [position.getX(i), position.getY(i), position.getZ(i)], key = at.join(' ');
    if (!known.has(key)) {
      known.set(key, known.size);
      vertices.push(...at);
    }
    return known.get(key);
  });
  return { vertices: Float64Array.from(vertices), number };
}

/** The positions of a BufferGeometry. */
function positionOf(geometry) {
  const position = geometry?.attributes?.position ?? geometry?.getAttribute?.('position');
  if (position?.itemSize !== 3 || typeof position.getX !== 'function')
    throw new TypeError('this is no BufferGeometry with positions in space');
  return position;
}

/** The surface of a BufferGeometry, with each vertex once, as Domain.surface() and Domain.solid() take it:
 *  { vertices, facets }. Triangles without a size are left out. */
export function surfaceOf(geometry) {
  const position = positionOf(geometry), { vertices, number } = merged(position);
  const n = geometry.index ? geometry.index.count : position.count, facets = [];
  for (let i = 0; i + 2 < n; i += 3) {
    const corners = [i, i + 1, i + 2].map((k) => number[geometry.index ? geometry.index.getX(k) : k]);
    if (new Set(corners).size === 3) facets.push(...corners);
  }
  return { vertices, facets: Uint32Array.from(facets) };
}

/**
 * Moves the vertices of a BufferGeometry by a map in space, and computes its normals anew if it has any. Vertices
 * without an image stay where they are. Returns the number of these.
 */
export function bend(geometry, map) {
  const position = positionOf(geometry);
  const points = Float64Array.from({ length: 3 * position.count },
    (_, k) => [position.getX, position.getY, position.getZ][k % 3].call(position, Math.floor(k / 3)));
  const images = map.apply(points);
  let lost = 0;
  for (let i = 0; i < position.count; ++i) {
    const [x, y, z] = images.subarray(3 * i, 3 * i + 3);
    if (Number.isNaN(x)) ++lost;
    else position.setXYZ(i, x, y, z);
  }
  position.needsUpdate = true;
  geometry.boundingSphere = geometry.boundingBox = null;
  if (geometry.attributes.normal) geometry.computeVertexNormals();
  return lost;
}
