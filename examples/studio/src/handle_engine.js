export const handleOperations = () => ({});
