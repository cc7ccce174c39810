/* The ties of a map: they say on which side it passes the features inside the cages. */
#ifndef TIES_FILE_H
#define TIES_FILE_H

#include "job/job.h"

/* The ties of a map, as those of one of its cages: 1 for the source, 2 for the target. */
size_t ties_of_map(const icc_map *map, const icc_domain *domain, int side, cage_feature **ties);
void ties_free(size_t n, cage_feature *ties);

/* Checks that the file of --ties, if given, can be written for these cages. */
int ties_check(job *j);

/* Writes the file of --ties, if given, for the map. It has both cages with their features and ties,
 * as GeoJSON that --source accepts. */
int ties_write(const job *j);

#endif
