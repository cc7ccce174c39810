/* Two layers of polygons in GeoJSON whose regions are named by a property. */
#ifndef LAYER_FILE_H
#define LAYER_FILE_H

#include "base/json_tree.h"

#include <icc/icc.h>

typedef struct layer {
    json_tree tree;
    char *text;
    size_t n_rings, n, room, room_first, room_names, room_holes;
    size_t *first;
    double *vertices;
    char **names; /* of each ring */
    int64_t *ids;
    uint8_t *holes;
} layer;

typedef struct layers {
    layer side[2];
    char **names; /* different ones, sorted */
    size_t n_names;
} layers;

/* Reads one side from a text of n bytes, which the layers own from then on, and which ends with a 0.
 * `by` is the property. False: see `wrong`. Start with zeros, and free the layers in any case. */
bool layers_read(layers *l, int side, char *text, size_t n, const char *by, problem *wrong);

/* Numbers the names, once both sides have been read. */
void layers_number(layers *l);

/* One side in the form that the library takes; borrowed. */
icc_layer layers_side(const layers *l, int side);
void layers_free(layers *l);

#endif
