#ifndef ICCP_SPECTRUM_H
#define ICCP_SPECTRUM_H

#include "kernel/sampling.h"

#endif
