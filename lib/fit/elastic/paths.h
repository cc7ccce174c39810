/* The ways of held vertices from where they are to their targets. */
#ifndef ICCP_PATHS_H
#define ICCP_PATHS_H

#include "base/env.h"

#include <stdbool.h>
#include <stdint.h>

/* Vertices that move together. */
typedef struct iccp_group {
    size_t n;
    double from[2], to[2]; /* centroids */
    double sum[2];         /* of conj(a) b over its vertices, relative to the centroids */
    double turn;           /* angle of the similarity between both places, in turns */
    bool moves;            /* its targets are not where it was at first */
    bool is_off;           /* its targets were given up */
} iccp_group;

typedef struct iccp_paths {
    iccp_memory memory;
    size_t n_points, n_groups;
    uint32_t *group_of; /* of each vertex; UINT32_MAX: it is not held */
    double *from;       /* 2 n_points */
    const double *to;   /* 2 n_points, borrowed */
    iccp_group *group;
} iccp_paths;

/* `hold` is that of iccp_elastic_input. Held vertices that have to move and are connected by edges
 * of the mesh form a group. Every other held vertex is a group of its own. */
icc_status iccp_paths_create(iccp_paths *paths, size_t n_points, const uint8_t *hold,
                             size_t n_triangles, const uint32_t *corners, const double *targets,
                             const double *images, const iccp_env *env);
void iccp_paths_free(iccp_paths *paths);

/* Begins new ways from the present images of the vertices. */
void iccp_paths_begin(iccp_paths *paths, const double *images);

/* Writes where a held vertex is after the share t of the way. After all of it, that is its target,
 * bit for bit. */
void iccp_paths_at(const iccp_paths *paths, uint32_t vertex, double t, double *place);

/* The largest angle by which a group turns on its way, in turns. */
double iccp_paths_turn(const iccp_paths *paths);

#endif
