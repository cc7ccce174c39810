/* Checks a map by round trips. A point is mapped, and its image is mapped back. The distance of the
 * two is what the doubles have lost.
 *
 * The way back costs as much as the map. So only points are sent back whose surroundings shrink so
 * much that digits may be missing. The divergence of the two fields along the curves tells how
 * much they shrink, and rounding cannot spoil it. Source: docs/theory/charts-space.md, "fields on
 * grids". */
#include "map/curves/round_trip.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "chart/low_discrepancy.h"
#include "gradient/function/function.h"
#include "map/curves/curves.h"
#include "math/elementary.h"
#include "math/orient.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Allowed distance of a point from its image mapped back, relative to the diagonal of the
 * bounding box. AWAY is for points of a certified map, SAMPLE_AWAY for samples. Rounding alone
 * gives about 1e-13. The distance grows tenfold within a small part of a domain's smallest
 * width. So points among accepted samples are still far from AWAY. */
static const double AWAY = 1e-6, SAMPLE_AWAY = 1e-9;

/* Ratios of the two volumes. Below SUSPECT a point is sent back. Below FLAT it counts as
 * flattened. */
static const double SUSPECT = 1e-4, FLAT = 1e-6;

/* N_SAMPLES: samples of each domain. MOST_FLAT: how many of 1,000 may be flattened. N_STEEP: how
 * many of each domain, where the charts contract most, have their derivatives compared with
 * those of the way back. JACOBIAN_OFF: how far the products of the two may be from the identity. */
enum { N_SAMPLES = 1024, MOST_FLAT = 2, N_STEEP = 4 };
static const double JACOBIAN_OFF = 1e-3;

/* ---- points ---- */

/* The rounding of the caller's coordinates, relative to the domain's diagonal: some units in the
 * last place. It matters for shapes far from the origin. */
static double rounding_of(const icc_domain *domain, double diagonal)
{
    const iccp_frame *frame = &domain->frame;
    double largest = 0;
    for (int32_t k = 0; k < domain->dim; ++k)
        largest = iccp_max(largest, fabs(frame->shift[k]) * frame->in[0] * frame->in[1]);
    return 4 * DBL_EPSILON * largest / diagonal;
}

static double diagonal_of(const icc_domain *domain)
{
    double sum = 0;
    for (int32_t k = 0; k < domain->dim; ++k) {
        const double side = domain->upper[k] - domain->lower[k];
        sum += side * side;
    }
    return sqrt(sum);
}

/* Returns true if a point has come back, in the caller's coordinates. `most` is the allowed
 * distance relative to the diagonal, to which rounding is added. */
static bool comes_back(const icc_domain *domain, const icc_domain *other, const double *point,
                       const double *back, double most)
{
    const double diagonal = diagonal_of(domain);
    const double rounding = rounding_of(domain, diagonal) + rounding_of(other, diagonal_of(other));
    double x[ICC_MAX_DIM], y[ICC_MAX_DIM], sum = 0;
    iccp_frame_in(&domain->frame, domain->dim, point, x);
    iccp_frame_in(&domain->frame, domain->dim, back, y);
    for (int32_t k = 0; k < domain->dim; ++k)
        sum += (x[k] - y[k]) * (x[k] - y[k]);
    return sqrt(sum) <= (most + rounding) * diagonal;
}

/* Sends back the images of the n points that `which` selects. `home` tells which of them come
 * back. */
static icc_status send_back(const icc_chart *from, const icc_chart *to, size_t n,
                            const size_t *which, const double *points, const double *images,
                            double most, bool *home, iccp_path *path)
{
    const size_t dim = (size_t)from->info.dim;
    double sent[ICCP_CHART_MANY * ICC_MAX_DIM], back[ICCP_CHART_MANY * ICC_MAX_DIM];
    icc_status arrived[ICCP_CHART_MANY];
    if (n == 0)
        return ICC_OK;
    for (size_t j = 0; j < n; ++j)
        memcpy(sent + dim * j, images + dim * which[j], dim * sizeof *sent);
    const icc_status all = iccp_curves_points(to, from, n, sent, back, NULL, arrived, path);
    for (size_t j = 0; all == ICC_OK && j < n; ++j)
        home[j] = arrived[j] == ICC_OK && comes_back(from->domain, to->domain,
                                                     points + dim * which[j], back + dim * j, most);
    return all;
}

/* Returns true if digits may be missing. NaN is suspect, too. */
static bool is_suspect(const iccp_shares *shares)
{
    return !(shares->to - shares->from >= iccp_ln(SUSPECT));
}

