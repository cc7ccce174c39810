// The tools of mode handles, and what each of them waits for.

/** What is on the button: its name and its picture. */
export const TOOLS = {
  move: ['Pose', 'M5 3l6 16 2.2-6.8L20 10z'], handle: ['Handle', 'M12 5a7 7 0 1 0 .01 0M12 9v6M9 12h6'],
  bone: ['Bone', 'M6 18L18 6M4 16a2 2 0 1 0 4 4M16 4a2 2 0 1 0 4 4'], line: ['Straight', 'M4 20L20 4M4 20h.01M20 4h.01'],
  parallel: ['Parallel', 'M3 17L15 5M9 19L21 7'], region: ['Rigid area', 'M6 4l12 3 2 9-9 4-8-7z'],
  paint: ['Paint', 'M14 4l6 6-8 8H6v-6zM4 21h9'], rigid: ['Rigid brush', 'M14 4l6 6-8 8H6v-6zM16 21h4M18 19v4'],
  remove: ['Remove', 'M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13'],
};

export const HINTS = {
  handle: 'Click where the handle is to be.',
  bone: 'Click one end of the bone.',
  line: 'In the weights: click both ends of a line, then its end again.',
  parallel: 'In the weights: both ends of a line that stays parallel to the last one.',
  region: 'In the weights: click the corners of what is to stay rigid.',
  paint: 'Paint in the weights. They are optimised when you lift the pointer.',
  rigid: 'Paint what is to move as if rigid.',
  remove: 'Click a handle or a bone.',
};
