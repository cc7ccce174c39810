/* Projected Newton with truncated conjugate gradients, preconditioned by the blocks of the points (J. Nocedal,
 * S. Wright, Numerical Optimization, section 7.1): factors of space fill up too much for a mesh as a
 * whole. */
#include "map/tet_newton.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

static const uint32_t PAIRS[12][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 0}, {1, 2}, {1, 3},
                                      {2, 0}, {2, 1}, {2, 3}, {3, 0}, {3, 1}, {3, 2}};

/* Sufficient decrease (Armijo), and how often a step is halved. */
static const double DECREASE = 1e-4;
enum { MAX_HALVINGS = 40 };

/* Added to the diagonal, relative to its mean: where negative curvature was left out the Hessian may be
 * singular. */
static const double SHIFT = 1e-10;

/* A pivot of a point's block that is smaller than this share of its diagonal is rounding. */
static const double SMALLEST_PIVOT = 1e-13;

/* Conjugate gradients end when the residual, in the preconditioner's norm, has fallen to this share. */
static const double RESIDUAL = 1e-2;
enum { MAX_DIRECTIONS = 200 };

/* ---- set-up ---- */

static uint32_t slot_of(const iccp_tet_newton *s, uint32_t simplex, uint32_t k)
{
    return s->slot[s->mesh->corners[4 * (size_t)simplex + k]];
}

static icc_status list_parts(iccp_tet_newton *s, const uint8_t *movable)
{
    const iccp_simplices *mesh = s->mesh;
    s->slot = iccp_alloc(&s->memory, mesh->n_points, sizeof *s->slot);
    s->free_point = iccp_alloc(&s->memory, mesh->n_points, sizeof *s->free_point);
    s->simplex = iccp_alloc(&s->memory, mesh->n_simplices, sizeof *s->simplex);
    if (s->slot == NULL || s->free_point == NULL || s->simplex == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < mesh->n_points; ++v) {
        s->slot[v] = NONE;
        if (v >= mesh->n_rim && (movable == NULL || movable[v])) {
            s->slot[v] = (uint32_t)s->n_free;
            s->free_point[s->n_free++] = v;
        }
    }
    for (uint32_t t = 0; t < mesh->n_simplices; ++t) {
        bool is_free = false;
        for (uint32_t k = 0; k < 4; ++k)
            is_free |= slot_of(s, t, k) != NONE;
        if (is_free)
            s->simplex[s->n_elements++] = t;
    }
    return ICC_OK;
}

/* Neighbours of each free point among the free ones, each once; `room` says where its list begins. */
static void list_neighbours(iccp_tet_newton *s, const size_t *room, uint32_t *degree,
                            uint32_t *list)
{
    memset(degree, 0, s->n_free * sizeof *degree);
    for (size_t e = 0; e < s->n_elements; ++e)
        for (int p = 0; p < 12; ++p) {
            const uint32_t a = slot_of(s, s->simplex[e], PAIRS[p][0]);
            const uint32_t b = slot_of(s, s->simplex[e], PAIRS[p][1]);
            s->neighbour[12 * e + (size_t)p] = NONE;
            if (a == NONE || b == NONE)
                continue;
            uint32_t *own = list + room[a], k = 0;
            while (k < degree[a] && own[k] != b)
                ++k;
            if (k == degree[a])
                own[degree[a]++] = b;
            s->neighbour[12 * e + (size_t)p] = k;
        }
}

/* Row 3 i + d holds the two other entries of the point's own block, then three columns for every
 * neighbour. */
static icc_status build_pattern(iccp_tet_newton *s, const uint32_t *degree, const size_t *room,
                                const uint32_t *list)
{
    size_t n_entries = 0;
    for (size_t i = 0; i < s->n_free; ++i)
        for (size_t d = 0; d < 3; ++d) {
            s->first[3 * i + d] = n_entries;
            n_entries += 2 + 3 * (size_t)degree[i];
        }
    s->first[3 * s->n_free] = n_entries;
    s->column = iccp_alloc(&s->memory, n_entries, sizeof *s->column);
    s->value = iccp_alloc(&s->memory, n_entries, sizeof *s->value);
    if (s->column == NULL || s->value == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t i = 0; i < s->n_free; ++i)
        for (uint32_t d = 0; d < 3; ++d) {
            uint32_t *column = s->column + s->first[3 * i + d];
            *column++ = 3 * i + (d == 0);
            *column++ = 3 * i + 2 - (d == 2);
            for (uint32_t k = 0; k < degree[i]; ++k)
                for (uint32_t c = 0; c < 3; ++c)
                    *column++ = 3 * list[room[i] + k] + c;
        }
    return ICC_OK;
}

