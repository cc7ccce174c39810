/* Proofs that the image of a grid's boundary is simple. */
#ifndef ICCP_BOX_H
#define ICCP_BOX_H

#include "base/env.h"
#include "sampled/samples.h"

#include <stdbool.h>

/* Sets `simple` if all samples on the boundary have exactly the same displacement or, in 2-D, if
 * the polygon of their images has representable vertices and is simple. All values are finite. */
icc_status iccp_box_simple(bool *simple, const icc_field *field, const iccp_env *env);

#endif
