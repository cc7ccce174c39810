/* Two domains with features that correspond, as bare vertices and walls, triangulated. */
#ifndef ICCP_SCENE_H
#define ICCP_SCENE_H

#include "domain/features.h"
#include "mesh/corners.h"

/* Vertices are those of the domains. The components are the outer ring, number 0, and the
 * features, number 1 + feature. */
typedef struct iccp_scene {
    iccp_memory memory;
    const icc_domain *domain[2]; /* source, target */
    size_t n;                    /* vertices */
    size_t n_components, n_walls;
    uint32_t *component; /* of each vertex */
    uint32_t *pairs;     /* 2 n_walls vertices: edges of the rings and segments of the lines */
    iccp_walls walls;
    iccp_corners mesh[2]; /* of what is inside, by these vertices alone, and constrained Delaunay;
                             twins across lines, not across rings */
    double scale;         /* lengths in the target are multiplied by this to compare with the
                             source's */
} iccp_scene;

icc_status iccp_scene_create(iccp_scene *scene, const icc_domain *source, const icc_domain *target,
                             const iccp_env *env);
void iccp_scene_free(iccp_scene *scene);

/* The constrained Delaunay triangulation of what is inside one of the two domains for n points, the
 * first of which are its vertices, and walls, among them the domain's own. The arrays of `mesh` are
 * the caller's to free. */
icc_status iccp_scene_triangulate(iccp_corners *mesh, const icc_domain *domain, size_t n,
                                  const double *points, const iccp_walls *walls,
                                  const iccp_env *env);

#endif
