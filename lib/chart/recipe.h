/* What a chart on a grid was made from: as bytes it is that, and a digest of what came out. */
#ifndef ICCP_RECIPE_H
#define ICCP_RECIPE_H

#include "chart/chart.h"
#include "function/function.h"

/* Of eta and leaf: functions still look like themselves. */
#define ICCP_MAX_SHARE 0.01

typedef struct iccp_recipe {
    icc_chart_options options; /* without the maximum: */
    bool has_maximum;          /* the grassfire's if not */
    double maximum[ICC_MAX_DIM];
} iccp_recipe;

/* `maximum`, in coordinates that the method likes, may be NULL. */
void iccp_recipe_keep(iccp_recipe *recipe, const icc_chart_options *options, const double *maximum,
                      int32_t dim);
void iccp_recipe_write(const iccp_recipe *recipe, int32_t dim, uint64_t digest, iccp_blob *w);

/* ICC_ERR_FORMAT for options that icc_chart_create() would refuse as arguments. */
icc_status iccp_recipe_read(iccp_recipe *recipe, int32_t dim, uint64_t *digest, iccp_blob *r);

/* NULL without. */
static inline const double *iccp_recipe_maximum(const iccp_recipe *recipe)
{
    return recipe->has_maximum ? recipe->maximum : NULL;
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
icc_status iccp_recipe_judge(icc_chart **chart, icc_status status, uint64_t wanted, uint64_t digest,
                             icc_error *err);

#endif
