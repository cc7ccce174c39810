/* The parameters that a chart on a grid was made from: as bytes it is that, and a digest of what
 * came out. */
#ifndef ICCP_CHART_PARAMETERS_H
#define ICCP_CHART_PARAMETERS_H

#include "chart/chart.h"
#include "gradient/function/function.h"

/* Of eta and leaf: functions still look like themselves. */
#define ICCP_MAX_SHARE 0.01

typedef struct iccp_chart_parameters {
    icc_chart_options options; /* without the maximum: */
    bool has_maximum;          /* the grassfire's if not */
    double maximum[ICC_MAX_DIM];
} iccp_chart_parameters;

/* `maximum`, in coordinates that the method likes, may be NULL. */
void iccp_chart_parameters_set(iccp_chart_parameters *parameters, const icc_chart_options *options,
                               const double *maximum, int32_t dim);
void iccp_chart_parameters_write(const iccp_chart_parameters *parameters, int32_t dim,
                                 uint64_t digest, iccp_blob *w);

/* ICC_ERR_FORMAT for options that icc_chart_create() would refuse as arguments. */
icc_status iccp_chart_parameters_read(iccp_chart_parameters *parameters, int32_t dim,
                                      uint64_t *digest, iccp_blob *r);

/* NULL without. */
static inline const double *iccp_chart_parameters_maximum(const iccp_chart_parameters *parameters)
{
    return parameters->has_maximum ? parameters->maximum : NULL;
}

/* FNV-1a, 64 bits, of numbers as bytes, after what `digest` has seen. All that are not numbers
 * count alike. */
#define ICCP_DIGEST_START UINT64_C(0xcbf29ce484222325)
uint64_t iccp_digest_f64(uint64_t digest, size_t n, const double *values);
uint64_t iccp_digest_f32(uint64_t digest, size_t n, const float *values);
uint64_t iccp_digest_u32(uint64_t digest, size_t n, const uint32_t *values);

/* Of the function, and where its maximum is. */
uint64_t iccp_digest_field(const icc_function *field);

/* After the chart has been rebuilt: ICC_ERR_VERSION if it could not be, or has another digest;
 * it is then released. */
icc_status iccp_chart_check_rebuilt(icc_chart **chart, icc_status status, uint64_t wanted,
                                    uint64_t digest, icc_error *err);

#endif
