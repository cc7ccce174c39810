/* Compares two regions by linear algebra modulo a prime.
 *
 * Of the loops of the surface, half as many as there are bound in a region. They are those along
 * which all of its classes have sum 0. A map between the regions that is given on the surface
 * exists only if the same loops bound in both, so only if both have the same classes on the
 * surface: the matrices of periods span the same columns. (Then all cup products of one region's
 * classes with the other's vanish on the surface.) */
#include "map/topology/witness.h"

#include "base/random.h"

#include <string.h>

/* Room for matrices with a row for each loop, and which rows to use. */
typedef struct workspace {
    const iccp_region_pair *pair;
    uint64_t *matrix; /* n_loops * (classes of both regions and 1) */
    uint32_t *pivots; /* n_loops */
    uint8_t *chosen;  /* by component */
} workspace;

static void end(workspace *w)
{
    iccp_free(&w->pair->memory, w->matrix);
    iccp_free(&w->pair->memory, w->pivots);
    iccp_free(&w->pair->memory, w->chosen);
}

static icc_status begin(workspace *w, const iccp_region_pair *pair)
{
    const iccp_memory *memory = &pair->memory;
    const size_t n = iccp_surface_n_loops(&pair->surface);
    w->pair = pair;
    w->matrix =
        iccp_alloc(memory, n * (pair->classes[0].n + pair->classes[1].n + 1), sizeof *w->matrix);
    w->pivots = iccp_alloc(memory, n, sizeof *w->pivots);
    w->chosen = iccp_alloc_zero(memory, pair->surface.n_components, sizeof *w->chosen);
    return w->matrix != NULL && w->pivots != NULL && w->chosen != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* ---- which components ---- */

/* Writes the periods of side k on the loops of chosen components, from this column on. Returns the
 * number of rows. */
static size_t write_periods(workspace *w, int k, size_t n_columns, size_t column)
{
    const iccp_region_surface *s = &w->pair->surface;
    const size_t n = w->pair->classes[k].n;
    size_t n_rows = 0;
    for (size_t c = 0; c < s->n_components; ++c)
        for (size_t l = s->loop_first[c]; w->chosen[c] && l < s->loop_first[c + 1]; ++l)
            memcpy(w->matrix + n_columns * n_rows++ + column, w->pair->periods[k] + n * l,
                   n * sizeof *w->matrix);
    return n_rows;
}

/* Returns true if a combination of loops of chosen components bounds in region `inside`, but not in
 * the other one. */
static bool differs(workspace *w, int inside)
{
    const size_t n = w->pair->classes[inside].n, n_other = w->pair->classes[!inside].n;
    (void)write_periods(w, inside, n + n_other, 0);
    const size_t n_rows = write_periods(w, !inside, n + n_other, n);
    const size_t rank = iccp_residue_reduce(w->matrix, n_rows, n + n_other, w->pivots);
    return rank > 0 && w->pivots[rank - 1] >= n;
}

static void choose_first(workspace *w, uint8_t *kept, size_t n)
{
    for (size_t c = 0; c < w->pair->surface.n_components; ++c)
        w->chosen[c] = kept[c] || c < n;
}

/* Chooses a smallest set of components that differ, one by one: the last component of the shortest
 * list that differs together with those chosen so far. (U. Junker, QuickXplain, 2004.) Returns the
 * size of the set. */
static size_t choose_components(workspace *w, uint8_t *kept, int inside)
{
    size_t n = w->pair->surface.n_components, n_kept = 0;
    memset(kept, 0, n);
    for (;; ++n_kept) {
        size_t low = 0; /* the shortest list has a length from low to n */
        while (low < n) {
            const size_t middle = low + (n - low) / 2;
            choose_first(w, kept, middle);
            if (differs(w, inside))
                n = middle;
            else
                low = middle + 1;
        }
        if (n == 0)
            return n_kept;
        kept[--n] = 1;
    }
}

/* Chooses the direction that needs fewer components. */
static icc_status choose(iccp_witness *witness, workspace *w)
{
    const size_t n = w->pair->surface.n_components;
    uint8_t *kept = iccp_alloc(&witness->memory, 2 * n, sizeof *kept);
    witness->partners = iccp_alloc(&witness->memory, n, sizeof *witness->partners);
    if (kept == NULL || witness->partners == NULL) {
        iccp_free(&witness->memory, kept);
        return ICC_ERR_MEMORY;
    }
    const size_t n_before = choose_components(w, kept, 0);
    witness->inside = choose_components(w, kept + n, 1) < n_before;
    const uint8_t *chosen = witness->inside ? kept + n : kept;
    witness->component = UINT32_MAX;
    for (uint32_t c = 0; c < n; ++c) {
        w->chosen[c] = chosen[c] && witness->component != UINT32_MAX;
        if (w->chosen[c])
            witness->partners[witness->n_partners++] = c;
        else if (chosen[c])
            witness->component = c;
    }
    iccp_free(&witness->memory, kept);
    return ICC_OK;
}

/* ---- classes ---- */

static uint64_t random_residue(uint64_t *state)
{
    return iccp_random(state) % ICCP_PRIME;
}

/* Adds factor * row to a sum. */
static void add_row(uint64_t *sum, const uint64_t *row, uint64_t factor, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        sum[i] = iccp_residue_add(sum[i], iccp_residue_multiply(factor, row[i]));
}

static uint64_t product(const uint64_t *a, const uint64_t *b, size_t n)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum = iccp_residue_add(sum, iccp_residue_multiply(a[i], b[i]));
    return sum;
}

