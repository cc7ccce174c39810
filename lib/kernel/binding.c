#include "kernel/binding.h"
