// libicc in WebAssembly: instances of the library on the caller's thread, or in a worker.
export { load } from './instance.js';
export { AsyncIcc } from './async.js';
export { Remote } from './remote.js';
export { serve } from './serve.js';
export { IccError } from './error.js';
export { constants } from './layouts.js';