/* Finds all classes that are 0 on the partners' loops, and a random one of them. */
static icc_status find_zeros(iccp_witness *witness, workspace *w, uint64_t *zero, uint64_t *random)
{
    const size_t n = w->pair->classes[witness->inside].n;
    const size_t n_rows = write_periods(w, witness->inside, n, 0);
    const size_t rank = iccp_residue_reduce(w->matrix, n_rows, n, w->pivots);
    witness->n_zeros = n - rank;
    witness->zeros = iccp_alloc(&witness->memory, (n - rank) * n, sizeof *witness->zeros);
    if (witness->zeros == NULL)
        return ICC_ERR_MEMORY;
    iccp_residue_null_space(witness->zeros, w->matrix, rank, n, w->pivots);
    memset(zero, 0, n * sizeof *zero);
    for (size_t i = 0; i < witness->n_zeros; ++i)
        add_row(zero, witness->zeros + n * i, random_residue(random), n);
    return ICC_OK;
}

/* Draws a class of the other region. Finds one of region `inside` that equals it on the loops of
 * partners; there is one because the partners alone do not differ. */
static void find_equal(const iccp_witness *witness, workspace *w, uint64_t *equal, uint64_t *drawn,
                       uint64_t *random)
{
    const iccp_region_surface *s = &w->pair->surface;
    const int other = !witness->inside;
    const size_t n = w->pair->classes[witness->inside].n, n_other = w->pair->classes[other].n;
    const size_t n_rows = write_periods(w, witness->inside, n + 1, 0);
    size_t row = 0;
    for (size_t c = 0; c < n_other; ++c)
        drawn[c] = random_residue(random);
    for (size_t c = 0; c < s->n_components; ++c)
        for (size_t l = s->loop_first[c]; w->chosen[c] && l < s->loop_first[c + 1]; ++l)
            w->matrix[(n + 1) * row++ + n] =
                product(w->pair->periods[other] + n_other * l, drawn, n_other);
    const size_t rank = iccp_residue_reduce(w->matrix, n_rows, n + 1, w->pivots);
    memset(equal, 0, n * sizeof *equal);
    for (size_t r = 0; r < rank; ++r)
        if (w->pivots[r] < n)
            equal[w->pivots[r]] = w->matrix[(n + 1) * r + n];
}

/* ---- a combination of loops ---- */

/* Lists the loops in the shortest combination of a basis along which the classes differ. Row i of
 * the matrix is the sum of class i of `zeros` along the component's loops. */
static void list_starts(iccp_witness *witness, const uint64_t *basis, size_t n_basis,
                        const uint64_t *difference, size_t first, size_t n_loops)
{
    const uint64_t *best = NULL;
    for (size_t b = 0; b < n_basis; ++b, basis += n_loops) {
        size_t n = 0;
        if (product(basis, difference, n_loops) == 0)
            continue;
        for (size_t l = 0; l < n_loops; ++l)
            n += basis[l] != 0;
        if (best == NULL || n < witness->n_starts) {
            best = basis;
            witness->n_starts = n;
        }
    }
    for (size_t l = 0, n = 0; best != NULL && l < n_loops; ++l)
        if (best[l] != 0)
            witness->starts[n++] = (uint32_t)(first + l);
}

/* Finds a combination of the component's loops that bounds. `equal` and `drawn` are as in
 * find_equal(). */
static icc_status find_starts(iccp_witness *witness, const iccp_region_pair *pair,
                              const uint64_t *equal, const uint64_t *drawn)
{
    const iccp_memory *memory = &witness->memory;
    const uint32_t *loop_first = pair->surface.loop_first + witness->component;
    const size_t first = loop_first[0], n_loops = loop_first[1] - first, n_zeros = witness->n_zeros;
    const int in = witness->inside;
    const size_t n = pair->classes[in].n, n_other = pair->classes[!in].n;
    uint64_t *matrix = iccp_alloc(memory, n_zeros * n_loops, sizeof *matrix);
    uint64_t *basis = iccp_alloc(memory, n_loops * n_loops, sizeof *basis);
    uint64_t *difference = iccp_alloc(memory, n_loops, sizeof *difference);
    uint32_t *pivots = iccp_alloc(memory, n_zeros, sizeof *pivots);
    witness->starts = iccp_alloc(memory, n_loops, sizeof *witness->starts);
    const bool has_memory = matrix != NULL && basis != NULL && difference != NULL &&
                            pivots != NULL && witness->starts != NULL;
    for (size_t l = 0; has_memory && l < n_loops; ++l) {
        const uint64_t *periods = pair->periods[in] + n * (first + l);
        const uint64_t *periods_other = pair->periods[!in] + n_other * (first + l);
        difference[l] = iccp_residue_subtract(product(periods, equal, n),
                                              product(periods_other, drawn, n_other));
        for (size_t i = 0; i < n_zeros; ++i)
            matrix[n_loops * i + l] = product(witness->zeros + n * i, periods, n);
    }
    if (has_memory) {
        const size_t rank = iccp_residue_reduce(matrix, n_zeros, n_loops, pivots);
        iccp_residue_null_space(basis, matrix, rank, n_loops, pivots);
        list_starts(witness, basis, n_loops - rank, difference, first, n_loops);
    }
    iccp_free(memory, matrix);
    iccp_free(memory, basis);
    iccp_free(memory, difference);
    iccp_free(memory, pivots);
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}

