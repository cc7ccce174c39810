export const spaceOperations = () => ({});
