/* Paths between vertices of a triangulation, up to moving them without crossing a vertex or a wall:
 * as the edges that they cross. */
#ifndef ICCP_WORD_H
#define ICCP_WORD_H

#include "map/compatible/plmap.h"
#include "map/isotopy/cuts.h"

/* A triangulation, counter-clockwise. */
typedef struct iccp_net {
    const iccp_corners *mesh;
    const double *points;    /* 2 for each vertex */
    const iccp_walls *walls; /* which nothing crosses; or NULL */
    uint32_t *corner;        /* of each vertex: one at it */
} iccp_net;

icc_status iccp_net_create(iccp_net *net, const iccp_corners *mesh, size_t n_vertices,
                           const double *points, const iccp_walls *walls,
                           const iccp_memory *memory);
void iccp_net_free(iccp_net *net, const iccp_memory *memory);

/* The smaller of the corners that face the edge between two vertices, which there is. */
uint32_t iccp_net_edge(const iccp_net *net, uint32_t a, uint32_t b);

/* A path, reduced: it crosses no edge forth and back at once, begins with an edge that does not end
 * where it does, and ends likewise. Two paths with the same ends can be moved one to the other,
 * with turns about their own ends where these are single points, just when they are the same
 * edges. */
typedef struct iccp_word {
    uint32_t ends[2];
    size_t n, room;
    uint32_t *sides; /* 2 n: the vertices right and left of each crossing */
} iccp_word;

typedef struct iccp_words {
    iccp_memory memory;
    size_t n;
    iccp_word *word;
} iccp_words;

/* Without crossings, and without ends. */
icc_status iccp_words_begin(iccp_words *words, size_t n, const iccp_memory *memory);
void iccp_words_free(iccp_words *words);
bool iccp_words_same(const iccp_words *a, const iccp_words *b);

/* What a polyline from vertex to vertex through n bends crosses. Exact. ICC_ERR_TOPOLOGY when it
 * meets a wall or leaves the triangulation. */
icc_status iccp_word_read(iccp_word *word, const iccp_net *net, uint32_t from, uint32_t to,
                          size_t n, const double *bends, const iccp_env *env);

/* One more crossing at the end, from a word that is not reduced yet. */
icc_status iccp_word_add(iccp_word *word, uint32_t right, uint32_t left, const iccp_env *env);

/* The ends of cuts in the target by a net of that. */
icc_status iccp_words_of_cuts(iccp_words *words, const iccp_cuts *cuts, const iccp_net *target,
                              const iccp_env *env);

/* The images of the source's side of cuts under a map, by a net of the target. */
icc_status iccp_words_of_images(iccp_words *words, const iccp_cuts *cuts, const iccp_plmap *map,
                                const icc_domain *source, const iccp_net *target,
                                const iccp_env *env);

#endif
