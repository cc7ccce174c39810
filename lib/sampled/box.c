/* The image of a grid's boundary. If all of it has one displacement, it is a shifted box. In 2-D it
 * is a polygon, since a field is linear along the edges of cells. */
#include "sampled/box.h"

#include "base/memory.h"
#include "geometry/polygon_check.h"
#include "math/expansion.h"

static bool is_on_boundary(const icc_field *field, const size_t *i)
{
    for (size_t k = 0; k < (size_t)field->dim; ++k)
        if (i[k] == 0 || i[k] + 1 == field->shape[k])
            return true;
    return false;
}

/* Returns true if a sample and the next one along an axis have the same displacement. */
static bool is_kept(const icc_field *field, const size_t *i, size_t axis)
{
    const size_t dim = (size_t)field->dim;
    double from[3], to[3], low;
    size_t next[3] = {0};
    memcpy(next, i, dim * sizeof *next);
    ++next[axis];
    iccp_sample_read(field, iccp_sample_at(field, i), from);
    iccp_sample_read(field, iccp_sample_at(field, next), to);
    bool kept = true;
    for (size_t k = 0; k < dim; ++k) {
        const double step = field->displacement ? 0 : field->step[dim * axis + k];
        const double difference = iccp_two_sum(to[k], -from[k], &low);
        kept = kept && !(difference < step) && !(difference > step) && !(low < 0) && !(low > 0);
    }
    return kept;
}

static bool is_shifted(const icc_field *field)
{
    const size_t dim = (size_t)field->dim, n = iccp_sample_count(field, 0);
    for (size_t at = 0; at < n; ++at) {
        size_t i[3] = {0};
        iccp_sample_split(field, at, 0, i);
        for (size_t k = 0; k < dim && is_on_boundary(field, i); ++k) {
            size_t next[3] = {i[0], i[1], i[2]};
            if (++next[k] < field->shape[k] && is_on_boundary(field, next) && !is_kept(field, i, k))
                return false;
        }
    }
    return true;
}

/* sum += a b. Returns false if that is not exact. */
static bool add_product(double *sum, double a, double b)
{
    double product_low, sum_low;
    const double product = iccp_two_product(a, b, &product_low);
    *sum = iccp_two_sum(*sum, product, &sum_low);
    return !(product_low < 0) && !(product_low > 0) && !(sum_low < 0) && !(sum_low > 0);
}

/* The image of a sample up to a shift that all have in common. Returns false if it is not exact. */
static bool image_of(const icc_field *field, size_t i, size_t j, double image[2])
{
    const size_t at[2] = {i, j};
    bool exact = true;
    iccp_sample_read(field, iccp_sample_at(field, at), image);
    for (size_t k = 0; k < 2 && field->displacement; ++k) {
        const double shift = image[k];
        image[k] = 0;
        exact = exact && add_product(&image[k], (double)i, field->step[k]) &&
                add_product(&image[k], (double)j, field->step[2 + k]) &&
                add_product(&image[k], shift, 1);
    }
    return exact;
}

/* Sample `at` of the ring around the grid, counter-clockwise in indices. */
static bool ring_image(const icc_field *field, size_t at, double image[2])
{
    const size_t right = field->shape[0] - 1, top = field->shape[1] - 1;
    if (at < right)
        return image_of(field, at, 0, image);
    at -= right;
    if (at < top)
        return image_of(field, right, at, image);
    at -= top;
    return at < right ? image_of(field, right - at, top, image)
                      : image_of(field, 0, top - (at - right), image);
}

static icc_status check_ring(bool *simple, const icc_field *field, const iccp_env *env)
{
    const size_t n = 2 * (field->shape[0] - 1) + 2 * (field->shape[1] - 1);
    double *ring = iccp_alloc(&env->memory, n, 2 * sizeof *ring);
    size_t n_defects = 1;
    bool exact = ring != NULL;
    icc_status status = ring != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t at = 0; at < n && exact; ++at)
        exact = ring_image(field, at, ring + 2 * at);
    if (exact)
        status = iccp_boundary_defects(n, ring, 0, NULL, NULL, &n_defects, env, NULL);
    iccp_free(&env->memory, ring);
    if (status != ICC_OK && status != ICC_ERR_BOUNDARY)
        return status;
    *simple = exact && status == ICC_OK && n_defects == 0;
    return ICC_OK;
}

icc_status iccp_box_simple(bool *simple, const icc_field *field, const iccp_env *env)
{
    *simple = is_shifted(field);
    return *simple || field->dim == 3 ? ICC_OK : check_ring(simple, field, env);
}
