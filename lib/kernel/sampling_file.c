#include "kernel/sampling.h"
