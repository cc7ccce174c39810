/* Medit text: https://www.ljll.fr/frey/publications/RT-0253.pdf */
#include "job/mesh_out.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

typedef struct map_mesh {
    icc_map_info info;
    double *points[2]; /* before and after */
    uint32_t *cells;
    uint32_t *regions; /* of each cell, from 0 */
} map_mesh;

/* ---- regions ---- */

/* A face of a cell or of a surface inside, its corners in rising order. */
typedef struct face {
    uint32_t corners[3];
    uint32_t cell; /* or n_cells and the number of the surface */
} face;

static int by_corners(const void *a, const void *b)
{
    const face *p = a, *q = b;
    for (size_t k = 0; k < 3; k++)
        if (p->corners[k] != q->corners[k])
            return p->corners[k] < q->corners[k] ? -1 : 1;
    return (p->cell > q->cell) - (p->cell < q->cell);
}

static face face_of(uint32_t a, uint32_t b, uint32_t c, size_t cell)
{
    face f = {{a, b, c}, (uint32_t)cell};
    for (size_t i = 0; i < 2; i++)
        for (size_t k = 0; k < 2 - i; k++)
            if (f.corners[k] > f.corners[k + 1]) {
                uint32_t swap = f.corners[k];
                f.corners[k] = f.corners[k + 1];
                f.corners[k + 1] = swap;
            }
    return f;
}

/* Lists the faces of all cells, then those of the surfaces inside. The first vertices of a map's
 * mesh are those of its domain: the outer ones, then those of the features in their order. */
static face *list_faces(const map_mesh *m, const cage *c, size_t *n)
{
    static const unsigned char corners[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
    size_t n_cells = m->info.n_simplices, n_surfaces = 0, n_walls = 0;
    for (size_t i = 0; i < c->n_features; i++)
        n_walls += c->features[i].kind == ICC_FEATURE_REGION ? c->features[i].n_facets : 0;
    face *faces = need(4 * n_cells + n_walls, sizeof *faces);
    *n = 0;
    for (size_t t = 0; t < n_cells; t++)
        for (size_t i = 0; i < 4; i++) {
            const uint32_t *v = m->cells + 4 * t;
            faces[(*n)++] = face_of(v[corners[i][0]], v[corners[i][1]], v[corners[i][2]], t);
        }
    uint32_t first = (uint32_t)c->n;
    for (size_t i = 0; i < c->n_features; i++) {
        const cage_feature *f = &c->features[i];
        for (size_t t = 0; f->kind == ICC_FEATURE_REGION && t < f->n_facets; t++) {
            const uint32_t *v = f->facets + 3 * t;
            faces[(*n)++] = face_of(first + v[0], first + v[1], first + v[2], n_cells + n_surfaces);
        }
        n_surfaces += f->kind == ICC_FEATURE_REGION;
        first += (uint32_t)f->n;
    }
    qsort(faces, *n, sizeof *faces, by_corners);
    return faces;
}

static uint32_t leader(uint32_t *sets, uint32_t i)
{
    while (sets[i] != i)
        i = sets[i] = sets[sets[i]];
    return i;
}

/* Joins cells that share a face that is on no surface. */
static void join_cells(uint32_t *sets, const face *faces, size_t n, size_t n_cells)
{
    for (size_t i = 0; i < n_cells; i++)
        sets[i] = (uint32_t)i;
    for (size_t i = 0; i + 1 < n; i++) {
        bool same = memcmp(faces[i].corners, faces[i + 1].corners, sizeof faces[i].corners) == 0;
        bool wall = i + 2 < n && faces[i + 2].cell >= n_cells &&
                    memcmp(faces[i].corners, faces[i + 2].corners, sizeof faces[i].corners) == 0;
        if (!same || faces[i + 1].cell >= n_cells || wall)
            continue;
        uint32_t a = leader(sets, faces[i].cell), b = leader(sets, faces[i + 1].cell);
        sets[a < b ? b : a] = a < b ? a : b;
    }
}

/* Numbers the pieces: a piece within surface k gets k + 1. Starts from the outer surface, and goes
 * through one surface after the other. */
static void number_pieces(map_mesh *m, uint32_t *sets, const face *faces, size_t n)
{
    const size_t n_cells = m->info.n_simplices;
    uint32_t *piece = need(n_cells, sizeof *piece); /* by leader: its number and 1, or 0 */
    bool changed = true;
    for (size_t i = 0; i < n_cells; i++)
        for (size_t k = 0; k < 4; k++)
            if (m->cells[4 * i + k] == 0) /* a vertex of the outer surface */
                piece[leader(sets, (uint32_t)i)] = 1;
    while (changed) {
        changed = false;
        for (size_t i = 0; i + 2 < n; i++) {
            if (faces[i + 2].cell < n_cells || faces[i].cell >= n_cells ||
                faces[i + 1].cell >= n_cells)
                continue;
            uint32_t a = leader(sets, faces[i].cell), b = leader(sets, faces[i + 1].cell);
            if ((piece[a] == 0) == (piece[b] == 0))
                continue;
            piece[piece[a] == 0 ? a : b] = 2 + faces[i + 2].cell - (uint32_t)n_cells;
            changed = true;
        }
    }
    for (size_t i = 0; i < n_cells; i++)
        m->regions[i] = piece[leader(sets, (uint32_t)i)] - 1;
    free(piece);
}

static void find_regions(map_mesh *m, const cage *c)
{
    size_t n;
    face *faces = list_faces(m, c, &n);
    uint32_t *sets = need(m->info.n_simplices, sizeof *sets);
    m->regions = need(m->info.n_simplices, sizeof *m->regions);
    join_cells(sets, faces, n, m->info.n_simplices);
    number_pieces(m, sets, faces, n);
    free(sets);
    free(faces);
}

/* ---- files ---- */

static map_mesh take_mesh(const job *j)
{
    map_mesh m = {.info.size = sizeof m.info};
    icc_map_get_info(j->map, &m.info);
    for (size_t k = 0; k < 2; k++)
        m.points[k] = need(m.info.n_vertices, 3 * sizeof *m.points[k]);
    m.cells = need(m.info.n_simplices, 4 * sizeof *m.cells);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = m.info.n_vertices,
                     .vertices = m.points[0],
                     .n_cells = m.info.n_simplices,
                     .cells = m.cells};
    icc_map_get_mesh(j->map, &mesh, m.points[1]);
    find_regions(&m, &j->cages[0]);
    return m;
}

