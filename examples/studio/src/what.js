// What triangles are filled with, for either renderer; the numbers are those of gl.js' shader.
export const WHAT = { picture: 0, squares: 1, values: 2, flat: 3 };
