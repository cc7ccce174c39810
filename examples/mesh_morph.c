/* A finite element mesh follows its boundary: a beam of tetrahedra is bent and twisted.
 *
 * mesh_morph SOURCE TARGET OUT.mesh OUT.vtk
 *
 * The files are Medit (.mesh) or legacy VTK as text. The target is a mesh of the moved boundary:
 * the source's boundary with the vertices elsewhere, in the same order, but inside it has nothing
 * to do with the source. A mesher that keeps the surface makes one, such as tetgen -pY. For
 * ParaView: Warp By Vector, colour by quality. */
#include <icc/icc.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct mesh {
    size_t n_vertices, n;
    double *vertices;
    uint32_t *corners; /* 4 of each of the n tetrahedra */
} mesh;

static void fail(const char *what)
{
    fprintf(stderr, "mesh_morph: %s\n", what);
    exit(1);
}

static void check(icc_status status, const icc_error *err)
{
    if (status != ICC_OK)
        fail(err != NULL ? err->message : icc_status_name(status));
}

static void *need(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    if (memory == NULL)
        fail("out of memory");
    return memory;
}

/* The parts of a Medit and of a legacy VTK file (version 2 or 3, all cells tetrahedra) that matter:
 * how their size is given, how many numbers a row has, which of them count, and the number of the
 * first vertex. */
static const struct section {
    const char *name, *head;
    size_t length, first, n_kept;
    double base;
} sections[] = {{"Vertices", "%zu", 4, 0, 3, 0},
                {"Tetrahedra", "%zu", 5, 0, 4, 1},
                {"POINTS", "%zu%*s", 3, 0, 3, 0},
                {"CELLS", "%zu%*s", 5, 1, 4, 0}};

static void read_section(FILE *file, const struct section *s, mesh *m)
{
    size_t n;
    if (fscanf(file, s->head, &n) != 1)
        fail("a number is missing in a mesh");
    if (s->n_kept == 3)
        m->n_vertices = n, m->vertices = need(n, 3 * sizeof *m->vertices);
    else
        m->n = n, m->corners = need(n, 4 * sizeof *m->corners);
    for (size_t i = 0, to = 0; i < n * s->length; i++) {
        double number;
        if (fscanf(file, "%lf", &number) != 1)
            fail("a number is missing in a mesh");
        if (i % s->length < s->first || i % s->length >= s->first + s->n_kept)
            continue;
        if (s->n_kept == 3)
            m->vertices[to++] = number;
        else
            m->corners[to++] = (uint32_t)(number - s->base);
    }
}

static mesh read_mesh(const char *name)
{
    mesh m = {0};
    char word[64];
    FILE *file = fopen(name, "r");
    while (file != NULL && fscanf(file, "%63s", word) == 1)
        for (size_t k = 0; k < sizeof sections / sizeof *sections; k++)
            if (strcmp(word, sections[k].name) == 0)
                read_section(file, &sections[k], &m);
    if (file == NULL || m.vertices == NULL || m.corners == NULL)
        fail("a file is no mesh");
    fclose(file);
    return m;
}

/* Volume against the mean square of the edges: 1 for the regular tetrahedron, either way round, 0
 * for a flat one. */
