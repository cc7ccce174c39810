/* Assembles, factorises and solves the linear system of a spline. */
#include "fit/spline/spline_system.h"

#include "base/sort.h"
#include "base/threads.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* Share of its diagonal that is added to a matrix that would be singular. It is far above rounding,
 * and far below what bending asks of vertices close to those that are told. */
static const double SPRING = 1e-10;

/* A told value is not determined by the others if the energy's matrix has less than this share of
 * the diagonal left for it. */
static const double LEAST_SHARE = 1e-9;

/* Told vertices that one task leaves out. */
enum { GRAIN = 128 };

/* ---- the matrix ---- */

static icc_status allocate(iccp_spline_system *s, size_t n_vertices, size_t n_told)
{
    s->told = iccp_alloc(&s->memory, n_told, sizeof *s->told);
    s->weight = iccp_alloc_zero(&s->memory, n_told, sizeof *s->weight);
    s->turn = iccp_alloc(&s->memory, n_told, sizeof *s->turn);
    s->slot = iccp_alloc_zero(&s->memory, n_vertices, sizeof *s->slot);
    return s->told != NULL && s->weight != NULL && s->turn != NULL && s->slot != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* Numbers the free vertices, and returns the number of entries in their rows. */
static size_t number_free(iccp_spline_system *s)
{
    const iccp_symmetric *q = &s->energy.matrix;
    size_t count = 0;
    for (size_t k = 0; k < s->n_told; ++k)
        if (!(s->weight[k] > 0))
            s->slot[s->told[k]] = NONE;
    for (size_t v = 0; v < q->n; ++v)
        if (s->slot[v] != NONE) {
            s->slot[v] = (uint32_t)s->n_free++;
            count += q->first[v + 1] - q->first[v];
        }
    return count;
}

static icc_status take_free_rows(iccp_spline_system *s)
{
    const iccp_symmetric *q = &s->energy.matrix;
    const size_t count = number_free(s);
    size_t end = 0, row = 0;
    s->first = iccp_alloc(&s->memory, s->n_free + 1, sizeof *s->first);
    s->diagonal = iccp_alloc(&s->memory, s->n_free, sizeof *s->diagonal);
    s->column = iccp_alloc(&s->memory, count, sizeof *s->column);
    s->value = iccp_alloc(&s->memory, count, sizeof *s->value);
    if (s->first == NULL || s->diagonal == NULL || s->column == NULL || s->value == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < q->n; ++v) {
        if (s->slot[v] == NONE)
            continue;
        s->first[row] = end;
        s->diagonal[row++] = q->diagonal[v];
        for (size_t p = q->first[v]; p < q->first[v + 1]; ++p)
            if (s->slot[q->column[p]] != NONE) {
                s->column[end] = s->slot[q->column[p]];
                s->value[end++] = q->value[p];
            }
    }
    s->first[row] = end;
    return ICC_OK;
}

static iccp_symmetric matrix_of(const iccp_spline_system *s, const double *diagonal)
{
    return (iccp_symmetric){s->n_free, s->first, s->column, s->value, diagonal};
}

/* Factorises with the weights on the diagonal. A matrix that is singular to working precision gets
 * weak springs. */
static icc_status factorise(iccp_spline_system *s, const iccp_env *env)
{
    double *diagonal = iccp_alloc(&env->memory, s->n_free, sizeof *diagonal);
    if (diagonal == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_ERR_SOLVER;
    for (int springs = s->is_loose; status == ICC_ERR_SOLVER && springs < 2; ++springs) {
        for (size_t i = 0; i < s->n_free; ++i)
            diagonal[i] = s->diagonal[i] * (1 + springs * SPRING);
        for (size_t k = 0; k < s->n_told; ++k)
            if (s->weight[k] > 0)
                diagonal[s->slot[s->told[k]]] += s->weight[k];
        const iccp_symmetric m = matrix_of(s, diagonal);
        status = iccp_ldlt_factorise(&s->factor, &m, env);
    }
    iccp_free(&env->memory, diagonal);
    return status;
}

/* ---- the order in which vertices are left out ---- */

/* Where elimination meets a told vertex or, if it has no row, one of its neighbours. */
static uint32_t place_of(const iccp_spline_system *s, uint32_t vertex)
{
    const iccp_symmetric *q = &s->energy.matrix;
    uint32_t row = s->slot[vertex];
    for (size_t p = q->first[vertex]; row == NONE && p < q->first[vertex + 1]; ++p)
        row = s->slot[q->column[p]];
    return row != NONE ? s->factor.position[row] : 0;
}

static bool is_earlier(const void *context, uint32_t a, uint32_t b)
{
    const uint32_t *place = context;
    return place[a] < place[b];
}

static icc_status find_turns(iccp_spline_system *s, const iccp_env *env)
{
    uint32_t *work = iccp_alloc(&env->memory, s->n_told, 2 * sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    uint32_t *place = work + s->n_told;
    for (uint32_t k = 0; k < s->n_told; ++k) {
        s->turn[k] = k;
        place[k] = place_of(s, s->told[k]);
    }
    iccp_sort_indices(s->turn, work, s->n_told, place, is_earlier);
    iccp_free(&env->memory, work);
    return ICC_OK;
}

/* ---- all of it ---- */

static icc_status create(iccp_spline_system *s, const iccp_bending_mesh *mesh, const uint32_t *told,
                         const double *weight, const iccp_env *env)
{
    iccp_env parts[3];
    iccp_split(parts, 3, (const double[]){1, 1, 2}, env);
    icc_status status = allocate(s, mesh->n_vertices, s->n_told);
    if (status == ICC_OK)
        status = iccp_bending_energy(&s->energy, mesh, &parts[0]);
    if (status != ICC_OK)
        return status;
    memcpy(s->told, told, s->n_told * sizeof *told);
    if (weight != NULL)
        memcpy(s->weight, weight, s->n_told * sizeof *weight);
    status = take_free_rows(s);
    const iccp_symmetric m = matrix_of(s, s->diagonal);
    if (status == ICC_OK)
        status = iccp_ldlt_analyse(&s->factor, &m, 1, &parts[1]);
    if (status == ICC_OK)
        status = find_turns(s, env);
    return status == ICC_OK ? factorise(s, &parts[2]) : status;
}

icc_status iccp_spline_system_create(iccp_spline_system *system, const iccp_bending_mesh *mesh,
                                     size_t n_told, const uint32_t *told, const double *weight,
                                     bool is_loose, const iccp_env *env)
{
    *system = (iccp_spline_system){.memory = env->memory, .n_told = n_told, .is_loose = is_loose};
    system->energy.memory = system->factor.memory = env->memory;
    const icc_status status = create(system, mesh, told, weight, env);
    if (status != ICC_OK)
        iccp_spline_system_free(system);
    return status;
}

void iccp_spline_system_free(iccp_spline_system *system)
{
    const iccp_memory memory = system->memory;
    iccp_gram_free(&system->energy);
    iccp_ldlt_free(&system->factor);
    iccp_free(&memory, system->told);
    iccp_free(&memory, system->weight);
    iccp_free(&memory, system->slot);
    iccp_free(&memory, system->turn);
    iccp_free(&memory, system->first);
    iccp_free(&memory, system->column);
    iccp_free(&memory, system->value);
    iccp_free(&memory, system->diagonal);
    *system = (iccp_spline_system){.memory = memory};
    system->energy.memory = system->factor.memory = memory;
}

icc_status iccp_spline_system_weigh(iccp_spline_system *system, const double *weight,
                                    const iccp_env *env)
{
    for (size_t k = 0; k < system->n_told; ++k)
        if (system->weight[k] > 0)
            system->weight[k] = weight[k];
    return factorise(system, env);
}

/* ---- solutions ---- */

/* Writes the right-hand side: the forces by which told vertices act on free ones. */
static void find_forces(const iccp_spline_system *s, const double *told, double *b)
{
    const iccp_symmetric *q = &s->energy.matrix;
    memset(b, 0, 2 * s->n_free * sizeof *b);
    for (size_t k = 0; k < s->n_told; ++k) {
        const uint32_t v = s->told[k];
        const double *value = told + 2 * k;
        for (size_t c = 0; c < 2 && s->weight[k] > 0; ++c)
            b[2 * (size_t)s->slot[v] + c] += s->weight[k] * value[c];
        if (s->slot[v] != NONE)
            continue;
        for (size_t p = q->first[v]; p < q->first[v + 1]; ++p)
            if (s->slot[q->column[p]] != NONE)
                for (size_t c = 0; c < 2; ++c)
                    b[2 * (size_t)s->slot[q->column[p]] + c] -= q->value[p] * value[c];
    }
}

icc_status iccp_spline_system_solve(const iccp_spline_system *system, const double *told, double *u,
                                    const iccp_env *env)
{
    const size_t n = system->n_free;
    double *b = iccp_alloc(&env->memory, n, 4 * sizeof *b);
    if (b == NULL)
        return ICC_ERR_MEMORY;
    find_forces(system, told, b);
    iccp_ldlt_solve_at_once(&system->factor, 2, b, b + 2 * n, env);
    for (size_t v = 0; v < system->energy.matrix.n; ++v)
        if (system->slot[v] != NONE)
            memcpy(u + 2 * v, b + 2 * (size_t)system->slot[v], 2 * sizeof *u);
    for (size_t k = 0; k < system->n_told; ++k)
        if (system->slot[system->told[k]] == NONE)
            memcpy(u + 2 * (size_t)system->told[k], told + 2 * k, 2 * sizeof *u);
    iccp_free(&env->memory, b);
    return iccp_progress(env, "solve", 1);
}

/* ---- leaving out ---- */

/* Told vertices that are left out in one pass over the factor, as sparse right-hand sides. */
typedef struct batch {
    const iccp_spline_system *system;
    const double *told, *u;
    double *left_out;
    size_t most; /* most entries of a right-hand side */
} batch;

/* Working memory of one task. */
typedef struct scratch {
    size_t n; /* entries of the right-hand sides */
    uint32_t *row, *path;
    double *value, *work;
    uint8_t *needed;
} scratch;

static void free_scratch(const scratch *w, const iccp_memory *memory)
{
    iccp_free(memory, w->row);
    iccp_free(memory, w->path);
    iccp_free(memory, w->value);
    iccp_free(memory, w->work);
    iccp_free(memory, w->needed);
}

static icc_status make_scratch(scratch *w, const batch *b)
{
    const iccp_spline_system *s = b->system;
    const size_t most = ICCP_LDLT_FORMS * b->most;
    *w =
        (scratch){.row = iccp_alloc(&s->memory, most, sizeof *w->row),
                  .path = iccp_alloc(&s->memory, s->factor.nodes.n, sizeof *w->path),
                  .value = iccp_alloc(&s->memory, most, ICCP_LDLT_FORMS * sizeof *w->value),
                  .work = iccp_alloc_zero(&s->memory, s->n_free, ICCP_LDLT_FORMS * sizeof *w->work),
                  .needed = iccp_alloc_zero(&s->memory, s->factor.nodes.n, 1)};
    return w->row != NULL && w->path != NULL && w->value != NULL && w->work != NULL &&
                   w->needed != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void add_entry(scratch *w, uint32_t row, size_t c, double value)
{
    double *values = w->value + ICCP_LDLT_FORMS * w->n;
    w->row[w->n++] = row;
    for (size_t k = 0; k < ICCP_LDLT_FORMS; ++k)
        values[k] = k == c ? value : 0;
}

/* Writes right-hand side c: the unit vector of a weighted vertex, or the free entries of an exact
 * one's row of Q. */
static void add_side(scratch *w, const iccp_spline_system *s, uint32_t vertex, size_t c)
{
    const iccp_symmetric *q = &s->energy.matrix;
    if (s->slot[vertex] != NONE) {
        add_entry(w, s->slot[vertex], c, 1);
        return;
    }
    for (size_t p = q->first[vertex]; p < q->first[vertex + 1]; ++p)
        if (s->slot[q->column[p]] != NONE)
            add_entry(w, s->slot[q->column[p]], c, q->value[p]);
}

static void leave_out_weighted(const batch *b, uint32_t k, double form)
{
    const uint32_t v = b->system->told[k];
    const double rest = 1 - b->system->weight[k] * form;
    for (size_t c = 0; c < 2; ++c)
        b->left_out[2 * k + c] =
            rest > LEAST_SHARE ? (b->u[2 * v + c] - b->told[2 * k + c]) / rest : NAN;
}

static void leave_out_exact(const batch *b, uint32_t k, double form)
{
    const iccp_symmetric *q = &b->system->energy.matrix;
    const uint32_t v = b->system->told[k];
    const double rest = q->diagonal[v] - form;
    double force[2] = {q->diagonal[v] * b->u[2 * v], q->diagonal[v] * b->u[2 * v + 1]};
    for (size_t p = q->first[v]; p < q->first[v + 1]; ++p)
        for (size_t c = 0; c < 2; ++c)
            force[c] += q->value[p] * b->u[2 * (size_t)q->column[p] + c];
    for (size_t c = 0; c < 2; ++c)
        b->left_out[2 * k + c] = rest > LEAST_SHARE * q->diagonal[v] ? -force[c] / rest : NAN;
}

static icc_status leave_out_some(void *argument, size_t begin, size_t end)
{
    const batch *b = argument;
    const iccp_spline_system *s = b->system;
    scratch w;
    const icc_status status = make_scratch(&w, b);
    for (size_t k = begin; status == ICC_OK && k < end; k += ICCP_LDLT_FORMS) {
        const size_t n = end - k < ICCP_LDLT_FORMS ? end - k : ICCP_LDLT_FORMS;
        double form[ICCP_LDLT_FORMS];
        w.n = 0;
        for (size_t c = 0; c < n; ++c)
            add_side(&w, s, s->told[s->turn[k + c]], c);
        iccp_ldlt_forms(&s->factor, w.n, w.row, w.value, form, w.work, w.needed, w.path);
        for (size_t c = 0; c < n; ++c) {
            const uint32_t i = s->turn[k + c];
            if (s->slot[s->told[i]] != NONE)
                leave_out_weighted(b, i, form[c]);
            else
                leave_out_exact(b, i, form[c]);
        }
    }
    free_scratch(&w, &s->memory);
    return status;
}

icc_status iccp_spline_system_leave_out(const iccp_spline_system *system, const double *told,
                                        const double *u, double *left_out, const iccp_env *env)
{
    const iccp_symmetric *q = &system->energy.matrix;
    batch b = {.system = system, .told = told, .u = u, .left_out = left_out, .most = 1};
    for (size_t k = 0; k < system->n_told; ++k) {
        const size_t v = system->told[k], n = q->first[v + 1] - q->first[v];
        b.most = n > b.most ? n : b.most;
    }
    return iccp_for_chunks(env, "solve", system->n_told, GRAIN, leave_out_some, &b);
}