icc_status iccp_checked_points(const icc_chart *from, const icc_chart *to, size_t n,
                               const double *points, double *images, icc_status *status,
                               iccp_path *path)
{
    const size_t dim = (size_t)from->info.dim;
    double own[ICCP_CHART_MANY * ICC_MAX_DIM]; /* a copy, because the images may overwrite the
                                                  points */
    iccp_shares shares[ICCP_CHART_MANY];
    size_t which[ICCP_CHART_MANY] = {0}, n_suspect = 0;
    bool home[ICCP_CHART_MANY];
    memcpy(own, points, n * dim * sizeof *own);
    icc_status all = iccp_curves_points(from, to, n, own, images, shares, status, path);
    for (size_t i = 0; all == ICC_OK && i < n; ++i)
        if (status[i] == ICC_OK && is_suspect(&shares[i]))
            which[n_suspect++] = i;
    if (all == ICC_OK)
        all = send_back(from, to, n_suspect, which, own, images, AWAY, home, path);
    for (size_t j = 0; all == ICC_OK && j < n_suspect; ++j)
        if (!home[j]) {
            status[which[j]] = ICC_ERR_TRACE;
            for (size_t k = 0; k < dim; ++k)
                images[dim * which[j] + k] = NAN;
        }
    return all;
}

/* ---- derivatives ---- */

/* Returns true if the determinant is positive. Its size may be anything. */
static bool is_positive(int32_t dim, const double *jacobian)
{
    const double zero[ICC_MAX_DIM] = {0};
    const double *rows[ICC_MAX_DIM + 1] = {zero};
    double scaled[ICC_MAX_DIM * ICC_MAX_DIM], largest = 0;
    for (int32_t k = 0; k < dim * dim; ++k)
        largest = iccp_max(largest, fabs(jacobian[k]));
    for (int32_t k = 0; k < dim * dim; ++k)
        scaled[k] = jacobian[k] / largest;
    for (int32_t k = 0; k < dim; ++k)
        rows[k + 1] = scaled + dim * k;
    return iccp_orient_value((size_t)dim, rows) > 0;
}

icc_status iccp_checked_point(const icc_chart *from, const icc_chart *to, const double *point,
                              double *image, double *jacobian, iccp_path *path)
{
    static const size_t FIRST = 0;
    bool home;
    icc_status status = iccp_curves_point(from, to, point, image, jacobian, path);
    if (status == ICC_OK && !is_positive(from->info.dim, jacobian))
        status = ICC_ERR_TRACE;
    if (status != ICC_OK)
        return status;
    status = send_back(from, to, 1, &FIRST, point, image, AWAY, &home, path);
    return status == ICC_OK && !home ? ICC_ERR_TRACE : status;
}

/* The largest entry of the product of two matrices minus the identity. */
static double miss_of(int32_t dim, const double *a, const double *b)
{
    double worst = 0;
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t j = 0; j < dim; ++j) {
            double sum = i == j ? -1 : 0;
            for (int32_t k = 0; k < dim; ++k)
                sum += a[i * dim + k] * b[k * dim + j];
            worst = iccp_max(worst, isfinite(sum) ? fabs(sum) : HUGE_VAL);
        }
    return worst;
}

/* Tells whether the derivative is accurate: the derivative of the way back must be its inverse,
 * and its determinant positive. */
static icc_status compare_derivatives(const icc_chart *from, const icc_chart *to,
                                      const double *point, bool *agree, const iccp_memory *memory)
{
    double image[ICC_MAX_DIM], back[ICC_MAX_DIM];
    double there[ICC_MAX_DIM * ICC_MAX_DIM], again[ICC_MAX_DIM * ICC_MAX_DIM];
    iccp_path path;
    iccp_path_init(&path, memory);
    icc_status status = iccp_curves_point(from, to, point, image, there, &path);
    if (status == ICC_OK)
        status = iccp_curves_point(to, from, image, back, again, &path);
    iccp_path_clear(&path);
    *agree = status == ICC_OK && is_positive(from->info.dim, there) &&
             miss_of(from->info.dim, again, there) <= JACOBIAN_OFF;
    return status == ICC_ERR_MEMORY ? status : ICC_OK;
}

/* ---- the whole map ---- */

typedef struct verdict {
    bool used, lost, flat;
    double steep; /* the smaller of the two shares */
} verdict;

typedef struct samples {
    const icc_chart *from, *to;
    const icc_grid *grid;
    const uint32_t *inside; /* the grid's inside vertices */
    const iccp_memory *memory;
    verdict *verdict; /* one for each sample */
} samples;

/* A point in the caller's coordinates near an inside vertex. It may be outside the domain. */
static void find_point(const samples *s, size_t index, double *point)
{
    const icc_grid *grid = s->grid;
    const int32_t dim = grid->dim;
    const size_t k = (size_t)((double)grid->n_inside * iccp_low_discrepancy(1, 0, index));
    const uint32_t vertex = s->inside[k < grid->n_inside ? k : grid->n_inside - 1];
    double local[ICC_MAX_DIM];
    for (int32_t i = 0; i < dim; ++i)
        local[i] = grid->origin[i] + grid->spacing * (iccp_grid_coordinate(grid, vertex, i) +
                                                      iccp_low_discrepancy(dim, i, index) - 0.5);
    iccp_frame_out(&s->from->domain->frame, dim, local, point);
}

