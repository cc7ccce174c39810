/* Where two outlines begin when all that is paired is their lengths. */
#ifndef ICCP_ARC_H
#define ICCP_ARC_H

#include "match/outline/outline.h"

/* The share of the target that goes with the source's vertex 0. */
double iccp_arc_start(const iccp_outline *source, const iccp_outline *target);

#endif
