/* The isotopy class of a map between two domains with features. Two maps belong to one class if
 * one can be moved to the other while it stays one-to-one (docs/theory/features.md). */
#ifndef ICCP_ISOTOPY_H
#define ICCP_ISOTOPY_H

#include "map/isotopy/crossing_sequence.h"

/* The class is described by the shortest tree of edges of the source's bare triangulation that
 * joins all components, or a tree for each part of the domain. It stores the class of each edge's
 * image in the target. The description depends on the map alone. */
typedef struct iccp_isotopy {
    iccp_memory memory;
    size_t n;
    iccp_sequences sequences; /* of the images, in the target's bare triangulation */
    iccp_polyline *line;      /* of each image: a short polyline of its class in the target, in
                                 local coordinates; ends included */
    double detour; /* total length of the lines over that of the straight lines between their
                      ends */
} iccp_isotopy;

/* If rounding prevents an answer, *out is NULL and the result is ICC_OK. */
icc_status iccp_isotopy_create(iccp_isotopy **out, const iccp_plmap *map, const icc_domain *source,
                               const icc_domain *target, const iccp_env *env);

/* Returns a tie as icc_map_get_tie() reports it. `bends` receives the bends in the target and may
 * be NULL. */
icc_tie_info iccp_isotopy_tie(const iccp_isotopy *isotopy, size_t tie, const icc_domain *source,
                              const icc_domain *target, double *bends);
/* Accepts NULL. */
void iccp_isotopy_free(iccp_isotopy *isotopy);

/* Returns true if two maps between the same domains are isotopic. Returns false if either is
 * NULL. */
bool iccp_isotopy_same(const iccp_isotopy *a, const iccp_isotopy *b);

/* *kept becomes true if the map takes each cut's source path to a path isotopic to its target
 * path. */
icc_status iccp_isotopy_has_cuts(bool *kept, const iccp_plmap *map, const iccp_domain_pair *domains,
                                 const iccp_cuts *cuts, const iccp_env *env);

/* Moves all vertices of the target straight to their new places and carries the images along. The
 * result is cuts in the source and in the new target. They describe the class that the old map's
 * class becomes. *arrived is false if vertices meet walls or one another on the way, or if rounding
 * prevents an answer. Then there are no cuts. Where nothing has to be cut, there is one class, and
 * no way is needed. The caller frees the cuts in any case. */
icc_status iccp_isotopy_move(iccp_cuts *cuts, bool *arrived, const iccp_isotopy *isotopy,
                             const icc_domain *source, const icc_domain *old_target,
                             const icc_domain *target, const iccp_env *env);

/* *kept becomes true if a map to `target` has the class that iccp_isotopy_move() would give.
 * `isotopy` is that of the map to `old_target`, and may be NULL. */
icc_status iccp_isotopy_is_kept(bool *kept, const iccp_isotopy *isotopy,
                                const icc_domain *old_target, const iccp_plmap *map,
                                const icc_domain *source, const icc_domain *target,
                                const iccp_env *env);

#endif
