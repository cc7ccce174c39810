/* Cages in the plane that do not correspond. */
#ifndef MATCH_CAGES_H
#define MATCH_CAGES_H

#include "job/job.h"

/* Checks that both cages can be matched. DONE, or FAILED with a message on stderr. */
int match_check(const job *j);

/* Replaces cages and domains by ones with common vertices, as --match asks. Both must have domains.
 * j->matched describes the result. DONE, or FAILED with a message on stderr. */
int match_cages(job *j);

/* Prints on stderr if a match in the plane turns a lot, or if the mirror image fits better. Either
 * may mean that the match is wrong. */
void match_note(const job *j);

/* Reports how well they match, as a member of the report. */
void match_report(json *r, const icc_match_info *info);

#endif
