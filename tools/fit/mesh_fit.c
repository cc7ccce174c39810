/* Told vertices of a mesh. Vertices of the boundary that are not told stay where they are, unless
 * an option lets them slide along straight walls or move anywhere. */
#include "fit/mesh_fit.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "base/system.h"
#include "fit/fit_job.h"
#include "fit/moves_file.h"
#include "job/fit_cages.h"
#include "mesh/element_kinds.h"
#include "mesh/mesh_boundary.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* The share of the remaining time that making a map takes. */
static const double MADE = 0.9;

/* A point this far from a vertex, as a share of the mesh's size, means the vertex. */
static const double SAME_PLACE = 1e-6;

/* The faces of a file as a mesh that has no other vertices. */
typedef struct faces {
    icc_mesh mesh;
    double *points;
    uint32_t *triangles;
    uint32_t *place;  /* of each vertex of the file: its number in the mesh, or NONE */
    uint32_t *origin; /* and back */
    uint32_t *cells;  /* triangles and quadrilaterals, or NULL if there is anything else */
    size_t *offsets;
    size_t n_cells;
} faces;

/* Whether all elements of a file are triangles and quadrilaterals, with some of the latter. */
static bool has_quads_alone(const mesh_file *m)
{
    size_t n_quads = 0;
    for (size_t e = 0; e < m->n_elements; e++) {
        const size_t n = m->node_starts[e + 1] - m->node_starts[e];
        const int kind = m->kinds[e];
        const bool is_quad = n == 4 && (kind == ELEMENT_QUADRILATERAL || kind == ELEMENT_POLYGON);
        if (!is_quad && !(n == 3 && (kind == ELEMENT_TRIANGLE || kind == ELEMENT_POLYGON)))
            return false;
        n_quads += is_quad;
    }
    return n_quads > 0;
}

/* Takes quadrilaterals whole, because a fit then keeps all their corners. */
static void take_quads(faces *f, const mesh_file *m)
{
    if (!has_quads_alone(m))
        return;
    const size_t n = m->n_elements;
    f->cells = need(m->node_starts[n], sizeof *f->cells);
    f->offsets = need(n + 1, sizeof *f->offsets);
    f->n_cells = n;
    memcpy(f->offsets, m->node_starts, (n + 1) * sizeof *f->offsets);
    for (size_t i = 0; i < m->node_starts[n]; i++)
        f->cells[i] = f->place[m->nodes[i]];
}

static faces take_faces(const mesh_file *m)
{
    faces f = {.mesh = {.size = sizeof f.mesh, .dim = 2, .n_cells = m->n_triangles}};
    f.points = need(m->n_vertices, 2 * sizeof *f.points);
    f.triangles = need(m->n_triangles, 3 * sizeof *f.triangles);
    f.place = need(m->n_vertices, sizeof *f.place);
    f.origin = need(m->n_vertices, sizeof *f.origin);
    for (size_t i = 0; i < m->n_vertices; i++)
        f.place[i] = NONE;
    for (size_t i = 0; i < 3 * m->n_triangles; i++)
        f.place[m->triangles[i]] = 0;
    for (size_t i = 0; i < m->n_vertices; i++)
        if (f.place[i] != NONE) {
            f.place[i] = (uint32_t)f.mesh.n_vertices;
            f.origin[f.mesh.n_vertices] = (uint32_t)i;
            memcpy(f.points + 2 * f.mesh.n_vertices++, m->points + 2 * i, 2 * sizeof *f.points);
        }
    for (size_t i = 0; i < m->n_triangles; i++) {
        const uint32_t *t = m->triangles + 3 * i;
        const double *x = m->points;
        bool turned = orientation(x + 2 * t[0], x + 2 * t[1], x + 2 * t[2]) < 0;
        for (size_t k = 0; k < 3; k++)
            f.triangles[3 * i + k] = f.place[t[turned ? 2 - k : k]];
    }
    f.mesh.vertices = f.points;
    f.mesh.cells = f.triangles;
    take_quads(&f, m);
    return f;
}

