/* Masks: which are refused, against definitions tried out one by one; their boundaries, as
 * complexes of simplices; their grids; and real ones, where they are at hand. */
#include "domain/domain.h"
#include "geometry/octants.h"
#include "gradient/grid/lattice.h"

#include "../../faulty.h"
#include "../../npy.h"
#include "../../random.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_CELLS = 1 << 12 };

typedef struct mask {
    int32_t dim;
    size_t shape[ICC_MAX_DIM];
    uint8_t cells[MAX_CELLS];
} mask;

static size_t count(const mask *m)
{
    size_t n = 1;
    for (int32_t k = 0; k < m->dim; ++k)
        n *= m->shape[k];
    return n;
}

static icc_status make(icc_domain **out, const mask *m, icc_error *err)
{
    *out = (icc_domain *)&out;
    *err = (icc_error){.size = sizeof *err, .index = -2};
    const icc_status status = icc_domain_create_mask(out, m->dim, m->shape, m->cells, NULL, err);
    ck_assert((*out == NULL) == (status != ICC_OK));
    return status;
}

/* A cell by its coordinates, which may lie outside. */
static bool at(const mask *m, const int *x)
{
    size_t index = 0;
    for (int32_t k = m->dim; k-- > 0;) {
        if (x[k] < 0 || x[k] >= (int)m->shape[k])
            return false;
        index = index * m->shape[k] + (size_t)x[k];
    }
    return m->cells[index] != 0;
}

/* ----------------------------------------------------------------- octants */

/* Whether the corners of a cube in a set are joined by its edges. */
static bool joined(uint64_t set, int n)
{
    uint64_t reached = set & (~set + 1), before = 0;
    while (reached != before) {
        before = reached;
        for (int c = 0; c < 1 << n; ++c)
            for (int k = 0; k < n; ++k)
                if (reached >> c & 1)
                    reached |= set & (uint64_t)1 << (c ^ 1 << k);
    }
    return set != 0 && reached == set;
}

/* Of the faces of the cube with all corners in a set. */
static int euler(uint64_t set, int n)
{
    int sum = 0;
    for (int c = 0; c < 1 << n; ++c)
        for (int free = 0; free < 1 << n; ++free) {
            if ((c & free) != 0)
                continue;
            bool in = true;
            int dim = 0;
            for (int k = 0; k < n; ++k)
                dim += free >> k & 1;
            for (int s = 0; s < 1 << n; ++s)
                in = in && ((s & ~free) != 0 || (set >> (c | s) & 1));
            sum += in ? (dim % 2 == 0 ? 1 : -1) : 0;
        }
    return sum;
}

/* The orthants on one side of an axis, numbered without it. */
static uint64_t half(uint64_t set, int n, int axis, int side)
{
    uint64_t found = 0;
    for (int c = 0; c < 1 << (n - 1); ++c) {
        const int low = c & ((1 << axis) - 1), high = (c >> axis) << (axis + 1);
        found |= (set >> (low | high | side << axis) & 1) << c;
    }
    return found;
}

/* Whether the orthants form a ball. On a sphere of dimension up to 3 a manifold is one if it and
 * the rest are connected and the Euler characteristic is 1. */
static bool is_ball(uint64_t set, int n)
{
    const uint64_t all = ((uint64_t)1 << (1 << n)) - 1;
    if (set == 0 || set == all)
        return true;
    for (int axis = 0; n > 1 && axis < n; ++axis)
        if (!is_ball(half(set, n, axis, 0), n - 1) || !is_ball(half(set, n, axis, 1), n - 1))
            return false;
    return joined(set, n) && joined(all & ~set, n) && euler(set, n) == 1;
}

static bool found_to_be_a_ball(uint64_t set, int n)
{
    const uint64_t all = ((uint64_t)1 << (1 << n)) - 1;
    if (set == 0 || set == all)
        return true;
    for (int axis = 0; n > 1 && axis < n; ++axis)
        for (int side = 0; side < 2; ++side)
            if (!found_to_be_a_ball(half(set, n, axis, side), n - 1))
                return false;
    return iccp_octants_contractible(set, n);
}

START_TEST(all_sets_of_octants)
{
    for (int n = 1; n <= 4; ++n) {
        const uint64_t all = ((uint64_t)1 << (1 << n)) - 1;
        size_t n_balls = 0, n_wrong = 0;
        for (uint64_t set = 1; set < all; ++set) {
            const bool ball = is_ball(set, n);
            n_balls += ball;
            n_wrong += found_to_be_a_ball(set, n) != ball;
        }
        ck_assert_uint_eq(n_wrong, 0);
        ck_assert_uint_gt(n_balls, 0);
    }
}
END_TEST

