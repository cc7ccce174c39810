/* Follows curves of a field that is linear in each Kuhn simplex of a grid. The field is given by a
 * vector at each vertex.
 *
 * Source: docs/theory/charts-space.md, "fields on grids", step 3. A curve's place is computed
 * afresh from a power series in each simplex, so there is no step size and no drift. */
#ifndef ICCP_FLOW_H
#define ICCP_FLOW_H

#include "field/vectors.h"
#include "geometry/path.h"

enum {
    ICCP_FLOW_TERMS = 25, /* the most terms of a Taylor series */
    ICCP_FLOW_WITHIN = -1 /* used instead of a corner: the piece ends within its simplex or at the
                             root */
};

typedef struct iccp_flow {
    const icc_grid *grid;
    const icc_domain *domain;
    const iccp_incidence *incidence;
    const iccp_vectors *vectors;
    uint32_t root; /* where all curves end; curves in the simplices around it are straight */
    size_t most_steps;
} iccp_flow;

/* Lattice units. A curve may be this far beyond the facet that it starts on without having
 * crossed it. Symmetric fields have curves that run along a facet, up to rounding. */
#define ICCP_FLOW_SLACK 1e-15

/* A place in a simplex. */
typedef struct iccp_flow_place {
    iccp_kuhn_simplex simplex;
    int32_t entry;          /* the corner opposite to the facet that the place lies on, or
                               ICCP_FLOW_WITHIN */
    double at[ICC_MAX_DIM]; /* by axis, relative to the lowest corner: between 0 and 1 */
} iccp_flow_place;

/* A curve on its way, piece by piece. The current piece starts at `place`. */
typedef struct iccp_flow_walk {
    const iccp_flow *flow;
    int32_t sign; /* +1: uphill, -1: downhill */
    iccp_flow_place place;
    double length; /* total length of the earlier pieces */
    double growth; /* logarithm of the factor by which the flow's volume has grown in the earlier
                      pieces */
    size_t n_steps;
    /* The parameter s of the current piece goes from 0 to `end`. The place moves by the sum of
     * term[j] (s / scale)^j. */
    int32_t n_terms;
    double scale, term[ICCP_FLOW_TERMS][ICC_MAX_DIM];
    double column[ICC_MAX_DIM][ICC_MAX_DIM]; /* by axis: how the vector changes along it */
    bool radial; /* the piece is straight, in a simplex at the root; then `column` is not used */
    double end, end_length, end_growth;
    double finish[ICC_MAX_DIM]; /* the place at the end of the piece */
    int32_t exit; /* the corner opposite to the facet where the piece ends, or ICCP_FLOW_WITHIN */
    bool ends;    /* the piece ends at the root */
} iccp_flow_walk;

/* The start of a piece, noted so that it can be found again. */
typedef struct iccp_flow_mark {
    iccp_flow_place place;
    double length, growth; /* of the earlier pieces */
} iccp_flow_mark;

/* Finds the place of a point in lattice coordinates. If several simplices hold the point, the
 * direction `ahead`, unless NULL, selects the one that lies ahead. Returns false beyond the
 * grid. */
bool iccp_flow_find(const iccp_flow *flow, const double *x, const double *ahead,
                    iccp_flow_place *place);

/* The vector at a place, and its lattice coordinates. */
void iccp_flow_vector(const iccp_flow *flow, const iccp_flow_place *place, double *vector);
void iccp_flow_position(const iccp_flow *flow, const iccp_flow_place *place, const double *at,
                        double *x);

/* Sets up a walk, without its first piece. */
void iccp_flow_begin(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                     const iccp_flow_place *place);

/* Starts a walk and finds its first piece. Fails with ICC_ERR_TRACE if the curve cannot move. */
icc_status iccp_flow_start(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                           const iccp_flow_place *place);

/* Continues with the next piece. Call it only while walk->ends is false. */
icc_status iccp_flow_next(iccp_flow_walk *walk);

/* iccp_flow_note() notes the start of the current piece. iccp_flow_rewind() goes back to the
 * noted piece that holds the given length. */
icc_status iccp_flow_note(const iccp_flow_walk *walk, iccp_path *path);
icc_status iccp_flow_rewind(iccp_flow_walk *walk, const iccp_path *path, double length);

/* The place within the cell at parameter s of the piece, and the vector there times the sign. */
void iccp_flow_at(const iccp_flow_walk *walk, double s, double *at);
void iccp_flow_velocity(const iccp_flow_walk *walk, double s, double *vector);

/* iccp_flow_length() is the length of the piece from 0 to s, in lattice units.
 * iccp_flow_at_length() is its inverse. */
double iccp_flow_length(const iccp_flow_walk *walk, double s);
double iccp_flow_at_length(const iccp_flow_walk *walk, double length);

/* Logarithm of the factor by which the flow's volume grows from 0 to s. */
double iccp_flow_growth(const iccp_flow_walk *walk, double s);

/* Returns true if the piece meets the boundary. Writes the parameter of the first such point,
 * its facet and its barycentric coordinates. */
bool iccp_flow_leaves(const iccp_flow_walk *walk, double *s, uint32_t *facet, double *bary);

/* Returns true if a boundary facet may run through the simplex of a place. */
bool iccp_flow_near_boundary(const iccp_flow *flow, const iccp_flow_place *place);

#endif
