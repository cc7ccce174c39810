/* Orders of elimination beside AMD of SuiteSparse, where that is installed: what the factor fills,
 * its multiplications, and seconds of ordering, analysis and factorisation, on systems of every
 * kind that the library solves. Usage: bench_ordering [CAGE.txt | SURFACE.obj] ..., for what the
 * default maps of these shapes factorise; surfaces take the program tetgen. The least of several
 * runs that take turns, in seconds of one thread. */
#include "cages.h"

#include "../meshes.h"
#include "domain/domain.h"
#include "math/gram.h"
#include "math/ldlt.h"
#include "math/ordering.h"
#include "mesh/planar.h"

#include <limits.h>
#include <stdbool.h>

#ifdef BENCH_WITH_AMD
#include <amd.h>
enum { N_ORDERS = 2 };
#else
enum { N_ORDERS = 1 };
#endif

enum { RUNS = 5, CELLS = 20 };

static iccp_env plain_env(void)
{
    iccp_env env;
    bench_check(iccp_env_read(&env, NULL, NULL), &(icc_error){.size = sizeof(icc_error)});
    return env;
}

/* ---- systems, as sets of unknowns that are all joined ---- */

typedef struct sets {
    iccp_sparse b; /* a row for each set */
    size_t row_room, entry_room;
} sets;

static void make_room(void **array, size_t n, size_t *room, size_t size)
{
    if (n < *room)
        return;
    *room = 2 * *room + 1024;
    *array = realloc(*array, *room * size);
    if (*array == NULL)
        exit(EXIT_FAILURE);
}

static void add_set(sets *s, size_t n, const uint32_t *unknown)
{
    iccp_sparse *b = &s->b;
    const size_t begin = b->n_rows > 0 ? b->first[b->n_rows] : 0;
    make_room((void **)&b->first, b->n_rows + 1, &s->row_room, sizeof *b->first);
    b->first[0] = 0;
    b->first[b->n_rows + 1] = begin;
    for (size_t k = 0; k < n; ++k) {
        size_t *end = &b->first[b->n_rows + 1];
        make_room((void **)&b->column, *end, &s->entry_room, sizeof *b->column);
        b->column[(*end)++] = unknown[k];
        if (unknown[k] >= b->n_columns)
            b->n_columns = (size_t)unknown[k] + 1;
    }
    ++b->n_rows;
}

/* Each unknown in place of one: the unknowns of one vertex. */
static sets in_blocks(const sets *s, size_t block)
{
    sets out = {0};
    uint32_t unknown[64];
    for (size_t i = 0; i < s->b.n_rows; ++i) {
        size_t n = 0;
        for (size_t p = s->b.first[i]; p < s->b.first[i + 1]; ++p)
            for (size_t d = 0; d < block; ++d)
                unknown[n++] = (uint32_t)(block * s->b.column[p] + d);
        add_set(&out, n, unknown);
    }
    return out;
}

static void free_sets(sets *s)
{
    free(s->b.first);
    free(s->b.column);
}

/* The matrix with a dominant diagonal whose pattern these sets have. */
static iccp_gram make_matrix(sets *s)
{
    const iccp_env env = plain_env();
    iccp_gram gram;
    s->b.value = bench_alloc(s->b.first[s->b.n_rows], sizeof *s->b.value);
    bench_check(iccp_gram_create(&gram, &s->b, &env), &(icc_error){.message = "matrix"});
    free(s->b.value);
    for (size_t i = 0; i < gram.matrix.n; ++i) {
        gram.diagonal[i] = (double)(gram.first[i + 1] - gram.first[i]) + 1;
        for (size_t p = gram.first[i]; p < gram.first[i + 1]; ++p)
            gram.value[p] = -1;
    }
    return gram;
}

/* ---- measuring ---- */

