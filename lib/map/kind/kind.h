/* The map object, and what each kind of map provides. What all kinds have in common is written
 * once, in lib/map itself, on top of the table.
 *
 * Legend of lib/map/kind. Begin with iccp_map_kind.
 * - kind: a table of operations. Plane and solid are the mesh maps (ICC_MAP_MESH) in two and three
 *   dimensions, curves goes point by point through two charts (ICC_MAP_CURVES).
 * - state: what only the kind knows of a map.
 * - certificate: the proof that a map is one-to-one; *_certificate.c in each kind's folder.
 *
 * Invariants: a map does not change once it is made, but for what `ready` makes. A map that is
 * handed out has been certified as it is (iccp_map_conclude()); of kind curves, it may lack its
 * certificate and gives the reason. */
#ifndef ICCP_KIND_H
#define ICCP_KIND_H

#include "chart/chart.h"
#include "map/energy/simplicial_map.h"

/* NULL for operations that a kind does not have. Points are in the caller's coordinates. */
typedef struct iccp_map_kind {
    int32_t number; /* ICC_MAP_... */

    /* Whether there are maps of this kind between domains like this one, and whether one can be
     * made from two charts of the source's method. */
    bool (*suits)(const icc_domain *source);
    bool (*takes)(const icc_chart *source);

    /* Makes the state of a map that has its domains and, unless these have features, its charts.
     * Fills in map->info. The state stays NULL, with ICC_OK, if no such map is found;
     * info.n_unrepaired is then not 0. */
    icc_status (*create)(icc_map *map, const icc_map_options *options, const iccp_env *env,
                         icc_error *err);

    /* The certificate of what the map is now: sets info.certified, and the reason if it does not
     * hold. A mesh map that cannot be certified is none: ICC_ERR_CERTIFICATE. */
    icc_status (*certify)(icc_map *map, const iccp_env *env, icc_error *err);
    /* Of a certified map: what follows from it about features. */
    icc_status (*describe)(icc_map *map, const iccp_env *env);

    /* At most ICCP_CHART_MANY points, forward or back. `images` or `jacobians` may be NULL. What
     * happens to a point is its status; returned is what concerns all. Ask `ready` first: it makes
     * what is made when it is first needed. */
    icc_status (*ready)(const icc_map *map, bool inverse);
    icc_status (*apply)(const icc_map *map, bool inverse, size_t n, const double *points,
                        double *images, double *jacobians, icc_status *status, iccp_path *path);

    /* The mesh that the map is linear on. After its images have been changed in place, `renew`
     * makes anew what depends on them; *kept is false if the change left the isotopy class of the
     * features, and then the images are to be put back. */
    iccp_simplicial_map (*mesh)(const icc_map *map);
    icc_status (*renew)(icc_map *map, bool *kept, const iccp_env *env);

    /* The state of a better map, and of one to the domain next->target_domain. `next` has its
     * domains, and what `map` has besides: its charts and its info if the domains are the same.
     * `retarget` leaves the state NULL, with ICC_OK, if it cannot get there: see `create`. *vertex
     * is then one of the boundary where the way is blocked, if the kind knows. */
    icc_status (*improve)(icc_map *next, const icc_map *map, const icc_improve_options *options,
                          icc_improve_report *report, const iccp_env *env, icc_error *err);
    icc_status (*retarget)(icc_map *next, const icc_map *map, int32_t iterations, size_t *vertex,
                           const iccp_env *env, icc_error *err);

    /* Whether `next`, which came of `map` by `improve`, or by `retarget` if `moved`, is of the
     * isotopy class of its features that it should be. */
    icc_status (*follows)(bool *kept, const icc_map *next, const icc_map *map, bool moved,
                          const iccp_env *env);
    /* See icc_map_get_tie(); ICC_ERR_ARGUMENT if there is no such tie. */
    icc_status (*tie)(const icc_map *map, size_t tie, icc_tie_info *info, double *target);

    /* The state as part of the bytes of a map (docs/formats.md). What is read still needs its
     * certificate. */
    icc_status (*visit)(iccp_blob *b, icc_map *map, const iccp_env *env);
    void (*free_state)(icc_map *map);
} iccp_map_kind;

struct icc_map {
    iccp_memory memory;
    const iccp_map_kind *kind;
    icc_domain *source_domain, *target_domain;
    icc_chart *source, *target; /* both NULL for a retargeted map and with features */
    void *state;                /* the kind's own */
    icc_map_info info;
};

#endif
