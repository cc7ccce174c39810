// The program of AsyncIcc's worker.
import { objectOperations } from './objects.js';
import { serve } from './serve.js';

serve(objectOperations);