/* Beyond, what is found to be contractible, or the rest, has the Euler characteristic of a ball. */
START_TEST(octants_beyond_4d)
{
    random_source r = {1};
    for (int n = 5; n <= 6; ++n) {
        size_t n_found = 0;
        for (int round = 0; round < share_of(300); ++round) {
            uint64_t set = (uint64_t)1 << random_below(&r, 1 << n); /* grown at random */
            for (int i = 0; i < round % 40; ++i) {
                const uint64_t more = set | (uint64_t)1 << random_below(&r, 1 << n);
                set = iccp_octants_contractible(more, n) ? more : set;
            }
            ck_assert(iccp_octants_contractible(set, n));
            const uint64_t all = n == 6 ? UINT64_MAX : UINT32_MAX;
            if (round % 10 == 0)
                ck_assert(euler(set, n) == 1 || euler(all & ~set, n) == 1);
            const uint64_t any = random_bits(&r) & all;
            if (!iccp_octants_contractible(any, n))
                continue;
            ++n_found;
            ck_assert(euler(any, n) == 1 || euler(all & ~any, n) == 1);
        }
        ck_assert(n == 6 || (n_found > (size_t)share_of(10) && n_found < (size_t)share_of(290)));
    }
}
END_TEST

/* ----------------------------------------------------------------- refusal */

/* Cells of a kind that are joined by faces; one layer around the mask counts as outside. */
static size_t count_pieces(const mask *m, bool kind)
{
    static uint8_t seen[8 * MAX_CELLS];
    static int stack[8 * MAX_CELLS];
    int size[3] = {1, 1, 1}, n_pieces = 0;
    for (int32_t k = 0; k < m->dim; ++k)
        size[k] = (int)m->shape[k] + 2;
    const int n = size[0] * size[1] * size[2], stride[3] = {1, size[0], size[0] * size[1]};
    memset(seen, 0, (size_t)n);
    for (int start = 0; start < n; ++start) {
        int n_stack = 0;
        stack[n_stack++] = start;
        bool first = true;
        while (n_stack > 0) {
            const int c = stack[--n_stack];
            const int x[3] = {c % size[0] - 1, c / size[0] % size[1] - 1, c / stride[2] - 1};
            if (seen[c] || at(m, x) != kind)
                continue;
            seen[c] = 1;
            n_pieces += first;
            first = false;
            for (int32_t k = 0; k < m->dim; ++k) {
                if (x[k] >= 0)
                    stack[n_stack++] = c - stride[k];
                if (x[k] + 2 < size[k])
                    stack[n_stack++] = c + stride[k];
            }
        }
    }
    return (size_t)n_pieces;
}

/* Contacts along an edge (two cells or gaps across a square of four) or at a corner (across a
 * cube). */
static bool is_well_composed(const mask *m)
{
    for (int axes = 3; axes < 1 << m->dim; ++axes) {
        if ((axes & (axes - 1)) == 0)
            continue;
        int x[3] = {-1, -1, -1};
        for (;;) {
            for (int diagonal = 0; diagonal < 1 << m->dim; ++diagonal) {
                if ((diagonal & ~axes) != 0)
                    continue;
                int n_same = 0, n_all = 0;
                int y[3], z[3];
                for (int k = 0; k < 3; ++k) {
                    y[k] = x[k] + (diagonal >> k & 1);
                    z[k] = x[k] + ((axes & ~diagonal) >> k & 1);
                }
                const bool kind = at(m, y);
                for (int c = 0; c < 1 << m->dim; ++c) {
                    if ((c & ~axes) != 0)
                        continue;
                    const int u[3] = {x[0] + (c & 1), x[1] + (c >> 1 & 1), x[2] + (c >> 2 & 1)};
                    n_same += at(m, u) == kind;
                    ++n_all;
                }
                if (at(m, z) == kind && n_same == 2 && n_all > 2)
                    return false;
            }
            int32_t k = 0;
            while (k < m->dim && ++x[k] >= (int)m->shape[k])
                x[k++] = -1;
            if (k >= m->dim)
                break;
        }
    }
    return true;
}

