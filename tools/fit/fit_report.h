/* Tells how well a map fits its control points. */
#ifndef FIT_REPORT_H
#define FIT_REPORT_H

#include "fit/fit_job.h"

/* Prints a summary, then a row for each point. */
void fit_print(const fit_job *f);

/* Adds the same to a report of --json. The job is that of a fit_job. */
void fit_describe(json *out, const job *j);

/* Writes a report of --json that holds nothing else. */
int fit_report(const fit_job *f);

#endif
