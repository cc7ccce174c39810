/* Saves and loads charts: the domain, the method's number, and the method's own bytes. */
#include "method/load.h"

#include "base/budget.h"
#include "domain/domain_file.h"
#include "method/methods.h"

static const char KIND[] = "CHRT";
/* A chart is saved in the version that brought its format. */
enum { VERSION = 1, LATER };

static uint32_t version_of(const icc_chart *chart)
{
    return chart->ops->is_later ? LATER : VERSION;
}

void iccp_chart_write(const icc_chart *chart, iccp_blob *w)
{
    uint64_t format = chart->ops->format;
    iccp_blob_u64(w, 1, &format);
    chart->ops->save(chart, w);
}

icc_status iccp_chart_read(icc_chart **out, const icc_domain *domain, iccp_blob *r,
                           const iccp_env *env, icc_error *err)
{
    uint64_t format;
    iccp_blob_u64(r, 1, &format);
    const iccp_chart_ops *method = iccp_method_of_format(format);
    *out = NULL;
    if (method == NULL || (method->is_planar && domain->dim != 2) ||
        (method->needs_mesh && domain->mesh == NULL))
        return ICC_ERR_FORMAT;
    return method->read(out, domain, r, env, err);
}

void iccp_chart_save(const icc_chart *chart, size_t capacity, void *data, size_t *n_bytes)
{
    icc_domain *domain = chart->domain;
    iccp_blob w;
    iccp_blob_begin(&w, data, capacity, KIND, version_of(chart));
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
    icc_status status = iccp_blob_open(&r, data, n_bytes, KIND, LATER, &env->memory, err);
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
    if (status == ICC_OK && (!iccp_blob_done(&r) || version_of(*out) != r.version)) {
        iccp_chart_release(*out);
        *out = NULL;
        status = ICC_ERR_FORMAT;
    }
    return iccp_budget_end(&budget, iccp_blob_blame(err, status, "chart"), err);
}
