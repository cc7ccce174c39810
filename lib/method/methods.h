/* The list of all methods for charts.
 *
 * Words of this folder. Begin with this file and chart_create.h.
 * - method: a table of operations that makes and evaluates charts (chart/chart.h).
 * - number: ICC_METHOD_..; two methods may share one if only one of them needs a mesh.
 * - format: the method's number in saved bytes. Every method has its own, and gradient has two.
 *
 * This folder is the only one that names all methods. To add a method, write its iccp_chart_ops in
 * a folder of its own and add it to the table in all_methods.c. A library with the papers alone has
 * papers_methods.c instead. Invariant: a method that needs a mesh
 * is only called if all domains have one.
 *
 * Ways: chart_create.h creates charts, load.h saves and loads them. */
#ifndef ICCP_METHODS_H
#define ICCP_METHODS_H

#include "chart/chart.h"

/* The methods of this library, then NULL. */
extern const iccp_chart_ops *const iccp_methods[];

/* iccp_method_find() finds a method by its number, and iccp_method_of_format() by its number in
 * saved bytes. Both return NULL if there is none. `has_mesh` means that all domains have a mesh
 * of their inside. Methods for such meshes are then preferred. */
const iccp_chart_ops *iccp_method_find(int32_t number, bool has_mesh);
const iccp_chart_ops *iccp_method_of_format(uint64_t format);

#endif
