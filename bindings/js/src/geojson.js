// GeoJSON (RFC 7946): its polygons as shapes, and any of its objects moved by a map.

/** How deep the positions of a geometry lie in its coordinates. */
const DEPTHS = { Point: 0, MultiPoint: 1, LineString: 1, MultiLineString: 2, Polygon: 2, MultiPolygon: 3 };

/** Whether a value is an object of GeoJSON. */
export const isGeoJson = (value) => typeof value?.type === 'string'
  && ['coordinates', 'geometry', 'geometries', 'features'].some((member) => member in value);

/** Positions without heights. */
const plane = (positions) => positions.map(([x, y]) => [x, y]);

/** The geometry of a feature, or of the only feature of a collection. */
function geometryOf(object) {
  if (object.type === 'Feature') return object.geometry;
  if (object.type !== 'FeatureCollection') return object;
  if (object.features.length !== 1)
    throw new TypeError(`a shape is one feature, but the collection has ${object.features.length}; pass one of its features`);
  return object.features[0].geometry;
}

/** A polygon as Domain.polygon() takes it: { outline, regions, holes }. The parts of a MultiPolygon become regions. */
export function shapeOf(object) {
  const geometry = geometryOf(object), type = geometry?.type;
  if (type !== 'Polygon' && type !== 'MultiPolygon')
    throw new TypeError(`a shape is a Polygon or a MultiPolygon of GeoJSON, not ${type ?? 'a feature without a geometry'}`);
  const parts = type === 'Polygon' ? [geometry.coordinates] : geometry.coordinates;
  const holes = parts.flatMap((rings) => rings.slice(1).map(plane));
  if (parts.length === 1) return { outline: plane(parts[0][0]), regions: [], holes };
  return { outline: null, regions: parts.map((rings) => plane(rings[0])), holes };
}

/** The positions of a line, with more of them where two are more than `segment` apart. */
function divided(line, segment) {
  return line.flatMap((to, i) => {
    const from = i > 0 ? line[i - 1] : to, n = Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / segment) || 1;
    const between = Array.from({ length: n - 1 }, (_, k) => from.map((a, axis) => a + (k + 1) / n * (to[axis] - a)));
    return [...between, to];
  });
}

/** Calls work(list of positions) at the bottom of coordinates, and puts its results in their places. */
const descend = (coordinates, depth, work) =>
  (depth <= 1 ? work(coordinates) : coordinates.map((inner) => descend(inner, depth - 1, work)));

/** A geometry whose lists of positions are replaced by those that work() gives. null: work() gave null for a list. */
function mappedGeometry(geometry, work) {
  if (geometry === null) return null;
  if (geometry.type === 'GeometryCollection') {
    const geometries = geometry.geometries.map((member) => mappedGeometry(member, work));
    return geometries.includes(null) ? null : { ...geometry, geometries };
  }
  const depth = DEPTHS[geometry.type];
  if (depth === undefined) throw new TypeError(`'${geometry.type}' is no type of GeoJSON`);
  const isLine = depth > 0 && geometry.type !== 'MultiPoint';
  let lost = false;
  const take = (positions) => {
    const images = work(positions, isLine);
    lost ||= images === null;
    return images;
  };
  const coordinates = depth === 0 ? take([geometry.coordinates])?.[0] : descend(geometry.coordinates, depth, take);
  return lost ? null : { ...geometry, coordinates };
}

function mapped(object, work) {
  const { bbox: _, ...rest } = object; // it would be that of before
  if (object.type === 'FeatureCollection') return { ...rest, features: object.features.map((feature) => mapped(feature, work)) };
  if (object.type === 'Feature') return { ...rest, geometry: mappedGeometry(object.geometry, work) };
  return mappedGeometry(rest, work);
}

/**
 * An object of GeoJSON whose positions are replaced by transform(numbers), two numbers a position. Heights, properties and other
 * members are kept; members `bbox` are left out. Lines get more positions where two are more than `segment` apart. A
 * geometry with a position that gets NaN becomes null.
 */
export function moved(object, transform, segment = Infinity) {
  if (!isGeoJson(object)) throw new TypeError('this is no object of GeoJSON');
  if (!(segment > 0)) throw new RangeError(`segment is ${segment}, but must be positive`);
  const lists = [];
  mapped(object, (positions, isLine) => {
    lists.push(isLine ? divided(positions, segment) : positions);
    return positions;
  });
  const images = transform(Float64Array.from(lists.flat().flatMap(([x, y]) => [x, y])));
  let list = 0, at = 0;
  return mapped(object, () => {
    const result = lists[list++].map(([, , ...heights]) => [images[at++], images[at++], ...heights]);
    return result.some(([x]) => Number.isNaN(x)) ? null : result;
  });
}
