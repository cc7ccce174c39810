#include "kernel/pose.h"
