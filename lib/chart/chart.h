/* The chart object: coordinates of a domain's inside, whatever the method. A method is a table of
 * operations on local points with a curve of their own. Bulk calls, and points that have no curve
 * (outside, on the boundary and at the maximum), are written once, on top of the table.
 *
 * Legend of lib/chart. Begin with iccp_chart_ops.
 * - coordinates: where the curve of a point meets the boundary (facet, barycentric coordinates),
 *   and the share of the curve's length that lies below the point.
 * - encode, decode: from a point to its coordinates, and back.
 * - place: where a point lies, in the terms of its method.
 * - jet: derivatives of what encode or decode gives.
 * - settled, end: without a curve of its own.
 *
 * Invariants: a chart does not change once it is made, but for what `ready` makes. Methods stand in
 * folders above; none of them is named here. lib/method makes charts. */
#ifndef ICCP_CHART_H
#define ICCP_CHART_H

#include "base/blob.h"
#include "domain/domain.h"
#include "geometry/path.h"
#include "icc/icc.h"
#include "mesh/planar.h"

/* Coordinates of one point. */
typedef struct iccp_coords {
    uint32_t facet;
    double bary[ICC_MAX_DIM];
    double t;
} iccp_coords;

/* Derivative of coordinates by the local point: bary[i * dim + j] of bary i by point coordinate
 * j. */
typedef struct iccp_encode_jet {
    double bary[ICC_MAX_DIM * ICC_MAX_DIM];
    double t[ICC_MAX_DIM];
} iccp_encode_jet;

/* Derivative of the local point by coordinates: bary[i * dim + j] of point coordinate i by bary j,
 * bary 0 giving way (column 0 is zero). */
typedef struct iccp_decode_jet {
    double bary[ICC_MAX_DIM * ICC_MAX_DIM];
    double t[ICC_MAX_DIM];
} iccp_decode_jet;

/* A curve as a polyline of local points, from the boundary to the maximum; for
 * icc_chart_trace(). */
typedef icc_status (*iccp_emit)(void *argument, const double *local);

/* Points that are handled at once: long enough to outweigh the handing out, short enough to cancel
 * quickly. */
enum { ICCP_CHART_MANY = 128 };

/* Where a point inside lies: room for a struct of the method that searches for it, which copies its
 * bytes in and out. */
typedef struct iccp_chart_place {
    unsigned char bytes[2 * ICC_MAX_DIM * sizeof(double)];
} iccp_chart_place;

/* All points are local. `path` is scratch. */
typedef struct iccp_chart_ops {
    int32_t number;  /* ICC_METHOD_... */
    uint64_t format; /* what the method is called in bytes (docs/formats.md) */
    bool is_planar;  /* for domains of dimension 2 alone */
    bool needs_mesh; /* for domains that have a mesh of their inside, all of those given */

    /* The chart of one domain, or those of two that correspond: with the same cuts of the boundary
     * and paired maxima. The options are complete and differ in `maximum` only. On failure all are
     * NULL, and of two err->side says which one failed. */
    icc_status (*create)(size_t n, icc_chart **out, const icc_domain *const *domain,
                         const icc_chart_options *options, const iccp_env *env, icc_error *err);
    /* What `save` has written. ICC_ERR_FORMAT or ICC_ERR_CERTIFICATE if it is no chart,
     * ICC_ERR_VERSION, with its reason, if it comes out otherwise than before. */
    icc_status (*read)(icc_chart **out, const icc_domain *domain, iccp_blob *r, const iccp_env *env,
                       icc_error *err);
    void (*save)(const icc_chart *chart, iccp_blob *w);

    /* ICC_INSIDE, with the place; ICC_BOUNDARY, with facet and barycentric coordinates in `coords`;
     * or ICC_OUTSIDE. NULL for methods that need no place: the domain is asked. */
    int32_t (*locate)(const icc_chart *chart, const double *point, iccp_chart_place *place,
                      iccp_coords *coords);
    /* The point is inside and not the maximum; likewise 0 < t < 1. `jet` may be NULL; it is refused
     * (ICC_ERR_TRACE) where there is no derivative. */
    icc_status (*encode)(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                         iccp_coords *coords, iccp_encode_jet *jet);
    /* Vertex v inside the chart's own mesh; NULL for methods that look for it like any point. */
    void (*encode_vertex)(const icc_chart *chart, size_t v, iccp_coords *coords);
    icc_status (*decode)(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path);
    /* The same without derivatives, bit for bit; NULL where that is not faster. For the n points
     * `which` of at most ICCP_CHART_MANY; `place` alone counts from 0 to n. What happens to a point
     * is its status; returned is what concerns all. `volume`: for each the logarithm of the local
     * volume there per area of the boundary and share of the way; or NULL. */
    icc_status (*encode_many)(const icc_chart *chart, size_t n, const size_t *which,
                              const iccp_chart_place *place, iccp_coords *coords, double *volume,
                              icc_status *status, iccp_path *path);
    icc_status (*decode_many)(const icc_chart *chart, size_t n, const size_t *which,
                              const iccp_coords *coords, double *points, double *volume,
                              icc_status *status, iccp_path *path);
    /* The point is inside, or on the boundary with these coordinates, else NULL; and not the
     * maximum. */
    icc_status (*trace)(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                        const iccp_coords *boundary, iccp_path *path, iccp_emit emit,
                        void *argument);
    /* Fills in everything but `size`; n_points > 0. NULL for methods that miss nothing. */
    icc_status (*measure)(const icc_chart *chart, size_t n_points, icc_chart_report *measures,
                          const iccp_env *env);
    /* The function on a grid that the curves follow; NULL for methods without one. */
    const icc_function *(*function)(const icc_chart *chart);
    /* Makes what encode or decode makes when it is first asked: who asks in parallel does so first.
     * ICC_OK or ICC_ERR_MEMORY. NULL for methods that have all they need. */
    icc_status (*ready)(const icc_chart *chart, bool decodes);
    void (*free_state)(icc_chart *chart);
} iccp_chart_ops;

