#ifndef ICCP_POSE_H
#define ICCP_POSE_H

#include "kernel/kernel.h"

#endif
