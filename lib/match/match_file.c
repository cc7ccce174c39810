/* Writing and reading matches, and checks of what was read. */
#include "match/match_file.h"

#include "base/blob.h"
#include "base/budget.h"
#include "domain/domain_file.h"
#include "domain/features.h"
#include "match/match_apply.h"

#include <string.h>

static const char KIND[] = "MTCH";
static const uint32_t VERSION = 1;

/* ---- checks that two domains can belong to a match ---- */

static bool is_plain(const icc_domain *domain)
{
    return (domain->dim == 2 || domain->dim == 3) && domain->mask == NULL && domain->mesh == NULL;
}

static bool same_features(const icc_domain *a, const icc_domain *b)
{
    if (a->features == NULL || b->features == NULL)
        return a->features == b->features;
    bool is_same = a->features->n == b->features->n;
    for (size_t k = 0; is_same && k < a->features->n; ++k) {
        const iccp_feature *const f = &a->features->item[k], *const g = &b->features->item[k];
        is_same = f->kind == g->kind && f->n == g->n && f->orientation == g->orientation;
    }
    return is_same;
}

static bool correspond(const icc_domain *a, const icc_domain *b)
{
    return is_plain(a) && is_plain(b) && a->dim == b->dim && a->n_vertices == b->n_vertices &&
           a->n_facets == b->n_facets && a->orientation == b->orientation &&
           memcmp(a->facets, b->facets, a->n_facets * a->tree.dim * sizeof *a->facets) == 0 &&
           same_features(a, b);
}

/* ---- writing and reading ---- */

static void visit_info(iccp_blob *b, icc_match_info *info)
{
    iccp_blob_i32(b, ICCP_U32, 0, 1, &info->mirrored);
    iccp_blob_size(b, &info->n_landmarks);
    iccp_blob_size(b, &info->n_joined);
    iccp_blob_size(b, &info->n_overlay);
    double *const numbers[] = {&info->cost,   &info->second,      &info->sure,
                               &info->turn,   &info->least_slope, &info->most_slope,
                               &info->energy, &info->off,         &info->least_angle};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k)
        iccp_blob_f64(b, 1, numbers[k]);
}

/* A match that is written is a copy of the caller's. */
static icc_status visit(iccp_blob *b, icc_match *match, const iccp_env part[2])
{
    icc_status status = ICC_OK;
    for (int side = 0; side < 2 && status == ICC_OK; ++side)
        status = iccp_domain_visit_any(b, &match->domain[side], &part[side]);
    if (status == ICC_OK && b->reads) {
        match->n = match->domain[0]->n_vertices;
        iccp_blob_require(b, correspond(match->domain[0], match->domain[1]));
        status = b->status;
    }
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        iccp_blob_array_u32(b, match->n, &match->origin[side]);
        status = b->status;
    }
    if (status == ICC_OK)
        visit_info(b, &match->info);
    return status == ICC_OK ? b->status : status;
}

void iccp_match_save(const icc_match *match, size_t capacity, void *data, size_t *n_bytes)
{
    const iccp_env part[2] = {0};
    icc_match copy = *match;
    iccp_blob b;
    iccp_blob_begin(&b, data, capacity, KIND, VERSION);
    (void)visit(&b, &copy, part);
    iccp_blob_end(&b, n_bytes);
}

static icc_status read_match(icc_match **out, iccp_blob *b, const iccp_env *env)
{
    const iccp_env whole = iccp_part(env, "load", 0, 1);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, &whole);
    icc_match *const match = *out = iccp_alloc_zero(&env->memory, 1, sizeof *match);
    if (match == NULL)
        return ICC_ERR_MEMORY;
    match->memory = env->memory;
    const icc_status status = visit(b, match, part);
    if (status != ICC_OK)
        return status;
    match->info.dim = match->domain[0]->dim;
    match->info.n_vertices = match->n;
    iccp_match_index(match);
    return iccp_blob_done(b) ? ICC_OK : ICC_ERR_FORMAT;
}

icc_status iccp_match_load(icc_match **out, size_t n_bytes, const void *data, const iccp_env *env,
                           icc_error *err)
{
    iccp_blob b;
    *out = NULL;
    icc_status status = iccp_blob_open(&b, data, n_bytes, KIND, VERSION, &env->memory, err);
    if (status != ICC_OK)
        return status;
    iccp_budget budget;
    const iccp_env limited = iccp_budget_begin(&budget, env);
    status = read_match(out, &b, &limited);
    if (status == ICC_OK)
        return ICC_OK;
    iccp_match_release(*out);
    *out = NULL;
    return iccp_budget_end(&budget, iccp_blob_blame(err, status, "match"), err);
}
