/* Counts the pixels inside a shape row by row. */
#include "plot/coverage.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>

/* The pixels from `low` to below `high` whose centres lie between two coordinates. */
typedef struct range {
    size_t low, high;
} range;

static range find_range(double lower, double upper, size_t n)
{
    range r = {0, 0};
    if (upper > 0 && lower < (double)n) {
        r.low = lower > 0.5 ? (size_t)ceil(lower - 0.5) : 0;
        r.high = upper < (double)n ? (size_t)ceil(upper) : n;
    }
    return r;
}

/* Counts the pixels whose centres are in the shape, up to `enough`. */
static size_t count_pixels(const icc_domain *domain, const icc_domain_info *box, size_t width,
                           size_t height, size_t enough)
{
    range columns = find_range(box->lower[0], box->upper[0], width),
          rows = find_range(box->lower[1], box->upper[1], height);
    size_t n = columns.high > columns.low ? columns.high - columns.low : 0, n_covered = 0;
    double *centres = need(n, 2 * sizeof *centres);
    int32_t *where = need(n, sizeof *where);
    for (size_t y = rows.low; y < rows.high && n_covered < enough; y++) {
        for (size_t i = 0; i < n; i++) {
            centres[2 * i] = (double)(columns.low + i) + 0.5;
            centres[2 * i + 1] = (double)y + 0.5;
        }
        if (icc_domain_locate(domain, n, centres, where, NULL, NULL, NULL) != ICC_OK)
            break;
        for (size_t i = 0; i < n && n_covered < enough; i++)
            n_covered += where[i] != ICC_OUTSIDE;
    }
    free(centres);
    free(where);
    return n_covered;
}

void coverage_tell(job *j, size_t width, size_t height)
{
    progress_end(&j->bar);
    for (size_t side = 0; side < 2; side++) {
        icc_domain_info box = {.size = sizeof box};
        icc_domain_get_info(j->domains[side], &box);
        const char *file = job_file(j, (int)side + 1),
                   *role = cage_role_name(side == 0 ? CAGE_SOURCE : CAGE_TARGET);
        size_t n = count_pixels(j->domains[side], &box, width, height, 2);
        if (n < 2)
            note("%s: the %s cage covers %zu pixel%s of the picture of %zu x %zu; cages are in "
                 "pixels",
                 file, role, n, n == 1 ? "" : "s", width, height);
        else if (box.lower[0] < -0.5 || box.lower[1] < -0.5 || box.upper[0] > (double)width + 0.5 ||
                 box.upper[1] > (double)height + 0.5)
            note("%s: the %s cage reaches beyond the picture of %zu x %zu%s", file, role, width,
                 height, side == 0 ? "" : "; parts that land there are cut off");
    }
}
