/* Domains with a mesh of their inside, which foliations in space need. */
#ifndef FILL_H
#define FILL_H

#include "job/job.h"

/* Makes the domains. They get a mesh if the options ask for it. In space,
 * a cage without a target also gets one if the method uses it. Does nothing the second time.
 * Returns DONE, or FAILED with a message on stderr. */
int fill_domains(job *j);

#endif
