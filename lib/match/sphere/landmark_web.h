/* Paths between landmarks of two surfaces, the sectors between them, and ways from one sector to
 * another. */
#ifndef ICCP_LANDMARK_WEB_H
#define ICCP_LANDMARK_WEB_H

#include "base/heap.h"
#include "match/sphere/landmark_paths.h"

/* Sector 2 p + e of a landmark begins, counter-clockwise, with end e of path p: there are at most
 * two for each path. Behind them, one for each landmark without a path. */
typedef struct iccp_landmark_web {
    iccp_split_surface *s; /* 2 */
    size_t n, n_paths, most_paths, n_sectors, most_vertices[2];
    const uint32_t *const *vertices;
    uint32_t (*ends)[2]; /* landmarks, by path */
    uint8_t *joined;     /* n * n */
    bool *is_in;         /* by landmark: it has a path */
    bool *is_stale;      /* by sector: its costs have changed */
    double *cost;        /* n_sectors^2: of a path from one to another, by both lengths */
    bool is_even;        /* paths cost more whose lengths differ */
    uint32_t root;       /* landmark */
    const double *scale; /* of lengths, by side */
    double most_ratio;   /* of a path's lengths */
    iccp_paths_report report;
    /* Of the search on one side. */
    iccp_heap heap;
    size_t room;
    double *distance;  /* by vertex */
    uint32_t *via;     /* by vertex: the half-edge to it */
    double *arrival;   /* by sector */
    uint32_t *entered; /* by sector: the half-edge to its landmark */
} iccp_landmark_web;

/* The landmark that a sector is at. */
uint32_t iccp_web_landmark_of(const iccp_landmark_web *w, uint32_t sector);

/* So that n vertices of a side can be searched; whether there is memory. */
bool iccp_web_make_room(iccp_landmark_web *w, size_t n, const iccp_memory *memory);

/* Shortest ways from a sector through free vertices to all others, as far as they are at most so
 * long, each side's lengths times `scale`: `distance`, `via`, `arrival` and `entered`. */
void iccp_web_search(iccp_landmark_web *w, int side, uint32_t from, double most);

/* What paths from a sector to all others cost, if that is at most so much; both ways. Cost: the sum
 * of both lengths; where w->is_even times their ratio squared, the greater one by the other. */
void iccp_web_find_costs(iccp_landmark_web *w, uint32_t from, double most);

#endif