/* Corners less edges plus faces less cells of the closed solid. */
static int euler_of(const mask *m)
{
    int sum = 0, h[3] = {0, 0, 0};
    for (;;) {
        bool in = false;
        int parity = 0;
        for (int c = 0; c < 1 << m->dim; ++c) {
            int x[3] = {0, 0, 0};
            for (int32_t k = 0; k < m->dim; ++k)
                x[k] = h[k] % 2 != 0 ? h[k] / 2 : h[k] / 2 - (c >> k & 1);
            in = in || at(m, x);
        }
        for (int32_t k = 0; k < m->dim; ++k)
            parity ^= h[k] & 1;
        sum += in ? 1 - 2 * parity : 0;
        int32_t k = 0;
        while (k < m->dim && ++h[k] > 2 * (int)m->shape[k])
            h[k++] = 0;
        if (k >= m->dim)
            return sum;
    }
}

static bool is_solid(const mask *m)
{
    return count_pieces(m, true) == 1 && is_well_composed(m) && count_pieces(m, false) == 1 &&
           euler_of(m) == 1;
}

/* Returns whether the mask is taken, and checks that it should be; a cell that is named lies in
 * it. */
static bool try_mask(const mask *m)
{
    icc_domain *domain;
    icc_error err;
    const bool solid = is_solid(m);
    const icc_status status = make(&domain, m, &err);
    if (status != (solid ? ICC_OK : ICC_ERR_TOPOLOGY))
        ck_abort_msg("%d for a mask that is %s", (int)status, solid ? "solid" : "none");
    if (!solid && (err.index < -1 || err.index >= (int64_t)count(m) || err.message[0] == '\0'))
        ck_abort_msg("index %ld: %s", (long)err.index, err.message);
    icc_domain_free(domain);
    return solid;
}

static mask from_bits(int32_t dim, const size_t *shape, uint64_t bits)
{
    mask m = {.dim = dim};
    memcpy(m.shape, shape, (size_t)dim * sizeof *shape);
    for (size_t i = 0; i < count(&m); ++i)
        m.cells[i] = (uint8_t)(bits >> i & 1);
    return m;
}

START_TEST(all_small_masks)
{
    static const size_t shapes[4][3] = {{4, 3}, {2, 2, 2}, {3, 2, 2}, {3, 3, 2}};
    for (int i = 0; i < 4; ++i) {
        const int32_t dim = i == 0 ? 2 : 3;
        mask m = from_bits(dim, shapes[i], 0);
        const uint64_t n = (uint64_t)1 << count(&m);
        size_t n_solid = 0;
        for (uint64_t bits = 0; bits<n; bits += n> 10000 ? 61 : 1) {
            m = from_bits(dim, shapes[i], bits);
            n_solid += try_mask(&m);
        }
        ck_assert_uint_gt(n_solid, 20);
    }
}
END_TEST

/* Dense masks of several sizes, most of them wrong in one place or two. */
START_TEST(random_masks)
{
    random_source r = {2};
    size_t n_solid = 0;
    for (int round = 0; round < share_of(1500); ++round) {
        mask m = {.dim = 2 + round % 2, .shape = {4, 4, 4}};
        for (int32_t k = 0; k < m.dim; ++k)
            m.shape[k] = (size_t)(2 + random_below(&r, 4));
        for (size_t i = 0; i < count(&m); ++i)
            m.cells[i] = (uint8_t)(random_below(&r, 12) > 0 ? 1 + random_below(&r, 255) : 0);
        n_solid += try_mask(&m);
    }
    ck_assert_uint_gt(n_solid, (size_t)share_of(100));
    ck_assert_uint_lt(n_solid, (size_t)share_of(1400));
}
END_TEST

static void expect(const mask *m, const char *text, int64_t index)
{
    icc_domain *domain;
    icc_error err;
    ck_assert_int_eq(make(&domain, m, &err), ICC_ERR_TOPOLOGY);
    ck_assert_msg(strstr(err.message, text) != NULL, "%s", err.message);
    ck_assert_int_eq(err.index, index);
}

START_TEST(what_is_wrong_is_said)
{
    static const size_t four[3] = {4, 4, 4}, three[3] = {3, 3, 3};
    mask m = from_bits(2, four, 0);
    expect(&m, "empty", -1);
    m = from_bits(2, four, 0x8001);
    expect(&m,
           "not one piece: no way through cells with common faces leads from cell 0 (0, 0) to "
           "cell 15 (3, 3)",
           15);
    m = from_bits(2, three, 0x1ef);
    expect(&m, "encloses a hole: cell 4 (1, 1)", 4);
    m = from_bits(2, three, 0x16f); /* gaps at (1, 1) and (1, 2), and at (2, 2) */
    m.cells[4] = 0;
    m.cells[8] = 0;
    m.cells[7] = 1;
    expect(&m, "touches itself", 5);
    m = from_bits(3, three, 0x7ffffff);
    m.cells[13] = 0;
    expect(&m, "encloses a hole: cell 13 (1, 1, 1)", 13);
    m.cells[4] = m.cells[22] = 0;
    expect(&m, "Euler characteristic is 0", -1);
}
END_TEST

