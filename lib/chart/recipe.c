#include "chart/recipe.h"

#include "base/error.h"

#include <math.h>
#include <string.h>

void iccp_recipe_keep(iccp_recipe *recipe, const icc_chart_options *options, const double *maximum,
                      int32_t dim)
{
    *recipe = (iccp_recipe){.options = *options, .has_maximum = maximum != NULL};
    recipe->options.maximum = NULL;
    for (int32_t k = 0; maximum != NULL && k < dim; ++k)
        recipe->maximum[k] = maximum[k];
}

void iccp_recipe_write(const iccp_recipe *recipe, int32_t dim, uint64_t digest, iccp_blob_writer *w)
{
    const icc_chart_options *o = &recipe->options;
    const uint32_t choices[6] = {(uint32_t)o->function, (uint32_t)o->tree,
                                 (uint32_t)o->cells,    (uint32_t)o->constraints,
                                 (uint32_t)o->solver,   recipe->has_maximum};
    const double shares[2] = {o->min_fall, o->leaf_min};
    iccp_blob_u32(w, 6, choices);
    iccp_blob_f64(w, 2, shares);
    iccp_blob_f64(w, (size_t)dim, recipe->maximum);
    iccp_blob_u64(w, digest);
}

static bool is_choice(uint32_t value, int32_t first, int32_t last)
{
    return value >= (uint32_t)first && value <= (uint32_t)last;
}

static bool is_zero(double value)
{
    return !(fabs(value) > 0) && !signbit(value);
}

icc_status iccp_recipe_read(iccp_recipe *recipe, int32_t dim, uint64_t *digest, iccp_blob_reader *r)
{
    uint32_t c[6];
    double shares[2];
    *recipe = (iccp_recipe){.has_maximum = false};
    iccp_blob_read_u32(r, 6, c);
    iccp_blob_read_f64(r, 2, shares);
    iccp_blob_read_f64(r, (size_t)dim, recipe->maximum);
    *digest = iccp_blob_read_u64(r);
    bool sound = !r->failed && is_choice(c[0], ICC_FUNCTION_DECAY, ICC_FUNCTION_CLAMPED) &&
                 is_choice(c[1], ICC_TREE_THESIS, ICC_TREE_PAPER) &&
                 (c[2] == 0 || is_choice(c[2], ICCP_MIN_CELLS, ICCP_MAX_CELLS)) &&
                 is_choice(c[3], 0, ICC_CONSTRAINTS_ALL) &&
                 is_choice(c[4], 0, ICC_SOLVER_ITERATIVE) && c[5] <= 1;
    for (int k = 0; k < 2; ++k)
        sound = sound && shares[k] >= 0 && shares[k] <= ICCP_MAX_SHARE;
    for (int32_t k = 0; k < dim; ++k)
        sound = sound && isfinite(recipe->maximum[k]) && (c[5] == 1 || is_zero(recipe->maximum[k]));
    if (!sound)
        return ICC_ERR_FORMAT;
    recipe->has_maximum = c[5] == 1;
    recipe->options = (icc_chart_options){.size = sizeof recipe->options,
                                          .function = (int32_t)c[0],
                                          .tree = (int32_t)c[1],
                                          .cells = (int32_t)c[2],
                                          .constraints = (int32_t)c[3],
                                          .solver = (int32_t)c[4],
                                          .min_fall = shares[0],
                                          .leaf_min = shares[1]};
    return ICC_OK;
}

static uint64_t add(uint64_t digest, uint64_t value, int n_bytes)
{
    for (int i = 0; i < n_bytes; ++i) {
        digest ^= value >> 8 * i & 0xff;
        digest *= UINT64_C(0x100000001b3);
    }
    return digest;
}

uint64_t iccp_digest_f64(uint64_t digest, size_t n, const double *values)
{
    for (size_t i = 0; i < n; ++i) {
        uint64_t bits = 0;
        if (!isnan(values[i]))
            memcpy(&bits, &values[i], sizeof bits);
        digest = add(digest, bits, 8);
    }
    return digest;
}

uint64_t iccp_digest_f32(uint64_t digest, size_t n, const float *values)
{
    for (size_t i = 0; i < n; ++i) {
        uint32_t bits = 0;
        if (!isnan(values[i]))
            memcpy(&bits, &values[i], sizeof bits);
        digest = add(digest, bits, 4);
    }
    return digest;
}

uint64_t iccp_digest_u32(uint64_t digest, size_t n, const uint32_t *values)
{
    for (size_t i = 0; i < n; ++i)
        digest = add(digest, values[i], 4);
    return digest;
}

/* Logarithms differ between mathematical libraries, so they count as well. */
uint64_t iccp_digest_field(const icc_function *field)
{
    const size_t n = field->tree->grid->n_vertices;
    uint64_t digest = iccp_digest_u32(ICCP_DIGEST_START, 1, &field->tree->root);
    digest = iccp_digest_f64(digest, n, field->values);
    if (field->logs != NULL)
        digest = iccp_digest_f64(digest, n, field->logs);
    for (size_t v = 0; field->exponent != NULL && v < n; ++v)
        digest = add(digest, (uint32_t)field->exponent[v], 4);
    return digest;
}

icc_status iccp_recipe_judge(icc_chart **chart, icc_status status, uint64_t wanted, uint64_t digest,
                             icc_error *err)
{
    if (status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ||
        (status == ICC_OK && digest == wanted))
        return status;
    iccp_chart_release(*chart);
    *chart = NULL;
    return iccp_fail(err, ICC_ERR_VERSION,
                     status == ICC_OK
                         ? "the chart comes out otherwise here than where it was saved"
                         : "the chart cannot be made here as it was where it was saved");
}