/* ---- all of it ---- */

/* Finds the classes by which a loop of the component is recognised. */
static icc_status find_classes(iccp_witness *witness, workspace *w, iccp_region_pair *pair)
{
    const iccp_memory *memory = &witness->memory;
    const int in = witness->inside;
    const size_t n = pair->classes[in].n, n_edges = pair->surface.n_edges;
    uint64_t random = 0;
    uint64_t *own = iccp_alloc(memory, 2 * n, sizeof *own);
    uint64_t *drawn = iccp_alloc(memory, pair->classes[!in].n, sizeof *drawn);
    uint64_t *values = iccp_alloc(memory, n_edges, sizeof *values);
    witness->zero = iccp_alloc(memory, n_edges, sizeof *witness->zero);
    witness->other = iccp_alloc(memory, n_edges, sizeof *witness->other);
    icc_status status = ICC_ERR_MEMORY;
    if (own != NULL && drawn != NULL && values != NULL && witness->zero != NULL &&
        witness->other != NULL)
        status = find_zeros(witness, w, own, &random);
    if (status == ICC_OK) {
        find_equal(witness, w, own + n, drawn, &random);
        iccp_region_pair_class(pair, in, own, witness->zero);
        iccp_region_pair_class(pair, in, own + n, witness->other);
        iccp_region_pair_class(pair, !in, drawn, values);
        for (size_t e = 0; e < n_edges; ++e)
            witness->other[e] = iccp_residue_subtract(witness->other[e], values[e]);
        status = find_starts(witness, pair, own + n, drawn);
    }
    iccp_free(memory, own);
    iccp_free(memory, drawn);
    iccp_free(memory, values);
    return status;
}

icc_status iccp_witness_find(iccp_witness *witness, iccp_region_pair *pair)
{
    workspace w = {0};
    *witness = (iccp_witness){.memory = pair->memory};
    if (iccp_surface_n_loops(&pair->surface) == 0)
        return ICC_OK;
    icc_status status = begin(&w, pair);
    if (status == ICC_OK) {
        memset(w.chosen, 1, pair->surface.n_components);
        witness->exists = differs(&w, 0) || differs(&w, 1);
    }
    if (status == ICC_OK && witness->exists)
        status = choose(witness, &w);
    if (status == ICC_OK && witness->exists)
        status = find_classes(witness, &w, pair);
    end(&w);
    if (status != ICC_OK)
        iccp_witness_free(witness);
    return status;
}

void iccp_witness_free(iccp_witness *witness)
{
    const iccp_memory memory = witness->memory;
    iccp_free(&memory, witness->partners);
    iccp_free(&memory, witness->zero);
    iccp_free(&memory, witness->other);
    iccp_free(&memory, witness->zeros);
    iccp_free(&memory, witness->starts);
    *witness = (iccp_witness){.memory = memory};
}

/* Sums a class along a closed loop on the surface. */
static uint64_t sum_along(const iccp_region_surface *s, const uint64_t *value, size_t n,
                          const uint32_t *loop)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t v = loop[i], w = loop[(i + 1) % n];
        size_t k = s->edge_first[v];
        while (s->ends[2 * (size_t)s->at_vertex[k]] != w &&
               s->ends[2 * (size_t)s->at_vertex[k] + 1] != w)
            ++k;
        sum = iccp_residue_add(sum, iccp_class_along(value, s->ends, s->at_vertex[k], v));
    }
    return sum;
}

icc_status iccp_witness_confirm(const iccp_witness *witness, iccp_region_pair *pair, size_t n,
                                const uint32_t *loop, bool *confirmed)
{
    const size_t n_classes = pair->classes[witness->inside].n;
    uint64_t *values = iccp_alloc(&pair->memory, pair->surface.n_edges, sizeof *values);
    if (values == NULL)
        return ICC_ERR_MEMORY;
    *confirmed = sum_along(&pair->surface, witness->other, n, loop) != 0;
    for (size_t i = 0; i < witness->n_zeros && *confirmed; ++i) {
        iccp_region_pair_class(pair, witness->inside, witness->zeros + n_classes * i, values);
        *confirmed = sum_along(&pair->surface, values, n, loop) == 0;
    }
    iccp_free(&pair->memory, values);
    return ICC_OK;
}