#ifdef BENCH_WITH_AMD
static void order_by_amd(const iccp_symmetric *m, uint32_t *order)
{
    const size_t n = m->n, n_entries = m->first[n], room = n_entries + n_entries / 5 + n + 1;
    int *pattern = bench_alloc(room, sizeof *pattern), *work = bench_alloc(9 * n + 1, sizeof *work);
    if (room > INT_MAX)
        exit(EXIT_FAILURE);
    for (size_t i = 0; i < n; ++i) {
        work[i] = (int)m->first[i];
        work[n + i] = (int)(m->first[i + 1] - m->first[i]);
    }
    for (size_t p = 0; p < n_entries; ++p)
        pattern[p] = (int)m->column[p];
    amd_2((int)n, work, pattern, work + n, (int)room, (int)n_entries, work + 2 * n, work + 3 * n,
          work + 4 * n, work + 5 * n, work + 6 * n, work + 7 * n, work + 8 * n, NULL, NULL);
    for (size_t k = 0; k < n; ++k)
        order[k] = (uint32_t)work[4 * n + k];
    free(pattern);
    free(work);
}
#endif

typedef struct measured {
    uint32_t *order;
    double n_entries, work, order_s, analyse_s, factor_s;
} measured;

static double least(double before, double after, double start)
{
    return fmin(before, after - start);
}

/* One turn of one order: `groups` are ordered, `full` has `block` rows for each of theirs. */
static void run(measured *m, int which, const iccp_symmetric *groups, const iccp_symmetric *full)
{
    const iccp_env env = plain_env();
    const icc_error error = {.message = "factor"};
    const size_t block = groups->n > 0 ? full->n / groups->n : 1;
    iccp_ldlt factor;
    const double t0 = bench_processor_seconds();
#ifdef BENCH_WITH_AMD
    if (which == 1)
        order_by_amd(groups, m->order);
#endif
    if (which == 0)
        bench_check(iccp_ordering(groups, m->order, &env), &error);
    const double t1 = bench_processor_seconds();
    for (size_t k = groups->n; k-- > 0;)
        for (size_t d = block; d-- > 0;)
            m->order[block * k + d] = (uint32_t)(block * m->order[k] + d);
    const double t2 = bench_processor_seconds();
    bench_check(iccp_ldlt_analyse_ordered(&factor, full, m->order, &env), &error);
    const double t3 = bench_processor_seconds();
    bench_check(iccp_ldlt_factorise(&factor, full, &env), &error);
    const double t4 = bench_processor_seconds();
    bench_check(iccp_ldlt_factorise(&factor, full, &env), &error); /* its memory is there now */
    const double t5 = bench_processor_seconds();
    m->n_entries = (double)factor.n_entries;
    m->work = factor.work;
    m->order_s = least(m->order_s, t1, t0);
    m->analyse_s = least(m->analyse_s, t3, t2);
    m->factor_s = fmin(least(m->factor_s, t4, t3), t5 - t4);
    iccp_ldlt_free(&factor);
}

static void print_row(const char *name, size_t n, const measured *m)
{
    static const char *const WHO[] = {"own", "amd"};
    for (int k = 0; k < N_ORDERS; ++k)
        printf("%-24s %7zu %s  entries %9.3g  work %9.3g  order %8.5f  analyse %8.5f  factor "
               "%8.5f\n",
               k == 0 ? name : "", n, WHO[k], m[k].n_entries, m[k].work, m[k].order_s,
               m[k].analyse_s, m[k].factor_s);
    if (N_ORDERS == 2) {
        const double sum[2] = {m[0].order_s + m[0].analyse_s + m[0].factor_s,
                               m[N_ORDERS - 1].order_s + m[N_ORDERS - 1].analyse_s +
                                   m[N_ORDERS - 1].factor_s};
        printf("%-24s own/amd      entries %9.3f  work %9.3f  order %8.3f  factor %8.3f  sum "
               "%8.3f\n",
               "", m[0].n_entries / m[N_ORDERS - 1].n_entries, m[0].work / m[N_ORDERS - 1].work,
               m[0].order_s / m[N_ORDERS - 1].order_s, m[0].factor_s / m[N_ORDERS - 1].factor_s,
               sum[0] / sum[1]);
    }
    fflush(stdout);
}

