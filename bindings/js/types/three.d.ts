import type { Map } from './index.js';
/** What is used of a BufferGeometry of three.js. */
export interface Geometry {
  readonly attributes: { readonly [name: string]: any };
  readonly index: { readonly count: number; getX(i: number): number } | null;
  boundingBox: any;
  boundingSphere: any;
  computeVertexNormals(): void;
}
/** The surface of a BufferGeometry, with each vertex once, as Domain.surface() and Domain.solid() take it. Triangles without a
 *  size are left out. */
export function surfaceOf(geometry: Geometry): { vertices: Float64Array; facets: Uint32Array };
/** Moves the vertices of a BufferGeometry by a map in space, and computes its normals anew if it has any. Vertices without
 *  an image stay where they are. Returns the number of these. */
export function bend(geometry: Geometry, map: Map): number;
