// What mode points opens with: an old map and a new one, which the page draws itself, and places that are on both.

const SIZE = 640;

/** Where a place of today is on the old map, whose survey was stretched and bent. */
const old = ([x, y]) => [x + 38 * Math.sin(y / 130) - 12, 0.94 * y + 24 * Math.sin(x / 110 + 1) + 16];

const TOWNS = [[120, 130], [330, 90], [520, 160], [250, 250], [430, 300], [140, 400], [320, 420], [520, 460], [240, 550], [430, 570]];
const COAST = [[20, 60], [160, 40], [300, 30], [470, 50], [600, 110], [610, 260], [590, 420], [610, 560], [500, 615], [330, 600], [170, 620],
  [60, 540], [90, 420], [40, 300], [70, 180]];
const RIVER = [[330, 90], [290, 170], [250, 250], [290, 340], [320, 420], [280, 490], [240, 550], [250, 615]];
const ROADS = [[[120, 130], [250, 250], [430, 300], [520, 460]], [[520, 160], [430, 300], [320, 420], [140, 400]], [[430, 570], [320, 420]]];

/** Straight pieces in so small steps that they bend with the map. */
const fine = (points) => points.slice(1).flatMap((b, k) => Array.from({ length: 12 }, (_, i) =>
  points[k].map((v, axis) => v + ((b[axis] - v) * i) / 12))).concat([points.at(-1)]);

function painted(place, { sea, land, ink, water, font }) {
  const sheet = Object.assign(document.createElement('canvas'), { width: SIZE, height: SIZE }), g = sheet.getContext('2d');
  const path = (points) => new Path2D(`M${fine(points).map((p) => place(p).join()).join('L')}`);
  const stroke = (points, style, width, dash = []) => {
    Object.assign(g, { strokeStyle: style, lineWidth: width, lineJoin: 'round' });
    g.setLineDash(dash);
    g.stroke(path(points));
  };
  g.fillStyle = sea;
  g.fillRect(0, 0, SIZE, SIZE);
  g.fillStyle = land;
  g.fill(path([...COAST, COAST[0]]));
  for (let k = 1; k < 10; ++k)
    for (const line of [[[64 * k, 0], [64 * k, SIZE]], [[0, 64 * k], [SIZE, 64 * k]]]) stroke(line, 'rgba(60,60,60,.16)', 1);
  stroke([...COAST, COAST[0]], ink, 2.5);
  stroke(RIVER, water, 5);
  for (const road of ROADS) stroke(road, ink, 1.6, [7, 4]);
  Object.assign(g, { fillStyle: ink, font, textAlign: 'center' });
  TOWNS.forEach((p, k) => {
    const [x, y] = place(p);
    g.fillRect(x - 5, y - 5, 10, 10);
    g.fillText('ABCDEFGHIK'[k], x, y - 18);
  });
  return sheet;
}

/** One place is wrong: the town D has been clicked beyond the town E. */
export function openingPairs() {
  const targets = TOWNS.map((p, k) => (k === 3 ? [456, 326] : p));
  return {
    before: painted(old, { sea: '#cfc4a0', land: '#efe2be', ink: '#4a3420', water: '#7d8f86', font: 'italic 22px Georgia, serif' }),
    after: painted((p) => p, { sea: '#bcd9ea', land: '#f3f4ea', ink: '#34424c', water: '#5fa3cf', font: '600 19px sans-serif' }),
    points: TOWNS.map(old), targets,
  };
}
