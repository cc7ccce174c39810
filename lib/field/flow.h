/* Curves of a field that is linear in each Kuhn simplex of a grid: its vectors are given at the
 * vertices. */
#ifndef ICCP_FLOW_H
#define ICCP_FLOW_H

#include "field/vectors.h"
#include "geometry/path.h"

enum {
    ICCP_FLOW_TERMS = 25, /* of a Taylor series at most */
    ICCP_FLOW_WITHIN = -1 /* instead of a corner: the piece ends within its simplex, or at the
                             root */
};

typedef struct iccp_flow {
    const icc_grid *grid;
    const icc_domain *domain;
    const iccp_incidence *incidence;
    const iccp_vectors *vectors;
    uint32_t root; /* where all curves end; in the simplices around it they are straight */
    size_t most_steps;
} iccp_flow;

/* Lattice units. How far beyond a facet that it starts on a curve may be without having crossed it:
 * curves that run along a facet do so for reasons of symmetry, up to rounding. */
#define ICCP_FLOW_SLACK 1e-15

/* A place in a simplex. */
typedef struct iccp_flow_place {
    iccp_kuhn_simplex simplex;
    int32_t entry;          /* the corner opposite to the facet that the place lies on, or
                               ICCP_FLOW_WITHIN */
    double at[ICC_MAX_DIM]; /* by axis, from the lowest corner: between 0 and 1 */
} iccp_flow_place;

/* A curve on its way, piece by piece: the one that starts at `place`. */
typedef struct iccp_flow_walk {
    const iccp_flow *flow;
    int32_t sign; /* +1: uphill, -1: downhill */
    iccp_flow_place place;
    double length; /* of the pieces before */
    double growth; /* and by how much the flow's volume has grown in them: its logarithm */
    size_t n_steps;
    /* The piece's parameter s goes from 0 to `end`. The place moves with the sum of term[j] (s
     * / scale)^j. */
    int32_t n_terms;
    double scale, term[ICCP_FLOW_TERMS][ICC_MAX_DIM];
    double column[ICC_MAX_DIM][ICC_MAX_DIM]; /* by axis: how the vector changes along it */
    bool radial; /* straight, in a simplex at the root; then `column` does not count */
    double end, end_length, end_growth;
    double finish[ICC_MAX_DIM]; /* the place at the end */
    int32_t exit; /* the corner opposite to the facet where the piece ends, or ICCP_FLOW_WITHIN */
    bool ends;    /* at the root */
} iccp_flow_walk;

/* Where a piece of a curve starts, so that it can be found again. */
typedef struct iccp_flow_mark {
    iccp_flow_place place;
    double length, growth; /* of the pieces before */
} iccp_flow_mark;

/* At a point in lattice coordinates; with `ahead`, a direction, in the simplex that lies there,
 * should the point be in several. False beyond the grid. */
bool iccp_flow_find(const iccp_flow *flow, const double *x, const double *ahead,
                    iccp_flow_place *place);

/* The vector there, and the lattice coordinates. */
void iccp_flow_vector(const iccp_flow *flow, const iccp_flow_place *place, double *vector);
void iccp_flow_position(const iccp_flow *flow, const iccp_flow_place *place, const double *at,
                        double *x);

/* A walk that has not found its first piece yet. */
void iccp_flow_begin(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                     const iccp_flow_place *place);

/* Starts a walk, and finds its first piece. ICC_ERR_TRACE when it cannot move. */
icc_status iccp_flow_start(iccp_flow_walk *walk, const iccp_flow *flow, int32_t sign,
                           const iccp_flow_place *place);

/* Continues with the next piece, of which there is one unless walk->ends. */
icc_status iccp_flow_next(iccp_flow_walk *walk);

/* Notes the start of the current piece, and goes back to the noted piece that holds the given
 * length. */
icc_status iccp_flow_note(const iccp_flow_walk *walk, iccp_path *path);
icc_status iccp_flow_rewind(iccp_flow_walk *walk, const iccp_path *path, double length);

/* The place within the cell at parameter s of the piece, and the vector there, times the sign. */
void iccp_flow_at(const iccp_flow_walk *walk, double s, double *at);
void iccp_flow_velocity(const iccp_flow_walk *walk, double s, double *vector);

/* The length of the piece from 0 to s, in lattice units; the other way round. */
double iccp_flow_length(const iccp_flow_walk *walk, double s);
double iccp_flow_at_length(const iccp_flow_walk *walk, double length);

/* The logarithm of how much the flow's volume grows from 0 to s. */
double iccp_flow_growth(const iccp_flow_walk *walk, double s);

/* Whether the piece meets the boundary: where first (the parameter), and the facet and barycentric
 * coordinates there. */
bool iccp_flow_leaves(const iccp_flow_walk *walk, double *s, uint32_t *facet, double *bary);

/* Whether a boundary facet may run through the simplex of a place. */
bool iccp_flow_near_boundary(const iccp_flow *flow, const iccp_flow_place *place);

#endif
