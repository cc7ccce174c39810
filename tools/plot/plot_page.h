/* libicc plot OUT.html: a page that shows a map in a browser and needs no other file. */
#ifndef PLOT_PAGE_H
#define PLOT_PAGE_H

#include "job/job.h"

/* The page, text that ends with '\0'. In place of its first marker it takes the data. The build makes
 * it from tools/plot/page and the studio's drawing code. */
extern const unsigned char viewer_page[];

/* Makes the map of a job, and the page of its first operand. */
int plot_page(job *j);

#endif
