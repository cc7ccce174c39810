/* An animal's volume goes from one pose to another: only its surface is given, before and after.
 *
 * The animal is drawn by hand from blocks, and its surface smoothed. The pose bends the surface
 * alone. Then a mesh of tetrahedra inside goes along, and every tetrahedron is looked at.
 *
 * animal_pose OUT.vtk writes the tetrahedra with their displacement: in ParaView, Warp By
 * Vector. */
#include <icc/icc.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { NX = 14, NY = 6, NZ = 9, N_CELLS = NX * NY * NZ };

/* Boxes of cells: from (x, y, z) to (x, y, z). */
static const int blocks[][6] = {
    {2, 1, 4, 11, 5, 7}, /* trunk */
    {2, 1, 0, 4, 2, 4},  /* four legs */
    {2, 4, 0, 4, 5, 4},   {9, 1, 0, 11, 2, 4}, {9, 4, 0, 11, 5, 4}, {10, 2, 6, 13, 4, 9}, /* head */
    {13, 2, 6, 14, 4, 8},                                                                 /* nose */
    {0, 2, 5, 2, 3, 6},                                                                   /* tail */
};

typedef struct mesh {
    size_t n_vertices, n_elements;
    double *vertices;
    uint32_t *elements;
} mesh;

static void *need(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    if (memory == NULL)
        exit(1);
    return memory;
}

static void check(icc_status status, const icc_error *err)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "%s\n", err != NULL ? err->message : icc_status_name(status));
    exit(1);
}

/* The surface of the blocks. */
static mesh draw_surface(void)
{
    const size_t shape[3] = {NX, NY, NZ};
    uint8_t cells[N_CELLS] = {0};
    for (size_t b = 0; b < sizeof blocks / sizeof *blocks; b++)
        for (int z = blocks[b][2]; z < blocks[b][5]; z++)
            for (int y = blocks[b][1]; y < blocks[b][4]; y++)
                for (int x = blocks[b][0]; x < blocks[b][3]; x++)
                    cells[x + NX * (y + NY * z)] = 1;
    icc_domain *solid;
    icc_error err = {.size = sizeof err};
    check(icc_domain_create_mask(&solid, 3, shape, cells, NULL, &err), &err);
    icc_domain_info info = {.size = sizeof info};
    check(icc_domain_get_info(solid, &info), NULL);
    mesh m = {.n_vertices = info.n_vertices, .n_elements = info.n_facets};
    m.vertices = need(m.n_vertices, 3 * sizeof(double));
    m.elements = need(m.n_elements, 3 * sizeof(uint32_t));
    check(icc_domain_get_boundary(solid, m.vertices, m.elements), NULL);
    icc_domain_free(solid);
    return m;
}

/* Moves each vertex half way to the mean of its neighbours. */
static void smooth(mesh *m)
{
    double *sum = need(m->n_vertices, 3 * sizeof *sum);
    unsigned *n = need(m->n_vertices, sizeof *n);
    for (size_t i = 0; i < 3 * m->n_elements; i++) {
        uint32_t v = m->elements[i], w = m->elements[i % 3 == 2 ? i - 2 : i + 1];
        for (size_t k = 0; k < 3; k++)
            sum[3 * v + k] += m->vertices[3 * w + k];
        n[v]++;
    }
    for (size_t i = 0; i < 3 * m->n_vertices; i++)
        m->vertices[i] = (m->vertices[i] + sum[i] / n[i / 3]) / 2;
    free(sum);
    free(n);
}

/* Legs step out in turn, the head goes up, the tail to the side. Shears only, so nothing can
 * meet. */
static void pose(const double from[3], double to[3])
{
    double x = from[0], y = from[1], z = from[2];
    double below = fmax(0, 4.5 - z), side = (y - 3) / 2, front = (x - 6.5) / 4;
    double neck = fmax(0, x - 9), tail = fmax(0, 2.5 - x);
    to[0] = x + 0.35 * below * side * (front > 0 ? 1 : -1) * fmin(1, front * front);
    to[1] = y + 0.25 * tail * tail;
    to[2] = z + 0.08 * neck * neck;
}

static icc_domain *make_domain(const mesh *surface, const double *vertices)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    check(icc_domain_create(&domain, 3, surface->n_vertices, vertices, surface->n_elements,
                            surface->elements, NULL, &err),
          &err);
    return domain;
}

