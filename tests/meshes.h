/* Conforming meshes for tests: cut cubes and balls of any dimension, polygons, and what tetgen
 * makes of a surface, where that program is installed. */
#ifndef TESTS_MESHES_H
#define TESTS_MESHES_H

#include "flat_mesh.h"
#include "obj.h"
#include "random.h"

#include <icc/stages.h>
#include <math.h>
#include <string.h>

typedef struct test_mesh {
    int32_t dim;
    size_t n_vertices, n_simplices, n_facets;
    double *vertices;
    uint32_t *simplices;
    uint32_t *facets; /* NULL when the order of the library will do */
} test_mesh;

static inline void *mesh_alloc(size_t n, size_t size)
{
    void *memory = malloc(n * size + 1);
    if (memory == NULL)
        abort();
    return memory;
}

static inline test_mesh mesh_of(int32_t dim, size_t n_vertices, size_t n_simplices)
{
    test_mesh m = {.dim = dim, .n_vertices = n_vertices, .n_simplices = n_simplices};
    m.vertices = mesh_alloc(n_vertices * (size_t)dim, sizeof *m.vertices);
    m.simplices = mesh_alloc(n_simplices * (size_t)(dim + 1), sizeof *m.simplices);
    return m;
}

static inline void mesh_free(test_mesh *m)
{
    free(m->vertices);
    free(m->simplices);
    free(m->facets);
    *m = (test_mesh){0};
}

static inline test_mesh mesh_copy(const test_mesh *m)
{
    const size_t dim = (size_t)m->dim;
    test_mesh copy = mesh_of(m->dim, m->n_vertices, m->n_simplices);
    memcpy(copy.vertices, m->vertices, m->n_vertices * dim * sizeof *m->vertices);
    memcpy(copy.simplices, m->simplices, m->n_simplices * (dim + 1) * sizeof *m->simplices);
    copy.n_facets = m->n_facets;
    if (m->facets != NULL) {
        copy.facets = mesh_alloc(m->n_facets * dim, sizeof *m->facets);
        memcpy(copy.facets, m->facets, m->n_facets * dim * sizeof *m->facets);
    }
    return copy;
}

/* The same mesh with every vertex elsewhere. */
static inline test_mesh mesh_moved(const test_mesh *m,
                                   void (*move)(int32_t dim, const double *x, double *y))
{
    test_mesh moved = mesh_copy(m);
    for (size_t v = 0; v < m->n_vertices; ++v)
        move(m->dim, m->vertices + (size_t)m->dim * v, moved.vertices + (size_t)m->dim * v);
    return moved;
}

static inline icc_status mesh_domain(icc_domain **out, const test_mesh *m, const icc_env *env,
                                     icc_error *err)
{
    return flat_create_mesh(out, m->dim, m->n_vertices, m->vertices, m->n_simplices, m->simplices,
                            m->n_facets, m->facets, env, err);
}

/* ---- cubes ---- */

static inline size_t mesh_power(size_t base, int32_t exponent)
{
    size_t power = 1;
    for (int32_t k = 0; k < exponent; ++k)
        power *= base;
    return power;
}

/* The digits of a number, the lowest first. */
static inline void mesh_digits(size_t number, size_t base, int32_t n, size_t *digits)
{
    for (int32_t k = 0; k < n; ++k, number /= base)
        digits[k] = number % base;
}

/* Permutation number `which` of dim! of 0..dim-1 (D. H. Lehmer's code). */
static inline void mesh_permutation(size_t which, int32_t dim, int32_t *order)
{
    for (int32_t k = 0; k < dim; ++k)
        order[k] = k;
    for (int32_t k = 0; k < dim; ++k) {
        const int32_t left = dim - k, j = k + (int32_t)(which % (size_t)left);
        which /= (size_t)left;
        const int32_t swap = order[k];
        order[k] = order[j];
        order[j] = swap;
    }
}

/* Kuhn's simplices in the cells of [0, n]^dim for which keep() holds; NULL: all. All (n + 1)^dim
 * lattice points are vertices, the first axis fastest, whether or not a simplex has them. */
static inline test_mesh mesh_cells(int32_t dim, size_t n,
                                   int (*keep)(int32_t dim, const size_t *cell))
{
    const size_t n_cells = mesh_power(n, dim);
    size_t n_cuts = 1, digits[ICC_MAX_DIM];
    for (int32_t k = 2; k <= dim; ++k)
        n_cuts *= (size_t)k;
    test_mesh m = mesh_of(dim, mesh_power(n + 1, dim), n_cuts * n_cells);
    for (size_t v = 0; v < m.n_vertices; ++v) {
        mesh_digits(v, n + 1, dim, digits);
        for (int32_t k = 0; k < dim; ++k)
            m.vertices[(size_t)dim * v + (size_t)k] = (double)digits[k];
    }
    m.n_simplices = 0;
    for (size_t cell = 0; cell < n_cells; ++cell) {
        mesh_digits(cell, n, dim, digits);
        for (size_t cut = 0; cut < n_cuts && (keep == NULL || keep(dim, digits)); ++cut) {
            uint32_t *to = m.simplices + (size_t)(dim + 1) * m.n_simplices++;
            int32_t order[ICC_MAX_DIM];
            size_t at = 0;
            mesh_permutation(cut, dim, order);
            for (int32_t k = dim; k-- > 0;)
                at = at * (n + 1) + digits[k];
            for (int32_t k = 0; k < dim; ++k) {
                to[k] = (uint32_t)at;
                at += mesh_power(n + 1, order[k]);
            }
            to[dim] = (uint32_t)at;
        }
    }
    return m;
}

