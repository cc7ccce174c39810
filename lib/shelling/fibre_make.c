/* The simplices are stored in the order of the leaves of their tree of boxes: what is near in space
 * is near in memory, and a simplex is one or two cache lines. */
#include "shelling/fibre.h"

#include <math.h>
#include <string.h>

enum { CORNERS = ICCP_FIBRE_CORNERS, CACHE_LINE = 64 };

typedef struct maker {
    iccp_fibres *fibres;
    const iccp_simplices *mesh;
    const double *direction;
    double tolerance;
    uint32_t *side; /* of each side of the mesh: its number here */
} maker;

/* Numbers the simplices and sorts the corners of each. */
static void number(const maker *m)
{
    const iccp_simplices *mesh = m->mesh;
    const size_t n = mesh->dim + 1;
    const uint32_t *order = m->fibres->tree.order;
    for (uint32_t place = 0; place < mesh->n_simplices; ++place) {
        const uint32_t *given = mesh->corners + n * order[place];
        m->fibres->place[order[place]] = place;
        uint32_t *sorted = m->fibres->corners + n * place;
        for (uint32_t i = 0; i < n; ++i) {
            uint32_t rank = 0;
            for (size_t j = 0; j < n; ++j)
                rank += given[j] < given[i];
            sorted[rank] = given[i];
            m->side[n * order[place] + i] = (uint32_t)n * place + rank;
        }
    }
}

static double speed_of(const iccp_fibres *fibres, const uint32_t *corners, const double *rate)
{
    const size_t dim = fibres->dim;
    double sum = 0;
    for (size_t k = 0; k < dim; ++k) {
        const double origin = fibres->points[dim * corners[0] + k];
        double x = 0;
        for (size_t i = 1; i <= dim; ++i)
            x += rate[i] * (fibres->points[dim * corners[i] + k] - origin);
        sum += x * x;
    }
    return sqrt(sum);
}

/* Twice the tolerance over the least height, by the gradients of the barycentric coordinates. */
static double margin_of(const maker *m, uint32_t simplex)
{
    const size_t dim = m->fibres->dim;
    iccp_fibre_jet jet;
    double steepest = 0;
    iccp_fibres_gradient(m->fibres, simplex, &jet);
    for (size_t i = 0; i <= dim; ++i) {
        double sum = 0;
        for (size_t k = 0; k < dim; ++k)
            sum += jet.bary[i][k] * jet.bary[i][k];
        steepest = fmax(steepest, sum);
    }
    return 2 * m->tolerance * sqrt(steepest);
}

/* In the star no side is left. */
static void fill_record(const maker *m, uint32_t place)
{
    const size_t n = m->fibres->dim + 1;
    const uint32_t simplex = m->fibres->tree.order[place];
    const uint32_t *corners = m->fibres->corners + n * place;
    iccp_fibre_word *record = m->fibres->records + iccp_fibre_stride(n) * place;
    double rate[CORNERS];
    bool in_star = false;
    for (size_t i = 0; i < n; ++i)
        in_star = in_star || corners[i] == m->fibres->centre;
    for (size_t i = 0; i < n; ++i) {
        const size_t given = n * simplex + i, k = m->side[given] % n;
        const uint32_t across = m->mesh->across[given];
        rate[k] = in_star ? 1 : m->direction[given];
        record[n + 2 + k / 2].side[k % 2] =
            (across & ICCP_ON_BOUNDARY) != 0 ? across : m->side[across];
        if ((across & ICCP_ON_BOUNDARY) != 0)
            m->fibres->rim[across & ~ICCP_ON_BOUNDARY] = m->side[given];
    }
    for (size_t i = 0; i < n; ++i)
        record[i].number = rate[i];
    record[n].number = in_star ? 0 : speed_of(m->fibres, corners, rate);
    record[n + 1].number = margin_of(m, place);
}

static icc_status make(maker *m)
{
    iccp_fibres *fibres = m->fibres;
    const iccp_simplices *mesh = m->mesh;
    const size_t n = mesh->dim + 1, n_simplices = mesh->n_simplices;
    iccp_facet_tree_create_solid(&fibres->tree, mesh->dim, mesh->points, n_simplices, mesh->corners,
                                 &fibres->memory);
    fibres->corners = iccp_alloc(&fibres->memory, n_simplices, n * sizeof *fibres->corners);
    fibres->block = iccp_alloc(&fibres->memory, n_simplices + 1,
                               iccp_fibre_stride(n) * sizeof *fibres->records);
    fibres->rim = iccp_alloc(&fibres->memory, mesh->n_facets, sizeof *fibres->rim);
    fibres->place = iccp_alloc(&fibres->memory, n_simplices, sizeof *fibres->place);
    m->side = iccp_alloc(&fibres->memory, n_simplices, n * sizeof *m->side);
    if (fibres->tree.boxes == NULL || fibres->corners == NULL || fibres->block == NULL ||
        fibres->rim == NULL || fibres->place == NULL || m->side == NULL)
        return ICC_ERR_MEMORY;
    fibres->records = fibres->block;
    while ((uintptr_t)fibres->records % CACHE_LINE != 0 &&
           fibres->records < fibres->block + iccp_fibre_stride(n))
        ++fibres->records;
    number(m);
    for (uint32_t place = 0; place < n_simplices; ++place)
        fill_record(m, place);
    fibres->tree.facets = fibres->corners;
    for (uint32_t place = 0; place < n_simplices; ++place)
        fibres->tree.order[place] = place;
    return ICC_OK;
}

icc_status iccp_fibres_create(iccp_fibres *fibres, const iccp_simplices *mesh, uint32_t centre,
                              const double *direction, double tolerance, const iccp_env *env)
{
    *fibres = (iccp_fibres){.memory = env->memory,
                            .dim = mesh->dim,
                            .n_simplices = mesh->n_simplices,
                            .centre = centre,
                            .points = mesh->points};
    maker m = {.fibres = fibres, .mesh = mesh, .direction = direction, .tolerance = tolerance};
    const icc_status status = make(&m);
    iccp_free(&env->memory, m.side);
    if (status != ICC_OK)
        iccp_fibres_free(fibres);
    return status;
}

void iccp_fibres_direction(const iccp_fibres *fibres, const iccp_simplices *mesh, size_t simplex,
                           double *direction)
{
    const size_t n = fibres->dim + 1, place = fibres->place[simplex];
    const uint32_t *given = mesh->corners + n * simplex, *sorted = fibres->corners + n * place;
    const iccp_fibre_word *record = iccp_fibre_record(fibres, (uint32_t)place);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < n; ++k)
            if (sorted[k] == given[i])
                direction[i] = record[k].number;
}

void iccp_fibres_free(iccp_fibres *fibres)
{
    iccp_facet_tree_free(&fibres->tree, &fibres->memory);
    iccp_free(&fibres->memory, fibres->corners);
    iccp_free(&fibres->memory, fibres->block);
    iccp_free(&fibres->memory, fibres->rim);
    iccp_free(&fibres->memory, fibres->place);
    *fibres = (iccp_fibres){.memory = fibres->memory};
}
