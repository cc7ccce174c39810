export const stageOperations = () => ({});
