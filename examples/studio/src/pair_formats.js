// Control points as the command `libicc fit` reads them: CSV, and QGIS' .points. Places are pixels, y downwards.

const number = (v) => `${+v.toFixed(4)}`;

export function writeCsv(points, targets, tolerance) {
  const [title, more] = tolerance > 0 ? [',tolerance', [tolerance]] : ['', []];
  return `x,y,to_x,to_y${title}\n${points.map((p, i) => [...p, ...targets[i], ...more].map(number).join()).join('\n')}\n`;
}

/** In QGIS, y points upwards in both. There is no column for tolerances. */
export const writePoints = (points, targets) => `mapX,mapY,sourceX,sourceY,enable\n${points.map(([x, y], i) =>
  [...[targets[i][0], -targets[i][1], x, -y].map(number), 1].join()).join('\n')}\n`;

/** The pairs of either: { points, targets }. */
export function readPairs(text) {
  const rows = text.split(/\r?\n/).map((line) => line.replace(/#.*/, '').trim()).filter(Boolean).map((line) => line.split(/[\s,;]+/));
  const qgis = rows[0]?.[0] === 'mapX', body = rows.filter(([first]) => Number.isFinite(Number(first)));
  if (body.length === 0 || body.some((row) => row.length < 4 || row.slice(0, 4).some((v) => !Number.isFinite(Number(v)))))
    throw new Error('There have to be four numbers in each row: x, y, to_x, to_y.');
  const pairs = body.filter((row) => !qgis || row[4] !== '0').map((row) => row.slice(0, 4).map(Number));
  return {
    points: pairs.map(([a, b, c, d]) => (qgis ? [c, -d] : [a, b])),
    targets: pairs.map(([a, b, c, d]) => (qgis ? [a, -b] : [c, d])),
  };
}
