/* Binary glTF: the places of its meshes' positions and indices in the file. It also finds how nodes
 * place the meshes, and their normals, tangents and morph targets. */
#ifndef GLB_H
#define GLB_H

#include "base/edits.h"
#include "base/json_tree.h"
#include "base/say.h"

#include <stdbool.h>
#include <stddef.h>

/* The items of an accessor: n of them, each `size` bytes, `stride` bytes apart, from byte `at` on. */
typedef struct glb_items {
    size_t at, n, size, stride;
} glb_items;

/* The type of the items of an accessor: integers, or 3, 4 or 16 floats each. */
typedef enum glb_kind { GLB_INDICES, GLB_THREE, GLB_FOUR, GLB_MATRIX } glb_kind;

/* An accessor that holds positions, and the number of its first vertex. */
typedef struct glb_positions {
    size_t accessor, first;
    glb_items items;
} glb_positions;

/* Data of a vertex besides its position: directions, and the displacements of its position and
 * directions by a morph target. */
typedef enum glb_use {
    GLB_NORMAL,
    GLB_TANGENT,
    GLB_MORPH,
    GLB_MORPH_NORMAL,
    GLB_MORPH_TANGENT
} glb_use;

typedef struct glb_vectors {
    glb_use use;
    size_t accessor;
    size_t set;   /* the positions to which it belongs */
    size_t base;  /* for a target's directions: the accessor to which they are added, or SIZE_MAX */
    size_t morph; /* for a target's directions: the accessor of its displacements, or SIZE_MAX */
    bool shared;  /* others use the same accessor, and their images may be different */
    glb_items items;
} glb_vectors;

typedef struct glb {
    const char *text; /* borrowed */
    json_tree tree;
    const json_item *json;    /* the root of the tree */
    size_t json_at, json_end; /* its chunk, in the text */
    size_t bin_at, bin_n;     /* the binary chunk */
    size_t n_accessors, n_views;
    const json_item **accessors, **views;
    size_t n_meshes, n_primitives;
    const json_item **primitives; /* of all meshes, one after another */
    size_t *starts;               /* of each mesh, and the end of all */
    size_t *set_of;      /* of an accessor that holds positions: its number among the sets below */
    size_t n_sets, room; /* in rising order in the file, without overlap */
    glb_positions *sets;
} glb;

/* Opens text[0..n), with text[n] == '\0'. False: see `wrong`. Close it in either case. */
bool glb_open(glb *out, const char *text, size_t n, problem *wrong);
void glb_close(glb *g);

/* Finds the items of the accessor that `index` names. `of` names its use in messages. */
bool glb_find_items(const glb *g, const json_item *index, const char *of, glb_kind kind,
                    size_t *accessor, glb_items *out, problem *wrong);

/* The number of the positions of a primitive. */
size_t glb_set_of(const glb *g, const json_item *primitive);

/* Gives each place where nodes draw a mesh a mesh of its own. *text is the scene with *n_copies of
 * them; free() it. NULL if there are none. False: see `wrong`. */
bool glb_split(const glb *g, char **text, size_t *n, size_t *n_copies, problem *wrong);

/* The affine maps (affine_map.h) by which nodes place each of the n_sets sets of positions; free()
 * them. Each set has one place, because the scene has been split. NULL: see `wrong`. */
double (*glb_find_places(const glb *g, problem *wrong))[12];

/* Finds all vectors; free() them. Directions that are not floats, or not one for each vertex, are
 * skipped and set *other. NULL although *n is not 0: see `wrong`. */
glb_vectors *glb_find_vectors(const glb *g, size_t *n, bool *other, problem *wrong);

/* True if positions, and n of their vectors, can be written in a text of that length without
 * affecting one another or indices. */
bool glb_is_apart(const glb *g, size_t n_text, size_t n, const glb_vectors *vectors,
                  problem *wrong);

/* Sets the bounds of an accessor to those of its items in `text`. Bounds that it does not have are
 * added. */
void glb_set_bounds(edits *e, const json_item *accessor, const char *text, const glb_items *items);

#endif
