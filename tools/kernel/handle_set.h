/* Handles and related data from JSON. They include places, edges between handles, lines to keep
 * straight, further regions and curves of the shape, weights to be painted, and rigid parts. */
#ifndef HANDLE_SET_H
#define HANDLE_SET_H

#include "base/say.h"

#include <icc/kernel.h>
#include <stdbool.h>

typedef struct outline {
    size_t n;
    double *points; /* n * 2 */
} outline;

/* The inside of a plane polygon, or of a ball. */
typedef struct rigid_part {
    outline region; /* 0 points: the ball */
    double centre[3], radius, rigidity;
} rigid_part;

/* A stroke gives a handle more weight, less and less towards the radius. Or it replaces all weights
 * within the radius. */
typedef struct stroke {
    uint32_t handle;
    double centre[3], radius, amount;
    double *weights; /* n_handles weights, which are then optimised; if NULL, handle and amount
                        are used */
} stroke;

typedef struct handle_set {
    size_t dim;
    size_t n_handles;
    double *handles; /* n_handles * dim */
    size_t n_edges;
    uint32_t *edges;   /* n_edges * 2 */
    bool linear_edges; /* weights are linear along the edges */
    size_t n_lines;
    icc_line *lines;
    size_t n_regions;
    outline *regions;
    size_t n_vertices; /* of the curves */
    double *vertices;  /* n_vertices * dim */
    size_t n_segments;
    uint32_t *segments; /* n_segments * 2 */
    size_t n_strokes;
    stroke *strokes;
    size_t n_rigid;
    rigid_part *rigid;
} handle_set;

/* Reads text[0..n), with text[n] == '\0'. False: see `wrong`, and `out` is empty. */
bool handle_set_read(handle_set *out, const char *text, size_t n, problem *wrong);
void handle_set_free(handle_set *set);

/* Reads a pose, {"transforms": [..]} or {"moves": [..]}. Returns n_handles * dim * (dim + 1)
 * numbers, made with need(), or NULL. `handles` are the places of the handles at rest. */
double *pose_read(size_t dim, size_t n_handles, const double *handles, const char *text, size_t n,
                  problem *wrong);

#endif
