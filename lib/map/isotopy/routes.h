/* Paths through the inside of a domain with features, none of which crosses another. */
#ifndef ICCP_ROUTES_H
#define ICCP_ROUTES_H

#include "base/heap.h"
#include "map/isotopy/scene.h"

/* Sectors at a vertex are what its walls and the paths that end there cut its surroundings into. A
 * sector has the name of what bounds it clockwise: a wall's, the vertex at its other end; a path's,
 * n + 2 path + (0 for its first end, 1 for its last), where n counts the vertices. */
#define ICCP_WHOLE_SECTOR (UINT32_MAX - 1) /* of a vertex where nothing ends */
#define ICCP_ANY_SECTOR UINT32_MAX

/* A vertex of a path where it crosses an edge. */
typedef struct iccp_crossing {
    uint32_t path, place; /* which path, and where on it */
    uint32_t edge;        /* of the bare triangulation, by the smaller of the corners that face it;
                             ICCP_NO_NEIGHBOUR: none, it crosses within a triangle of that */
    uint32_t next;        /* the crossing after it on that edge, away from the vertex after the
                             corner; or ICCP_NO_NEIGHBOUR */
    bool is_forward;      /* the path has the edge's beginning on its right */
} iccp_crossing;

typedef struct iccp_path_ends {
    uint32_t vertex[2];
    uint32_t first, n; /* its crossings are n vertices from this one on */
    bool is_straight;  /* it runs along an edge, and its one crossing is on it */
} iccp_path_ends;

typedef struct iccp_routes {
    iccp_memory memory;
    const iccp_scene *scene;
    int side; /* of the scene */
    size_t n_vertices, n_paths, vertex_room, triangle_room;
    iccp_corners mesh;       /* in which paths laid so far run along edges */
    double *points;          /* 2 n_vertices */
    uint32_t *corner;        /* of each vertex: one at it */
    uint32_t *bare_corner;   /* the same for the vertices of the bare triangulation */
    iccp_crossing *crossing; /* of each vertex beyond those of the scene */
    uint32_t *first;         /* of each corner of the bare triangulation: the first crossing on its
                                edge, or ICCP_NO_NEIGHBOUR */
    iccp_path_ends *path;    /* room for one less than there are components */
    iccp_heap queue;
    double *distance;   /* of each corner, valid if */
    uint32_t *stamp;    /* this is the search's */
    uint32_t *previous; /* the corner crossed before, or ICCP_NO_NEIGHBOUR */
    uint8_t *is_goal;
    uint32_t search;
} iccp_routes;

/* A way that was found. */
typedef struct iccp_way {
    uint32_t from, to;
    double length;      /* up to half the size of triangles */
    uint32_t sector[2]; /* at its ends */
    bool is_straight;
    size_t n, room;
    uint32_t *corner; /* n: of the edges it crosses, those that it leaves a triangle by; of a
                         straight way, one that faces its edge */
} iccp_way;

icc_status iccp_routes_create(iccp_routes *routes, const iccp_scene *scene, int side,
                              const iccp_env *env);
void iccp_routes_free(iccp_routes *routes);

/* No paths again. */
void iccp_routes_reset(iccp_routes *routes);

/* The shortest way, about, between two vertices, leaving and arriving in given sectors; shorter
 * than `most`. way->length is HUGE_VAL when there is none. */
icc_status iccp_routes_find(iccp_routes *routes, uint32_t from, uint32_t from_sector, uint32_t to,
                            uint32_t to_sector, double most, iccp_way *way);

/* Makes a way a path. Ways found before are then of no use any more. */
icc_status iccp_routes_lay(iccp_routes *routes, const iccp_way *way);

void iccp_way_free(iccp_way *way, const iccp_memory *memory);

#endif
