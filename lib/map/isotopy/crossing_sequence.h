/* A path between two vertices of a triangulation, up to isotopy, stored as the sequence of edges
 * that it crosses. An isotopy may not move the path across a vertex or a wall. */
#ifndef ICCP_CROSSING_SEQUENCE_H
#define ICCP_CROSSING_SEQUENCE_H

#include "map/compatible/plmap.h"
#include "map/isotopy/cuts.h"

/* A triangulation, counter-clockwise. */
typedef struct iccp_triangulation {
    const iccp_corners *mesh;
    const double *points;    /* 2 for each vertex */
    const iccp_walls *walls; /* edges that no path crosses, or NULL */
    iccp_fans fans;
} iccp_triangulation;

icc_status iccp_triangulation_create(iccp_triangulation *triangulation, const iccp_corners *mesh,
                                     size_t n_vertices, const double *points,
                                     const iccp_walls *walls, const iccp_memory *memory);
void iccp_triangulation_free(iccp_triangulation *triangulation, const iccp_memory *memory);

/* A reduced path. It never crosses an edge and then at once crosses it back. Its first edge does
 * not end at its first vertex, nor its last edge at its last vertex.
 *
 * Two paths with the same ends are isotopic exactly if their sequences are equal. The isotopy may
 * turn a path about an end that is a single point. */
typedef struct iccp_sequence {
    uint32_t ends[2];
    size_t n, room;
    uint32_t *sides; /* 2 n: for each crossing, the edge's end on the right, then on the left */
} iccp_sequence;

typedef struct iccp_sequences {
    iccp_memory memory;
    size_t n;
    iccp_sequence *sequence;
} iccp_sequences;

/* Makes n sequences without crossings. The caller then sets their ends. */
icc_status iccp_sequences_begin(iccp_sequences *sequences, size_t n, const iccp_memory *memory);
void iccp_sequences_free(iccp_sequences *sequences);
bool iccp_sequences_same(const iccp_sequences *a, const iccp_sequences *b);

/* Finds the edges that a polyline crosses. It runs from vertex to vertex through n bends. Exact.
 * ICC_ERR_TOPOLOGY if it meets a wall or leaves the triangulation. */
icc_status iccp_sequence_read(iccp_sequence *sequence, const iccp_triangulation *triangulation,
                              uint32_t from, uint32_t to, size_t n, const double *bends,
                              const iccp_env *env);

/* Appends a crossing to a sequence whose ends have not been reduced yet. A crossing that undoes the
 * last one removes it instead. */
icc_status iccp_sequence_add(iccp_sequence *sequence, uint32_t right, uint32_t left,
                             const iccp_env *env);

/* The target's side of each cut, as a sequence in a triangulation of the target. */
icc_status iccp_sequences_of_cuts(iccp_sequences *sequences, const iccp_cuts *cuts,
                                  const iccp_triangulation *target, const iccp_env *env);

/* The images under a map of the source's side of each cut, as sequences in a triangulation of the
 * target. */
icc_status iccp_sequences_of_images(iccp_sequences *sequences, const iccp_cuts *cuts,
                                    const iccp_plmap *map, const icc_domain *source,
                                    const iccp_triangulation *target, const iccp_env *env);

#endif