static double quality(const double *vertices, const uint32_t *corners)
{
    double e[3][3], squares = 0;
    for (size_t i = 0; i < 4; i++)
        for (size_t k = 0; k < 3; k++) {
            for (size_t j = 0; j < i; j++)
                squares += pow(vertices[3 * corners[i] + k] - vertices[3 * corners[j] + k], 2);
            if (i > 0)
                e[i - 1][k] = vertices[3 * corners[i] + k] - vertices[3 * corners[0] + k];
        }
    const double volume = (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
                          6;
    return 12 * cbrt(9 * volume * volume) / squares;
}

/* The corners, counted from `base`, between `before` and `after`. */
static void write_corners(FILE *f, const mesh *m, const char *before, unsigned base,
                          const char *after)
{
    for (size_t i = 0; i < 4 * m->n; i++)
        fprintf(f, "%s%u%s", i % 4 == 0 ? before : " ", m->corners[i] + base,
                i % 4 == 3 ? after : "");
}

static void write_rows(FILE *f, size_t n, const double *vertices, const double *origins,
                       const char *after)
{
    for (size_t i = 0; i < 3 * n; i++)
        fprintf(f, "%.17g%s", vertices[i] - (origins != NULL ? origins[i] : 0),
                i % 3 == 2 ? after : " ");
}

static void write_medit(FILE *f, const mesh *m, const double *images)
{
    fprintf(f, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n", m->n_vertices);
    write_rows(f, m->n_vertices, images, NULL, " 0\n");
    fprintf(f, "Tetrahedra\n%zu\n", m->n);
    write_corners(f, m, "", 1, " 0\n");
    fputs("End\n", f);
}

static void write_vtk(FILE *f, const mesh *m, const double *images)
{
    fprintf(f, "# vtk DataFile Version 3.0\nmorph\nASCII\nDATASET UNSTRUCTURED_GRID\n");
    fprintf(f, "POINTS %zu double\n", m->n_vertices);
    write_rows(f, m->n_vertices, m->vertices, NULL, "\n");
    fprintf(f, "CELLS %zu %zu\n", m->n, 5 * m->n);
    write_corners(f, m, "4 ", 0, "\n");
    fprintf(f, "CELL_TYPES %zu\n", m->n);
    for (size_t i = 0; i < m->n; i++)
        fputs("10\n", f);
    fprintf(f, "POINT_DATA %zu\nVECTORS displacement double\n", m->n_vertices);
    write_rows(f, m->n_vertices, images, m->vertices, "\n");
    fprintf(f, "CELL_DATA %zu\nSCALARS quality double\nLOOKUP_TABLE default\n", m->n);
    for (size_t i = 0; i < m->n; i++)
        fprintf(f, "%.6f\n", quality(images, m->corners + 4 * i));
}

static void write_file(const char *name, void (*write)(FILE *, const mesh *, const double *),
                       const mesh *m, const double *images)
{
    FILE *f = fopen(name, "w");
    if (f == NULL)
        fail("a file cannot be written");
    write(f, m, images);
    if (fclose(f) != 0)
        fail("a file cannot be written");
}

static void tell(const char *what, const mesh *m, const double *vertices, const icc_certificate *c)
{
    double least = 1, sum = 0;
    for (size_t i = 0; i < m->n; i++) {
        const double q = quality(vertices, m->corners + 4 * i);
        least = fmin(least, q);
        sum += q;
    }
    printf("%-9s quality at least %.3f, %.3f on the mean", what, least, sum / (double)m->n);
    if (c != NULL)
        printf("; %zu of %zu tetrahedra inverted, %zu flat: %scertified", c->n_inverted, m->n,
               c->n_flat, c->certified ? "" : "not ");
    putchar('\n');
}

/* As the library takes it. */
static icc_mesh mesh_of(const mesh *m)
{
    return (icc_mesh){.size = sizeof(icc_mesh),
                      .dim = 3,
                      .n_vertices = m->n_vertices,
                      .vertices = m->vertices,
                      .n_cells = m->n,
                      .cells = m->corners};
}

static icc_domain *make_domain(const mesh *m)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    const icc_mesh own = mesh_of(m);
    check(icc_domain_create_mesh(&domain, &own, 0, NULL, NULL, &err), &err);
    return domain;
}

/* The map is one-to-one, but straight tetrahedra with the images of their corners need not be:
 * those that invert are repaired, which leaves the boundary where it is. (A map of kind mesh, the
 * default in space, starts from the same images and is repaired when it is made.) */
static void morph(const mesh *source, const mesh *target, double *images)
{
    icc_domain *before = make_domain(source), *after = make_domain(target);
    const icc_env env = {.size = sizeof env, .threads = 4};
    icc_error err = {.size = sizeof err};
    icc_certificate certificate = {.size = sizeof certificate};
    icc_map_info info = {.size = sizeof info};
    const icc_map_options options = {.size = sizeof options, .kind = ICC_MAP_CURVES};
    const icc_mesh own = mesh_of(source);
    icc_map *map;
    check(icc_map_create(&map, before, after, &options, &env, &err), &err);
    check(icc_map_get_info(map, &info), NULL);
    printf("the map is %scertified\n", info.certified ? "" : "not ");
    tell("before", source, source->vertices, NULL);
    check(icc_map_certify(map, &own, images, &certificate, &env, &err), &err);
    tell("mapped", source, images, &certificate);
    check(icc_map_repair(map, &own, images, &certificate, &env, &err), &err);
    tell("repaired", source, images, &certificate);
    icc_map_free(map);
    icc_domain_free(after);
    icc_domain_free(before);
}

int main(int argc, char **argv)
{
    if (argc != 5)
        fail("usage: mesh_morph SOURCE TARGET OUT.mesh OUT.vtk");
    mesh source = read_mesh(argv[1]), target = read_mesh(argv[2]);
    double *images = need(source.n_vertices, 3 * sizeof *images);
    morph(&source, &target, images);
    write_file(argv[3], write_medit, &source, images);
    write_file(argv[4], write_vtk, &source, images);
    printf("the result is %s, and %s\n", argv[3], argv[4]);
    free(images);
    free(source.vertices);
    free(source.corners);
    free(target.vertices);
    free(target.corners);
    return 0;
}
