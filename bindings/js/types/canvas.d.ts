import type { Map } from './index.js';
/** The pixels of an image, a canvas, a video or an ImageBitmap. An image has to be loaded. */
export function pixelsOf(image: CanvasImageSource): ImageData;
/** Draws a warped picture over the whole of a canvas. Pixels without an image become transparent. Pixel (i, j) of the canvas
 *  covers [i, i + 1] x [j, j + 1] of the target's plane. */
export function drawWarped(canvas: HTMLCanvasElement | OffscreenCanvas, map: Map, picture: ImageData | CanvasImageSource): void;
