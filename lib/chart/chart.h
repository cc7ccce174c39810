/* The chart object: coordinates of a domain's inside, by any method. A method is a table of
 * operations on local points that have a curve of their own. Batch calls are written once on top of
 * the table. So are points without a curve: outside, on the boundary and at the maximum.
 *
 * Words of this folder. Begin with iccp_chart_ops.
 * - coordinates: where the curve of a point meets the boundary (facet, barycentric coordinates),
 *   and the share t of the curve's length below the point.
 * - maximum: the point where all curves end. In lib/field it is the root, in lib/foliation and
 *   lib/shelling the centre.
 * - local: in the domain's frame, in which its size is about 1; see geometry/frame.h.
 * - encode, decode: from a point to its coordinates, and back.
 * - place: where a point lies, in the terms of its method.
 * - jet: derivatives of the result of encode or decode.
 * - trivial: a point without a curve of its own, so its coordinates are known at once.
 * - end: coordinates of the boundary or of the maximum, where a curve ends.
 * - loss: a point and its coordinates do not lead to each other (losses.h).
 *
 * Ways: chart.c handles one point, encode_points.c a few, encode_all.c many. losses.c tells which
 * do not come back. low_discrepancy.h spreads sample points.
 *
 * Invariants: after its creation a chart changes only by `ready`. Methods stand in folders
 * above, and none of them is named here. lib/method creates charts. Source: Huynh and Gingold,
 * Bijective Deformations in R^n via Integral Curve Coordinates. */
#ifndef ICCP_CHART_H
#define ICCP_CHART_H

#include "base/blob.h"
#include "domain/domain.h"
#include "geometry/path.h"
#include "icc/icc.h"
#include "mesh/planar.h"

/* The coordinates of one point. */
typedef struct iccp_coords {
    uint32_t facet;
    double bary[ICC_MAX_DIM];
    double t;
} iccp_coords;

/* Derivatives of coordinates by the local point: bary[i * dim + j] is that of bary i by point
 * coordinate j. */
typedef struct iccp_encode_jet {
    double bary[ICC_MAX_DIM * ICC_MAX_DIM];
    double t[ICC_MAX_DIM];
} iccp_encode_jet;

/* Derivatives of the local point by coordinates. bary[i * dim + j] is that of point coordinate i
 * by bary j. When bary j grows, bary 0 falls by as much, so column 0 is zero. */
typedef struct iccp_decode_jet {
    double bary[ICC_MAX_DIM * ICC_MAX_DIM];
    double t[ICC_MAX_DIM];
} iccp_decode_jet;

/* Receives a curve from icc_chart_trace() as a polyline of local points, from the boundary to
 * the maximum. */
typedef icc_status (*iccp_emit)(void *argument, const double *local);

/* Number of points that are handled at once. It is large enough to outweigh the cost of a call,
 * and small enough to cancel quickly. */
enum { ICCP_CHART_MANY = 128 };

/* Room for the place of an inside point: a struct of the method, which copies its bytes in and
 * out. */
typedef struct iccp_chart_place {
    unsigned char bytes[2 * ICC_MAX_DIM * sizeof(double)];
} iccp_chart_place;

