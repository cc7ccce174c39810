/* libicc plot OUT.vtk: the source in the legacy VTK format, for ParaView.
 *
 * One unstructured grid of four parts, which the cell data `part` distinguishes: 0 the cells of the
 * grid (methods gradient and field), 1 the tree's edges, 2 the boundary, 3 integral curves. A
 * target adds the point data `displacement`. ParaView's filter Warp By Vector turns it into the
 * target. */
#include "plot/plot.h"

#include "base/allocate.h"
#include "base/system.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PART_GRID, PART_TREE, PART_BOUNDARY, PART_CURVES };
enum { VTK_LINE = 3, VTK_POLY_LINE = 4, VTK_TRIANGLE = 5, VTK_PIXEL = 8, VTK_VOXEL = 11 };
enum { DEFAULT_LINES = 120 };

/* The data of a point. */
typedef struct place {
    double at[3];
    double function; /* or its logarithm */
    double share;    /* of the length of its curve */
    int32_t generation;
    int32_t inside;
} place;

typedef struct cell {
    int32_t part, type;
    size_t first, n; /* in `corners` */
} cell;

typedef struct vtk {
    job job;
    stages stages;
    size_t dim;
    place *places;
    cell *cells;
    uint32_t *corners;
    double *moved; /* the images of the places, dim coordinates each; NULL if there is no map */
    size_t n_places, n_cells, n_corners;
    size_t room_places, room_cells, room_corners;
} vtk;

static uint32_t add_place(vtk *v, const double *at, place what)
{
    v->places = grow(v->places, &v->room_places, v->n_places + 1, sizeof *v->places);
    memcpy(what.at, at, v->dim * sizeof *at);
    v->places[v->n_places] = what;
    return (uint32_t)v->n_places++;
}

static void add_cell(vtk *v, int32_t part, int32_t type, size_t n, const uint32_t *corners)
{
    v->cells = grow(v->cells, &v->room_cells, v->n_cells + 1, sizeof *v->cells);
    v->corners = grow(v->corners, &v->room_corners, v->n_corners + n, sizeof *v->corners);
    memcpy(v->corners + v->n_corners, corners, n * sizeof *corners);
    v->cells[v->n_cells++] = (cell){.part = part, .type = type, .first = v->n_corners, .n = n};
    v->n_corners += n;
}

/* -------------------------------------------------------------------- grid */

/* Adds the vertices that the tree reaches. `ids` gets their places, and UINT32_MAX for the
 * others. */
static void add_vertices(vtk *v, uint32_t *ids)
{
    const stages *s = &v->stages;
    const uint8_t *inside = icc_grid_inside(s->grid);
    const int32_t *generations = icc_tree_generations(s->tree);
    for (size_t i = 0; i < s->lattice.n_vertices; i++) {
        ids[i] = UINT32_MAX;
        if (generations[i] < 0)
            continue;
        double at[ICC_MAX_DIM];
        stages_position(s, (uint32_t)i, at);
        ids[i] = add_place(v, at,
                           (place){.function = isfinite(s->values[i]) ? s->values[i] : s->low,
                                   .generation = generations[i],
                                   .inside = inside[i]});
    }
}

/* Adds the grid cell whose lowest corner is vertex i, if the tree reaches all its corners. */
static void add_grid_cell(vtk *v, const uint32_t *ids, size_t i)
{
    const size_t *shape = v->stages.lattice.shape;
    uint32_t corners[8];
    size_t n = (size_t)1 << v->dim;
    for (size_t c = 0; c < n; c++) {
        size_t corner = i, step = 1, rest = i;
        for (size_t k = 0; k < v->dim; k++) {
            if (c >> k & 1 && rest % shape[k] + 1 == shape[k])
                return;
            corner += (c >> k & 1) * step;
            rest /= shape[k];
            step *= shape[k];
        }
        corners[c] = ids[corner];
        if (corners[c] == UINT32_MAX)
            return;
    }
    add_cell(v, PART_GRID, v->dim == 2 ? VTK_PIXEL : VTK_VOXEL, n, corners);
}

static void add_grid(vtk *v)
{
    const stages *s = &v->stages;
    if (s->field == NULL)
        return;
    const uint32_t *parents = icc_tree_parents(s->tree);
    uint32_t *ids = need(s->lattice.n_vertices, sizeof *ids);
    add_vertices(v, ids);
    for (size_t i = 0; i < s->lattice.n_vertices; i++) {
        add_grid_cell(v, ids, i);
        if (ids[i] != UINT32_MAX && parents[i] != UINT32_MAX)
            add_cell(v, PART_TREE, VTK_LINE, 2, (uint32_t[2]){ids[i], ids[parents[i]]});
    }
    free(ids);
}

/* ---------------------------------------------------------------- boundary */

