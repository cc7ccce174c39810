#include "kernel/shape.h"