static void free_faces(faces *f)
{
    free(f->points);
    free(f->triangles);
    free(f->place);
    free(f->origin);
    free(f->cells);
    free(f->offsets);
}

/* Takes the images of the file's vertices from the map. Vertices of no face stay. */
static void take_images(const job *j, const faces *f, const mesh_file *m, double *images)
{
    icc_map_info info = {.size = sizeof info};
    icc_map_get_info(j->map, &info);
    double *points = need(info.n_vertices, 2 * sizeof *points);
    double *own = need(info.n_vertices, 2 * sizeof *own);
    uint32_t *cells = need(info.n_simplices, 3 * sizeof *cells);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = info.n_vertices,
                     .vertices = points,
                     .n_cells = info.n_simplices,
                     .cells = cells};
    icc_map_get_mesh(j->map, &mesh, own);
    memcpy(images, m->points, m->n_vertices * 2 * sizeof *images);
    for (size_t i = 0; i < f->mesh.n_vertices; i++)
        memcpy(images + 2 * (size_t)f->origin[i], own + 2 * i, 2 * sizeof *images);
    free(points);
    free(own);
    free(cells);
}

/* ------------------------------------------------------------- constraints */

typedef enum fate { FREE = 0, TOLD, SLIDES } fate;

typedef struct told {
    const faces *faces;
    moves moves;
    fate *fates;        /* of each vertex */
    double *to;         /* of those told */
    double *directions; /* of those that slide */
    size_t *lines;      /* 0: not in the file */
    size_t n_inner;     /* points that are no vertices */
    double *inner, *inner_to;
    size_t *inner_lines;
    size_t n_items;
    size_t *item_lines; /* of all items of all constraints */
} told;

static told start_told(const faces *f)
{
    size_t n = f->mesh.n_vertices;
    return (told){.faces = f,
                  .fates = need(n, sizeof(fate)),
                  .to = need(n, 2 * sizeof(double)),
                  .directions = need(n, 2 * sizeof(double)),
                  .lines = need(n, sizeof(size_t))};
}

static void free_told(told *t)
{
    moves_free(&t->moves);
    free(t->fates);
    free(t->to);
    free(t->directions);
    free(t->lines);
    free(t->inner);
    free(t->inner_to);
    free(t->inner_lines);
    free(t->item_lines);
}

static void tell(told *t, uint32_t v, const double *to, size_t line)
{
    t->fates[v] = isnan(to[0]) ? SLIDES : TOLD;
    memcpy(t->to + 2 * (size_t)v, to, 2 * sizeof *to);
    t->lines[v] = line;
}

static int take_numbered(told *t, const char *name)
{
    for (size_t i = 0; i < t->moves.n; i++) {
        uint32_t v = t->faces->place[t->moves.vertices[i]];
        if (v == NONE)
            return failed(name, t->moves.lines[i], "vertex %u belongs to no face",
                          (unsigned)t->moves.vertices[i]);
        tell(t, v, t->moves.to + 2 * i, t->moves.lines[i]);
    }
    return DONE;
}

static double size_of(const faces *f)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 2 * f->mesh.n_vertices; i++) {
        lower[i % 2] = fmin(lower[i % 2], f->points[i]);
        upper[i % 2] = fmax(upper[i % 2], f->points[i]);
    }
    return fmax(upper[0] - lower[0], upper[1] - lower[1]);
}

/* The vertex at a point, or NONE. */
static uint32_t vertex_at(const faces *f, const double *point, double most)
{
    uint32_t at = NONE;
    for (size_t i = 0; i < f->mesh.n_vertices; i++) {
        double d = hypot(f->points[2 * i] - point[0], f->points[2 * i + 1] - point[1]);
        if (d <= most) {
            most = d;
            at = (uint32_t)i;
        }
    }
    return at;
}

