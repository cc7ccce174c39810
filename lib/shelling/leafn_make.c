/* Makes the records that leafn.h describes. Simplices are stored in the order of the leaves of
 * their tree of boxes. So simplices near in space are near in memory, and each takes one or two
 * cache lines. */
#include "shelling/leafn.h"

#include "base/minmax.h"

#include <math.h>
#include <string.h>

enum { CORNERS = ICCP_LEAFN_CORNERS, CACHE_LINE = 64 };

typedef struct maker {
    iccp_leaves *leaves;
    const iccp_simplices *mesh;
    const double *direction;
    double tolerance;
    uint32_t *side; /* of each side of the mesh: its number here */
} maker;

/* Numbers the simplices in the order of the tree's leaves and sorts the corners of each. Notes
 * in `side` the new number of every side of the mesh. */
static void number_simplices(const maker *m)
{
    const iccp_simplices *mesh = m->mesh;
    const size_t n = mesh->dim + 1;
    const uint32_t *order = m->leaves->tree.order;
    for (uint32_t place = 0; place < mesh->n_simplices; ++place) {
        const uint32_t *given = mesh->corners + n * order[place];
        m->leaves->place[order[place]] = place;
        uint32_t *sorted = m->leaves->corners + n * place;
        for (uint32_t i = 0; i < n; ++i) {
            uint32_t rank = 0;
            for (size_t j = 0; j < n; ++j)
                rank += given[j] < given[i];
            sorted[rank] = given[i];
            m->side[n * order[place] + i] = (uint32_t)n * place + rank;
        }
    }
}

/* The speed of a point whose barycentric coordinates change at the given rates. */
static double speed_of(const iccp_leaves *leaves, const uint32_t *corners, const double *rate)
{
    const size_t dim = leaves->dim;
    double sum = 0;
    for (size_t k = 0; k < dim; ++k) {
        const double origin = leaves->points[dim * corners[0] + k];
        double x = 0;
        for (size_t i = 1; i <= dim; ++i)
            x += rate[i] * (leaves->points[dim * corners[i] + k] - origin);
        sum += x * x;
    }
    return sqrt(sum);
}

/* Twice the tolerance over the least height, from the gradients of the barycentric coordinates. */
static double margin_of(const maker *m, uint32_t simplex)
{
    const size_t dim = m->leaves->dim;
    iccp_leafn_jet jet;
    double steepest = 0;
    iccp_leafn_gradient(m->leaves, simplex, &jet);
    for (size_t i = 0; i <= dim; ++i) {
        double sum = 0;
        for (size_t k = 0; k < dim; ++k)
            sum += jet.bary[i][k] * jet.bary[i][k];
        steepest = iccp_max(steepest, sum);
    }
    return 2 * m->tolerance * sqrt(steepest);
}

/* Fills in everything that a step of a leaf reads of its simplex. In the star all rates are 1.
 * So a rising leaf cannot leave by any side and ends there. */
static void fill_record(const maker *m, uint32_t place)
{
    const size_t n = m->leaves->dim + 1;
    const uint32_t simplex = m->leaves->tree.order[place];
    const uint32_t *corners = m->leaves->corners + n * place;
    iccp_leafn_word *record = m->leaves->records + iccp_leafn_stride(n) * place;
    double rate[CORNERS];
    bool in_star = false;
    for (size_t i = 0; i < n; ++i)
        in_star = in_star || corners[i] == m->leaves->centre;
    for (size_t i = 0; i < n; ++i) {
        const size_t given = n * simplex + i, k = m->side[given] % n;
        const uint32_t across = m->mesh->across[given];
        rate[k] = in_star ? 1 : m->direction[given];
        record[n + 2 + k / 2].side[k % 2] =
            (across & ICCP_ON_BOUNDARY) != 0 ? across : m->side[across];
        if ((across & ICCP_ON_BOUNDARY) != 0)
            m->leaves->boundary_side[across & ~ICCP_ON_BOUNDARY] = m->side[given];
    }
    for (size_t i = 0; i < n; ++i)
        record[i].number = rate[i];
    record[n].number = in_star ? 0 : speed_of(m->leaves, corners, rate);
    record[n + 1].number = margin_of(m, place);
}

/* Builds the tree first, because the order of its leaves determines all numbers. At the end the
 * tree gets the new numbers, so that queries return them. Records start at a cache line. */
static icc_status build(maker *m)
{
    iccp_leaves *leaves = m->leaves;
    const iccp_simplices *mesh = m->mesh;
    const size_t n = mesh->dim + 1, n_simplices = mesh->n_simplices;
    iccp_facet_tree_create_solid(&leaves->tree, mesh->dim, mesh->points, n_simplices, mesh->corners,
                                 &leaves->memory);
    leaves->corners = iccp_alloc(&leaves->memory, n_simplices, n * sizeof *leaves->corners);
    leaves->block = iccp_alloc(&leaves->memory, n_simplices + 1,
                               iccp_leafn_stride(n) * sizeof *leaves->records);
    leaves->boundary_side =
        iccp_alloc(&leaves->memory, mesh->n_facets, sizeof *leaves->boundary_side);
    leaves->place = iccp_alloc(&leaves->memory, n_simplices, sizeof *leaves->place);
    m->side = iccp_alloc(&leaves->memory, n_simplices, n * sizeof *m->side);
    if (leaves->tree.boxes == NULL || leaves->corners == NULL || leaves->block == NULL ||
        leaves->boundary_side == NULL || leaves->place == NULL || m->side == NULL)
        return ICC_ERR_MEMORY;
    leaves->records = leaves->block;
    while ((uintptr_t)leaves->records % CACHE_LINE != 0 &&
           leaves->records < leaves->block + iccp_leafn_stride(n))
        ++leaves->records;
    number_simplices(m);
    for (uint32_t place = 0; place < n_simplices; ++place)
        fill_record(m, place);
    leaves->tree.facets = leaves->corners;
    for (uint32_t place = 0; place < n_simplices; ++place)
        leaves->tree.order[place] = place;
    return ICC_OK;
}

icc_status iccp_leafn_create(iccp_leaves *leaves, const iccp_simplices *mesh, uint32_t centre,
                             const double *direction, double tolerance, const iccp_env *env)
{
    *leaves = (iccp_leaves){.memory = env->memory,
                            .dim = mesh->dim,
                            .n_simplices = mesh->n_simplices,
                            .centre = centre,
                            .points = mesh->points};
    maker m = {.leaves = leaves, .mesh = mesh, .direction = direction, .tolerance = tolerance};
    const icc_status status = build(&m);
    iccp_free(&env->memory, m.side);
    if (status != ICC_OK)
        iccp_leafn_free(leaves);
    return status;
}

void iccp_leafn_direction(const iccp_leaves *leaves, const iccp_simplices *mesh, size_t simplex,
                          double *direction)
{
    const size_t n = leaves->dim + 1, place = leaves->place[simplex];
    const uint32_t *given = mesh->corners + n * simplex, *sorted = leaves->corners + n * place;
    const iccp_leafn_word *record = iccp_leafn_record(leaves, (uint32_t)place);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < n; ++k)
            if (sorted[k] == given[i])
                direction[i] = record[k].number;
}

void iccp_leafn_free(iccp_leaves *leaves)
{
    iccp_facet_tree_free(&leaves->tree, &leaves->memory);
    iccp_free(&leaves->memory, leaves->corners);
    iccp_free(&leaves->memory, leaves->block);
    iccp_free(&leaves->memory, leaves->boundary_side);
    iccp_free(&leaves->memory, leaves->place);
    *leaves = (iccp_leaves){.memory = leaves->memory};
}
