#include "kernel/weights.h"