struct icc_chart {
    iccp_memory memory;
    atomic_size_t references;
    icc_domain *domain;
    icc_chart_info info; /* with the maximum in the caller's coordinates */
    union {
        icc_gradient_info gradient;
        icc_field_info field;
        icc_foliation_info foliation;
        icc_shelling_info shelling; /* see iccp_chart_is_shelling() */
        icc_disc_info disc;
    } own;                       /* what only the chart's method has */
    double maximum[ICC_MAX_DIM]; /* local */
    const iccp_chart_ops *ops;
    void *state;             /* the method's own */
    const iccp_planar *mesh; /* the domain's that the chart lives on, part of the state; or
                                NULL */
};

/* A chart without a method yet: the creator of a method fills in ops, state, info and maximum. */
icc_status iccp_chart_new(icc_chart **out, const icc_domain *domain, const iccp_env *env);
icc_chart *iccp_chart_retain(const icc_chart *chart);
void iccp_chart_release(icc_chart *chart);
void iccp_chart_set_maximum(icc_chart *chart, const double *local);

/* ---- one local point ---- */

/* Whether a point has no curve of its own: it is outside, the maximum, or on the boundary. Then
 * *status and `coords` are the answer; else `place` is for the method. */
bool iccp_chart_is_settled(const icc_chart *chart, const double *point, iccp_chart_place *place,
                           iccp_coords *coords, icc_status *status);

/* Whether coordinates are those of a point of the boundary or of the maximum. Then it is
 * written. */
bool iccp_chart_is_end(const icc_chart *chart, const iccp_coords *coords, double *point);

/* `jet` may be NULL; it is refused (ICC_ERR_TRACE) where there is no derivative, as there is none
 * on the boundary and at the maximum. */
icc_status iccp_chart_encode(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet);
icc_status iccp_chart_decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path);

/* See iccp_chart_ops. */
icc_status iccp_chart_ready(const icc_chart *chart, bool decodes);

/* The same as of its point, up to rounding, for vertex v inside chart->mesh. */
icc_status iccp_chart_encode_vertex(const icc_chart *chart, size_t v, iccp_coords *coords);

/* The curve through a point, from the boundary to the maximum; of the maximum, the point alone. */
icc_status iccp_chart_trace(const icc_chart *chart, const double *point, iccp_path *path,
                            iccp_emit emit, void *argument);

/* Whether the chart is of method foliation on the domain's mesh. */
bool iccp_chart_is_shelling(const icc_chart *chart);

#endif
