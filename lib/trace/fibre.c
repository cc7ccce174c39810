#include "trace/fibre.h"
