// Errors of the library as plain values.

export const plain = ({ message, code, index, item, side }) => ({ message, code, index, item, side });
