#include "kernel/interpolant.h"