/* Small cubes inside, six tetrahedra each, which share a diagonal. */
static mesh fill(const icc_domain *domain)
{
    enum { FINE = 2, PX = FINE * NX + 1, PY = FINE * NY + 1, PZ = FINE * NZ + 1 };
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                    {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    const size_t step[3] = {1, PX, PX * PY}, n = PX * PY * PZ;
    mesh m = {.n_vertices = n, .vertices = need(n, 3 * sizeof(double))};
    int32_t *where = need(n, sizeof *where);
    m.elements = need(6 * n, 4 * sizeof(uint32_t));
    for (size_t i = 0; i < n;
         i++) { /* a little off the places where the surface has its vertices */
        m.vertices[3 * i] = (double)(i % PX) / FINE + 0.013;
        m.vertices[3 * i + 1] = (double)(i / PX % PY) / FINE + 0.017;
        m.vertices[3 * i + 2] = (double)(i / PX / PY) / FINE + 0.019;
    }
    check(icc_domain_locate(domain, n, m.vertices, where, NULL, NULL, NULL), NULL);
    for (size_t i = 0; i + step[0] + step[1] + step[2] < n; i++) {
        bool whole = true;
        for (size_t c = 0; c < 8; c++)
            whole = whole &&
                    where[i + (c & 1) * step[0] + (c >> 1 & 1) * step[1] + (c >> 2) * step[2]] ==
                        ICC_INSIDE;
        for (int t = 0; whole && t < 6; t++) {
            size_t at = i;
            for (int k = 0; k < 4; at += k < 3 ? step[order[t][k]] : 0, k++)
                m.elements[4 * m.n_elements + (size_t)k] = (uint32_t)at;
            m.n_elements++;
        }
    }
    free(where);
    return m;
}

/* Six times the volume of a tetrahedron. */
static double determinant(const double *points, const uint32_t *t)
{
    double e[3][3];
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < 3; k++)
            e[i][k] = points[3 * t[i + 1] + k] - points[3 * t[0] + k];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

static void count(const mesh *volume, const double *images)
{
    size_t n_kept = 0, n_inverted = 0;
    for (size_t i = 0; i < volume->n_elements; i++) {
        const uint32_t *t = volume->elements + 4 * i;
        double det = determinant(volume->vertices, t) * determinant(images, t);
        n_kept += det > 0;
        n_inverted += det <= 0;
    }
    printf("%zu tetrahedra: %zu keep their orientation, %zu do not, %zu have no image\n",
           volume->n_elements, n_kept, n_inverted, volume->n_elements - n_kept - n_inverted);
}

static void write_vtk(const char *name, const mesh *volume, const double *images)
{
    FILE *f = fopen(name, "w");
    if (f == NULL)
        exit(1);
    fprintf(f, "# vtk DataFile Version 3.0\nanimal\nASCII\nDATASET UNSTRUCTURED_GRID\n");
    fprintf(f, "POINTS %zu double\n", volume->n_vertices);
    for (size_t i = 0; i < 3 * volume->n_vertices; i++)
        fprintf(f, "%.6f%c", volume->vertices[i], i % 3 == 2 ? '\n' : ' ');
    fprintf(f, "CELLS %zu %zu\n", volume->n_elements, 5 * volume->n_elements);
    for (size_t i = 0; i < 4 * volume->n_elements; i++)
        fprintf(f, "%s%u%c", i % 4 == 0 ? "4 " : "", (unsigned)volume->elements[i],
                i % 4 == 3 ? '\n' : ' ');
    fprintf(f, "CELL_TYPES %zu\n", volume->n_elements);
    for (size_t i = 0; i < volume->n_elements; i++)
        fputs("10\n", f);
    fprintf(f, "POINT_DATA %zu\nVECTORS displacement double\n", volume->n_vertices);
    for (size_t i = 0; i < 3 * volume->n_vertices; i++) {
        double d = images[i] - volume->vertices[i];
        fprintf(f, "%.6f%c", isnan(d) ? 0 : d, i % 3 == 2 ? '\n' : ' ');
    }
    if (fclose(f) != 0)
        exit(1);
    printf("the result is %s\n", name);
}

static void report(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    check(icc_map_get_info(map, &info), NULL);
    printf("the map is %scertified; ", info.certified ? "" : "not ");
    if (info.kind == ICC_MAP_MESH)
        printf("%zu tetrahedra of its own, mean energy %.2f (6 for an isometry)\n",
               info.n_simplices, info.energy);
    else
        printf("it follows curves\n");
}

int main(int argc, char **argv)
{
    mesh surface = draw_surface();
    for (int i = 0; i < 2; i++)
        smooth(&surface);
    double *posed = need(surface.n_vertices, 3 * sizeof *posed);
    for (size_t i = 0; i < surface.n_vertices; i++)
        pose(surface.vertices + 3 * i, posed + 3 * i);

    icc_domain *source = make_domain(&surface, surface.vertices),
               *target = make_domain(&surface, posed);
    const icc_env env = {.size = sizeof env, .threads = 4};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    check(icc_map_create(&map, source, target, NULL, &env, &err), &err);
    report(map);

    mesh volume = fill(source);
    double *images = need(volume.n_vertices, 3 * sizeof *images);
    check(icc_map_apply(map, volume.n_vertices, volume.vertices, images, NULL, NULL, &env), NULL);
    count(&volume, images);
    if (argc > 1)
        write_vtk(argv[1], &volume, images);

    icc_map_free(map);
    icc_domain_free(target);
    icc_domain_free(source);
    free(images);
    free(volume.vertices);
    free(volume.elements);
    free(posed);
    free(surface.vertices);
    free(surface.elements);
    return 0;
}