/* Moves the vertices inside [0, n]^dim by up to `amount` along each axis; 0.1 keeps all simplices
 * positive. */
static inline void mesh_shake(test_mesh *m, size_t n, double amount, random_source *r)
{
    const size_t dim = (size_t)m->dim;
    for (size_t v = 0; v < m->n_vertices; ++v) {
        double *x = m->vertices + dim * v;
        int is_inner = 1;
        for (size_t k = 0; k < dim; ++k)
            is_inner &= x[k] > 0 && x[k] < (double)n;
        for (size_t k = 0; k < dim && is_inner; ++k)
            x[k] += random_between(r, -amount, amount);
    }
}

static inline test_mesh mesh_cube(int32_t dim, size_t n, double amount, random_source *r)
{
    test_mesh m = mesh_cells(dim, n, NULL);
    mesh_shake(&m, n, amount, r);
    return m;
}

/* The same blown up towards a ball round the origin with radius 1. */
static inline test_mesh mesh_ball(int32_t dim, size_t n, double amount, random_source *r)
{
    test_mesh m = mesh_cube(dim, n, amount, r);
    for (size_t v = 0; v < m.n_vertices; ++v) {
        double *x = m.vertices + (size_t)dim * v, largest = 0, sum = 0;
        for (int32_t k = 0; k < dim; ++k) {
            x[k] = 2 * x[k] / (double)n - 1;
            largest = fmax(largest, fabs(x[k]));
            sum += x[k] * x[k];
        }
        for (int32_t k = 0; k < dim && sum > 0; ++k)
            x[k] *= 0.4 + 0.6 * largest / sqrt(sum);
    }
    return m;
}

/* A move of points in space that is not affine. */
static inline void mesh_bend(int32_t dim, const double *x, double *y)
{
    (void)dim;
    y[0] = x[0] + 0.3 * sin(x[1]);
    y[1] = x[1] + 0.25 * x[2] * x[0] / 3;
    y[2] = 1.5 * x[2] - 0.2 * x[0] * x[1] / 3;
}

/* ---- polygons ---- */

/* A counter-clockwise polygon with the points of a lattice of the given width that lie inside, away
 * from the boundary. */
static inline test_mesh mesh_polygon(size_t n, const double *xy, double width)
{
    icc_domain *domain;
    icc_domain_info info = {.size = sizeof info};
    if (icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, NULL) != ICC_OK)
        abort();
    (void)icc_domain_get_info(domain, &info);
    const size_t columns = (size_t)((info.upper[0] - info.lower[0]) / width) + 1;
    const size_t rows = (size_t)((info.upper[1] - info.lower[1]) / width) + 1;
    test_mesh m = mesh_of(2, n + rows * columns, 2 * (n + rows * columns));
    memcpy(m.vertices, xy, 2 * n * sizeof *xy);
    m.n_vertices = n;
    for (size_t i = 0; i < rows * columns; ++i) {
        double *p = m.vertices + 2 * m.n_vertices, bary[2], near[2];
        int32_t where;
        uint32_t f;
        p[0] = info.lower[0] + ((double)(i % columns) + 0.5) * width;
        p[1] = info.lower[1] + ((double)(i / columns) + 0.5) * width;
        (void)icc_domain_locate(domain, 1, p, &where, &f, bary, NULL);
        for (int k = 0; k < 2; ++k)
            near[k] = bary[0] * xy[2 * f + (size_t)k] + bary[1] * xy[2 * ((f + 1) % n) + (size_t)k];
        m.n_vertices += where == ICC_INSIDE && hypot(p[0] - near[0], p[1] - near[1]) > 0.3 * width;
    }
    icc_domain_free(domain);
    m.n_simplices = 2 * m.n_vertices - n - 2;
    if (icc_triangulate(n, m.n_vertices, m.vertices, m.simplices, NULL, NULL) != ICC_OK)
        abort();
    return m;
}

/* ---- tetgen ---- */

static inline int mesh_has_tetgen(void)
{
    return system("command -v tetgen >/dev/null 2>&1") == 0;
}

