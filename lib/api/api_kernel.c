#include "icc/kernel.h"
