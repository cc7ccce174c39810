/* The parameters that a chart on a grid was made from. A saved chart consists of these and of a
 * digest of the result. */
#ifndef ICCP_CHART_PARAMETERS_H
#define ICCP_CHART_PARAMETERS_H

#include "chart/chart.h"
#include "gradient/function/function.h"

/* Largest eta and leaf. Up to this, functions hardly change their shape. */
#define ICCP_MAX_SHARE 0.01

typedef struct iccp_chart_parameters {
    icc_chart_options options; /* except the maximum and the order of the axes */
    bool has_maximum;          /* false: the grassfire chose the maximum */
    double maximum[ICC_MAX_DIM];
} iccp_chart_parameters;

/* Sets the parameters. `maximum` is in coordinates that the method chooses; it may be NULL. */
void iccp_chart_parameters_set(iccp_chart_parameters *parameters, const icc_chart_options *options,
                               const double *maximum, int32_t dim);
void iccp_chart_parameters_write(const iccp_chart_parameters *parameters, int32_t dim,
                                 uint64_t digest, iccp_blob *w);

/* Returns ICC_ERR_FORMAT for options that icc_chart_create() would refuse as arguments. */
icc_status iccp_chart_parameters_read(iccp_chart_parameters *parameters, int32_t dim,
                                      uint64_t *digest, iccp_blob *r);

/* Returns NULL if there is no maximum. */
static inline const double *iccp_chart_parameters_maximum(const iccp_chart_parameters *parameters)
{
    return parameters->has_maximum ? parameters->maximum : NULL;
}

/* FNV-1a, 64 bits, of numbers as bytes, continued from `digest`. All NaN are equal to it. */
#define ICCP_DIGEST_START UINT64_C(0xcbf29ce484222325)
uint64_t iccp_digest_f64(uint64_t digest, size_t n, const double *values);
uint64_t iccp_digest_f32(uint64_t digest, size_t n, const float *values);
uint64_t iccp_digest_u32(uint64_t digest, size_t n, const uint32_t *values);

/* Returns the digest of the function and of its maximum's place. */
uint64_t iccp_digest_field(const icc_function *field);

/* Call it after the chart has been rebuilt. Returns ICC_ERR_VERSION and releases the chart if
 * rebuilding failed or the digest differs. */
icc_status iccp_chart_check_rebuilt(icc_chart **chart, icc_status status, uint64_t wanted,
                                    uint64_t digest, icc_error *err);

#endif
