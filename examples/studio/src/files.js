// Files that several modes take and give: pictures and shapes.
import { download, draw } from './dom.js';
import { readShape } from './formats.js';
import { boxOf } from './shape.js';

const SMALL = 1 / 8;           // of the picture: a shape that is smaller is made larger

/** Whether a file is a picture of pixels. */
export const isPicture = ({ type }) => type.startsWith('image/') && type !== 'image/svg+xml';

/** The shape in a file: as it is, or scaled to the picture when it does not lie there. */
export async function shapeFrom(file, { width: w, height: h }) {
  const shape = readShape(await file.text(), draw);
  const [left, top, right, bottom] = boxOf(shape.flatMap((part) => part.points));
  const away = left < -w || top < -h || right > 2 * w || bottom > 2 * h;
  if (!away && Math.max(right - left, bottom - top) > w * SMALL) return shape;
  const scale = 0.8 * Math.min(w / (right - left), h / (bottom - top));
  return shape.map((part) => ({ ...part, points: part.points.map(([x, y]) =>
    [w / 2 + (x - (left + right) / 2) * scale, h / 2 + (y - (top + bottom) / 2) * scale]) }));
}

/** Saves the picture as the library warps it by `operation`, in its own size or that of `to`. */
export async function saveWarped(remote, operation, image, say, to = image) {
  const { width, height } = image;
  const sheet = Object.assign(document.createElement('canvas'), { width, height }), g = sheet.getContext('2d');
  g.drawImage(image, 0, 0);
  const picture = g.getImageData(0, 0, width, height);
  const { pixels, error } = await remote.call(operation, { picture: { width, height, data: picture.data }, width: to.width, height: to.height });
  if (error) { say(error.message); return; }
  [sheet.width, sheet.height] = [to.width, to.height];
  g.putImageData(new ImageData(pixels, to.width, to.height), 0, 0);
  sheet.toBlob((blob) => download('warped.png', blob));
}