static int write_side(const char *name, const map_mesh *m, const double *points)
{
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    fprintf(file.stream, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n",
            m->info.n_vertices);
    for (size_t i = 0; i < m->info.n_vertices; i++)
        fprintf(file.stream, "%.17g %.17g %.17g 0\n", points[3 * i], points[3 * i + 1],
                points[3 * i + 2]);
    fprintf(file.stream, "Tetrahedra\n%zu\n", m->info.n_simplices);
    for (size_t i = 0; i < m->info.n_simplices; i++) {
        const uint32_t *v = m->cells + 4 * i;
        fprintf(file.stream, "%lu %lu %lu %lu %lu\n", (unsigned long)v[0] + 1,
                (unsigned long)v[1] + 1, (unsigned long)v[2] + 1, (unsigned long)v[3] + 1,
                (unsigned long)m->regions[i] + 1);
    }
    fputs("End\n", file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

bool mesh_out_is_wanted(const job *j)
{
    return j->args->mesh_out != NULL || j->args->target_mesh_out != NULL;
}

int mesh_out_check(job *j)
{
    int result = mesh_out_is_wanted(j) ? job_read_cages(j) : DONE;
    return result == DONE && mesh_out_is_wanted(j) && job_dim(j) != 3
               ? failed(j->args->source, 0,
                        "this is no surface in space; --mesh-out writes tetrahedra")
               : result;
}

int mesh_out_write(const job *j)
{
    const char *names[2] = {j->args->mesh_out, j->args->target_mesh_out};
    icc_map_info info = {.size = sizeof info};
    int result = DONE;
    if (!mesh_out_is_wanted(j))
        return DONE;
    icc_map_get_info(j->map, &info);
    if (info.kind != ICC_MAP_MESH)
        return failed(j->args->source, 0,
                      "no mesh map was found, so there are no tetrahedra to write");
    map_mesh m = take_mesh(j);
    for (size_t k = 0; k < 2 && result == DONE; k++)
        if (names[k] != NULL)
            result = write_side(names[k], &m, m.points[k]);
    free(m.points[0]);
    free(m.points[1]);
    free(m.cells);
    free(m.regions);
    return result;
}
