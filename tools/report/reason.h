/* Words that tell why charts and maps are not certified. */
#ifndef REASON_H
#define REASON_H

#include "report/chart_facts.h"

enum { REASON_LENGTH = 320 };

/* All reasons why a chart is not certified, the most important one first. */
const char *reason_of_chart(char text[REASON_LENGTH], const chart_facts *chart);

/* All reasons why a map is not certified. */
const char *reason_of_map(char text[REASON_LENGTH], const icc_map_info *map,
                          const icc_map_report *made);

#endif
