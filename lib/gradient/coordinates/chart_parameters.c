/* The parameters of charts on a grid, as bytes. */
#include "gradient/coordinates/chart_parameters.h"

#include "base/error.h"

#include <math.h>
#include <string.h>

void iccp_chart_parameters_set(iccp_chart_parameters *parameters, const icc_chart_options *options,
                               const double *maximum, int32_t dim)
{
    *parameters = (iccp_chart_parameters){.options = *options, .has_maximum = maximum != NULL};
    parameters->options.maximum = NULL;
    parameters->options.axis_order = NULL;
    for (int32_t k = 0; maximum != NULL && k < dim; ++k)
        parameters->maximum[k] = maximum[k];
}

static bool is_zero(double value)
{
    return !(fabs(value) > 0) && !signbit(value);
}

static void visit(iccp_blob *b, iccp_chart_parameters *parameters, int32_t dim, uint64_t *digest)
{
    icc_chart_options *o = &parameters->options;
    int32_t has_maximum = parameters->has_maximum;
    iccp_blob_i32(b, ICCP_U32, ICC_FUNCTION_DECAY, ICC_FUNCTION_HARMONIC, &o->function);
    iccp_blob_i32(b, ICCP_U32, ICC_TREE_THESIS, ICC_TREE_PAPER, &o->tree);
    iccp_blob_i32(b, ICCP_U32, 0, ICCP_MAX_CELLS, &o->cells);
    iccp_blob_i32(b, ICCP_U32, 0, ICC_CONSTRAINTS_ALL, &o->constraints);
    iccp_blob_i32(b, ICCP_U32, 0, ICC_SOLVER_ITERATIVE, &o->solver);
    iccp_blob_i32(b, ICCP_U32, 0, 1, &has_maximum);
    iccp_blob_f64(b, 1, &o->min_fall);
    iccp_blob_f64(b, 1, &o->leaf_min);
    iccp_blob_f64(b, (size_t)dim, parameters->maximum);
    iccp_blob_u64(b, 1, digest);
    parameters->has_maximum = has_maximum == 1;
}

void iccp_chart_parameters_write(const iccp_chart_parameters *parameters, int32_t dim,
                                 uint64_t digest, iccp_blob *b)
{
    iccp_chart_parameters copy = *parameters;
    visit(b, &copy, dim, &digest);
}

icc_status iccp_chart_parameters_read(iccp_chart_parameters *parameters, int32_t dim,
                                      uint64_t *digest, iccp_blob *b)
{
    icc_chart_options *o = &parameters->options;
    *parameters = (iccp_chart_parameters){.options.size = sizeof *o};
    visit(b, parameters, dim, digest);
    bool sound = b->status == ICC_OK && (o->cells == 0 || o->cells >= ICCP_MIN_CELLS) &&
                 o->min_fall >= 0 && o->min_fall <= ICCP_MAX_SHARE && o->leaf_min >= 0 &&
                 o->leaf_min <= ICCP_MAX_SHARE;
    for (int32_t k = 0; k < dim; ++k)
        sound = sound && isfinite(parameters->maximum[k]) &&
                (parameters->has_maximum || is_zero(parameters->maximum[k]));
    return sound ? ICC_OK : ICC_ERR_FORMAT;
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

/* Logarithms differ between mathematical libraries, so the digest includes them. */
uint64_t iccp_digest_field(const icc_function *field)
{
    const size_t n = field->tree->grid->n_vertices;
    uint64_t digest = iccp_digest_u32(ICCP_DIGEST_START, 1, &field->tree->root);
    digest = iccp_digest_f64(digest, n, field->values);
    for (size_t v = 0; field->has_logs && v < n; ++v) {
        const double u = iccp_function_log(field, v);
        digest = iccp_digest_f64(digest, 1, &u);
    }
    for (size_t v = 0; field->exponent != NULL && v < n; ++v)
        digest = add(digest, (uint32_t)field->exponent[v], 4);
    return digest;
}

icc_status iccp_chart_check_rebuilt(icc_chart **chart, icc_status status, uint64_t wanted,
                                    uint64_t digest, icc_error *err)
{
    if (status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ||
        (status == ICC_OK && digest == wanted))
        return status;
    iccp_chart_release(*chart);
    *chart = NULL;
    return iccp_fail(err, ICC_ERR_VERSION,
                     status == ICC_OK ? "the chart differs from the one that was saved"
                                      : "the saved chart cannot be made again here");
}
