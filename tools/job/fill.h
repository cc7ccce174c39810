/* Domains with a mesh of their inside, which foliations in space need. */
#ifndef FILL_H
#define FILL_H

#include "job/job.h"

/* Makes the domains, with a mesh where the options ask for it: one that is given, or tetgen's; and
 * in space, where the method takes one, that of a cage without a target. Does nothing the second
 * time. Returns DONE, or FAILED with a line on stderr. */
int fill_domains(job *j);

#endif
