/* Solids with features: the surfaces, points and lines that options add to cages in space. */
#ifndef SOLID_CAGES_H
#define SOLID_CAGES_H

#include "job/job.h"

/* Adds the features of the options --void, --surface, --feature-points and --feature-lines, and of
 * the same ones of the target, to the cages that have been read. */
int solid_cages_add(job *j);

/* Makes the domain of a solid with features. */
icc_status job_make_solid(icc_domain **out, const cage *c, const icc_env *env, icc_error *err);

#endif
