#ifndef ICCP_BINDING_H
#define ICCP_BINDING_H

#include "kernel/kernel.h"

#endif
