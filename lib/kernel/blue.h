#ifndef ICCP_SAMPLING_BLUE_H
#define ICCP_SAMPLING_BLUE_H

#include "kernel/sampling.h"

#endif