/* Points at vertices mean these. Others are carried between the vertices. */
static int take_points(told *t, const char *name)
{
    const control_points *c = &t->moves.points;
    double most = SAME_PLACE * size_of(t->faces);
    t->inner = need(c->n, 2 * sizeof *t->inner);
    t->inner_to = need(c->n, 2 * sizeof *t->inner_to);
    t->inner_lines = need(c->n, sizeof *t->inner_lines);
    for (size_t i = 0; i < c->n; i++) {
        uint32_t v = vertex_at(t->faces, c->from + 2 * i, most);
        if (v != NONE && t->lines[v] > 0)
            return failed(name, c->lines[i], "this vertex is in line %zu already", t->lines[v]);
        if (v != NONE) {
            tell(t, v, c->to + 2 * i, c->lines[i]);
            continue;
        }
        memcpy(t->inner + 2 * t->n_inner, c->from + 2 * i, 2 * sizeof *t->inner);
        memcpy(t->inner_to + 2 * t->n_inner, c->to + 2 * i, 2 * sizeof *t->inner_to);
        t->inner_lines[t->n_inner++] = c->lines[i];
    }
    return DONE;
}

/* Sets the direction of the wall at a vertex. False if it is not straight there. */
static bool take_wall(told *t, uint32_t v, uint32_t before, uint32_t after)
{
    const double *x = t->faces->points, *a = x + 2 * (size_t)before, *b = x + 2 * (size_t)after;
    t->directions[2 * v] = b[0] - a[0];
    t->directions[2 * v + 1] = b[1] - a[1];
    return fit_is_straight(a, x + 2 * (size_t)v, b);
}

/* Decides about a vertex of the boundary. */
static int settle_vertex(told *t, const job *j, uint32_t v, uint32_t before, uint32_t after)
{
    bool is_straight = take_wall(t, v, before, after);
    if (t->fates[v] == SLIDES && !is_straight)
        return failed(j->args->moves, t->lines[v],
                      "this vertex cannot slide: the boundary has a corner there");
    if (t->fates[v] != FREE || j->args->frees)
        return DONE;
    if (j->args->slides && is_straight)
        t->fates[v] = SLIDES;
    else
        tell(t, v, t->faces->points + 2 * (size_t)v, 0);
    return DONE;
}

static int settle_boundary(told *t, const job *j)
{
    size_t n = t->faces->mesh.n_vertices;
    mesh_boundary b;
    uint32_t *next = need(n, sizeof *next), *last = need(n, sizeof *last);
    mesh_boundary_find(&b, 2, t->faces->mesh.n_cells, t->faces->triangles);
    for (size_t v = 0; v < n; v++)
        next[v] = last[v] = NONE;
    for (size_t i = 0; i < b.n; i++) {
        next[b.facets[2 * i]] = b.facets[2 * i + 1];
        last[b.facets[2 * i + 1]] = b.facets[2 * i];
    }
    int result = DONE;
    for (uint32_t v = 0; v < n && result == DONE; v++)
        if (next[v] != NONE && last[v] != NONE)
            result = settle_vertex(t, j, v, last[v], next[v]);
        else if (t->fates[v] == SLIDES)
            result = failed(j->args->moves, t->lines[v],
                            "this vertex cannot slide: it is not on the boundary");
    mesh_boundary_free(&b);
    free(next);
    free(last);
    return result;
}

/* Lists the vertices of one fate, with their places or their directions. */
static icc_constraint list(told *t, fate of, const double *values, uint32_t *vertices,
                           double *listed)
{
    size_t n = 0;
    for (size_t v = 0; v < t->faces->mesh.n_vertices; v++)
        if (t->fates[v] == of) {
            vertices[n] = (uint32_t)v;
            memcpy(listed + 2 * n++, values + 2 * v, 2 * sizeof *listed);
            t->item_lines[t->n_items++] = t->lines[v];
        }
    return (icc_constraint){.size = sizeof(icc_constraint),
                            .kind = of == TOLD ? ICC_CONSTRAINT_VERTICES : ICC_CONSTRAINT_SLIDING,
                            .n = n,
                            .vertices = vertices,
                            .target = of == TOLD ? listed : NULL,
                            .direction = of == TOLD ? NULL : listed};
}

