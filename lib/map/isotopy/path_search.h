/* Finds shortest paths inside a domain with features. No path crosses another. */
#ifndef ICCP_PATH_SEARCH_H
#define ICCP_PATH_SEARCH_H

#include "base/heap.h"
#include "map/isotopy/domain_pair.h"
#include "mesh/vertex_fans.h"

/* Walls and paths that end at a vertex divide its surroundings into sectors. A sector is named
 * after its clockwise border. A wall's name is the vertex at its other end. A path's name is n + 2
 * path for its first end and n + 2 path + 1 for its last, where n counts the vertices. */
#define ICCP_WHOLE_SECTOR (UINT32_MAX - 1) /* of a vertex where nothing ends */
#define ICCP_ANY_SECTOR UINT32_MAX

/* The vertex of a path where it crosses an edge. */
typedef struct iccp_crossing {
    uint32_t path, place; /* the path, and the crossing's number on it */
    uint32_t edge;        /* edge of the bare triangulation, named by the smaller corner that
                             faces it; ICCP_NO_NEIGHBOUR if the crossing lies inside a triangle
                             of it */
    uint32_t next;        /* the next crossing on that edge, away from the vertex after the
                             corner; or ICCP_NO_NEIGHBOUR */
    bool is_forward;      /* the path has the edge's beginning on its right */
} iccp_crossing;

typedef struct iccp_path_ends {
    uint32_t vertex[2];
    uint32_t first, n; /* its crossings are vertices first to first + n - 1 */
    bool is_straight;  /* it runs along an edge and has one crossing on that edge */
} iccp_path_ends;

typedef struct iccp_path_search {
    iccp_memory memory;
    const iccp_domain_pair *domains;
    int side; /* 0 source, 1 target */
    size_t n_vertices, n_paths, vertex_room, triangle_room;
    iccp_corners mesh;       /* triangulation in which the laid paths run along edges */
    double *points;          /* 2 n_vertices */
    iccp_fans fans, bare;    /* of that triangulation, and of the bare one */
    iccp_crossing *crossing; /* of each vertex beyond the domain's */
    uint32_t *first;         /* of each corner of the bare triangulation: the first crossing on
                                its edge, or ICCP_NO_NEIGHBOUR */
    iccp_path_ends *path;    /* room for all components less one */
    iccp_heap queue;
    double *distance;   /* of each corner; valid if */
    uint32_t *stamp;    /* this equals `current` */
    uint32_t *previous; /* the corner crossed before, or ICCP_NO_NEIGHBOUR */
    uint8_t *is_goal;
    uint32_t current;
} iccp_path_search;

/* A path that was found but is not laid yet. */
typedef struct iccp_found_path {
    uint32_t from, to;
    double length;      /* exact up to half the size of triangles */
    uint32_t sector[2]; /* at its two ends */
    bool is_straight;
    size_t n, room;
    uint32_t *corner; /* n corners. Each faces an edge that the path crosses, in the triangle
                         that it leaves. A straight path has one, which faces its edge. */
} iccp_found_path;

icc_status iccp_path_search_create(iccp_path_search *search, const iccp_domain_pair *domains,
                                   int side, const iccp_env *env);
void iccp_path_search_free(iccp_path_search *search);

/* Removes all paths. */
void iccp_path_search_reset(iccp_path_search *search);

/* Finds a nearly shortest path between two vertices that leaves and arrives in the given sectors.
 * found->length is HUGE_VAL if no path is shorter than `most`. */
icc_status iccp_path_search_find(iccp_path_search *search, uint32_t from, uint32_t from_sector,
                                 uint32_t to, uint32_t to_sector, double most,
                                 iccp_found_path *found);

/* Lays a path that was found: later paths may not cross it. Paths found earlier become invalid. */
icc_status iccp_path_search_lay(iccp_path_search *search, const iccp_found_path *found);

void iccp_found_path_free(iccp_found_path *found, const iccp_memory *memory);

#endif
