/* Binary glTF: where the positions and indices of its meshes lie in the file. */
#ifndef GLB_H
#define GLB_H

#include "base/say.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

/* The items of an accessor: n of them, each `size` bytes, `stride` bytes apart, from byte `at` on. */
typedef struct glb_items {
    size_t at, n, size, stride;
} glb_items;

/* An accessor that holds positions, and the number of its first vertex. */
typedef struct glb_positions {
    size_t accessor, first;
    glb_items items;
} glb_positions;

typedef struct glb {
    const char *text; /* borrowed */
    cJSON *json;
    size_t json_end;      /* of its chunk, in the text */
    size_t bin_at, bin_n; /* the binary chunk */
    size_t n_accessors, n_views;
    const cJSON **accessors, **views;
    size_t *set_of;      /* of an accessor that holds positions: which of the sets below */
    size_t n_sets, room; /* ascending in the file, apart */
    glb_positions *sets;
} glb;

/* Opens text[0..n), with text[n] == '\0'. False: see `wrong`. Close it in either case. */
bool glb_open(glb *out, const char *text, size_t n, problem *wrong);
void glb_close(glb *g);

/* The items of the accessor that `index` names. They are positions, or whole numbers. */
bool glb_find_items(const glb *g, const cJSON *index, bool positions, size_t *accessor,
                    glb_items *out, problem *wrong);

#endif