static icc_status create(told *t, job *j, icc_error *err)
{
    const args *a = j->args;
    size_t n = t->faces->mesh.n_vertices, n_lists = 0;
    uint32_t *vertices[2] = {need(n, sizeof **vertices), need(n, sizeof **vertices)};
    double *values[2] = {need(n, 2 * sizeof **values), need(n, 2 * sizeof **values)};
    t->item_lines = need(n + t->n_inner, sizeof *t->item_lines);
    icc_constraint lists[3] = {list(t, TOLD, t->to, vertices[0], values[0])};
    n_lists += lists[0].n > 0;
    lists[n_lists] = list(t, SLIDES, t->directions, vertices[1], values[1]);
    n_lists += lists[n_lists].n > 0;
    for (size_t i = 0; i < t->n_inner; i++)
        t->item_lines[t->n_items++] = t->inner_lines[i];
    if (t->n_inner > 0)
        lists[n_lists++] = (icc_constraint){.size = sizeof *lists,
                                            .kind = ICC_CONSTRAINT_POINTS,
                                            .n = t->n_inner,
                                            .source = t->inner,
                                            .target = t->inner_to};
    const icc_fit_options options = {.size = sizeof options,
                                     .model = ICC_FIT_ELASTIC,
                                     .reach = a->reach,
                                     .stiffness = a->stiffness};
    icc_mesh mesh = t->faces->mesh;
    if (t->faces->cells != NULL) {
        mesh.n_cells = t->faces->n_cells;
        mesh.cells = t->faces->cells;
        mesh.offsets = t->faces->offsets;
    }
    progress_expect(&j->bar, MADE);
    icc_status status =
        icc_fit_create(&j->fit, NULL, &mesh, n_lists, lists, &options, &j->env, err);
    for (size_t i = 0; i < 2; i++) {
        free(vertices[i]);
        free(values[i]);
    }
    return status;
}

/* The file and the line of an error: those of a move, or the mesh. */
static int refused(const told *t, job *j, const icc_error *err)
{
    bool of_move = err->item == ICC_ITEM_POINT && err->index >= 0 &&
                   (uint64_t)err->index < t->n_items && t->item_lines[err->index] > 0;
    return fit_failed(j, of_move ? j->args->moves : j->args->operands[0],
                      of_move ? t->item_lines[err->index] : 0, err);
}

/* Names the told items that are not at their places. */
static int tell_off(const told *t, job *j)
{
    icc_fit_info info = {.size = sizeof info};
    icc_fit_get_info(j->fit, &info);
    progress_end(&j->bar);
    if (info.n_off == 0)
        return DONE;
    double *residuals = need(info.n_items, 2 * sizeof *residuals);
    icc_fit_get_residuals(j->fit, residuals, NULL);
    size_t worst = 0;
    for (size_t i = 0; i < info.n_items; i++)
        if (hypot(residuals[2 * i], residuals[2 * i + 1]) >
            hypot(residuals[2 * worst], residuals[2 * worst + 1]))
            worst = i;
    size_t line = t->item_lines[worst];
    char where[40] = "";
    if (line > 0)
        snprintf(where, sizeof where, " (line %zu)", line);
    note("%s: %zu vertices are not at their places, up to %g off%s, because the mesh would fold or "
         "overlap on the way",
         j->args->moves, info.n_off, info.most_off, where);
    free(residuals);
    return PARTIAL;
}

static int make(told *t, job *j, const mesh_file *m, double *images)
{
    icc_error err = {.size = sizeof err, .index = -1};
    double began = seconds_now();
    if (create(t, j, &err) != ICC_OK)
        return refused(t, j, &err);
    j->map = (icc_map *)(uintptr_t)icc_fit_map(j->fit);
    j->seconds_made = seconds_now() - began;
    take_images(j, t->faces, m, images);
    int result = fit_take_cages(j);
    return result == DONE ? tell_off(t, j) : result;
}

