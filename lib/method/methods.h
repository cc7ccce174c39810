/* The methods of coordinates that there are. */
#ifndef ICCP_METHODS_H
#define ICCP_METHODS_H

#include "chart/chart.h"

/* The method with this number, or the one with this number in bytes; NULL if there is none. With
 * `has_mesh` all domains have a mesh of their inside, and what is made for such meshes comes
 * first. */
const iccp_chart_ops *iccp_method_find(int32_t number, bool has_mesh);
const iccp_chart_ops *iccp_method_of_format(uint64_t format);

#endif
