#include "kernel/cells.h"
