/* The paths between landmarks of two surfaces, the sectors between them, and shortest paths from
 * one sector to another. */
#ifndef ICCP_LANDMARK_WEB_H
#define ICCP_LANDMARK_WEB_H

#include "base/heap.h"
#include "match/sphere/landmark_paths.h"

/* Sector 2 p + e of a landmark begins, counter-clockwise, with end e of path p, so there are two
 * sectors for each path. After these come the sectors of landmarks without a path, one for each. */
typedef struct iccp_landmark_web {
    iccp_split_surface *s; /* 2 */
    size_t n, n_paths, most_paths, n_sectors, most_vertices[2];
    const uint32_t *const *vertices;
    uint32_t (*ends)[2]; /* landmarks, by path */
    uint8_t *joined;     /* n * n */
    bool *is_in;         /* by landmark: it has a path */
    bool *is_stale;      /* by sector: its costs have changed */
    double *cost;        /* n_sectors^2: cost of a path between two sectors, by its lengths on
                            both sides */
    bool is_even;        /* paths whose two lengths differ cost more */
    uint32_t root;       /* a landmark */
    const double *scale; /* of lengths, by side */
    double most_ratio;   /* of a path's two lengths */
    iccp_paths_report report;
    /* The search on one side. */
    iccp_heap heap;
    size_t room;
    double *distance;  /* by vertex */
    uint32_t *via;     /* by vertex: the half-edge to it */
    double *arrival;   /* by sector: the distance to it */
    uint32_t *entered; /* by sector: the half-edge to its landmark */
} iccp_landmark_web;

/* The landmark of a sector. */
uint32_t iccp_web_landmark_of(const iccp_landmark_web *w, uint32_t sector);

/* Makes room to search n vertices of a side. Returns false if there is no memory. */
bool iccp_web_make_room(iccp_landmark_web *w, size_t n, const iccp_memory *memory);

/* Finds shortest paths from a sector through free vertices to all other sectors, up to length
 * `most`. Lengths are multiplied by `scale`. Fills in `distance`, `via`, `arrival` and
 * `entered`. */
void iccp_web_search(iccp_landmark_web *w, int side, uint32_t from, double most);

/* Finds the costs of paths from a sector to all others, in both directions, up to `most`. The cost
 * is the sum of both lengths. If w->is_even, it is multiplied by the squared ratio of the greater
 * length to the smaller. */
void iccp_web_find_costs(iccp_landmark_web *w, uint32_t from, double most);

#endif
