/* Domains with a mesh of their inside, which foliations in space need. */
#ifndef FILL_H
#define FILL_H

#include "job/job.h"

/* Replaces the domains, which have been made, by domains with a mesh, if the options ask for it, or
 * in space if the method wants it and tetgen is there. Returns DONE, or FAILED with a line on
 * stderr. */
int fill_domains(job *j);

#endif
