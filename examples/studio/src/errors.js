// Errors of the library as plain values.

export const plain = ({ message, code, index, item, side, which }) =>
  ({ message, code, index, item, side: side ?? which ?? null });
