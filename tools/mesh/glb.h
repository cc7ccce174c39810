/* Binary glTF: where the positions and indices of its meshes lie in the file, what nodes do to them, and
 * what is attached to them. */
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

/* What an accessor holds: whole numbers, or three or four floats an item. */
typedef enum glb_kind { GLB_INDICES, GLB_THREE, GLB_FOUR } glb_kind;

/* An accessor that holds positions, and the number of its first vertex. */
typedef struct glb_positions {
    size_t accessor, first;
    glb_items items;
} glb_positions;

/* What is attached to positions: directions, and displacements by a morph target of places and of
 * directions. */
typedef enum glb_use {
    GLB_NORMAL,
    GLB_TANGENT,
    GLB_MORPH,
    GLB_MORPH_NORMAL,
    GLB_MORPH_TANGENT
} glb_use;

typedef struct glb_vectors {
    glb_use use;
    size_t accessor, set; /* set: whose vertices */
    size_t base,
        morph;   /* of a target's directions: the accessors of what they are added to and of its
                             places, or SIZE_MAX */
    bool shared; /* by others, whose images may be different */
    glb_items items;
} glb_vectors;

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

/* The items of the accessor that `index` names, which is for `of`. */
bool glb_find_items(const glb *g, const cJSON *index, const char *of, glb_kind kind,
                    size_t *accessor, glb_items *out, problem *wrong);

/* What nodes do to each set of positions: n_sets of 12 numbers (affine_map.h), to be freed. NULL: see `wrong`. */
double (*glb_find_places(const glb *g, problem *wrong))[12];

/* All that is attached, to be freed; those of directions that are not floats, or not as many as the
 * vertices, set *other and are left out. NULL, and *n is not 0: see `wrong`. */
glb_vectors *glb_find_vectors(const glb *g, size_t *n, bool *other, problem *wrong);

/* Whether positions, and n of what is attached to them, can be written in a text of that length without
 * changing one another or indices. */
bool glb_is_apart(const glb *g, size_t n_text, size_t n, const glb_vectors *vectors,
                  problem *wrong);

/* Whether something is skinned, and whether nodes are animated. */
bool glb_has_skins(const glb *g);
bool glb_has_animations(const glb *g);

#endif