/* The operations of a method. All points are local. `path` is scratch memory. */
typedef struct iccp_chart_ops {
    int32_t number;  /* ICC_METHOD_... */
    uint64_t format; /* the method's number in saved bytes (docs/reference/formats.md) */
    bool is_later;   /* version 2 of saved charts brought this format; version 1 has the others */
    bool is_planar;  /* the method is for domains of dimension 2 only */
    bool needs_mesh; /* the method needs a mesh of the inside in every given domain */

    /* Creates the chart of one domain, or the charts of two that correspond. Those of a pair
     * have the same cuts of the boundary and paired maxima. The options are complete, and those
     * of a pair differ only in `maximum`. On failure all charts are NULL. For a pair, err->side
     * tells which one failed. */
    icc_status (*create)(size_t n, icc_chart **out, const icc_domain *const *domain,
                         const icc_chart_options *options, const iccp_env *env, icc_error *err);
    /* Reads what `save` has written. Fails with ICC_ERR_FORMAT or ICC_ERR_CERTIFICATE if it is
     * no chart. Fails with ICC_ERR_VERSION and a message if the chart differs from the saved
     * one. */
    icc_status (*read)(icc_chart **out, const icc_domain *domain, iccp_blob *r, const iccp_env *env,
                       icc_error *err);
    void (*save)(const icc_chart *chart, iccp_blob *w);

    /* Returns ICC_INSIDE and writes the place, or ICC_BOUNDARY and writes facet and barycentric
     * coordinates to `coords`, or ICC_OUTSIDE. NULL for methods that need no place; the domain
     * is then asked. */
    int32_t (*locate)(const icc_chart *chart, const double *point, iccp_chart_place *place,
                      iccp_coords *coords);
    /* Encode and decode one point. The point must be inside and not the maximum, so 0 < t < 1.
     * `jet` may be NULL. If it is not and there is no derivative, they fail with ICC_ERR_TRACE. */
    icc_status (*encode)(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                         iccp_coords *coords, iccp_encode_jet *jet);
    /* Encodes vertex v inside the chart's own mesh. NULL for methods that treat it like any
     * point. */
    void (*encode_vertex)(const icc_chart *chart, size_t v, iccp_coords *coords);
    icc_status (*decode)(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path);
    /* Encode and decode many points without derivatives, with the same bits. NULL if that is not
     * faster. The n points are those that `which` selects, of at most ICCP_CHART_MANY. Only
     * `place` counts from 0 to n. `status` gets the outcome of each point, and the return value
     * is an error that concerns all of them. `volume`, or NULL, gets for each point the
     * logarithm of local volume per area of the boundary and per share of the curve. */
    icc_status (*encode_many)(const icc_chart *chart, size_t n, const size_t *which,
                              const iccp_chart_place *place, iccp_coords *coords, double *volume,
                              icc_status *status, iccp_path *path);
    icc_status (*decode_many)(const icc_chart *chart, size_t n, const size_t *which,
                              const iccp_coords *coords, double *points, double *volume,
                              icc_status *status, iccp_path *path);
    /* Traces the curve through a point that is not the maximum. `boundary` holds its coordinates
     * if it lies on the boundary, and is NULL if it is inside. */
    icc_status (*trace)(const icc_chart *chart, const double *point, const iccp_chart_place *place,
                        const iccp_coords *boundary, iccp_path *path, iccp_emit emit,
                        void *argument);
    /* Tell whether other curves join that of a point on its way down, and that of coordinates
     * below their point. NULL for methods whose curves do not merge. */
    bool (*merges_down)(const icc_chart *chart, const double *point);
    bool (*merges_up)(const icc_chart *chart, const iccp_coords *coords);
    /* Fills in all members but `size`. n_points > 0. NULL for methods that miss no points. */
    icc_status (*measure)(const icc_chart *chart, size_t n_points, icc_chart_report *measures,
                          const iccp_env *env);
    /* The function on a grid that the curves follow; NULL for methods without one. */
    const icc_function *(*function)(const icc_chart *chart);
    /* Makes data that encode or decode would make at its first call. Parallel callers must call
     * it first. Returns ICC_OK or ICC_ERR_MEMORY. NULL for methods that have no such data. */
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
    } own; /* information that only the chart's method has */
    icc_chart_timings timings;
    double maximum[ICC_MAX_DIM]; /* local */
    const iccp_chart_ops *ops;
    void *state;             /* the method's own data */
    const iccp_planar *mesh; /* the chart's mesh of the domain, part of the state; or NULL */
};

/* A chart without a method. The creator of the method then fills in ops, state, info and
 * maximum. */
icc_status iccp_chart_new(icc_chart **out, const icc_domain *domain, const iccp_env *env);
icc_chart *iccp_chart_retain(const icc_chart *chart);
void iccp_chart_release(icc_chart *chart);
void iccp_chart_set_maximum(icc_chart *chart, const double *local);

/* ---- one local point ---- */

/* Returns true if a point has no curve of its own: it is outside, the maximum, or on the
 * boundary. `*status` and `coords` are then the result. Otherwise `place` is set for the method. */
bool iccp_chart_is_trivial(const icc_chart *chart, const double *point, iccp_chart_place *place,
                           iccp_coords *coords, icc_status *status);

/* Returns true if the coordinates are those of a point of the boundary or of the maximum, and
 * writes that point. */
bool iccp_chart_is_end(const icc_chart *chart, const iccp_coords *coords, double *point);

/* Encode and decode one point. `jet` may be NULL. If it is not and there is no derivative, they
 * fail with ICC_ERR_TRACE. There is none on the boundary and at the maximum. */
icc_status iccp_chart_encode(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet);
icc_status iccp_chart_decode(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path);

/* See iccp_chart_ops. */
icc_status iccp_chart_ready(const icc_chart *chart, bool decodes);

/* Encodes vertex v inside chart->mesh. The result is that of its point, up to rounding. */
icc_status iccp_chart_encode_vertex(const icc_chart *chart, size_t v, iccp_coords *coords);

/* Emits the curve through a point, from the boundary to the maximum. For the maximum it emits
 * only that point. */
icc_status iccp_chart_trace(const icc_chart *chart, const double *point, iccp_path *path,
                            iccp_emit emit, void *argument);

/* Returns true if the chart is of method foliation on the domain's own mesh. */
bool iccp_chart_is_shelling(const icc_chart *chart);

#endif
