/* Leaves of a foliation that are straight in every simplex of a mesh. Along a leaf, the
 * barycentric coordinates of a simplex change at constant rates. Source:
 * docs/theory/charts-space.md, "foliations of simplices".
 *
 * A leaf that rises passes simplices of ever smaller rank and ends at the centre. A leaf that falls
 * ends on the boundary. In the star, the simplices at the centre, leaves are straight lines to it.
 *
 * A place is a simplex and barycentric coordinates, which matter only up to a common factor. So
 * their sum may drift away from 1 by rounding. */
#ifndef ICCP_LEAFN_H
#define ICCP_LEAFN_H

#include "geometry/facet_tree.h"
#include "geometry/path.h"
#include "geometry/simplices.h"

enum { ICCP_LEAFN_CORNERS = ICC_MAX_DIM + 1 };

/* A word of a simplex's record. The record has dim + 1 rates, a speed, a margin, and dim + 1
 * sides, two to a word. The speed is length per unit of the rates, and 0 in the star. A point
 * whose barycentric coordinates all exceed the margin is not on the boundary. */
typedef union iccp_leafn_word {
    double number;
    uint32_t side[2];
} iccp_leafn_word;

/* The foliation. Its simplices are numbered so that neighbours are near each other in memory.
 * The corners of each are sorted, so two simplices list their common corners in the same order. */
typedef struct iccp_leaves {
    iccp_memory memory;
    size_t dim;
    size_t n_simplices;
    uint32_t centre;
    const double *points;     /* borrowed from the mesh */
    uint32_t *corners;        /* dim + 1 each */
    iccp_leafn_word *records; /* see iccp_leafn_stride(); in 3-D each record is one cache line */
    iccp_leafn_word *block;   /* the allocated block that contains the records */
    uint32_t *boundary_side;  /* of each facet of the domain: its side */
    uint32_t *place;          /* of each simplex of the mesh: its number here */
    iccp_facet_tree tree;     /* boxes of the simplices */
} iccp_leaves;

typedef struct iccp_leafn_place {
    uint32_t simplex;
    double bary[ICCP_LEAFN_CORNERS];
} iccp_leafn_place;

/* Derivatives of a place, and of the length of the leaf up to it, by up to ICC_MAX_DIM
 * parameters. */
typedef struct iccp_leafn_jet {
    size_t n;
    double bary[ICCP_LEAFN_CORNERS][ICC_MAX_DIM];
    double length[ICC_MAX_DIM];
} iccp_leafn_jet;

/* Creates the leaves. `direction` is explained in shelling/shelling_certificate.h. Points within
 * `tolerance` of the boundary count as on it. */
icc_status iccp_leafn_create(iccp_leaves *leaves, const iccp_simplices *mesh, uint32_t centre,
                             const double *direction, double tolerance, const iccp_env *env);
void iccp_leafn_free(iccp_leaves *leaves);

/* The direction in a simplex of the mesh, in the order of its corners there. All rates are 1 in
 * the star. */
void iccp_leafn_direction(const iccp_leaves *leaves, const iccp_simplices *mesh, size_t simplex,
                          double *direction);

/* Finds the simplex that holds a point up to rounding. Returns false if there is none near.
 * `*inner` is set if the point is so far from the simplex's sides that it is certainly not on
 * the boundary. */
bool iccp_leafn_find(const iccp_leaves *leaves, const double *point, double tolerance,
                     iccp_leafn_place *place, bool *inner);

/* The place of a point of a facet of the domain, given by barycentric coordinates in the order
 * of `vertices`. */
void iccp_leafn_enter(const iccp_leaves *leaves, uint32_t facet, const uint32_t *vertices,
                      const double *bary, iccp_leafn_place *place);

/* The barycentric coordinates on the facet where a falling leaf has ended, in the order of
 * `vertices`. */
void iccp_leafn_facet(const iccp_leaves *leaves, const iccp_leafn_place *place,
                      const uint32_t *vertices, double *bary);

void iccp_leafn_point(const iccp_leaves *leaves, const iccp_leafn_place *place, double *point);

/* The offset from a corner of its simplex to a place. */
void iccp_leafn_offset(const iccp_leaves *leaves, const iccp_leafn_place *place, size_t corner,
                       double *offset);

/* Writes the derivatives of a simplex's barycentric coordinates by the point's coordinates. */
void iccp_leafn_gradient(const iccp_leaves *leaves, uint32_t simplex, iccp_leafn_jet *jet);

/* Derivatives of the point by the parameters of a jet: dim rows of jet->n numbers. */
void iccp_leafn_movement(const iccp_leaves *leaves, const iccp_leafn_place *place,
                         const iccp_leafn_jet *jet, double movement[ICC_MAX_DIM][ICC_MAX_DIM]);

/* Follows the leaf to the centre and returns its length. The place becomes the first one in the
 * star. */
double iccp_leafn_rise(const iccp_leaves *leaves, iccp_leafn_place *place);

/* Follows the leaf to the boundary and returns its length. */
double iccp_leafn_fall(const iccp_leaves *leaves, iccp_leafn_place *place, uint32_t *facet);

/* Like iccp_leafn_rise() and iccp_leafn_fall(), with derivatives. jet->length must start at 0.
 * When the rising leaf enters simplex `stop`, its jet is copied to `stopped`. Pass UINT32_MAX
 * and NULL to leave this out. */
double iccp_leafn_rise_jet(const iccp_leaves *leaves, iccp_leafn_place *place, iccp_leafn_jet *jet,
                           uint32_t stop, iccp_leafn_jet *stopped);
double iccp_leafn_fall_jet(const iccp_leaves *leaves, iccp_leafn_place *place, uint32_t *facet,
                           iccp_leafn_jet *jet);

/* Follows the leaf and notes the first place and every place where the leaf enters a simplex,
 * each with the length up to it. The last note is the centre if the leaf rises, and the boundary
 * if it falls. */
icc_status iccp_leafn_note_rise(const iccp_leaves *leaves, const iccp_leafn_place *place,
                                iccp_path *path);
icc_status iccp_leafn_note_fall(const iccp_leaves *leaves, const iccp_leafn_place *place,
                                iccp_path *path);

/* The place of a note. */
void iccp_leafn_noted(const iccp_path *path, size_t k, iccp_leafn_place *place);

/* Moves a place up the leaf by a length, within its simplex. `piece` is the leaf's length from
 * the place to the end of the simplex. */
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
