// The tools of mode cage, and what each of them waits for.

/** What is on the button: its name and its picture. */
export const TOOLS = {
  move: ['Move', 'M5 3l6 16 2.2-6.8L20 10z'], corner: ['Add corner', 'M4 18L12 6l8 12M12 3v6M9 6h6'],
  hole: ['Hole', 'M12 4a8 8 0 1 0 .01 0M12 9a3 3 0 1 0 .01 0'], line: ['Line', 'M5 19L19 5M5 19h.01M19 5h.01'],
  point: ['Pin', 'M12 21v-8M8 9a4 4 0 1 0 8 0a4 4 0 1 0-8 0'], remove: ['Remove', 'M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13'],
  outline: ['New cage', 'M6 4l12 3 2 9-9 4-8-7z'],
};

export const HINTS = {
  hole: 'Click the corners of the hole; click the first again to close it.',
  line: 'Click the points of the line; click the last again to end it.',
  point: 'Click where the pin is to be.',
  outline: 'Click the corners of the new cage; click the first again to close it.',
  corner: 'Click beside an edge.',
  remove: 'Click a corner, a pin or a line to remove it.',
};