/* The corners of facet i. Those of a ring are its edges. */
static void facet_corners(const cage *c, size_t i, uint32_t *corners)
{
    for (size_t k = 0; k < c->dim; k++)
        corners[k] = c->n_facets > 0 ? c->facets[i * c->dim + k] : (uint32_t)((i + k) % c->n);
}

static size_t count_facets(const cage *c)
{
    return c->n_facets > 0 ? c->n_facets : c->n;
}

static void add_boundary(vtk *v)
{
    const cage *c = &v->job.cages[0];
    uint32_t first = (uint32_t)v->n_places, corners[3];
    for (size_t i = 0; i < c->n; i++)
        add_place(v, c->points + v->dim * i, (place){.function = v->stages.low, .generation = -1});
    for (size_t i = 0; i < count_facets(c); i++) {
        facet_corners(c, i, corners);
        for (size_t k = 0; k < v->dim; k++)
            corners[k] += first;
        add_cell(v, PART_BOUNDARY, v->dim == 2 ? VTK_LINE : VTK_TRIANGLE, v->dim, corners);
    }
}

/* ------------------------------------------------------------------ curves */

static double distance(const double *a, const double *b, size_t dim)
{
    double sum = 0;
    for (size_t k = 0; k < dim; k++)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

/* The length, or by Heron's formula the area. */
static double facet_measure(const cage *c, const uint32_t *corners)
{
    const double *p[3] = {NULL, NULL, NULL};
    for (size_t k = 0; k < c->dim; k++)
        p[k] = c->points + c->dim * corners[k];
    double x = distance(p[0], p[1], c->dim);
    if (c->dim == 2)
        return x;
    double y = distance(p[1], p[2], 3), z = distance(p[2], p[0], 3), s = (x + y + z) / 2;
    return sqrt(fmax(0, s * (s - x) * (s - y) * (s - z)));
}

/* A curve from a point of the boundary to the maximum, as one polyline. Its n points carry the
 * share of the length walked. `*curve` has room for *room doubles and grows as needed. */
static void add_curve(vtk *v, const double *start, double **curve, size_t *room)
{
    size_t n = 0, dim = v->dim;
    icc_status status =
        icc_chart_trace(v->stages.chart, start, *room / dim, *curve, &n, &v->job.env, NULL);
    if (status == ICC_OK && n * dim > *room) {
        *curve = grow(*curve, room, n * dim, sizeof **curve);
        status = icc_chart_trace(v->stages.chart, start, n, *curve, &n, &v->job.env, NULL);
    }
    if (status != ICC_OK || n < 2)
        return;
    double length = 0, walked = 0;
    uint32_t *corners = need(n, sizeof *corners);
    for (size_t i = 1; i < n; i++)
        length += distance(*curve + dim * (i - 1), *curve + dim * i, dim);
    for (size_t i = 0; i < n; i++) {
        walked += i > 0 ? distance(*curve + dim * (i - 1), *curve + dim * i, dim) : 0;
        corners[i] = add_place(
            v, *curve + dim * i,
            (place){.function = v->stages.low, .share = walked / length, .generation = -1});
    }
    add_cell(v, PART_CURVES, VTK_POLY_LINE, n, corners);
    free(corners);
}

/* Adds curves from the middles of facets, spread evenly over the boundary's measure. */
static void add_curves(vtk *v)
{
    const cage *c = &v->job.cages[0];
    size_t n = v->job.args->lines > 0 ? (size_t)v->job.args->lines : DEFAULT_LINES, room = 0, k = 0;
    double total = 0, walked = 0, *curve = NULL, start[3];
    uint32_t corners[3];
    for (size_t i = 0; i < count_facets(c); i++) {
        facet_corners(c, i, corners);
        total += facet_measure(c, corners);
    }
    curve = grow(curve, &room, 4096, sizeof *curve);
    for (size_t i = 0; i < count_facets(c) && k < n; i++) {
        facet_corners(c, i, corners);
        walked += facet_measure(c, corners);
        size_t wanted = (size_t)(walked / total * (double)n + 0.5);
        if (wanted <= k)
            continue;
        k = wanted;
        for (size_t a = 0; a < v->dim; a++) {
            start[a] = 0;
            for (size_t b = 0; b < v->dim; b++)
                start[a] += c->points[v->dim * corners[b] + a] / (double)v->dim;
        }
        add_curve(v, start, &curve, &room);
    }
    free(curve);
}

/* ----------------------------------------------------------------- writing */

static int move_places(vtk *v)
{
    if (v->job.map == NULL)
        return DONE;
    v->moved = need(v->n_places, v->dim * sizeof *v->moved);
    for (size_t i = 0; i < v->n_places; i++)
        memcpy(v->moved + v->dim * i, v->places[i].at, v->dim * sizeof *v->moved);
    icc_status ran =
        icc_map_apply(v->job.map, v->n_places, v->moved, v->moved, NULL, NULL, &v->job.env);
    return ran == ICC_OK ? DONE : job_failed_status(&v->job, ran);
}

/* Writes an array for each property, with a value for every place. */
static void write_point_data(const vtk *v, FILE *f)
{
    fprintf(f, "POINT_DATA %zu\nSCALARS %s double 1\nLOOKUP_TABLE default\n", v->n_places,
            v->stages.logarithmic ? "log_function" : "function");
    for (size_t i = 0; i < v->n_places; i++)
        fprintf(f, "%.17g\n", v->places[i].function);
    fputs("SCALARS share double 1\nLOOKUP_TABLE default\n", f);
    for (size_t i = 0; i < v->n_places; i++)
        fprintf(f, "%.17g\n", v->places[i].share);
    fputs("SCALARS generation int 1\nLOOKUP_TABLE default\n", f);
    for (size_t i = 0; i < v->n_places; i++)
        fprintf(f, "%d\n", (int)v->places[i].generation);
    fputs("SCALARS inside int 1\nLOOKUP_TABLE default\n", f);
    for (size_t i = 0; i < v->n_places; i++)
        fprintf(f, "%d\n", (int)v->places[i].inside);
    if (v->moved == NULL)
        return;
    fputs("VECTORS displacement double\n", f);
    for (size_t i = 0; i < v->n_places; i++)
        for (size_t k = 0; k < 3; k++) {
            double d = k < v->dim ? v->moved[v->dim * i + k] - v->places[i].at[k] : 0;
            fprintf(f, "%.17g%c", isnan(d) ? 0 : d, k < 2 ? ' ' : '\n');
        }
}

/* Writes the legacy format of version 3.0 as text, because every program that shows VTK files reads
 * it. */
static void write_vtk(const vtk *v, FILE *f)
{
    fprintf(f, "# vtk DataFile Version 3.0\nlibicc %s\nASCII\nDATASET UNSTRUCTURED_GRID\n",
            icc_version());
    fprintf(f, "POINTS %zu double\n", v->n_places);
    for (size_t i = 0; i < v->n_places; i++)
        fprintf(f, "%.17g %.17g %.17g\n", v->places[i].at[0], v->places[i].at[1],
                v->places[i].at[2]);
    fprintf(f, "CELLS %zu %zu\n", v->n_cells, v->n_cells + v->n_corners);
    for (size_t i = 0; i < v->n_cells; i++) {
        fprintf(f, "%zu", v->cells[i].n);
        for (size_t k = 0; k < v->cells[i].n; k++)
            fprintf(f, " %u", (unsigned)v->corners[v->cells[i].first + k]);
        fputc('\n', f);
    }
    fprintf(f, "CELL_TYPES %zu\n", v->n_cells);
    for (size_t i = 0; i < v->n_cells; i++)
        fprintf(f, "%d\n", (int)v->cells[i].type);
    fprintf(f, "CELL_DATA %zu\nSCALARS part int 1\nLOOKUP_TABLE default\n", v->n_cells);
    for (size_t i = 0; i < v->n_cells; i++)
        fprintf(f, "%d\n", (int)v->cells[i].part);
    write_point_data(v, f);
}

/* Makes grid, boundary and curves of one chart, and moves them if there is a map. */
static int make(vtk *v)
{
    job *j = &v->job;
    int result = job_read_cages(j);
    if (result == DONE && job_dim(j) != 2 && job_dim(j) != 3)
        result = failed(j->args->source, 0, "%zu dimensions; a .vtk file has 2 or 3", job_dim(j));
    if (result == DONE && j->cages[0].n_features > 0)
        result =
            failed(j->args->source, 0,
                   "there are holes, lines or points inside; OUT.svg draws them, OUT.vtk does not");
    if (result == DONE)
        result = j->args->target != NULL ? job_make_map(j) : job_make_chart(j);
    if (result == DONE)
        result = stages_make(&v->stages, j, 1);
    if (result != DONE)
        return result;
    v->dim = job_dim(j);
    v->stages.low = v->stages.field != NULL ? v->stages.low : 0;
    add_grid(v);
    add_boundary(v);
    add_curves(v);
    result = move_places(v);
    progress_end(&j->bar);
    return result;
}

int plot_vtk(const args *a)
{
    vtk v = {.dim = 0};
    outfile file;
    double began = seconds_now();
    job_start(&v.job, a);
    int result = make(&v);
    if (result == DONE && !outfile_open(&file, a->operands[0]))
        result = FAILED;
    else if (result == DONE) {
        write_vtk(&v, file.stream);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    if (result == DONE)
        result = report_points(&v.job, v.n_places, 0, seconds_now() - began);
    stages_free(&v.stages);
    free(v.places);
    free(v.cells);
    free(v.corners);
    free(v.moved);
    job_end(&v.job);
    return result;
}
