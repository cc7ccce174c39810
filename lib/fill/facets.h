/* Recovers the facets of the surfaces as faces of the mesh. */
#ifndef ICCP_FACETS_H
#define ICCP_FACETS_H

#include "fill/constraints.h"

/* Changes a mesh that contains the segments so that each facet is made of faces of the mesh. */
icc_status iccp_recover_facets(iccp_tets *m, const iccp_constraints *s, const iccp_env *env,
                               icc_error *err);

#endif
