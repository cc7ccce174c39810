/* The unknowns, their pattern, and the line search; the step is made in map/tet_step.c. */
#include "map/tet_newton.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* Sufficient decrease (Armijo), and how often a step is halved. */
static const double DECREASE = 1e-4;
enum { MAX_HALVINGS = 40 };

/* ---- set-up ---- */

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
            is_free |= iccp_tet_slot(s, t, k) != NONE;
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
        for (uint32_t p = 0; p < 12; ++p) {
            uint32_t a, b;
            iccp_tet_pair(p, &a, &b);
            a = iccp_tet_slot(s, s->simplex[e], a);
            b = iccp_tet_slot(s, s->simplex[e], b);
            s->neighbour[12 * e + p] = NONE;
            if (a == NONE || b == NONE)
                continue;
            uint32_t *own = list + room[a], k = 0;
            while (k < degree[a] && own[k] != b)
                ++k;
            if (k == degree[a])
                own[degree[a]++] = b;
            s->neighbour[12 * e + p] = k;
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
                if (iccp_tet_slot(s, s->simplex[e], k) != NONE)
                    room[iccp_tet_slot(s, s->simplex[e], k) + 1] += 3;
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
    s->work = iccp_alloc(&s->memory, n, ICCP_TET_WORK * sizeof *s->work);
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

double iccp_tet_newton_energy(const iccp_tet_newton *newton, double epsilon)
{
    double sum = 0;
    for (size_t e = 0; e < newton->n_elements && sum < HUGE_VAL; ++e) {
        const double *image[4];
        iccp_tet_images(newton, e, image);
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
        iccp_tet_images(newton, e, image);
        const double det = iccp_tet_jacobian(&newton->element[e], image, j);
        least = fmin(least, det);
        *n_bad += det <= 0;
    }
    return least;
}

/* ---- line search ---- */

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
