/* Sorts segments and points by their left ends, and compares those whose ranges overlap. */
#include "fit/lines_check.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/sort.h"
#include "geometry/segment.h"

/* A segment ends at its item and begins at the one before. A point is a segment from itself. */
typedef struct checker {
    const iccp_told *told;
    const double *points;
    size_t n;
    uint32_t *order; /* the items, then working memory */
} checker;

static const double *begin_of(const checker *c, uint32_t i)
{
    return c->points + 2 * (size_t)(i - c->told->joined[i]);
}

static const double *end_of(const checker *c, uint32_t i)
{
    return c->points + 2 * (size_t)i;
}

static double left_of(const checker *c, uint32_t i)
{
    return iccp_min(begin_of(c, i)[0], end_of(c, i)[0]);
}

static double right_of(const checker *c, uint32_t i)
{
    return iccp_max(begin_of(c, i)[0], end_of(c, i)[0]);
}

static bool is_left(const void *context, uint32_t a, uint32_t b)
{
    return left_of(context, a) < left_of(context, b);
}

/* Whether two segments have a point in common that is not an end of both, unless they are equal. */
static bool meet(const double *a, const double *b, const double *c, const double *d)
{
    const bool ac = iccp_point_equal(a, c), ad = iccp_point_equal(a, d),
               bc = iccp_point_equal(b, c), bd = iccp_point_equal(b, d);
    if ((ac && bd) || (ad && bc))
        return false;
    if (ac || ad)
        return iccp_point_folds(a, b, ac ? d : c);
    if (bc || bd)
        return iccp_point_folds(b, a, bc ? d : c);
    return iccp_segments_meet(a, b, c, d) != 0;
}

/* Whether two items meet, of which at least one is a segment. */
static bool items_meet(const checker *k, uint32_t i, uint32_t j)
{
    const double *a = begin_of(k, i), *b = end_of(k, i), *c = begin_of(k, j), *d = end_of(k, j);
    if (k->told->joined[i] && k->told->joined[j])
        return meet(a, b, c, d);
    if (!k->told->joined[i])
        return !iccp_point_equal(b, c) && !iccp_point_equal(b, d) && iccp_segment_has(c, d, b);
    return !iccp_point_equal(d, a) && !iccp_point_equal(d, b) && iccp_segment_has(a, b, d);
}

static icc_status blame(const checker *c, uint32_t i, uint32_t j, icc_error *err)
{
    const uint32_t line = c->told->joined[i] ? i : j, other = line == i ? j : i;
    if (!c->told->joined[other])
        return iccp_fail_at(err, ICC_ERR_CERTIFICATE, ICC_ITEM_POINT, (int64_t)line,
                            "the line from point %zu to point %zu meets point %zu",
                            (size_t)line - 1, (size_t)line, (size_t)other);
    const size_t late = line > other ? line : other, early = line > other ? other : line;
    return iccp_fail_at(err, ICC_ERR_CERTIFICATE, ICC_ITEM_POINT, (int64_t)late,
                        "the line from point %zu to point %zu meets the line from point %zu to "
                        "point %zu",
                        late - 1, late, early - 1, early);
}

/* Lists segments and exact points that are on no line. */
static icc_status list_items(checker *c, icc_error *err)
{
    const iccp_told *told = c->told;
    for (uint32_t i = 0; i < told->n; ++i) {
        if (told->joined[i] && iccp_point_equal(begin_of(c, i), end_of(c, i)))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                "the line from point %zu to point %zu has no length", (size_t)i - 1,
                                (size_t)i);
        if (told->joined[i] ||
            (told->kind[i] == ICC_CONSTRAINT_POINTS && !(told->tolerance[i] > 0)))
            c->order[c->n++] = i;
    }
    iccp_sort_indices(c->order, c->order + told->n, c->n, c, is_left);
    return ICC_OK;
}

static icc_status compare(const checker *c, icc_error *err)
{
    for (size_t k = 0; k < c->n; ++k) {
        const uint32_t i = c->order[k];
        for (size_t l = k + 1; l < c->n && left_of(c, c->order[l]) <= right_of(c, i); ++l) {
            const uint32_t j = c->order[l];
            if ((c->told->joined[i] || c->told->joined[j]) && items_meet(c, i, j))
                return blame(c, i, j, err);
        }
    }
    return ICC_OK;
}

icc_status iccp_lines_check(const iccp_told *told, const double *points, int side,
                            const iccp_env *env, icc_error *err)
{
    checker c = {.told = told, .points = points};
    c.order = iccp_alloc(&env->memory, told->n, 2 * sizeof *c.order);
    icc_status status = c.order != NULL ? list_items(&c, err) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = compare(&c, err);
    iccp_free(&env->memory, c.order);
    return status == ICC_OK || status == ICC_ERR_MEMORY ? status
                                                        : iccp_fail_side(err, status, side);
}