/* ---------------------------------------------------------------- boundary */

/* Random solids: cells are added to one as long as it stays a solid. */
static mask random_solid(random_source *r, int32_t dim, size_t side, int rounds)
{
    mask m = {.dim = dim};
    for (int32_t k = 0; k < dim; ++k)
        m.shape[k] = side;
    const size_t n = count(&m);
    m.cells[n / 2] = 1;
    for (int i = 0; i < rounds; ++i) {
        const size_t cell = (size_t)random_below(r, (int)n);
        if (m.cells[cell])
            continue;
        m.cells[cell] = 1;
        icc_domain *domain;
        icc_error err;
        if (make(&domain, &m, &err) != ICC_OK)
            m.cells[cell] = 0;
        icc_domain_free(domain);
    }
    return m;
}

static size_t count_solid(const mask *m)
{
    size_t n = 0;
    for (size_t i = 0; i < count(m); ++i)
        n += m->cells[i] != 0;
    return n;
}

/* A face of a facet: its vertices in order, and the sign that the facet gives it. */
typedef struct ridge {
    uint32_t vertex[ICC_MAX_DIM];
    int sign;
} ridge;

static int compare_ridges(const void *a, const void *b)
{
    return memcmp(((const ridge *)a)->vertex, ((const ridge *)b)->vertex,
                  sizeof(uint32_t[ICC_MAX_DIM]));
}

static ridge ridge_of(const uint32_t *facet, int dim, int left_out)
{
    ridge r = {.sign = left_out % 2 == 0 ? 1 : -1};
    int n = 0;
    for (int i = 0; i < dim; ++i)
        if (i != left_out)
            r.vertex[n++] = facet[i];
    for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j)
            if (r.vertex[j] < r.vertex[i]) {
                const uint32_t moved = r.vertex[i];
                r.vertex[i] = r.vertex[j];
                r.vertex[j] = moved;
                r.sign = -r.sign;
            }
    return r;
}

/* Each face of a facet belongs to two, from opposite sides. */
static void check_closed(int dim, size_t n_facets, const uint32_t *facets)
{
    const size_t n = n_facets * (size_t)dim;
    ridge *ridges = calloc(n, sizeof *ridges);
    for (size_t i = 0; i < n; ++i)
        ridges[i] = ridge_of(facets + i / (size_t)dim * (size_t)dim, dim, (int)(i % (size_t)dim));
    qsort(ridges, n, sizeof *ridges, compare_ridges);
    size_t n_wrong = n % 2;
    for (size_t i = 0; i + 1 < n; i += 2)
        n_wrong += compare_ridges(&ridges[i], &ridges[i + 1]) != 0 ||
                   ridges[i].sign + ridges[i + 1].sign != 0 ||
                   (i + 2 < n && compare_ridges(&ridges[i], &ridges[i + 2]) == 0);
    ck_assert_uint_eq(n_wrong, 0);
    free(ridges);
}

static double determinant(int n, double a[ICC_MAX_DIM][ICC_MAX_DIM])
{
    double product = 1;
    for (int c = 0; c < n; ++c) {
        int p = c;
        for (int i = c; i < n; ++i)
            p = fabs(a[i][c]) > fabs(a[p][c]) ? i : p;
        if (fabs(a[p][c]) < 1e-9)
            return 0;
        for (int j = 0; j < n && p != c; ++j) {
            const double moved = a[p][j];
            a[p][j] = a[c][j];
            a[c][j] = -moved;
        }
        product *= a[c][c];
        for (int i = c + 1; i < n; ++i)
            for (int j = n; j-- > c;)
                a[i][j] -= a[i][c] / a[c][c] * a[c][j];
    }
    return product;
}

