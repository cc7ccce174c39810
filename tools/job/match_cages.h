/* Cages in the plane that do not correspond. */
#ifndef MATCH_CAGES_H
#define MATCH_CAGES_H

#include "job/job.h"

/* Whether both cages are such that they can be matched. DONE, or FAILED with a line on stderr. */
int match_check(const job *j);

/* Once both have domains: replaces cages and domains by such with common vertices, as --match says;
 * j->matched tells how. DONE, or FAILED with a line on stderr. */
int match_cages(job *j);

/* Says on stderr if a match in the plane turns much, or if the mirror image fits better. Either may
 * mean that the match is wrong. */
void match_note(const job *j);

/* How well they match, as a member of the report. */
void match_report(json *r, const icc_match_info *info);

#endif
