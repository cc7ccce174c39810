/* Judges all cells of a sampled field, each by itself, and then the field as a whole.
 *
 * Cells that are all positive make the field one-to-one near each point. Around an edge of the grid
 * lie four cells, each with an angle below 180 degrees, so they go around it once. Around a sample
 * the same holds for the sphere of directions, which has no connected coverings. If the image of
 * the boundary is simple, each point inside it is then hit once, because all hits count +1 and
 * their sum is the boundary's winding number. */
#include "sampled/sampled_certify.h"

#include "base/error.h"
#include "base/memory.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "sampled/box.h"
#include "sampled/cell_sign.h"

#include <float.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>

enum { CELLS_PER_CHUNK = 1024 };

typedef struct judging {
    const icc_field *field;
    const iccp_memory *memory;
    uint8_t *kind;        /* of each cell: 0 or ICC_CELL_* */
    double *least;        /* of each chunk */
    int sign;             /* of the grid's determinant */
    atomic_size_t n_long; /* cells in which the displacement may grow as fast as the place */
} judging;

/* Bounds how much the displacement changes in a cell, relative to the way along the axes. Below 1
 * everywhere, two places of a box have different images: their displacements differ by less than
 * they do. */
static double growth_of(const iccp_cell *cell, const icc_field *field)
{
    const size_t dim = (size_t)field->dim;
    double worst = 0;
    for (size_t k = 0; k < dim; ++k) {
        double sum = 0;
        for (size_t axis = 0; axis < dim; ++axis) {
            double most = 0;
            for (size_t e = 0; e < cell->n_edges[axis]; ++e) {
                const double *term = cell->term[axis][e][k];
                const double edge = term[0] + term[1];
                const double step = field->displacement ? 0 : field->step[dim * axis + k];
                /* Two roundings: of the edge, and of its difference from the step. */
                most = iccp_max(most, fabs(edge - step) + DBL_EPSILON * (fabs(edge) + fabs(step)));
            }
            sum += most / fabs(field->step[dim * axis + axis]);
        }
        worst = iccp_max(worst, sum);
    }
    return worst * (1 + 8 * DBL_EPSILON);
}

static bool is_along_axes(const icc_field *field)
{
    const size_t dim = (size_t)field->dim;
    for (size_t axis = 0; axis < dim; ++axis)
        for (size_t k = 0; k < dim; ++k)
            if (k != axis && fabs(field->step[dim * axis + k]) > 0)
                return false;
    return true;
}

static icc_status judge_chunk(void *argument, size_t begin, size_t end)
{
    judging *j = argument;
    iccp_cell_work *work = NULL;
    const bool along = is_along_axes(j->field);
    double least = HUGE_VAL;
    size_t n_long = 0;
    bool failed = false;
    for (size_t c = begin; c < end && !failed; ++c) {
        iccp_cell cell;
        size_t i[3] = {0};
        iccp_sample_split(j->field, c, 1, i);
        const bool finite = iccp_cell_read(&cell, j->field, i, j->sign);
        j->kind[c] = (uint8_t)(finite ? iccp_cell_sign(&cell, &least, &work, j->memory, &failed)
                                      : ICC_CELL_MISSING);
        n_long += !along || !finite || !(growth_of(&cell, j->field) < 1);
    }
    j->least[begin / CELLS_PER_CHUNK] = least;
    atomic_fetch_add(&j->n_long, n_long);
    iccp_free(j->memory, work);
    return failed ? ICC_ERR_MEMORY : ICC_OK;
}

/* The exact sign of the grid's own determinant, and its value. */
static icc_status sign_of_grid(int *sign, double *value, const icc_field *field,
                               const iccp_env *env, icc_error *err)
{
    iccp_cell cell;
    iccp_cell_bounds b = {{0}, {0}};
    const bool usable = iccp_cell_read_grid(&cell, field) && iccp_cell_bound(&b, &cell);
    if (usable && b.lower[0] <= 0 && b.upper[0] >= 0) {
        iccp_cell_work *work = iccp_cell_work_create(&env->memory);
        if (work == NULL)
            return iccp_fail_memory(err);
        if (!iccp_cell_bound_exactly(&b, &cell, work))
            b.lower[0] = b.upper[0] = 0;
        iccp_free(&env->memory, work);
    }
    *value = 0.5 * b.lower[0] + 0.5 * b.upper[0];
    *sign = b.lower[0] > 0 ? 1 : b.upper[0] < 0 ? -1 : 0;
    if (!usable || *sign == 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_field: the steps span no volume that can be computed with; give one "
                         "step for each axis, in independent directions");
    return ICC_OK;
}

/* Counts and lists the cells that are not proven. */
static void list_cells(icc_field_report *r, const judging *j, size_t capacity, uint32_t *cells,
                       int32_t *kinds)
{
    size_t n = 0;
    for (size_t c = 0; c < r->n_cells; ++c) {
        const int32_t kind = j->kind[c];
        r->n_folded += kind == ICC_CELL_FOLDED;
        r->n_undecided += kind == ICC_CELL_UNDECIDED;
        r->n_missing += kind == ICC_CELL_MISSING;
        if (kind != 0 && n < capacity) {
            cells[n] = (uint32_t)c;
            kinds[n++] = kind;
        }
    }
    r->certified = r->n_folded + r->n_undecided + r->n_missing == 0;
}

/* Decides about the whole field and says what is missing. */
static icc_status conclude(icc_field_report *r, judging *j, const iccp_env *env)
{
    bool simple = r->certified && atomic_load(&j->n_long) == 0;
    icc_status status = ICC_OK;
    if (r->certified && !simple)
        status = iccp_box_simple(&simple, j->field, env);
    r->one_to_one = simple;
    if (!r->certified)
        snprintf(r->message, sizeof r->message,
                 "of %zu cells %zu fold, %zu are undecided and %zu have a corner without a value",
                 r->n_cells, r->n_folded, r->n_undecided, r->n_missing);
    else if (!simple)
        snprintf(r->message, sizeof r->message,
                 "no cell folds, but it is not proven that the boundary of the box stays simple");
    return status;
}

icc_status iccp_sampled_certify(const icc_field *field, size_t capacity, uint32_t *cells,
                                int32_t *kinds, icc_field_report *report, const iccp_env *env,
                                icc_error *err)
{
    double volume;
    judging j = {.field = field, .memory = &env->memory};
    memset(report, 0, sizeof *report);
    report->n_cells = iccp_sample_count(field, 1);
    icc_status status = sign_of_grid(&j.sign, &volume, field, env, err);
    if (status != ICC_OK)
        return status;
    const size_t n_chunks = (report->n_cells - 1) / CELLS_PER_CHUNK + 1;
    j.kind = iccp_alloc(&env->memory, report->n_cells, 1);
    j.least = iccp_alloc(&env->memory, n_chunks, sizeof *j.least);
    status = j.kind != NULL && j.least != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "check", report->n_cells, CELLS_PER_CHUNK, judge_chunk, &j);
    if (status == ICC_OK) {
        list_cells(report, &j, capacity, cells, kinds);
        report->least = HUGE_VAL;
        for (size_t i = 0; i < n_chunks; ++i)
            report->least = iccp_min(report->least, j.least[i]);
        report->least /= fabs(volume);
        status = conclude(report, &j, env);
    }
    iccp_free(&env->memory, j.kind);
    iccp_free(&env->memory, j.least);
    return iccp_explain(err, status);
}