/* Sum of the cones from the origin to outward facets. */
static double measure(int dim, size_t n_facets, const uint32_t *facets, const double *vertices)
{
    double sum = 0, factorial = 1;
    for (int k = 2; k <= dim; ++k)
        factorial *= k;
    for (size_t f = 0; f < n_facets; ++f) {
        double a[ICC_MAX_DIM][ICC_MAX_DIM];
        for (int i = 0; i < dim; ++i)
            memcpy(a[i], vertices + (size_t)dim * facets[f * (size_t)dim + (size_t)i],
                   (size_t)dim * sizeof(double));
        sum += determinant(dim, a);
    }
    return sum / factorial;
}

START_TEST(boundaries_are_closed_and_outward)
{
    random_source r = {3};
    static const size_t sides[5] = {6, 6, 4, 3, 2};
    for (int dim = 1; dim <= 5; ++dim)
        for (int round = 0; round < (dim < 4 ? 10 : 2); ++round) {
            const mask m = random_solid(&r, dim, sides[dim - 1], dim < 4 ? 60 : 25);
            icc_domain *domain;
            icc_error err;
            ck_assert_int_eq(make(&domain, &m, &err), ICC_OK);
            icc_domain_info info = {.size = sizeof info};
            ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
            ck_assert_double_eq_tol(info.measure, (double)count_solid(&m), 1e-9);
            double *vertices = calloc(info.n_vertices * (size_t)dim, sizeof *vertices);
            uint32_t *facets = calloc(info.n_facets * (size_t)dim, sizeof *facets);
            ck_assert_int_eq(icc_domain_get_boundary(domain, vertices, facets), ICC_OK);
            size_t n_odd = 0;
            for (size_t i = 0; i < info.n_vertices * (size_t)dim; ++i)
                n_odd += fmod(2 * vertices[i], 1) > 0 || vertices[i] < 0;
            ck_assert_uint_eq(n_odd, 0);
            if (dim > 1) {
                check_closed(dim, info.n_facets, facets);
                ck_assert_double_eq_tol(measure(dim, info.n_facets, facets, vertices),
                                        (double)count_solid(&m), 1e-6);
            }
            free(vertices);
            free(facets);
            icc_domain_free(domain);
        }
}
END_TEST

/* ------------------------------------------------------------------- grids */

static void check_grid(const mask *m, int32_t cells, size_t cuts)
{
    icc_domain *domain;
    icc_error err;
    icc_grid *grid;
    ck_assert_int_eq(make(&domain, m, &err), ICC_OK);
    ck_assert_int_eq(icc_grid_create(&grid, domain, cells, NULL, NULL), ICC_OK);
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
    ck_assert(info.spacing == 1.0 / (double)cuts);
    size_t n_wrong = 0, n_inside = 0, n_located = 0;
    for (uint32_t v = 0; v < info.n_vertices; ++v) {
        bool in = true;
        double p[ICC_MAX_DIM];
        for (int around = 0; around < 1 << m->dim; ++around) {
            int x[ICC_MAX_DIM];
            for (int32_t k = 0; k < m->dim; ++k) {
                const int i = (int)iccp_grid_coordinate(grid, v, k) - 2, c = (int)cuts;
                const bool wall = (i + 4 * c) % c == 0;
                x[k] = (i + 4 * c) / c - 4 - (wall && (around >> k & 1) ? 1 : 0);
                p[k] = (double)i / (double)cuts;
            }
            in = in && at(m, x);
        }
        n_wrong += in != grid->inside[v];
        n_inside += in;
        if ((cuts & (cuts - 1)) == 0 && v % 3 == 0) { /* positions are exact */
            int32_t where;
            ck_assert_int_eq(icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL), ICC_OK);
            n_wrong += (where == ICC_INSIDE) != in;
            ++n_located;
        }
    }
    ck_assert_uint_eq(n_wrong, 0);
    ck_assert_uint_eq(info.n_inside, n_inside);
    ck_assert_uint_eq(info.n_stray, 0);
    ck_assert((n_located > 0) == ((cuts & (cuts - 1)) == 0));
    icc_grid_free(grid);
    icc_domain_free(domain);
}

START_TEST(grids_of_masks)
{
    random_source r = {4};
    for (int32_t dim = 1; dim <= 4; ++dim) {
        const size_t side = dim > 3 ? 3 : 5;
        const mask m = random_solid(&r, dim, side, 40);
        const int32_t longest = (int32_t)side;
        check_grid(&m, 0, 2);
        check_grid(&m, 2 * longest, 2);
        check_grid(&m, 2 * longest + 1, 4);
        if (dim < 4)
            check_grid(&m, 5 * longest, 6);
    }
}
END_TEST

