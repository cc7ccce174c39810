// Pictures of a page: what a canvas can draw goes in, and a canvas comes out.

/** The pixels of an image, a canvas, a video or an ImageBitmap. An image has to be loaded. */
export function pixelsOf(image) {
  const width = image.naturalWidth || image.videoWidth || image.width, height = image.naturalHeight || image.videoHeight || image.height;
  if (!(width > 0 && height > 0)) throw new TypeError('this picture has no size; wait until it is loaded');
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, width, height);
}

/**
 * Draws a warped picture over the whole of a canvas. picture: ImageData, or what pixelsOf() takes. Pixels without an image become
 * transparent. Pixel (i, j) of the canvas covers [i, i + 1] x [j, j + 1] of the target's plane.
 */
export function drawWarped(canvas, map, picture) {
  const source = picture.data ? picture : pixelsOf(picture);
  canvas.getContext('2d').putImageData(map.warp(source, new ImageData(canvas.width, canvas.height)), 0, 0);
}
