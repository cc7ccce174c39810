/* The lines and rings of a whole layer as one network: nodes, and sides between them.
 *
 * If the layer is a coverage, whose polygons share sides, positions in the same place are one node,
 * and a node that lies on a side of another polygon becomes a vertex of that side, too. Then
 * neighbours have the same sides, and these have the same images. */
#ifndef GEO_LAYER_H
#define GEO_LAYER_H

#include "geo/carrier.h"
#include "geo/geo_index.h"

/* A side between two nodes, a < b. `on` are the nodes put into it, from a to b. */
typedef struct layer_side {
    uint32_t a, b;
    size_t first_on, n_on;
} layer_side;

typedef struct geo_layer {
    size_t *first; /* for each object of the index: its first position */
    size_t n;
    uint32_t *node; /* of each position; NULL if each is a node of its own */
    size_t n_nodes;
    double *nodes; /* 2 n_nodes; if `node` is not NULL, sorted by x, then by y */
    /* The nodes that have been mapped last, and of each of them: its image, the status of its
     * mapping, and whether it was snapped before */
    size_t first_mapped, n_mapped;
    double *images;
    icc_status *status;
    bool *snapped;
    size_t room_images, room_status, room_snapped;
    /* Sides, sorted by a, then by b. There are none unless vertices are put into sides. */
    size_t n_sides;
    layer_side *sides;
    uint32_t *on;
    size_t n_on;     /* nodes put into sides, counted for each side */
    size_t n_welded; /* positions that differ from their node by at most the length */
    size_t n_shared; /* sides, between all nodes, of two polygons or more */
} geo_layer;

/* Reads the coordinates of all live geometries. If polygons share sides, or `joined` is set, it
 * welds vertices within `length` of each other, and puts vertices into sides within `length`.
 * False: see `wrong`. Free the result in either case. */
bool geo_layer_read(geo_layer *out, const geo_index *index, const char *text, double length,
                    bool joined, problem *wrong);
void geo_layer_free(geo_layer *layer);

/* Maps the nodes first .. first + n - 1 and some that follow, unless this has been done. The images
 * of other nodes may be lost. */
icc_status geo_layer_map(geo_layer *layer, const carrier *c, size_t first, size_t n);

/* The side between two nodes, or NULL if nothing is put into it. */
const layer_side *geo_layer_side(const geo_layer *layer, uint32_t a, uint32_t b);

#endif
