/* The certificate of a chart of method field. Source: docs/theory/charts-space.md, "fields on
 * grids". */
#ifndef ICCP_FIELD_CERTIFICATE_H
#define ICCP_FIELD_CERTIFICATE_H

#include "field/field_state.h"

/* Sets the counts of the certificate in chart->own.field, chart->info.reason and
 * chart->info.certified, once the vectors are there. */
void iccp_field_certify(const iccp_field_state *state, icc_chart *chart);

#endif