/* Maps points, and maps some of them back: all that are suspect, and one in four of the others. */
static icc_status judge_chunk(void *argument, size_t begin, size_t end)
{
    enum { ONE_IN = 4 };
    const samples *s = argument;
    const size_t dim = (size_t)s->grid->dim, n = end - begin;
    double points[ICCP_CHART_MANY * ICC_MAX_DIM], images[ICCP_CHART_MANY * ICC_MAX_DIM];
    iccp_shares shares[ICCP_CHART_MANY];
    icc_status status[ICCP_CHART_MANY];
    size_t which[ICCP_CHART_MANY] = {0}, n_back = 0;
    bool home[ICCP_CHART_MANY];
    iccp_path path;
    iccp_path_init(&path, s->memory);
    for (size_t i = 0; i < n; ++i)
        find_point(s, begin + i, points + dim * i);
    icc_status all = iccp_curves_points(s->from, s->to, n, points, images, shares, status, &path);
    for (size_t i = 0; all == ICC_OK && i < n; ++i) {
        const bool mapped = status[i] == ICC_OK;
        s->verdict[begin + i] = (verdict){
            .used = status[i] != ICC_ERR_OUTSIDE,
            .lost = !mapped,
            .flat = mapped && !(shares[i].to - shares[i].from >= iccp_ln(FLAT)),
            .steep = mapped ? iccp_min(shares[i].from, shares[i].to) : HUGE_VAL,
        };
        if (mapped && (i % ONE_IN == 0 || is_suspect(&shares[i])))
            which[n_back++] = i;
    }
    if (all == ICC_OK)
        all = send_back(s->from, s->to, n_back, which, points, images, SAMPLE_AWAY, home, &path);
    for (size_t j = 0; all == ICC_OK && j < n_back; ++j)
        s->verdict[begin + which[j]].lost = !home[j];
    iccp_path_clear(&path);
    return all;
}

/* Compares derivatives at the samples where the charts contract most. A map's derivative is a
 * product of the charts' derivatives, so it loses digits first. */
static icc_status judge_derivatives(samples *s)
{
    for (int i = 0; i < N_STEEP; ++i) {
        size_t steepest = 0;
        double point[ICC_MAX_DIM];
        bool agree;
        for (size_t k = 1; k < N_SAMPLES; ++k)
            if (s->verdict[k].steep < s->verdict[steepest].steep)
                steepest = k;
        verdict *x = &s->verdict[steepest];
        find_point(s, steepest, point);
        const icc_status status = compare_derivatives(s->from, s->to, point, &agree, s->memory);
        if (status != ICC_OK)
            return status;
        x->steep = HUGE_VAL;
        x->lost = x->lost || (x->used && !agree);
    }
    return ICC_OK;
}

static void list_inside(const icc_grid *grid, uint32_t *inside)
{
    size_t n = 0;
    for (size_t v = 0; v < grid->n_vertices; ++v)
        if (grid->inside[v])
            inside[n++] = (uint32_t)v;
}

/* Checks the map in one direction, with samples of the first domain. */
static icc_status judge_way(const icc_chart *from, const icc_chart *to, iccp_map_facts *info,
                            const iccp_env *env)
{
    const icc_grid *grid = from->ops->function(from)->tree->grid;
    uint32_t *inside = iccp_alloc(&env->memory, grid->n_inside, sizeof *inside);
    verdict *verdicts = iccp_alloc_zero(&env->memory, N_SAMPLES, sizeof *verdicts);
    samples s = {from, to, grid, inside, &env->memory, verdicts};
    icc_status status = inside != NULL && verdicts != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        list_inside(grid, inside);
        status = iccp_for_chunks(env, "check", N_SAMPLES, ICCP_CHART_MANY, judge_chunk, &s);
    }
    if (status == ICC_OK)
        status = judge_derivatives(&s);
    for (size_t i = 0; status == ICC_OK && i < N_SAMPLES; ++i) {
        info->n_samples += verdicts[i].used;
        info->n_lost += verdicts[i].used && verdicts[i].lost;
        info->n_flat += verdicts[i].used && verdicts[i].flat;
    }
    iccp_free(&env->memory, inside);
    iccp_free(&env->memory, verdicts);
    return status;
}

icc_status iccp_round_trip_check(const icc_chart *source, const icc_chart *target,
                                 iccp_map_facts *info, const iccp_env *env)
{
    icc_status status = judge_way(source, target, info, env);
    if (status == ICC_OK)
        status = judge_way(target, source, info, env);
    if (info->n_lost > 0)
        info->reason = ICC_REASON_LOST;
    else if (1000 * info->n_flat > MOST_FLAT * info->n_samples)
        info->reason = ICC_REASON_FLAT;
    info->certified = info->reason == ICC_REASON_NONE;
    return status;
}
