/* A closed surface of triangles whose edges can be halved. */
#ifndef ICCP_SPLIT_SURFACE_H
#define ICCP_SPLIT_SURFACE_H

#include "match/surface/half_edges.h"

/* Half-edges are numbered as in match/surface/half_edges.h. */
typedef struct iccp_split_surface {
    iccp_memory memory;
    size_t n_vertices, n_faces, n_given; /* given vertices come first */
    size_t room_vertices, room_faces;
    double *x;             /* 3 n_vertices */
    uint32_t *origin;      /* 3 n_faces */
    uint32_t *twin;        /* 3 n_faces */
    uint32_t *part_of;     /* n_faces: the given face that contains each face */
    uint32_t *path;        /* 3 n_faces: the path that the edge belongs to, at both half-edges; or
                          ICCP_NO_EDGE */
    uint32_t *out;         /* n_vertices: a half-edge that starts at it; ICCP_NO_EDGE if it has no
                          faces */
    uint32_t *holder;      /* n_vertices: its path or landmark; or ICCP_NO_EDGE */
    uint32_t (*halves)[2]; /* n_vertices: the ends of the edge that it halves */
} iccp_split_surface;

static inline uint32_t iccp_split_end(const iccp_split_surface *s, uint32_t h)
{
    return s->origin[iccp_after(h)];
}

/* The next half-edge that starts at the same vertex, counter-clockwise and clockwise. */
static inline uint32_t iccp_split_turn(const iccp_split_surface *s, uint32_t h)
{
    return s->twin[iccp_before(h)];
}

static inline uint32_t iccp_split_turn_back(const iccp_split_surface *s, uint32_t h)
{
    return iccp_after(s->twin[h]);
}

/* Copies a complete surface, without paths. False if there is no memory. Free it in any case. */
bool iccp_split_surface_create(iccp_split_surface *s, const iccp_half_edges *m, const double *x,
                               const iccp_memory *memory);
void iccp_split_surface_free(iccp_split_surface *s);

/* Puts a vertex in the middle of an edge that is not part of a path. False if there is no
 * memory. */
bool iccp_split_halve(iccp_split_surface *s, uint32_t h);

/* Removes a vertex in the middle of an edge that belongs to no path. The other vertices keep their
 * numbers, but half-edges do not. Returns false if this is impossible: the vertex has more edges by
 * now, or its neighbours are joined by another edge. */
bool iccp_split_unite(iccp_split_surface *s, uint32_t vertex);

#endif
