// The tools of mode points, and what each of them waits for.

/** What is on the button: its name and its picture. */
export const TOOLS = {
  move: ['Move', 'M5 3l6 16 2.2-6.8L20 10z'], pair: ['Pair', 'M5 8h.01M19 16h.01M8 9l8 6M16 11v4h-4'],
  remove: ['Remove', 'M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13'],
};

export const HINTS = {
  pair: 'Click a place on the left, then the same place on the right.',
  remove: 'Click a point to remove its pair.',
};

export const OTHER = { before: 'Now click the same place on the left.', after: 'Now click the same place on the right.' };
