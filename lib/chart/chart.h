/* The chart object: coordinates of a domain's inside, whatever the method. A method is a table of
 * operations on local points; bulk calls, maps and measures are written once, on top of the
 * table. */
#ifndef ICCP_CHART_H
#define ICCP_CHART_H

#include "base/blob.h"
#include "domain/domain.h"
#include "icc/icc.h"
#include "mesh/planar.h"
#include "trace/path.h"

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

/* The maximum has all boundary points: it stands with the middle of facet 0. */
void iccp_coords_of_maximum(int32_t dim, iccp_coords *coords);

/* A curve as a polyline of local points, from the boundary to the maximum; for
 * icc_chart_trace(). */
typedef icc_status (*iccp_emit)(void *argument, const double *local);

/* Points that are handled at once: long enough to outweigh the handing out, short enough to cancel
 * quickly. */
enum { ICCP_CHART_MANY = 128 };

typedef struct iccp_chart_ops {
    /* The point is inside or on the boundary. `jet` may be NULL; it is refused (ICC_ERR_TRACE)
     * where there is no derivative. `path` is scratch. */
    icc_status (*encode)(const icc_chart *chart, const double *point, iccp_coords *coords,
                         iccp_encode_jet *jet, iccp_path *path);
    icc_status (*decode)(const icc_chart *chart, const iccp_coords *coords, double *point,
                         iccp_decode_jet *jet, iccp_path *path);
    /* The same for at most ICCP_CHART_MANY points, without derivatives, bit for bit; NULL where
     * that is not faster. Points whose status is not ICC_OK are left out, and what happens to one
     * is its status; returned is what concerns all. `volume`: for each the logarithm of the local
     * volume there per area of the boundary and share of the way, NaN on the boundary and at the
     * maximum; or NULL. */
    icc_status (*encode_many)(const icc_chart *chart, size_t n, const double *points,
                              iccp_coords *coords, double *volume, icc_status *status,
                              iccp_path *path);
    icc_status (*decode_many)(const icc_chart *chart, size_t n, const iccp_coords *coords,
                              double *points, double *volume, icc_status *status, iccp_path *path);
    icc_status (*trace)(const icc_chart *chart, const double *point, iccp_path *path,
                        iccp_emit emit, void *argument);
    /* Fills in everything but `size`; n_points > 0. NULL for methods that miss nothing. */
    icc_status (*measure)(const icc_chart *chart, size_t n_points, icc_chart_report *measures,
                          const iccp_env *env);
    /* What the method's loader wants, without the domain (chart/load.h). */
    void (*save)(const icc_chart *chart, iccp_blob *w);
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
    } own; /* what only the chart's method has */
    const iccp_chart_ops *ops;
    void *state;             /* the method's own */
    const iccp_planar *mesh; /* the domain's that the chart lives on, part of the state; or
                                NULL */
};

/* A chart without a method yet: the creator of a method fills in ops, state and info. */
icc_status iccp_chart_new(icc_chart **out, const icc_domain *domain, const iccp_env *env);
icc_chart *iccp_chart_retain(const icc_chart *chart);
void iccp_chart_release(icc_chart *chart);

/* Whether the chart is of method foliation on the domain's mesh. */
bool iccp_chart_is_shelling(const icc_chart *chart);

#endif
