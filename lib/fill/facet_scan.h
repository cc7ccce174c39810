/* Finds how a mesh that contains the segments of a surface meets one of its facets. */
#ifndef ICCP_FACET_SCAN_H
#define ICCP_FACET_SCAN_H

#include "fill/constraints.h"
#include "fill/pairs.h"

typedef struct iccp_facet_scan {
    iccp_tets *m;
    const iccp_constraints *s;
    uint32_t facet;
    const uint32_t *corners;
    iccp_pairs known;
    /* Edges that lie in the facet or pierce it: two points and a tetrahedron each */
    iccp_list edges;
    iccp_list piercing; /* those of them that go from one side of the facet to the other */
    iccp_list faces;    /* sides whose corners are on the facet; most of several appear twice */
} iccp_facet_scan;

void iccp_facet_scan_init(iccp_facet_scan *scan, iccp_tets *m, const iccp_constraints *s);
void iccp_facet_scan_free(iccp_facet_scan *scan);

/* Fills in the lists for a facet. Returns false if there is no memory. */
bool iccp_facet_scan_run(iccp_facet_scan *scan, uint32_t facet);

/* Returns true if edge pq meets the facet between its ends, which are not on it. */
bool iccp_facet_pierced(const iccp_facet_scan *scan, uint32_t p, uint32_t q);

#endif
