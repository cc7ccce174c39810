/* Leaves of a foliation that are straight in every simplex of a mesh: the barycentric coordinates
 * of a simplex change at constant rates along them. docs/theory.md, foliations of simplices.
 *
 * A leaf that rises passes simplices of ever smaller rank and ends at the centre; one that falls
 * ends on the boundary. In the simplices at the centre, the star, leaves are straight lines to it.
 *
 * A place is a simplex and barycentric coordinates, which count up to a common factor: their sum
 * may drift away from 1 by rounding, and that does no harm. */
#ifndef ICCP_FIBRE_H
#define ICCP_FIBRE_H

#include "domain/facet_tree.h"
#include "domain/simplices.h"
#include "trace/path.h"

enum { ICCP_FIBRE_CORNERS = ICC_MAX_DIM + 1 };

/* A simplex has dim + 1 rates, a speed (length per unit of the rates; 0 in the star), a margin (a
 * point whose barycentric coordinates are all greater is not on the boundary) and dim + 1 sides,
 * two to a word. */
typedef union iccp_fibre_word {
    double number;
    uint32_t side[2];
} iccp_fibre_word;

/* The foliation, with simplices numbered so that neighbours are near each other in memory. The
 * corners of each are sorted: two simplices list the corners that they share in the same order. */
typedef struct iccp_fibres {
    iccp_memory memory;
    size_t dim;
    size_t n_simplices;
    uint32_t centre;
    const double *points;     /* borrowed from the mesh */
    uint32_t *corners;        /* dim + 1 each */
    iccp_fibre_word *records; /* see iccp_fibre_stride(); in 3-D one cache line each */
    iccp_fibre_word *block;   /* that they are part of */
    uint32_t *rim;            /* of each facet of the domain: its side */
    uint32_t *place;          /* of each simplex of the mesh: its number here */
    iccp_facet_tree tree;     /* of the simplices */
} iccp_fibres;

typedef struct iccp_fibre_place {
    uint32_t simplex;
    double bary[ICCP_FIBRE_CORNERS];
} iccp_fibre_place;

/* Derivatives of a place and of the length of the way to it by up to ICC_MAX_DIM parameters. */
typedef struct iccp_fibre_jet {
    size_t n;
    double bary[ICCP_FIBRE_CORNERS][ICC_MAX_DIM];
    double length[ICC_MAX_DIM];
} iccp_fibre_jet;

/* `direction`: see shelling/shelling_certificate.h. `tolerance`: points this close to the boundary
 * are on it. */
icc_status iccp_fibres_create(iccp_fibres *fibres, const iccp_simplices *mesh, uint32_t centre,
                              const double *direction, double tolerance, const iccp_env *env);
void iccp_fibres_free(iccp_fibres *fibres);

/* The direction in a simplex of the mesh, in the order of its corners there; all 1 in the star. */
void iccp_fibres_direction(const iccp_fibres *fibres, const iccp_simplices *mesh, size_t simplex,
                           double *direction);

/* The simplex that holds a point up to rounding: false if there is none near. Whether the point is
 * so far from the simplex's sides that it is certainly not on the boundary goes to `inner`. */
bool iccp_fibres_find(const iccp_fibres *fibres, const double *point, double tolerance,
                      iccp_fibre_place *place, bool *inner);

/* A place on a facet of the domain, by barycentric coordinates in the order of its vertices. */
void iccp_fibres_enter(const iccp_fibres *fibres, uint32_t facet, const uint32_t *vertices,
                       const double *bary, iccp_fibre_place *place);

/* The numbers of a place on the facet where a leaf that fell has ended, in the order of its
 * vertices. */
void iccp_fibres_facet(const iccp_fibres *fibres, const iccp_fibre_place *place,
                       const uint32_t *vertices, double *bary);

void iccp_fibres_point(const iccp_fibres *fibres, const iccp_fibre_place *place, double *point);

/* From a corner of its simplex to a place. */
void iccp_fibres_offset(const iccp_fibres *fibres, const iccp_fibre_place *place, size_t corner,
                        double *offset);

/* Derivatives of the barycentric coordinates of a simplex by the point's coordinates. */
void iccp_fibres_gradient(const iccp_fibres *fibres, uint32_t simplex, iccp_fibre_jet *jet);

/* Derivatives of the point by the parameters of a jet: dim rows of jet->n. */
void iccp_fibres_movement(const iccp_fibres *fibres, const iccp_fibre_place *place,
                          const iccp_fibre_jet *jet, double movement[ICC_MAX_DIM][ICC_MAX_DIM]);

/* Follows the leaf to the centre; returns its length. The place becomes the first one in the
 * star. */
double iccp_fibres_rise(const iccp_fibres *fibres, iccp_fibre_place *place);

/* Follows it to the boundary. */
double iccp_fibres_fall(const iccp_fibres *fibres, iccp_fibre_place *place, uint32_t *facet);

/* The same with derivatives: jet->length starts at 0. When the leaf enters simplex `stop`, the jet
 * there is copied to `stopped`; both may be left out (UINT32_MAX, NULL). */
double iccp_fibres_rise_jet(const iccp_fibres *fibres, iccp_fibre_place *place, iccp_fibre_jet *jet,
                            uint32_t stop, iccp_fibre_jet *stopped);
double iccp_fibres_fall_jet(const iccp_fibres *fibres, iccp_fibre_place *place, uint32_t *facet,
                            iccp_fibre_jet *jet);

/* The same, with a note of every place where the leaf enters a simplex, the first place included,
 * and the length up to there. Rising, the last note stands for the centre; falling, for the
 * boundary. */
icc_status iccp_fibres_note_rise(const iccp_fibres *fibres, const iccp_fibre_place *place,
                                 iccp_path *path);
icc_status iccp_fibres_note_fall(const iccp_fibres *fibres, const iccp_fibre_place *place,
                                 iccp_path *path);

/* The place of a note. */
void iccp_fibres_noted(const iccp_path *path, size_t k, iccp_fibre_place *place);

/* Moves a place up by a length within its simplex, where the leaf has length `piece` from there
 * on. */
void iccp_fibres_ahead(const iccp_fibres *fibres, double length, double piece,
                       iccp_fibre_place *place);

/* Derivatives after that move, from those before it and those of the two lengths. */
void iccp_fibres_ahead_jet(const iccp_fibres *fibres, const iccp_fibre_place *place, double length,
                           double piece, const double *d_length, const double *d_piece,
                           iccp_fibre_jet *jet);

static inline double iccp_fibre_sum(const double *bary, size_t corners)
{
    double sum = 0;
    for (size_t i = 0; i < corners; ++i)
        sum += bary[i];
    return sum;
}

static inline size_t iccp_fibre_stride(size_t corners)
{
    return corners + 2 + (corners + 1) / 2;
}

static inline const iccp_fibre_word *iccp_fibre_record(const iccp_fibres *fibres, uint32_t simplex)
{
    return fibres->records + iccp_fibre_stride(fibres->dim + 1) * simplex;
}

#endif
