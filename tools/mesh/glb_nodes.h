/* The nodes of a glTF scene, and the skins whose joints they are. */
#ifndef GLB_NODES_H
#define GLB_NODES_H

#include "mesh/glb.h"

#include <stdint.h>

typedef struct glb_node {
    const json_item *json;
    size_t parent;     /* or SIZE_MAX */
    double own[12];    /* affine_map.h: from the node to its parent */
    double matrix[12]; /* from the node to the scene */
} glb_node;

typedef struct glb_nodes {
    size_t n;
    glb_node *list;
    size_t *order; /* parents before their children */
} glb_nodes;

/* Reads all nodes. False: see `wrong`. Free them in either case. */
bool glb_nodes_read(glb_nodes *out, const glb *g, problem *wrong);
void glb_nodes_free(glb_nodes *nodes);

/* The name of a node for messages. */
const char *glb_node_name(char out[32], const glb_node *node);

/* Joint k of a skin moves vertices to the scene by its inverse bind matrix, the k-th, and then by
 * the matrix of its node. If the skin stands as it was bound, these products are one matrix. */
typedef struct glb_skin {
    size_t n;
    uint32_t *joints; /* nodes */
    size_t accessor;  /* of the inverse bind matrices */
    glb_items inverses;
    double bind[12];   /* that one matrix; the identity if there is none */
    const char *stays; /* why its joints cannot be moved, or NULL */
} glb_skin;

/* Reads all skins. False: see `wrong`. Free them in either case. */
bool glb_skins_read(glb_skin **out, size_t *n, const glb *g, const glb_nodes *nodes,
                    problem *wrong);
void glb_skins_free(glb_skin *skins, size_t n);

/* Finds how a node, or its skin, places its mesh. False: see `wrong`. */
bool glb_place_node(const glb_nodes *nodes, const glb_skin *skins, size_t index, double out[12],
                    problem *wrong);

/* The skin of a node that draws a mesh, or NULL. */
const glb_skin *glb_skin_of(const glb_skin *skins, const glb_node *node);

#endif