/* Frees the sets. */
static void measure(const char *name, sets *s, size_t block)
{
    sets blocks = in_blocks(s, block);
    iccp_gram groups = make_matrix(s), full = make_matrix(&blocks);
    measured m[2];
    for (int which = 0; which < 2; ++which)
        m[which] = (measured){.order = bench_alloc(full.matrix.n, sizeof(uint32_t)),
                              .order_s = HUGE_VAL,
                              .analyse_s = HUGE_VAL,
                              .factor_s = HUGE_VAL};
    for (int k = 0; k < RUNS; ++k)
        for (int which = 0; which < N_ORDERS; ++which)
            run(&m[which], which, &groups.matrix, &full.matrix);
    print_row(name, full.matrix.n, m);
    free(m[0].order);
    free(m[1].order);
    iccp_gram_free(&groups);
    iccp_gram_free(&full);
    free_sets(&blocks);
    free_sets(s);
}

/* ---- what there is to be solved ---- */

/* Sets of neighbours in a grid of size^dim: pairs, or each unknown with all its neighbours (normal
 * equations of the Laplacian). Walls across the grid leave gaps at alternate ends. */
static sets grid(size_t size, size_t dim, bool is_star, size_t n_walls)
{
    sets s = {0};
    size_t n = 1;
    for (size_t axis = 0; axis < dim; ++axis)
        n *= size;
    for (size_t i = 0; i < n; ++i) {
        uint32_t star[7] = {(uint32_t)i};
        size_t length = 1;
        for (size_t axis = 0, step = 1; axis < dim; ++axis, step *= size) {
            const size_t at = i / step % size, other = axis == 1 ? i % size : size / 2;
            const bool ends = at + 1 == size;
            const size_t wall = n_walls > 0 ? at / (size / n_walls) : 0;
            const bool is_wall = n_walls > 0 && axis == 1 && at % (size / n_walls) == 0 &&
                                 (wall % 2 == 0 ? other > 9 : other + 10 < size);
            if (at > 0 && is_star)
                star[length++] = (uint32_t)(i - step);
            if (!ends && is_star)
                star[length++] = (uint32_t)(i + step);
            if (!ends && !is_star && !is_wall)
                add_set(&s, 2, (uint32_t[]){(uint32_t)i, (uint32_t)(i + step)});
        }
        if (is_star)
            add_set(&s, length, star);
    }
    return s;
}

/* A grid's pairs, and equations that join three neighbours each to an unknown of their own. */
static sets constrained_grid(size_t size, size_t n_equations)
{
    sets s = grid(size, 2, false, 0);
    random_source r = {1};
    for (size_t k = 0; k < n_equations; ++k) {
        const uint32_t row = (uint32_t)(size * size + k);
        const uint32_t i = (uint32_t)random_below(&r, (int)(size * (size - 1) - 1));
        for (uint32_t j = 0; j < 3; ++j)
            add_set(&s, 2, (uint32_t[]){row, j < 2 ? i + j : i + (uint32_t)size});
    }
    return s;
}

/* Pairs of random points in a unit cube with about `near` others within reach. */
static sets scattered(size_t n, size_t dim, double near)
{
    static const double BALL[] = {1, 2, 3.141592653589793, 4.1887902047863905};
    const double reach = pow(near / ((double)n * BALL[dim]), 1 / (double)dim);
    random_source r = {2};
    double *x = bench_alloc(n, dim * sizeof *x);
    sets s = {0};
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < dim; ++k)
            x[dim * i + k] = random_unit(&r);
        add_set(&s, 1, (uint32_t[]){(uint32_t)i});
        for (size_t j = 0; j < i; ++j) {
            double square = 0;
            for (size_t k = 0; k < dim; ++k)
                square += (x[dim * i + k] - x[dim * j + k]) * (x[dim * i + k] - x[dim * j + k]);
            if (square < reach * reach)
                add_set(&s, 2, (uint32_t[]){(uint32_t)j, (uint32_t)i});
        }
    }
    free(x);
    return s;
}

