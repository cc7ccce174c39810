#include "kernel/structure.h"
