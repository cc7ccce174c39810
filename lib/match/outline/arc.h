/* Finds where two outlines begin if they are paired by arc length alone. */
#ifndef ICCP_ARC_H
#define ICCP_ARC_H

#include "match/outline/outline.h"

/* Returns the share of the target that is paired with the source's vertex 0. */
double iccp_arc_start(const iccp_outline *source, const iccp_outline *target);

#endif
