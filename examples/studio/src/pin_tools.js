// The tools of mode pins, and what each of them waits for.

/** What is on the button: its name and its picture. */
export const TOOLS = {
  move: ['Move', 'M5 3l6 16 2.2-6.8L20 10z'], point: ['Pin', 'M12 21v-8M8 9a4 4 0 1 0 8 0a4 4 0 1 0-8 0'],
  remove: ['Remove', 'M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13'], outline: ['New figure', 'M6 4l12 3 2 9-9 4-8-7z'],
  hole: ['Hole', 'M12 4a8 8 0 1 0 .01 0M12 9a3 3 0 1 0 .01 0'],
};

export const HINTS = {
  point: 'Click in the figure where the pin is to be.',
  remove: 'Click a pin to remove it.',
  outline: 'In the picture At rest: click around the figure; click the first corner again to close it.',
  hole: 'In the picture At rest: click the corners of the hole; click the first again to close it.',
};
