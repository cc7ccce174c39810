/* The mesh that an elastic fit moves, and what is told of its vertices. */
#ifndef ICCP_ELASTIC_SHAPE_H
#define ICCP_ELASTIC_SHAPE_H

#include "fit/elastic/elastic_model.h"
#include "fit/fit.h"

#include <stdatomic.h>

/* It does not change once it is made. Fits to other targets share it. */
typedef struct iccp_elastic_shape {
    iccp_memory memory;
    atomic_size_t references;
    iccp_frame frame;
    size_t n_points, n_triangles, n_vertices; /* n_vertices: of the caller's mesh or domain */
    double *given;                            /* 2 n_points, the caller's coordinates */
    double *points;                           /* 2 n_points, local */
    /* 3 n_triangles, counter-clockwise. Then 3 n_more: the halves of quadrilaterals by their other
     * diagonals */
    uint32_t *triangles;
    size_t n_more;
    double *factor; /* of the weight of each of both; NULL: all are 1 */
    /* For each vertex that libicc made on a told edge: the ends of that edge, and its place there.
     * UINT32_MAX elsewhere. NULL for a mesh of the caller's. */
    uint32_t *ends;
    double *share;
    uint8_t *hold;     /* n_points: ICCP_LOOSE, ICCP_HELD or ICCP_SLIDING */
    uint32_t *item;    /* n_points: the told item of a vertex, or UINT32_MAX */
    double *direction; /* 2 n_points: of sliding vertices */
    size_t n_inner;
    uint32_t *inner; /* n_inner: held vertices inside, which become points of the map */
    iccp_elastic *elastic;
} iccp_elastic_shape;

/* Makes the shape for a mesh or a domain, of which the other one is NULL. Finds the vertices of all
 * told points: sets told->vertex, and told->source of the others. */
icc_status iccp_elastic_shape_create(iccp_elastic_shape **out, const icc_domain *domain,
                                     const icc_mesh *mesh, iccp_told *told,
                                     const icc_fit_options *options, const iccp_env *env,
                                     icc_error *err);
iccp_elastic_shape *iccp_elastic_shape_retain(iccp_elastic_shape *shape);
void iccp_elastic_shape_release(iccp_elastic_shape *shape);

/* Fills in the local targets of held and sliding vertices. */
void iccp_elastic_shape_aim(const iccp_elastic_shape *shape, const iccp_told *told,
                            double *targets);

#endif
