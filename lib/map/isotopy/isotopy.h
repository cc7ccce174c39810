/* Which of the maps between two domains with features one is, up to moving it while it stays
 * one-to-one: docs/theory.md, features. */
#ifndef ICCP_ISOTOPY_H
#define ICCP_ISOTOPY_H

#include "map/isotopy/word.h"

/* The shortest tree of edges of the source's bare triangulation that joins its components, and
 * where the images of these can be moved to in the target. It follows from the map alone. */
typedef struct iccp_isotopy {
    iccp_memory memory;
    size_t n;
    iccp_words words;    /* of the images, in the target's bare triangulation */
    iccp_polyline *line; /* of each: the same, drawn in the target, local; ends included */
    double detour;       /* lengths of these over those of the straight lines between their ends */
} iccp_isotopy;

/* *out is NULL, with ICC_OK, where rounding is in the way. */
icc_status iccp_isotopy_create(iccp_isotopy **out, const iccp_plmap *map, const icc_domain *source,
                               const icc_domain *target, const iccp_env *env);

/* A tie as icc_map_get_tie() tells it; `bends` in the target may be NULL. */
icc_tie_info iccp_isotopy_tie(const iccp_isotopy *isotopy, size_t tie, const icc_domain *source,
                              const icc_domain *target, double *bends);
/* Accepts NULL. */
void iccp_isotopy_free(iccp_isotopy *isotopy);

/* Whether two maps between the same domains are isotopic; not if either is NULL. */
bool iccp_isotopy_same(const iccp_isotopy *a, const iccp_isotopy *b);

/* Whether a map takes the source's side of cuts to the target's, up to moving them. */
icc_status iccp_isotopy_has_cuts(bool *kept, const iccp_plmap *map, const iccp_scene *scene,
                                 const iccp_cuts *cuts, const iccp_env *env);

/* What becomes of the images when all vertices of the target go straight to their new places: cuts
 * in the source and in the new target, for a map isotopic to what becomes of the old one. *arrived:
 * whether there are any; not where vertices meet walls or one another on the way, and where
 * rounding is in it. The caller frees the cuts in any case. */
icc_status iccp_isotopy_move(iccp_cuts *cuts, bool *arrived, const iccp_isotopy *isotopy,
                             const icc_domain *source, const icc_domain *old_target,
                             const icc_domain *target, const iccp_env *env);

/* Whether a map to `target` is what becomes of one to `old_target`, of which `isotopy` may be NULL,
 * when all vertices of the target go straight to their new places. */
icc_status iccp_isotopy_follows(bool *kept, const iccp_isotopy *isotopy,
                                const icc_domain *old_target, const iccp_plmap *map,
                                const icc_domain *source, const icc_domain *target,
                                const iccp_env *env);

#endif