/* A domain with the same facets is another way to the same inside. */
START_TEST(moved_boundaries_correspond)
{
    random_source r = {5};
    const mask m = random_solid(&r, 3, 4, 60);
    icc_domain *domain, *moved;
    icc_error err;
    ck_assert_int_eq(make(&domain, &m, &err), ICC_OK);
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    double *vertices = calloc(info.n_vertices * 3, sizeof *vertices);
    uint32_t *facets = calloc(info.n_facets * 3, sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(domain, vertices, facets), ICC_OK);
    for (size_t i = 0; i < info.n_vertices; ++i)
        vertices[3 * i] += 0.125 * vertices[3 * i + 1];
    ck_assert_int_eq(
        icc_domain_create(&moved, 3, info.n_vertices, vertices, info.n_facets, facets, NULL, &err),
        ICC_OK);
    ck_assert_int_eq(icc_domain_get_info(moved, &info), ICC_OK);
    ck_assert_double_eq_tol(info.measure, (double)count_solid(&m), 1e-9);
    free(vertices);
    free(facets);
    icc_domain_free(moved);
    icc_domain_free(domain);
}
END_TEST

/* Grows on the grid of a mask from its maximum or another vertex; whether there is an order. */
static bool grow(const mask *m, int32_t cells, random_source *r, icc_grow_report *report)
{
    icc_domain *domain;
    icc_error err;
    icc_grid *grid;
    icc_tree *tree;
    uint32_t root;
    ck_assert_int_eq(make(&domain, m, &err), ICC_OK);
    ck_assert_int_eq(icc_grid_create(&grid, domain, cells, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
    while (r != NULL &&
           (root = (uint32_t)random_below(r, (int)grid->n_vertices), !grid->inside[root]))
        continue;
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    uint32_t *rank = calloc(grid->n_vertices, sizeof *rank);
    *report = (icc_grow_report){.size = sizeof *report};
    const icc_status status = icc_tree_grow(tree, NULL, rank, report, NULL, &err);
    ck_assert_uint_eq(report->n_vertices, grid->n_inside);
    ck_assert(status == ICC_OK || status == ICC_ERR_TOPOLOGY);
    icc_function_report found = {.size = sizeof found};
    ck_assert_int_eq(icc_tree_get_rank_report(tree, rank, &found, NULL, NULL), ICC_OK);
    ck_assert(status != ICC_OK || (found.critical == UINT32_MAX && found.n_maxima == 1));
    free(rank);
    icc_tree_free(tree);
    icc_grid_free(grid);
    icc_domain_free(domain);
    return status == ICC_OK;
}

START_TEST(orders_in_random_solids)
{
    static const struct {
        int32_t dim;
        size_t side;
        int rounds, n_shapes;
    } kinds[3] = {{2, 12, 120, 10}, {3, 9, 500, 3}, {4, 3, 120, 5}};
    random_source r = {7};
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < kinds[k].n_shapes; ++i) {
            const mask m = random_solid(&r, kinds[k].dim, kinds[k].side, kinds[k].rounds);
            for (int j = 0; j < 4; ++j) {
                icc_grow_report report;
                const int32_t cells = j == 2 ? 4 * (int32_t)kinds[k].side : 0;
                ck_assert(grow(&m, cells, j > 0 ? &r : NULL, &report));
                ck_assert(kinds[k].dim > 2 || report.method == ICC_GROW_AS_GIVEN);
            }
        }
}
END_TEST

/* Bing's house with two rooms, walls one cell thick: a ball, as any that can be filled with clay
 * through its two shafts. On the coarsest grid its inside is the house with thin walls, which
 * cannot be taken down; on a finer one it can. */
START_TEST(a_house_needs_a_finer_grid)
{
    mask m = {.dim = 3, .shape = {11, 11, 5}};
    for (int i = 0; i < 11 * 11 * 5; ++i) {
        const int x = i % 11, y = i / 11 % 11, z = i / 121;
        const int shaft = z < 2 ? 3 : 7, wing = z < 2 ? 1 : 9;
        const bool hole = (z <= 2 && x == 3 && y == 5) || (z >= 2 && x == 7 && y == 5);
        const bool shell = x % 10 == 0 || y % 10 == 0 || z % 2 == 0;
        const bool in_room = (abs(x - shaft) <= 1 && abs(y - 5) <= 1) || (x == wing && y == 5);
        m.cells[i] = !hole && (shell || in_room);
    }
    ck_assert_uint_eq(count_solid(&m), 457);
    icc_grow_report report;
    ck_assert(!grow(&m, 0, NULL, &report));
    ck_assert_uint_gt(report.n_remaining, 0);
    ck_assert(grow(&m, 44, NULL, &report));
    ck_assert_int_eq(report.method, ICC_GROW_THINNED);
}
END_TEST

/* --------------------------------------------------------------- real ones */

static icc_status make_file(const char *folder, const char *name, bool mended, icc_error *err)
{
    char path[512];
    npy a;
    (void)snprintf(path, sizeof path, "%s/%s/%s.npy", TEST_SHARED_DATA, folder, name);
    if (!npy_read(&a, path)) {
        free(a.cells);
        return -1;
    }
    icc_domain *domain;
    *err = (icc_error){.size = sizeof *err};
    if (mended)
        ck_assert_int_eq(icc_mask_repair(a.dim, a.shape, a.cells, NULL, NULL, NULL), ICC_OK);
    const icc_status status = icc_domain_create_mask(&domain, a.dim, a.shape, a.cells, NULL, err);
    if (status == ICC_OK) {
        icc_grid *grid;
        icc_tree *tree;
        uint32_t root;
        ck_assert_int_eq(icc_grid_create(&grid, domain, 0, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
        uint32_t *rank = calloc(grid->n_vertices, sizeof *rank);
        icc_function_report found = {.size = sizeof found};
        ck_assert_int_eq(icc_tree_grow(tree, NULL, rank, NULL, NULL, err), ICC_OK);
        ck_assert_int_eq(icc_tree_get_rank_report(tree, rank, &found, NULL, NULL), ICC_OK);
        ck_assert_uint_eq(found.critical, UINT32_MAX);
        ck_assert_uint_eq(found.n_maxima, 1);
        free(rank);
        icc_tree_free(tree);
        icc_grid_free(grid);
    }
    icc_domain_free(domain);
    free(a.cells);
    return status;
}

static bool has_contacts(const mask *m)
{
    return !is_well_composed(m);
}

/* Balls of cells with some taken away at random: no contact is left, nothing is emptied, and what
 * has none stays as it is. */
START_TEST(contacts_are_filled)
{
    random_source r = {8};
    size_t n_mended = 0, n_left = 0;
    for (int round = 0; round < share_of(400); ++round) {
        mask m = {.dim = 2 + round % 2, .shape = {6, 5, 4}};
        for (size_t i = 0; i < count(&m); ++i)
            m.cells[i] = random_below(&r, 10) < 3 + round % 6 ? 7 : 0;
        const bool had = has_contacts(&m);
        mask mended = m;
        size_t n_filled = 99, n_emptied = 0, n_more = 0;
        ck_assert_int_eq(icc_mask_repair(m.dim, m.shape, mended.cells, &n_filled, NULL, NULL),
                         ICC_OK);
        for (size_t i = 0; i < count(&m); ++i) {
            n_emptied += m.cells[i] != 0 && mended.cells[i] != m.cells[i];
            n_more += m.cells[i] == 0 && mended.cells[i] != 0;
        }
        ck_assert_uint_eq(n_emptied, 0);
        ck_assert_uint_eq(n_more, n_filled);
        ck_assert(had || n_filled == 0);
        n_mended += had && !has_contacts(&mended);
        n_left += has_contacts(&mended);
    }
    ck_assert_uint_gt(n_mended, (size_t)share_of(300));
    ck_assert_uint_lt(n_left, 10);
    ck_assert_int_eq(icc_mask_repair(2, NULL, NULL, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
}
END_TEST

static icc_status repair(const icc_env *env, icc_error *err, void *argument)
{
    mask m = *(const mask *)argument;
    const icc_status status = icc_mask_repair(m.dim, m.shape, m.cells, NULL, env, err);
    ck_assert((memcmp(m.cells, ((const mask *)argument)->cells, count(&m)) == 0) ==
              (status != ICC_OK));
    return status;
}

/* Skipped where the files are not there. */
START_TEST(masks_from_files)
{
    static const struct {
        const char *folder, *name;
        icc_status status;
    } files[] = {
        {"masks", "n1_horse_2d", ICC_OK},
        {"masks", "n2_char2_2d", ICC_OK},
        {"masks", "n3_fox_3d", ICC_ERR_TOPOLOGY}, /* 6 pairs of cells touch only along an edge */
        {"masks", "n4_spot_3d", ICC_OK},
        {"masks", "n5_fox_4d", ICC_ERR_TOPOLOGY}, /* 8 pairs only along a square */
        {"bad/masks", "m01_all_zero", ICC_ERR_TOPOLOGY},
        {"bad/masks", "m02_all_one_ok", ICC_OK},
        {"bad/masks", "m03_two_components", ICC_ERR_TOPOLOGY},
        {"bad/masks", "m04_hole_2d", ICC_ERR_TOPOLOGY},
        {"bad/masks", "m05_checkerboard", ICC_ERR_TOPOLOGY},
        {"bad/masks", "m06_one_cell", ICC_OK},
        {"bad/masks", "m07_diagonal_touch", ICC_ERR_TOPOLOGY},
        {"bad/masks", "m08_torus_3d", ICC_ERR_TOPOLOGY},
        {"bad/masks", "m09_void_3d", ICC_ERR_TOPOLOGY},
        {"bad/masks", "m10_1d_ok", ICC_OK},
        {"bad/masks", "m13_zero_dim", ICC_ERR_ARGUMENT},
        {"bad/masks", "m14_one_cell_wide_ok", ICC_OK},
        {"bad/masks", "m15_diamond_ok", ICC_OK},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        icc_error err;
        const icc_status status = make_file(files[i].folder, files[i].name, false, &err);
        ck_assert_msg(status == files[i].status || status == -1, "%s: %d, %s", files[i].name,
                      (int)status, err.message);
        if (files[i].folder[0] == 'm') { /* real ones are solids but for such contacts */
            const icc_status mended = make_file(files[i].folder, files[i].name, true, &err);
            ck_assert_msg(mended == ICC_OK || mended == -1, "%s: %s", files[i].name, err.message);
        }
    }
}
END_TEST

/* --------------------------------------------------------- failing, wrong */

static icc_status make_and_grid(const icc_env *env, icc_error *err, void *argument)
{
    const mask *m = argument;
    icc_domain *domain = (icc_domain *)&domain;
    icc_grid *grid = NULL;
    icc_status status = icc_domain_create_mask(&domain, m->dim, m->shape, m->cells, env, err);
    ck_assert((domain == NULL) == (status != ICC_OK));
    if (status == ICC_OK)
        status = icc_grid_create(&grid, domain, 0, env, err);
    icc_grid_free(grid);
    icc_domain_free(domain);
    return status;
}

START_TEST(every_failure_is_reported)
{
    random_source r = {6};
    for (int32_t dim = 1; dim <= 4; ++dim) {
        mask m = random_solid(&r, dim, 3, 10);
        faulty_sweep(make_and_grid, &m);
    }
    mask diagonal = from_bits(2, (size_t[]){2, 2}, 0x9);
    faulty_sweep(repair, &diagonal);
}
END_TEST

START_TEST(wrong_arguments)
{
    const uint8_t cells[4] = {1, 1, 1, 1};
    const size_t shape[ICC_MAX_DIM] = {2, 2, 0, 1, 1, 1};
    icc_domain *domain = (icc_domain *)&domain;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create_mask(NULL, 2, shape, cells, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_mask(&domain, 2, NULL, cells, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(domain);
    ck_assert_int_eq(icc_domain_create_mask(&domain, 2, shape, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_mask(&domain, 0, shape, cells, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_mask(&domain, 7, shape, cells, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_mask(&domain, 3, shape, cells, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(err.index, 2);
    static const size_t large[3][2] = {{SIZE_MAX, 2}, {1 << 14, 1 << 14}, {1 << 28, 1}};
    for (int i = 0; i < 3; ++i)
        ck_assert_int_eq(icc_domain_create_mask(&domain, 2, large[i], cells, NULL, NULL),
                         ICC_ERR_RESOLUTION);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("mask");
    TCase *tests = tcase_create("mask");
    tcase_add_test(tests, all_sets_of_octants);
    tcase_add_test(tests, octants_beyond_4d);
    tcase_add_test(tests, all_small_masks);
    tcase_add_test(tests, random_masks);
    tcase_add_test(tests, what_is_wrong_is_said);
    tcase_add_test(tests, boundaries_are_closed_and_outward);
    tcase_add_test(tests, grids_of_masks);
    tcase_add_test(tests, moved_boundaries_correspond);
    tcase_add_test(tests, orders_in_random_solids);
    tcase_add_test(tests, a_house_needs_a_finer_grid);
    tcase_add_test(tests, contacts_are_filled);
    tcase_add_test(tests, masks_from_files);
    tcase_add_test(tests, every_failure_is_reported);
    tcase_add_test(tests, wrong_arguments);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
