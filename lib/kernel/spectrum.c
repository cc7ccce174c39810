#include "kernel/spectrum.h"
