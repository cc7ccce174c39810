#include "chart/chart.h"

icc_status iccp_chart_new(icc_chart **out, const icc_domain *domain, const iccp_env *env)
{
    icc_chart *chart = iccp_alloc_zero(&env->memory, 1, sizeof *chart);
    *out = chart;
    if (chart == NULL)
        return ICC_ERR_MEMORY;
    chart->memory = env->memory;
    atomic_init(&chart->references, 1);
    chart->domain = iccp_domain_retain(domain);
    chart->info.dim = domain->dim;
    return ICC_OK;
}

icc_chart *iccp_chart_retain(const icc_chart *chart)
{
    icc_chart *shared = (icc_chart *)chart;
    atomic_fetch_add(&shared->references, 1);
    return shared;
}

void iccp_chart_release(icc_chart *chart)
{
    if (chart == NULL || atomic_fetch_sub(&chart->references, 1) != 1)
        return;
    if (chart->state != NULL)
        chart->ops->free_state(chart);
    iccp_domain_release(chart->domain);
    const iccp_memory memory = chart->memory;
    iccp_free(&memory, chart);
}

void iccp_coords_of_maximum(int32_t dim, iccp_coords *coords)
{
    *coords = (iccp_coords){.facet = 0, .t = 1};
    for (int32_t k = 0; k < dim; ++k)
        coords->bary[k] = 1.0 / dim;
}

bool iccp_chart_is_shelling(const icc_chart *chart)
{
    return chart->info.method == ICC_METHOD_FOLIATION && chart->mesh == NULL;
}
