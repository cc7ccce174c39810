#include "method/load.h"

#include "base/budget.h"
#include "domain/domain_file.h"
#include "field/chart_field.h"
#include "foliation/chart_disc.h"
#include "foliation/chart_foliation.h"
#include "gradient/coordinates/chart_gradient.h"
#include "shelling/shelling_file.h"

static const char KIND[] = "CHRT";
static const uint32_t VERSION = 1;

/* The format's own number for ICC_METHOD_FOLIATION on the domain's mesh. */
enum { ON_MESH = 5 };

void iccp_chart_write(const icc_chart *chart, iccp_blob *w)
{
    uint64_t method = iccp_chart_is_shelling(chart) ? ON_MESH : (uint64_t)chart->info.method;
    iccp_blob_u64(w, 1, &method);
    chart->ops->save(chart, w);
}

icc_status iccp_chart_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                           const iccp_env *env, icc_error *err)
{
    uint64_t method;
    iccp_blob_u64(r, 1, &method);
    *out = NULL;
    if (method == ICC_METHOD_GRADIENT)
        return iccp_chart_gradient_read(out, domain, r, env, err);
    if (method == ICC_METHOD_FIELD)
        return iccp_chart_field_read(out, domain, r, env, err);
    if (method == ICC_METHOD_FOLIATION && domain->dim == 2)
        return iccp_chart_foliation_read(out, domain, r, env);
    if (method == ICC_METHOD_DISC && domain->dim == 2)
        return iccp_chart_disc_read(out, domain, r, env);
    if (method == ON_MESH && domain->mesh != NULL)
        return iccp_chart_shelling_read(out, domain, r, env);
    return ICC_ERR_FORMAT;
}

void iccp_chart_save(const icc_chart *chart, size_t capacity, void *data, size_t *n_bytes)
{
    icc_domain *domain = chart->domain;
    iccp_blob w;
    iccp_blob_begin(&w, data, capacity, KIND, VERSION);
    (void)iccp_domain_visit(&w, &domain, NULL);
    iccp_chart_write(chart, &w);
    iccp_blob_end(&w, n_bytes);
}

icc_status iccp_chart_load(icc_chart **out, size_t n_bytes, const void *data, const iccp_env *env,
                           icc_error *err)
{
    iccp_blob r;
    icc_domain *domain = NULL;
    *out = NULL;
    icc_status status = iccp_blob_open(&r, data, n_bytes, KIND, VERSION, &env->memory, err);
    if (status != ICC_OK)
        return status;
    iccp_budget budget;
    const iccp_env limited = iccp_budget_begin(&budget, env);
    const iccp_env whole = iccp_part(&limited, "load", 0, 1);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 6}, &whole);
    status = iccp_domain_visit(&r, &domain, &part[0]);
    if (status == ICC_OK)
        status = iccp_chart_read(out, domain, &r, &part[1], err);
    iccp_domain_release(domain);
    if (status == ICC_OK && !iccp_blob_done(&r)) {
        iccp_chart_release(*out);
        *out = NULL;
        status = ICC_ERR_FORMAT;
    }
    return iccp_budget_end(&budget, iccp_blob_blame(err, status, "chart"), err);
}
