/* Why charts and maps are not certified, in words. */
#ifndef REASON_H
#define REASON_H

#include "report/chart_facts.h"

enum { REASON_LENGTH = 320 };

/* Every reason that there is, the one that matters first; of a chart that is not certified. */
const char *reason_of_chart(char text[REASON_LENGTH], const chart_facts *chart);

/* Of a map that is not certified. */
const char *reason_of_map(char text[REASON_LENGTH], const icc_map_info *map);

#endif