static icc_status find_pattern(iccp_tet_newton *s)
{
    size_t *room = iccp_alloc_zero(&s->memory, s->n_free + 1, sizeof *room);
    uint32_t *degree = iccp_alloc(&s->memory, s->n_free, sizeof *degree);
    uint32_t *list = iccp_alloc(&s->memory, 12 * s->n_elements, sizeof *list);
    icc_status status = ICC_ERR_MEMORY;
    if (room != NULL && degree != NULL && list != NULL) {
        for (size_t e = 0; e < s->n_elements; ++e)
            for (uint32_t k = 0; k < 4; ++k)
                if (slot_of(s, s->simplex[e], k) != NONE)
                    room[slot_of(s, s->simplex[e], k) + 1] += 3;
        for (size_t i = 0; i < s->n_free; ++i)
            room[i + 1] += room[i];
        list_neighbours(s, room, degree, list);
        status = build_pattern(s, degree, room, list);
    }
    iccp_free(&s->memory, room);
    iccp_free(&s->memory, degree);
    iccp_free(&s->memory, list);
    return status;
}

/* Doubles of work space per unknown: the residual, the preconditioned one, a direction and its product, and
 * the factors of the point's block. */
enum { WORK = 6 };

static icc_status allocate(iccp_tet_newton *s)
{
    const size_t n = 3 * s->n_free;
    s->element = iccp_alloc(&s->memory, s->n_elements, sizeof *s->element);
    s->neighbour = iccp_alloc(&s->memory, s->n_elements, 12 * sizeof *s->neighbour);
    s->first = iccp_alloc(&s->memory, n + 1, sizeof *s->first);
    s->diagonal = iccp_alloc(&s->memory, n, sizeof *s->diagonal);
    s->gradient = iccp_alloc(&s->memory, n, sizeof *s->gradient);
    s->step = iccp_alloc(&s->memory, n, sizeof *s->step);
    s->saved = iccp_alloc(&s->memory, n, sizeof *s->saved);
    s->work = iccp_alloc(&s->memory, n, WORK * sizeof *s->work);
    return s->element != NULL && s->neighbour != NULL && s->first != NULL && s->diagonal != NULL &&
                   s->gradient != NULL && s->step != NULL && s->saved != NULL && s->work != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void set_element(iccp_tet_newton *s, size_t e, double stretch)
{
    double stretched[4][3];
    const double *corner[4];
    for (size_t k = 0; k < 4; ++k) {
        const double *p = iccp_corner_point(s->mesh, 4 * (size_t)s->simplex[e] + k);
        for (int d = 0; d < 3; ++d)
            stretched[k][d] = stretch * p[d];
        corner[k] = stretched[k];
    }
    iccp_tet_create(&s->element[e], corner);
}

icc_status iccp_tet_newton_create(iccp_tet_newton *newton, const iccp_simplices *mesh,
                                  double *images, const uint8_t *movable, double stretch,
                                  const iccp_env *env)
{
    iccp_tet_newton *s = newton;
    *s = (iccp_tet_newton){.memory = env->memory, .mesh = mesh, .images = images};
    icc_status status = list_parts(s, movable);
    if (status == ICC_OK)
        status = allocate(s);
    if (status == ICC_OK)
        status = find_pattern(s);
    for (size_t e = 0; status == ICC_OK && e < s->n_elements; ++e)
        set_element(s, e, stretch);
    if (status != ICC_OK)
        iccp_tet_newton_free(s);
    return status;
}

void iccp_tet_newton_free(iccp_tet_newton *newton)
{
    iccp_tet_newton *s = newton;
    iccp_free(&s->memory, s->free_point);
    iccp_free(&s->memory, s->slot);
    iccp_free(&s->memory, s->simplex);
    iccp_free(&s->memory, s->element);
    iccp_free(&s->memory, s->neighbour);
    iccp_free(&s->memory, s->first);
    iccp_free(&s->memory, s->column);
    iccp_free(&s->memory, s->value);
    iccp_free(&s->memory, s->diagonal);
    iccp_free(&s->memory, s->gradient);
    iccp_free(&s->memory, s->step);
    iccp_free(&s->memory, s->saved);
    iccp_free(&s->memory, s->work);
    *s = (iccp_tet_newton){.memory = s->memory};
}

/* ---- energy ---- */

static void corner_images(const iccp_tet_newton *s, size_t e, const double *image[4])
{
    const uint32_t *v = s->mesh->corners + 4 * (size_t)s->simplex[e];
    for (int k = 0; k < 4; ++k)
        image[k] = s->images + 3 * (size_t)v[k];
}

double iccp_tet_newton_energy(const iccp_tet_newton *newton, double epsilon)
{
    double sum = 0;
    for (size_t e = 0; e < newton->n_elements && sum < HUGE_VAL; ++e) {
        const double *image[4];
        corner_images(newton, e, image);
        sum += iccp_tet_untangle_energy(&newton->element[e], image, epsilon);
    }
    return sum;
}

double iccp_tet_newton_least(const iccp_tet_newton *newton, size_t *n_bad)
{
    double least = HUGE_VAL;
    *n_bad = 0;
    for (size_t e = 0; e < newton->n_elements; ++e) {
        const double *image[4];
        double j[9];
        corner_images(newton, e, image);
        const double det = iccp_tet_jacobian(&newton->element[e], image, j);
        least = fmin(least, det);
        *n_bad += det <= 0;
    }
    return least;
}

/* ---- one step ---- */

/* Which of the two entries beside the diagonal, in row d of a block, is that of column c. */
static size_t beside(uint32_t d, uint32_t c)
{
    return c > d ? c - 1 : c;
}

static void add_element(iccp_tet_newton *s, size_t e, const iccp_tet_local *local)
{
    for (uint32_t a = 0; a < 4; ++a) {
        const uint32_t i = slot_of(s, s->simplex[e], a);
        for (uint32_t d = 0; d < 3 && i != NONE; ++d) {
            s->gradient[3 * i + d] += local->gradient[3 * a + d];
            s->diagonal[3 * i + d] += local->hessian[3 * a + d][3 * a + d];
            for (uint32_t c = 0; c < 3; ++c)
                if (c != d)
                    s->value[s->first[3 * i + d] + beside(d, c)] +=
                        local->hessian[3 * a + d][3 * a + c];
        }
    }
    for (int p = 0; p < 12; ++p) {
        const uint32_t k = s->neighbour[12 * e + (size_t)p];
        if (k == NONE)
            continue;
        const uint32_t a = PAIRS[p][0], b = PAIRS[p][1];
        const uint32_t i = slot_of(s, s->simplex[e], a);
        for (uint32_t d = 0; d < 3; ++d) {
            double *value = s->value + s->first[3 * i + d] + 2 + 3 * (size_t)k;
            for (uint32_t c = 0; c < 3; ++c)
                value[c] += local->hessian[3 * a + d][3 * b + c];
        }
    }
}

static void assemble(iccp_tet_newton *s, double epsilon)
{
    const size_t n = 3 * s->n_free;
    double sum = 0;
    memset(s->gradient, 0, n * sizeof *s->gradient);
    memset(s->diagonal, 0, n * sizeof *s->diagonal);
    memset(s->value, 0, s->first[n] * sizeof *s->value);
    for (size_t e = 0; e < s->n_elements; ++e) {
        const double *image[4];
        iccp_tet_local local;
        corner_images(s, e, image);
        iccp_tet_untangle_local(&s->element[e], image, epsilon, &local);
        add_element(s, e, &local);
    }
    for (size_t i = 0; i < n; ++i)
        sum += s->diagonal[i];
    for (size_t i = 0; i < n; ++i)
        s->diagonal[i] += SHIFT * sum / (double)n;
}

/* L D L^T of each point's block: the three pivots and the three entries of L. */
static void factorise_blocks(const iccp_tet_newton *s, double *factor)
{
    for (size_t i = 0; i < s->n_free; ++i, factor += 6) {
        const double *d = s->diagonal + 3 * i;
        const double *x = s->value + s->first[3 * i], *y = s->value + s->first[3 * i + 1];
        factor[0] = d[0];
        factor[3] = x[0] / d[0];
        factor[4] = x[1] / d[0];
        factor[1] = fmax(d[1] - factor[3] * x[0], SMALLEST_PIVOT * d[1]);
        const double rest = y[1] - factor[4] * x[0];
        factor[5] = rest / factor[1];
        factor[2] = fmax(d[2] - factor[4] * x[1] - factor[5] * rest, SMALLEST_PIVOT * d[2]);
    }
}

static void precondition(size_t n_blocks, const double *factor, const double *r, double *z)
{
    for (size_t i = 0; i < n_blocks; ++i, factor += 6, r += 3, z += 3) {
        const double y1 = r[1] - factor[3] * r[0];
        const double y2 = r[2] - factor[4] * r[0] - factor[5] * y1;
        z[2] = y2 / factor[2];
        z[1] = y1 / factor[1] - factor[5] * z[2];
        z[0] = r[0] / factor[0] - factor[3] * z[1] - factor[4] * z[2];
    }
}

static double product(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

static void apply_hessian(const iccp_tet_newton *s, const double *x, double *y)
{
    for (size_t i = 0; i < 3 * s->n_free; ++i) {
        double sum = s->diagonal[i] * x[i];
        for (size_t k = s->first[i]; k < s->first[i + 1]; ++k)
            sum += s->value[k] * x[s->column[k]];
        y[i] = sum;
    }
}

/* Every iterate from 0 on is a direction of descent. */
static icc_status solve(iccp_tet_newton *s, const iccp_env *env)
{
    const size_t n = 3 * s->n_free;
    double *r = s->work, *z = r + n, *p = z + n, *q = p + n, *factor = q + n;
    factorise_blocks(s, factor);
    for (size_t i = 0; i < n; ++i) {
        s->step[i] = 0;
        r[i] = -s->gradient[i];
    }
    precondition(s->n_free, factor, r, z);
    memcpy(p, z, n * sizeof *p);
    double rho = product(n, r, z);
    const double enough = RESIDUAL * RESIDUAL * rho;
    for (int k = 0; k < MAX_DIRECTIONS && rho > enough; ++k) {
        if (iccp_progress(env, "untangle", (double)k / MAX_DIRECTIONS) != ICC_OK)
            return ICC_ERR_CANCELLED;
        apply_hessian(s, p, q);
        const double curvature = product(n, p, q);
        if (!(curvature > 0))
            break;
        const double length = rho / curvature;
        for (size_t i = 0; i < n; ++i) {
            s->step[i] += length * p[i];
            r[i] -= length * q[i];
        }
        precondition(s->n_free, factor, r, z);
        const double next = product(n, r, z), share = next / rho;
        rho = next;
        for (size_t i = 0; i < n; ++i)
            p[i] = z[i] + share * p[i];
    }
    return ICC_OK;
}

icc_status iccp_tet_newton_solve(iccp_tet_newton *newton, double epsilon, double *slope,
                                 const iccp_env *env)
{
    assemble(newton, epsilon);
    const icc_status status = solve(newton, env);
    *slope = product(3 * newton->n_free, newton->gradient, newton->step);
    return status;
}

static void go(iccp_tet_newton *s, double length)
{
    for (size_t i = 0; i < s->n_free; ++i)
        for (size_t d = 0; d < 3; ++d)
            s->images[3 * (size_t)s->free_point[i] + d] =
                s->saved[3 * i + d] + length * s->step[3 * i + d];
}

double iccp_tet_newton_move(iccp_tet_newton *newton, double epsilon, double before, double slope)
{
    iccp_tet_newton *s = newton;
    double length = 1;
    for (size_t i = 0; i < s->n_free; ++i)
        memcpy(s->saved + 3 * i, s->images + 3 * (size_t)s->free_point[i], 3 * sizeof(double));
    for (int k = 0; k < MAX_HALVINGS; ++k, length *= 0.5) {
        go(s, length);
        const double after = iccp_tet_newton_energy(s, epsilon);
        if (after <= before + DECREASE * length * slope)
            return after;
    }
    go(s, 0);
    return before;
}
