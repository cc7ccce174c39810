/* The ties of a map: which way round one another what is inside the cages goes. */
#ifndef TIES_FILE_H
#define TIES_FILE_H

#include "job/job.h"

/* The ties of a map, as those of one of its cages; 1 source, 2 target. */
size_t ties_of_map(const icc_map *map, const icc_domain *domain, int side, cage_feature **ties);
void ties_free(size_t n, cage_feature *ties);

/* Whether the cages are such that the file of --ties, if it was given, can be written. */
int ties_check(job *j);

/* Writes the file of --ties, if it was given, once there is a map: both cages with what is inside and
 * the ties, as GeoJSON that --source takes. */
int ties_write(const job *j);

#endif
