/* Declarations shared by the files that implement fit/elastic/elastic_model.h. */
#ifndef ICCP_ELASTIC_PARTS_H
#define ICCP_ELASTIC_PARTS_H

#include "domain/outlines.h"
#include "fit/elastic/contact.h"
#include "fit/elastic/elastic_model.h"
#include "fit/elastic/reach.h"
#include "map/energy/assembly.h"
#include "math/ldlt.h"

/* The places of the Hessian's entries and the order of elimination. They serve the triangles, the
 * bending and pairs that may touch. For the pattern, links (reach.h) and pairs (a, b, p) count as
 * further triangles. */
typedef struct iccp_elastic_plan {
    uint32_t *corners;  /* 3 for each triangle, link and pair, in this order */
    size_t first_touch; /* number of triangles and links */
    size_t n_touches;
    iccp_touch *touch;
    uint32_t *place;        /* of each entry of the bending matrix, see iccp_reach_find() */
    iccp_assembly assembly; /* of the shared plan: without sums */
    iccp_ldlt factor;       /* of the shared plan: without numbers */
} iccp_elastic_plan;

struct iccp_elastic {
    iccp_memory memory;
    size_t n_points, n_triangles;
    size_t n_mesh; /* the first triangles, which form the mesh */
    double *points;
    uint32_t *corners;
    uint8_t *hold;
    double *axis;    /* 2 n_points: unit directions of sliding vertices; (1, 0) for the others */
    double *element; /* ICCP_ELEMENT(2) for each triangle, with the weight in place of the area */
    double *spring;  /* n_points: the stiffness of the spring of a held or sliding vertex */
    double weight;   /* sum of the weights */
    iccp_reach reach;
    bool contact;
    iccp_contact_shape shape; /* the outlines, as contact needs them */
    iccp_outlines outlines;
    iccp_elastic_plan plan; /* without touching pairs */
};

/* The state of one solution. */
typedef struct iccp_elastic_state {
    const iccp_elastic *as;
    double *images;          /* the caller's */
    double *place;           /* 2 n_points: where springs pull and settled vertices are */
    double *pull;            /* n_points: factor of each spring's stiffness */
    uint8_t *settled;        /* n_points: 1: the told unknowns are fixed */
    double *motion, *saved;  /* 2 n_points */
    double *solution, *work; /* 2 n_points */
    double *term;            /* one for each triangle */
    iccp_elastic_plan own;   /* shares the plan, or has one with touching pairs */
    iccp_contact contact;
    iccp_env threads; /* without progress */
    size_t n_iterations;
} iccp_elastic_state;

/* Returns a view of the mesh with the present images. */
iccp_simplicial_map iccp_elastic_view(const iccp_elastic_state *state);

/* Makes a plan for the mesh and touching pairs, which are copied. */
icc_status iccp_elastic_plan_create(iccp_elastic_plan *plan, const iccp_elastic *elastic,
                                    size_t n_touches, const iccp_touch *touch, const iccp_env *env);
void iccp_elastic_plan_free(iccp_elastic_plan *plan, const iccp_memory *memory);

#endif
