/* Leaves of a foliation that are straight in every simplex of a mesh: the barycentric coordinates
 * of a simplex change at constant rates along them. docs/theory.md, foliations of simplices.
 *
 * A leaf that rises passes simplices of ever smaller rank and ends at the centre; one that falls
 * ends on the boundary. In the simplices at the centre, the star, leaves are straight lines to it.
 *
 * A place is a simplex and barycentric coordinates, which count up to a common factor: their sum
 * may drift away from 1 by rounding, and that does no harm. */
#ifndef ICCP_LEAFN_H
#define ICCP_LEAFN_H

#include "geometry/facet_tree.h"
#include "geometry/path.h"
#include "geometry/simplices.h"

enum { ICCP_LEAFN_CORNERS = ICC_MAX_DIM + 1 };

/* A simplex has dim + 1 rates, a speed (length per unit of the rates; 0 in the star), a margin (a
 * point whose barycentric coordinates are all greater is not on the boundary) and dim + 1 sides,
 * two to a word. */
typedef union iccp_leafn_word {
    double number;
    uint32_t side[2];
} iccp_leafn_word;

/* The foliation, with simplices numbered so that neighbours are near each other in memory. The
 * corners of each are sorted: two simplices list the corners that they share in the same order. */
typedef struct iccp_leaves {
    iccp_memory memory;
    size_t dim;
    size_t n_simplices;
    uint32_t centre;
    const double *points;     /* borrowed from the mesh */
    uint32_t *corners;        /* dim + 1 each */
    iccp_leafn_word *records; /* see iccp_leafn_stride(); in 3-D one cache line each */
    iccp_leafn_word *block;   /* that they are part of */
    uint32_t *boundary_side;  /* of each facet of the domain: its side */
    uint32_t *place;          /* of each simplex of the mesh: its number here */
    iccp_facet_tree tree;     /* of the simplices */
} iccp_leaves;

typedef struct iccp_leafn_place {
    uint32_t simplex;
    double bary[ICCP_LEAFN_CORNERS];
} iccp_leafn_place;

/* Derivatives of a place and of the length of the way to it by up to ICC_MAX_DIM parameters. */
typedef struct iccp_leafn_jet {
    size_t n;
    double bary[ICCP_LEAFN_CORNERS][ICC_MAX_DIM];
    double length[ICC_MAX_DIM];
} iccp_leafn_jet;

/* `direction`: see shelling/shelling_certificate.h. `tolerance`: points this close to the boundary
 * are on it. */
icc_status iccp_leafn_create(iccp_leaves *leaves, const iccp_simplices *mesh, uint32_t centre,
                             const double *direction, double tolerance, const iccp_env *env);
void iccp_leafn_free(iccp_leaves *leaves);

/* The direction in a simplex of the mesh, in the order of its corners there; all 1 in the star. */
void iccp_leafn_direction(const iccp_leaves *leaves, const iccp_simplices *mesh, size_t simplex,
                          double *direction);

/* The simplex that holds a point up to rounding: false if there is none near. Whether the point is
 * so far from the simplex's sides that it is certainly not on the boundary goes to `inner`. */
bool iccp_leafn_find(const iccp_leaves *leaves, const double *point, double tolerance,
                     iccp_leafn_place *place, bool *inner);

/* A place on a facet of the domain, by barycentric coordinates in the order of its vertices. */
void iccp_leafn_enter(const iccp_leaves *leaves, uint32_t facet, const uint32_t *vertices,
                      const double *bary, iccp_leafn_place *place);

/* The numbers of a place on the facet where a leaf that fell has ended, in the order of its
 * vertices. */
void iccp_leafn_facet(const iccp_leaves *leaves, const iccp_leafn_place *place,
                      const uint32_t *vertices, double *bary);

void iccp_leafn_point(const iccp_leaves *leaves, const iccp_leafn_place *place, double *point);

/* From a corner of its simplex to a place. */
void iccp_leafn_offset(const iccp_leaves *leaves, const iccp_leafn_place *place, size_t corner,
                       double *offset);

/* Derivatives of the barycentric coordinates of a simplex by the point's coordinates. */
void iccp_leafn_gradient(const iccp_leaves *leaves, uint32_t simplex, iccp_leafn_jet *jet);

/* Derivatives of the point by the parameters of a jet: dim rows of jet->n. */
void iccp_leafn_movement(const iccp_leaves *leaves, const iccp_leafn_place *place,
                         const iccp_leafn_jet *jet, double movement[ICC_MAX_DIM][ICC_MAX_DIM]);

/* Follows the leaf to the centre; returns its length. The place becomes the first one in the
 * star. */
double iccp_leafn_rise(const iccp_leaves *leaves, iccp_leafn_place *place);

/* Follows it to the boundary. */
double iccp_leafn_fall(const iccp_leaves *leaves, iccp_leafn_place *place, uint32_t *facet);

/* The same with derivatives: jet->length starts at 0. When the leaf enters simplex `stop`, the jet
 * there is copied to `stopped`; both may be left out (UINT32_MAX, NULL). */
double iccp_leafn_rise_jet(const iccp_leaves *leaves, iccp_leafn_place *place, iccp_leafn_jet *jet,
                           uint32_t stop, iccp_leafn_jet *stopped);
double iccp_leafn_fall_jet(const iccp_leaves *leaves, iccp_leafn_place *place, uint32_t *facet,
                           iccp_leafn_jet *jet);

/* The same, with a note of every place where the leaf enters a simplex, the first place included,
 * and the length up to there. Rising, the last note stands for the centre; falling, for the
 * boundary. */
icc_status iccp_leafn_note_rise(const iccp_leaves *leaves, const iccp_leafn_place *place,
                                iccp_path *path);
icc_status iccp_leafn_note_fall(const iccp_leaves *leaves, const iccp_leafn_place *place,
                                iccp_path *path);

/* The place of a note. */
void iccp_leafn_noted(const iccp_path *path, size_t k, iccp_leafn_place *place);

/* Moves a place up by a length within its simplex, where the leaf has length `piece` from there
 * on. */
void iccp_leafn_ahead(const iccp_leaves *leaves, double length, double piece,
                      iccp_leafn_place *place);

/* Derivatives after that move, from those before it and those of the two lengths. */
void iccp_leafn_ahead_jet(const iccp_leaves *leaves, const iccp_leafn_place *place, double length,
                          double piece, const double *d_length, const double *d_piece,
                          iccp_leafn_jet *jet);

static inline double iccp_leafn_sum(const double *bary, size_t corners)
{
    double sum = 0;
    for (size_t i = 0; i < corners; ++i)
        sum += bary[i];
    return sum;
}

static inline size_t iccp_leafn_stride(size_t corners)
{
    return corners + 2 + (corners + 1) / 2;
}

static inline const iccp_leafn_word *iccp_leafn_record(const iccp_leaves *leaves, uint32_t simplex)
{
    return leaves->records + iccp_leafn_stride(leaves->dim + 1) * simplex;
}

#endif
