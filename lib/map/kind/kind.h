/* The map object, and the table of operations that each kind of map provides. What all kinds share
 * is written once in lib/map, on top of the table.
 *
 * Words of this folder. Begin with iccp_map_kind.
 * - kind: a table of operations. Plane and solid are the mesh maps (ICC_MAP_MESH) in two and three
 *   dimensions. A curve map goes point by point through two charts (ICC_MAP_CURVES).
 * - state: the data of a map that only its kind knows.
 * - certificate: the proof that a map is one-to-one; *_certificate.c in each kind's folder.
 *
 * Ways: lib/map/plane, lib/map/solid and lib/map/curves fill the table. caller_point.h maps one
 * point in the caller's coordinates, map_facts.h holds what a map's info says.
 *
 * Invariants: after its creation a map changes only by `ready`. Every map has been certified in
 * its final form before the caller gets it (iccp_map_conclude()). Only a curve map may lack its
 * certificate, and it then gives the reason. */
#ifndef ICCP_KIND_H
#define ICCP_KIND_H

#include "chart/chart.h"
#include "map/energy/simplicial_map.h"
#include "map/kind/map_facts.h"

/* The operations of a kind. Those that a kind does not have are NULL. Points are in the caller's
 * coordinates. */
typedef struct iccp_map_kind {
    int32_t number; /* ICC_MAP_... */

    /* `suits` returns true if there are maps of this kind between domains like this one. `takes`
     * returns true if one can be made from two charts of the source's method. */
    bool (*suits)(const icc_domain *source);
    bool (*takes)(const icc_chart *source);

    /* Makes the state of a map that has its domains and, unless these have features, its charts.
     * Fills in map->info. If no such map is found, the state stays NULL, with ICC_OK, and
     * info.n_unrepaired is not 0. */
    icc_status (*create)(icc_map *map, const icc_map_options *options, const iccp_env *env,
                         icc_error *err);

    /* Certifies the map as it is now. Sets info.certified, and the reason if the certificate
     * does not hold. A mesh map that cannot be certified fails with ICC_ERR_CERTIFICATE. */
    icc_status (*certify)(icc_map *map, const iccp_env *env, icc_error *err);
    /* Fills in what a certified map implies about features. */
    icc_status (*describe)(icc_map *map, const iccp_env *env);

    /* Maps at most ICCP_CHART_MANY points forward or back. `images` or `jacobians` may be NULL.
     * `status` gets the outcome of each point, and the return value is an error that concerns
     * all of them. Call `ready` first, which makes the data that is made at the first need. */
    icc_status (*ready)(const icc_map *map, bool inverse);
    icc_status (*apply)(const icc_map *map, bool inverse, size_t n, const double *points,
                        double *images, double *jacobians, icc_status *status, iccp_path *path);

    /* `mesh` returns the mesh on which the map is linear. `regions` fills in the region of each of
     * its simplices; if it is NULL, all have number 0. After the images of `mesh` have been changed
     * in place, `renew` updates the data that depends on them. *kept is false if the change left
     * the isotopy class of the features. The caller then restores the images. */
    iccp_simplicial_map (*mesh)(const icc_map *map);
    icc_status (*regions)(const icc_map *map, uint32_t *regions);
    icc_status (*renew)(icc_map *map, bool *kept, const iccp_env *env);

    /* `improve` makes the state of a better map, `retarget` that of a map to the domain
     * next->target_domain. `next` has its domains. If they are those of `map`, it also has the
     * charts and the info of `map`.
     * If `retarget` cannot reach the domain, it leaves the state NULL, with ICC_OK; see
     * `create`. *vertex is then a vertex of the boundary where the way is blocked, if the kind
     * knows one. */
    icc_status (*improve)(icc_map *next, const icc_map *map, const icc_improve_options *options,
                          icc_improve_report *report, const iccp_env *env, icc_error *err);
    icc_status (*retarget)(icc_map *next, const icc_map *map, int32_t iterations, size_t *vertex,
                           const iccp_env *env, icc_error *err);

    /* Tells whether `next` is in the isotopy class of its features that it should have. `next`
     * was made from `map` by `retarget` if `moved` is true, and otherwise by `improve`. */
    icc_status (*keeps_class)(bool *kept, const icc_map *next, const icc_map *map, bool moved,
                              const iccp_env *env);
    /* See icc_map_get_tie(). Fails with ICC_ERR_ARGUMENT if there is no such tie. */
    icc_status (*tie)(const icc_map *map, size_t tie, icc_tie_info *info, double *target);

    /* Reads or writes the state as part of the bytes of a map (docs/reference/formats.md). A state
     * that was read still needs its certificate. */
    icc_status (*visit)(iccp_blob *b, icc_map *map, const iccp_env *env);
    void (*free_state)(icc_map *map);
} iccp_map_kind;

struct icc_map {
    iccp_memory memory;
    const iccp_map_kind *kind;
    icc_domain *source_domain, *target_domain;
    struct iccp_slide *slide; /* how its chains slide (map/slide/knots.h), or NULL. Then the domains
                                 have its knots as vertices */
    icc_chart *source, *target; /* both NULL for a retargeted map and with features */
    void *state;                /* the kind's own data */
    iccp_map_facts info;
};

#endif
