/* One defect of a polygon. */
#ifndef ICCP_DEFECT_H
#define ICCP_DEFECT_H

#include <stdint.h>

typedef struct iccp_defect {
    int32_t kind;  /* ICC_DEFECT_*; 0: none */
    uint32_t a, b; /* positions of points or edges in the polygon, as icc.h says for the kind */
} iccp_defect;

#endif
