#include "kernel/blue.h"