static inline void mesh_write_surface(const char *path, size_t n_vertices, const double *vertices,
                                      size_t n_faces, const uint32_t *faces)
{
    FILE *file = fopen(path, "w");
    if (file == NULL)
        abort();
    (void)fprintf(file, "%zu 3 0 0\n", n_vertices);
    for (size_t v = 0; v < n_vertices; ++v)
        (void)fprintf(file, "%zu %.17g %.17g %.17g\n", v, vertices[3 * v], vertices[3 * v + 1],
                      vertices[3 * v + 2]);
    (void)fprintf(file, "%zu 0\n", n_faces);
    for (size_t f = 0; f < n_faces; ++f)
        (void)fprintf(file, "3 %lu %lu %lu\n", (unsigned long)faces[3 * f],
                      (unsigned long)faces[3 * f + 1], (unsigned long)faces[3 * f + 2]);
    (void)fprintf(file, "0\n0\n");
    if (fclose(file) != 0)
        abort();
}

/* Reads PATH.1.node and PATH.1.ele, numbered from 0. Numbers are read as text by strtod, so points
 * that tetgen was given in 17 digits come back as they were. */
static inline int mesh_read_tetgen(test_mesh *m, const char *path)
{
    char name[256];
    size_t n_vertices = 0, n_simplices = 0;
    (void)snprintf(name, sizeof name, "%s.1.node", path);
    FILE *nodes = fopen(name, "r");
    (void)snprintf(name, sizeof name, "%s.1.ele", path);
    FILE *cells = fopen(name, "r");
    int good = nodes != NULL && cells != NULL && fscanf(nodes, "%zu %*[^\n]", &n_vertices) == 1 &&
               fscanf(cells, "%zu %*[^\n]", &n_simplices) == 1;
    *m = mesh_of(3, n_vertices, n_simplices);
    for (size_t v = 0; good && v < n_vertices; ++v) {
        double *x = m->vertices + 3 * v;
        good = fscanf(nodes, "%*u %lf %lf %lf%*[^\n]", &x[0], &x[1], &x[2]) == 3;
    }
    for (size_t s = 0; good && s < n_simplices; ++s) {
        unsigned long c[4];
        good = fscanf(cells, "%*u %lu %lu %lu %lu%*[^\n]", &c[0], &c[1], &c[2], &c[3]) == 4;
        for (size_t k = 0; good && k < 4; ++k)
            m->simplices[4 * s + k] = (uint32_t)c[k];
    }
    if (nodes != NULL)
        (void)fclose(nodes);
    if (cells != NULL)
        (void)fclose(cells);
    return good;
}

static inline void mesh_remove_files(const char *path)
{
    static const char *const ENDS[] = {".smesh",  ".1.node", ".1.ele",
                                       ".1.face", ".1.edge", ".1.smesh"};
    char name[256];
    for (size_t k = 0; k < sizeof ENDS / sizeof *ENDS; ++k) {
        (void)snprintf(name, sizeof name, "%s%s", path, ENDS[k]);
        (void)remove(name);
    }
}

/* The inside of a surface by tetgen, which keeps the surface: its vertices come first and its faces
 * are the facets. Works in files whose names begin with `tag`, so tests that run at the same time
 * need different ones. False, with a message, when there is no tetgen. */
static inline int mesh_tetgen(test_mesh *m, size_t n_vertices, const double *vertices,
                              size_t n_faces, const uint32_t *faces, const char *tag)
{
    char path[200], command[256];
    *m = (test_mesh){0};
    if (!mesh_has_tetgen()) {
        (void)printf("tetgen is not installed: %s skipped\n", tag);
        return 0;
    }
    const char *mode = getenv("ICC_TEST_MODE"); /* the same program runs in several modes at once */
    (void)snprintf(path, sizeof path, "%s.%s.tetgen", tag, mode != NULL ? mode : "default");
    (void)snprintf(command, sizeof command, "tetgen -pYq1.4zQ '%s.smesh' >/dev/null 2>&1", path);
    char name[256];
    (void)snprintf(name, sizeof name, "%s.smesh", path);
    mesh_write_surface(name, n_vertices, vertices, n_faces, faces);
    const int good = system(command) == 0 && mesh_read_tetgen(m, path);
    mesh_remove_files(path);
    if (!good) {
        (void)printf("tetgen does not mesh %s\n", tag);
        mesh_free(m);
        return 0;
    }
    m->n_facets = n_faces;
    m->facets = mesh_alloc(3 * n_faces, sizeof *m->facets);
    memcpy(m->facets, faces, 3 * n_faces * sizeof *faces);
    return 1;
}

#ifdef TEST_SHARED_DATA
/* Of a surface of the data beside the tree, such as "t01_cube_bend" and "src". False, with a
 * message, when it or tetgen is missing. */
static inline int mesh_of_data(test_mesh *m, const char *name, const char *side, const char *tag)
{
    char path[512];
    obj o;
    *m = (test_mesh){0};
    (void)snprintf(path, sizeof path, "%s/3d/%s.%s.obj", TEST_SHARED_DATA, name, side);
    if (!obj_read(&o, path)) {
        (void)printf("%s is not there: %s skipped\n", path, tag);
        return 0;
    }
    char label[128];
    (void)snprintf(label, sizeof label, "%s_%s_%s", tag, name, side);
    const int good = mesh_tetgen(m, o.n_vertices, o.vertices, o.n_faces, o.faces, label);
    obj_free(&o);
    return good;
}
#endif

#endif