static sets simplices(size_t n, size_t n_corners, const uint32_t *corner, uint32_t first_free)
{
    sets s = {0};
    for (size_t i = 0; i < n; ++i) {
        uint32_t unknown[4];
        size_t length = 0;
        for (size_t k = 0; k < n_corners; ++k)
            if (corner[n_corners * i + k] >= first_free)
                unknown[length++] = corner[n_corners * i + k] - first_free;
        if (length > 0)
            add_set(&s, length, unknown);
    }
    return s;
}

/* Of the mesh that a default map starts with: its Laplacian, and Newton's matrix. */
static void measure_cage(const char *path)
{
    const iccp_env env = plain_env();
    icc_error error = {.size = sizeof error};
    icc_domain *domain = cage_read(path);
    iccp_planar mesh;
    uint32_t *pieces = bench_alloc(cage_info(domain).n_facets, sizeof *pieces);
    char name[64];
    iccp_planar_pieces(pieces, domain, NULL, CELLS);
    bench_check(iccp_planar_create(&mesh, domain, pieces, CELLS, &env, &error), &error);
    for (size_t block = 1; block <= 2; ++block) {
        sets s = simplices(mesh.n_triangles, 3, mesh.triangles, (uint32_t)mesh.n_boundary);
        snprintf(name, sizeof name, "%.12s %s", cage_name(path),
                 block == 1 ? "harmonic" : "newton");
        measure(name, &s, block);
    }
    iccp_planar_free(&mesh);
    free(pieces);
    icc_domain_free(domain);
}

static void measure_surface(const char *path)
{
    obj o;
    test_mesh m;
    char name[64];
    if (!obj_read(&o, path) ||
        !mesh_tetgen(&m, o.n_vertices, o.vertices, o.n_faces, o.faces, "bench_ordering")) {
        fprintf(stderr, "cannot mesh %s\n", path);
        exit(EXIT_FAILURE);
    }
    sets s = simplices(m.n_simplices, 4, m.simplices, 0);
    snprintf(name, sizeof name, "%.12s stiffness", cage_name(path));
    measure(name, &s, 1);
    obj_free(&o);
    mesh_free(&m);
}

int main(int argc, char **argv)
{
    random_source r = {3};
    for (int a = 1; a < argc; ++a) {
        const size_t length = strlen(argv[a]);
        if (length > 4 && strcmp(argv[a] + length - 4, ".obj") == 0)
            measure_surface(argv[a]);
        else
            measure_cage(argv[a]);
    }
    sets square = grid(200, 2, false, 0), walls = grid(400, 2, false, 8),
         box = grid(24, 3, false, 0);
    sets normal = grid(200, 2, true, 0), tied = constrained_grid(150, 3000);
    sets flat = scattered(12000, 2, 20), full = scattered(4000, 2, 120),
         solid = scattered(8000, 3, 30);
    test_mesh ball = mesh_ball(3, 24, 0.2, &r);
    sets tets = simplices(ball.n_simplices, 4, ball.simplices, 0);
    measure("grid 200^2", &square, 1);
    measure("grid 400^2, walls", &walls, 1);
    measure("grid 24^3", &box, 1);
    measure("normal equations 200^2", &normal, 1);
    measure("grid 150^2, equations", &tied, 1);
    measure("kernel 2-D, 20 near", &flat, 1);
    measure("kernel 2-D, 120 near", &full, 1);
    measure("kernel 3-D, 30 near", &solid, 1);
    measure("tetrahedra in a ball", &tets, 1);
    mesh_free(&ball);
    return EXIT_SUCCESS;
}
