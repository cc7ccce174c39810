#include "kernel/gram.h"