/* A mesh in the plane with faces. */
static int check_mesh(const job *j, const mesh_file *m)
{
    const char *name = j->args->operands[0];
    if (m->dim != 2)
        return failed(name, 0, "--%s is for meshes in the plane",
                      j->args->moves != NULL ? "fit" : "nearest");
    return m->n_triangles > 0 ? DONE : failed(name, 0, "there are no faces");
}

int mesh_fit(job *j, const mesh_file *m, double *images)
{
    int result = check_mesh(j, m);
    if (result != DONE)
        return result;
    faces f = take_faces(m);
    told t = start_told(&f);
    result = moves_read(&t.moves, j->args->moves, m->n_vertices);
    if (result == DONE)
        result = take_numbered(&t, j->args->moves);
    if (result == DONE)
        result = take_points(&t, j->args->moves);
    if (result == DONE)
        result = settle_boundary(&t, j);
    if (result == DONE)
        result = make(&t, j, m, images);
    free_told(&t);
    free_faces(&f);
    return result;
}

/* ----------------------------------------------------------------- nearest */

static int read_warped(const job *j, const mesh_file *m, mesh_file *warped)
{
    const char *name = j->args->nearest;
    size_t n;
    char *text = file_read_shape(name, &n);
    *warped = (mesh_file){.dim = 2};
    if (text == NULL)
        return FAILED;
    problem wrong;
    bool good = mesh_read(warped, 2, text, n, &wrong);
    int result = good ? DONE : failed(name, wrong.line, "%s", wrong.text);
    if (good && warped->n_vertices != m->n_vertices)
        result = failed(name, 0, "%zu vertices, but %s has %zu; they correspond one by one",
                        warped->n_vertices, j->args->operands[0], m->n_vertices);
    free(text);
    return result;
}

static void print_nearest(const job *j, const icc_nearest_report *r)
{
    static const char *const ways[] = {"nothing folded, so nothing has changed", NULL,
                                       "all of it was mapped anew"};
    char text[160];
    if (r->repair == ICC_REPAIR_PATCHES)
        snprintf(text, sizeof text, "%zu patch%s with %.3g %% of the area %s mapped anew",
                 r->n_patches, r->n_patches == 1 ? "" : "es", 100 * r->changed,
                 r->n_patches == 1 ? "was" : "were");
    else
        snprintf(text, sizeof text, "%s", ways[r->repair]);
    if (r->repair == ICC_REPAIR_NONE)
        note("%s: %s", j->args->nearest, text);
    else
        note("%s: %zu faces folded; %s, and the vertices moved by %.3g (root mean square), %.3g at "
             "most",
             j->args->nearest, r->n_folded, text, r->moved, r->most_moved);
}

static int make_nearest(job *j, const faces *f, const mesh_file *m, const mesh_file *warped,
                        double *images)
{
    icc_error err = {.size = sizeof err, .index = -1};
    icc_nearest_report made = {.size = sizeof made};
    double *own = need(f->mesh.n_vertices, 2 * sizeof *own);
    for (size_t i = 0; i < f->mesh.n_vertices; i++)
        memcpy(own + 2 * i, warped->points + 2 * (size_t)f->origin[i], 2 * sizeof *own);
    progress_expect(&j->bar, MADE);
    icc_status status = icc_map_create_nearest(&j->map, &f->mesh, own, NULL, &made, &j->env, &err);
    free(own);
    if (status != ICC_OK)
        return fit_failed(j, err.side == 1 ? j->args->operands[0] : j->args->nearest, 0, &err);
    take_images(j, f, m, images);
    int result = fit_take_cages(j);
    progress_end(&j->bar);
    if (result == DONE)
        print_nearest(j, &made);
    return result;
}

int mesh_nearest(job *j, const mesh_file *m, double *images)
{
    mesh_file warped = {.dim = 2};
    int result = check_mesh(j, m);
    if (result == DONE)
        result = read_warped(j, m, &warped);
    if (result == DONE) {
        faces f = take_faces(m);
        result = make_nearest(j, &f, m, &warped, images);
        free_faces(&f);
    }
    mesh_free(&warped);
    return result;
}
