/* Any mask of cells: it is refused with a text, or gives a boundary around as much as its cells, a
 * grid with every cell's middle inside, and an order that the verifier agrees with, if there is
 * one. Turned round it fares the same. */
#include "fuzz.h"
#include "icc/stages.h"

#include <math.h>

enum { MAX_CELLS = 256 };

typedef struct mask {
    int32_t dim;
    size_t shape[ICC_MAX_DIM], n, n_solid;
    uint8_t cells[MAX_CELLS];
} mask;

/* One byte for the dimension and the kind, one for each side; then one byte for each cell to be
 * taken out of a box, or one bit for each cell. */
static void read_mask(mask *m, const uint8_t *data, size_t size)
{
    static const size_t most[ICC_MAX_DIM] = {64, 256, 125,
                                             27, 4,   1}; /* a cell has 46,080 facets in 6-D */
    const unsigned choice = size > 0 ? data[0] : 0;
    size_t next = 1;
    m->dim = 1 + (int32_t)(choice / 2 % ICC_MAX_DIM);
    m->n = 1;
    m->n_solid = 0;
    for (int32_t k = 0; k < m->dim; ++k, ++next) {
        m->shape[k] = next < size ? 1 + data[next] % 16u : 2;
        if (m->shape[k] > most[m->dim - 1] / m->n)
            m->shape[k] = most[m->dim - 1] / m->n;
        m->n *= m->shape[k];
    }
    memset(m->cells, choice % 2, sizeof m->cells);
    for (size_t bit = 0; choice % 2 == 0 && bit < m->n && next + bit / 8 < size; ++bit)
        m->cells[bit] = data[next + bit / 8] >> bit % 8 & 1;
    for (; choice % 2 == 1 && next < size; ++next)
        m->cells[data[next] % m->n] = 0;
    for (size_t i = 0; i < m->n; ++i)
        m->n_solid += m->cells[i];
}

static icc_status make(icc_domain **out, const mask *m)
{
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_domain_create_mask(out, m->dim, m->shape, m->cells, NULL, &err);
    require((*out == NULL) == (status != ICC_OK));
    require(status == ICC_OK || status == ICC_ERR_TOPOLOGY);
    require(status == ICC_OK || (err.message[0] != '\0' && err.index < (int64_t)m->n));
    return status;
}

static void check_turned(const mask *m, icc_status expected)
{
    mask turned = *m;
    for (size_t i = 0; i < m->n; ++i)
        turned.cells[i] = m->cells[m->n - 1 - i];
    icc_domain *domain;
    require(make(&domain, &turned) == expected);
    icc_domain_free(domain);
}

static void check_order(const icc_grid *grid, size_t n_vertices)
{
    icc_tree *tree;
    uint32_t root, *rank = calloc(n_vertices, sizeof *rank);
    icc_grow_report report = {.size = sizeof report};
    icc_function_report found = {.size = sizeof found};
    require(rank != NULL);
    require(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL) == ICC_OK);
    require(icc_tree_create(&tree, grid, root, NULL, NULL, NULL) == ICC_OK);
    const icc_status status = icc_tree_grow(tree, NULL, rank, &report, NULL, NULL);
    require(status == ICC_OK || status == ICC_ERR_TOPOLOGY);
    require(icc_tree_get_rank_report(tree, rank, &found, NULL, NULL) == ICC_OK);
    require(status != ICC_OK || (found.critical == UINT32_MAX && found.n_maxima == 1));
    icc_tree_free(tree);
    free(rank);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    mask m;
    read_mask(&m, data, size);
    icc_domain *domain;
    const icc_status status = make(&domain, &m);
    if (m.dim < 5)
        check_turned(&m, status);
    if (status != ICC_OK)
        return 0;
    icc_domain_info shape = {.size = sizeof shape};
    icc_grid_info info = {.size = sizeof info};
    icc_grid *grid;
    require(icc_domain_get_info(domain, &shape) == ICC_OK);
    require(fabs(shape.measure - (double)m.n_solid) < 1e-9 * (double)m.n_solid);
    require(icc_grid_create(&grid, domain, 0, NULL, NULL) == ICC_OK);
    require(icc_grid_get_info(grid, &info) == ICC_OK);
    require(info.n_inside >= m.n_solid && info.n_stray == 0 && info.spacing == 0.5);
    check_order(grid, info.n_vertices);
    icc_grid_free(grid);
    icc_domain_free(domain);
    return 0;
}
