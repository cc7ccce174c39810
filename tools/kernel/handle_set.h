/* Handles and what goes with them, from JSON: where they are, the edges between them, lines to keep
 * straight, further regions and curves of the shape, weights to be painted, rigid parts. */
#ifndef HANDLE_SET_H
#define HANDLE_SET_H

#include "base/say.h"

#include <icc/kernel.h>
#include <stdbool.h>

typedef struct outline {
    size_t n;
    double *points; /* n * 2 */
} outline;

/* What lies in a polygon of the plane, or in a ball. */
typedef struct rigid_part {
    outline region; /* of 0 points: the ball */
    double centre[3], radius, rigidity;
} rigid_part;

/* More weight for a handle, less and less towards the radius; or all within it starts anew. */
typedef struct stroke {
    uint32_t handle;
    double centre[3], radius, amount;
    double *weights; /* n_handles, which are optimised; NULL: handle and amount count */
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

/* Reads a pose, {"transforms": [..]} or {"moves": [..]}: n_handles * dim * (dim + 1) numbers, made
 * with need(), or NULL. `handles` are where the handles are at rest. */
double *pose_read(size_t dim, size_t n_handles, const double *handles, const char *text, size_t n,
                  problem *wrong);

#endif
