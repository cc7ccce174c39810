/* Creates charts of one domain or of two. It pairs the maxima of two domains, and shifts grids
 * that happen to lie badly. Source: docs/theory/charts-space.md, "fields on grids". */
#include "field/field_charts.h"

#include "base/error.h"
#include "field/chart_field.h"
#include "field/pairing.h"

/* Uses the caller's maximum if there is one, else `preferred`, which may be NULL. */
static icc_status create_one(icc_chart **out, const icc_domain *domain,
                             const icc_chart_options *options, const double *preferred,
                             const iccp_env *env, icc_error *err)
{
    double local[ICC_MAX_DIM];
    *out = NULL;
    if (options->maximum != NULL) {
        iccp_frame_in(&domain->frame, domain->dim, options->maximum, local);
        if (iccp_domain_locate(domain, local, true, NULL, NULL) != ICC_INSIDE)
            return iccp_fail(err, ICC_ERR_OUTSIDE, "the maximum is not inside the domain");
        preferred = local;
    }
    return iccp_explain(err, iccp_chart_field_create(out, domain, options, preferred, env, err));
}

/* Shifts the grids of unlucky charts if that makes all of them certified. Otherwise they stay as
 * they are. */
static icc_status shift_grids(icc_chart **chart, int n, const iccp_env *env)
{
    icc_chart *shifted[2] = {NULL, NULL};
    icc_status status = ICC_OK;
    bool all = true;
    for (int k = 0; k < n; ++k)
        all = all && (chart[k]->info.certified || iccp_chart_field_is_unlucky(chart[k]));
    for (int k = 0; k < n && all && status == ICC_OK; ++k)
        if (!chart[k]->info.certified) {
            status = iccp_chart_field_shift(&shifted[k], chart[k], env);
            all = shifted[k] != NULL;
        }
    for (int k = 0; k < n; ++k)
        if (all && shifted[k] != NULL) {
            iccp_chart_release(chart[k]);
            chart[k] = shifted[k];
        } else {
            iccp_chart_release(shifted[k]);
        }
    return status;
}

/* Maps one chart's maximum to the other domain. NULL if the image is no good place for a
 * maximum. */
static const double *guess_maximum(const icc_chart *chart, const icc_domain *other, double *image)
{
    double local[ICC_MAX_DIM];
    iccp_frame_in(&chart->domain->frame, chart->domain->dim, chart->info.maximum, local);
    return iccp_pair_point(chart->domain, other, local, image) ? image : NULL;
}

/* The target's maximum is the approximate image of the source's. If that is too near the
 * boundary, the source's maximum is the image of the target's. If each domain chose for itself,
 * the maxima might lie in different limbs. */
static icc_status create_pair(icc_chart **out, const icc_domain *const *domain,
                              const icc_chart_options *options, const iccp_env *env, icc_error *err)
{
    double image[ICC_MAX_DIM];
    int32_t side = 1;
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){4, 4, 1}, env);
    icc_status status = create_one(&out[0], domain[0], &options[0], NULL, &part[0], err);
    if (status == ICC_OK) {
        const double *preferred = guess_maximum(out[0], domain[1], image);
        side = 2;
        status = create_one(&out[1], domain[1], &options[1], preferred, &part[1], err);
        if (status == ICC_OK && preferred == NULL && options[0].maximum == NULL)
            preferred = guess_maximum(out[1], domain[0], image);
        else
            preferred = NULL;
        if (preferred != NULL) {
            iccp_chart_release(out[0]);
            side = 1;
            status = create_one(&out[0], domain[0], &options[0], preferred, &part[2], err);
        }
    }
    if (status == ICC_OK)
        status = iccp_explain(err, shift_grids(out, 2, env));
    if (status == ICC_OK)
        return ICC_OK;
    iccp_chart_release(out[0]);
    iccp_chart_release(out[1]);
    out[0] = out[1] = NULL;
    return iccp_fail_side(err, status, side);
}

icc_status iccp_field_charts_create(size_t n, icc_chart **out, const icc_domain *const *domain,
                                    const icc_chart_options *options, const iccp_env *env,
                                    icc_error *err)
{
    if (n > 1)
        return create_pair(out, domain, options, env, err);
    icc_status status = create_one(out, *domain, options, NULL, env, err);
    if (status == ICC_OK)
        status = iccp_explain(err, shift_grids(out, 1, env));
    if (status != ICC_OK) {
        iccp_chart_release(*out);
        *out = NULL;
    }
    return status;
}
