/* The order in which the vertices of two outlines are merged. */
#ifndef ICCP_MERGE_ORDER_H
#define ICCP_MERGE_ORDER_H

#include "match/outline/outline.h"

/* A vertex of one outline or of both, or a landmark. */
typedef struct iccp_event {
    double at[2]; /* shares, unwrapped from the cut */
    uint32_t vertex[2];
    double d; /* their distance, in units of the shorter edge; negative for a landmark */
    bool is_fixed;
} iccp_event;

typedef struct iccp_merge_order {
    const iccp_outline *outline[2];
    size_t n[2];
    double cut[2]; /* where both outlines are cut open */
    double *place; /* of all vertices, those of the source first: shares from the cut */
    double *edge;  /* the shorter edge at each vertex */
    uint32_t *order[2], *work;
    double *knot; /* pairs: the pairing from the cut to the cut */
    size_t n_knots;
    double *bent; /* the same, bent through all joined vertices */
    size_t n_bent;
    iccp_event *join, *event;
    size_t n_joins, n_events;
    unsigned char *is_joined; /* of all vertices */
} iccp_merge_order;

/* Returns where n monotone knots take x, which is on side `from`. */
double iccp_merge_order_follow(const double *knot, size_t n, int from, double x);

/* Orders events along the source, then along the target; for iccp_sort(). */
int iccp_event_by_source(const void *a, const void *b);

/* Finds the joins, in order along both outlines: landmarks, and pairs of vertices close to each
 * other. Vertices closer than `drop`, as a share of the perimeter, are joined in any case. */
void iccp_merge_vertices(iccp_merge_order *w, size_t n_landmarks, const double *landmarks,
                         double drop);

#endif
