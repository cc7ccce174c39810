/* Chooses the plane that cuts a solid, and makes the cut. */
#include "plot/solid_cut.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 20 }; /* of the grid, along the longer side of the cut */

/* ------------------------------------------------------------------- the body */

/* Takes the tetrahedra of the source's domain, or else fills it with tetrahedra. */
static int take_domain(solid *x)
{
    job *j = x->job;
    icc_domain_info info = {.size = sizeof info};
    icc_domain *made[2] = {NULL, NULL};
    const icc_domain *from = j->domains[0];
    const cage *c = &j->cages[0];
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status ran = icc_domain_get_info(from, &info);
    if (info.n_mesh_vertices == 0) {
        ran =
            icc_domain_create(&made[0], 3, c->n, c->points, c->n_facets, c->facets, &j->env, &err);
        if (ran == ICC_OK)
            ran = icc_domain_fill(&made[1], made[0], NULL, &j->env, &err);
        from = made[1];
    }
    if (ran == ICC_OK) {
        icc_domain_get_info(from, &info);
        x->body.n_points = info.n_mesh_vertices;
        x->body.n_tets = info.n_mesh_simplices;
        x->body.points[0] = need(info.n_mesh_vertices, 3 * sizeof(double));
        x->body.tets = need(info.n_mesh_simplices, 4 * sizeof(uint32_t));
        icc_mesh mesh = {.size = sizeof mesh,
                         .n_vertices = x->body.n_points,
                         .vertices = x->body.points[0],
                         .n_cells = x->body.n_tets,
                         .cells = x->body.tets};
        ran = icc_domain_get_mesh(from, &mesh);
        x->body.points[1] = need(info.n_mesh_vertices, 3 * sizeof(double)); /* see map_sheet() */
    }
    icc_domain_free(made[0]);
    icc_domain_free(made[1]);
    return ran == ICC_OK ? DONE : job_failed(j, &err);
}

static int take_map(solid *x, const icc_map_info *info)
{
    body *b = &x->body;
    b->n_points = info->n_vertices;
    b->n_tets = info->n_simplices;
    for (size_t side = 0; side < 2; side++)
        b->points[side] = need(b->n_points, 3 * sizeof(double));
    b->tets = need(b->n_tets, 4 * sizeof *b->tets);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = b->n_points,
                     .vertices = b->points[0],
                     .n_cells = b->n_tets,
                     .cells = b->tets};
    icc_status ran = icc_map_get_mesh(x->job->map, &mesh, b->points[1]);
    return ran == ICC_OK ? DONE : job_failed_status(x->job, ran);
}

static int make_body(solid *x)
{
    job *j = x->job;
    icc_map_info info = {.size = sizeof info};
    icc_map_get_info(j->map, &info);
    x->exact = info.kind == ICC_MAP_MESH;
    x->body.n_vertices = j->cages[0].n;
    x->body.n_faces = j->cages[0].n_facets;
    x->body.faces = j->cages[0].facets;
    for (size_t side = 0; side < 2; side++)
        x->body.vertices[side] = j->cages[side].points;
    return x->exact ? take_map(x, &info) : take_domain(x);
}

/* ------------------------------------------------------------------- the plane */

/* The plane through the middle of the source's box, at right angles to one of the axes. */
static plane middle_plane(const job *j, size_t axis)
{
    icc_domain_info box = {.size = sizeof box};
    plane p = {.normal = {axis == 0, axis == 1, axis == 2}};
    icc_domain_get_info(j->domains[0], &box);
    for (size_t k = 0; k < 3; k++)
        p.at[k] = box.lower[k] + (box.upper[k] - box.lower[k]) / 2;
    return p;
}

/* Chooses the plane: the one in the options, or else the one of three with the largest section. */
static plane choose_plane(const solid *x)
{
    const args *a = x->job->args;
    plane best = middle_plane(x->job, 2);
    const double *normal = a->slice + (a->n_slice == 6 ? 3 : 0);
    double most = 0, size = fmax(fabs(normal[0]), fmax(fabs(normal[1]), fabs(normal[2])));
    if (a->n_slice == 6)
        memcpy(best.at, a->slice, sizeof best.at);
    for (size_t k = 0; k < 3 && a->n_slice > 0; k++) {
        double length = hypot(hypot(normal[0] / size, normal[1] / size), normal[2] / size);
        best.normal[k] = normal[k] / size / length;
    }
    for (size_t axis = 3; axis-- > 0 && a->n_slice == 0;) {
        plane p = middle_plane(x->job, axis);
        corners section = {0};
        cut_sheet(&section, &x->body, &p);
        double area = corners_area(&section);
        best = area > most * 1.001 ? p : best;
        most = fmax(area, most);
        free(section.all);
    }
    return best;
}

/* ------------------------------------------------------------------- the cut */

static double side_length(const cut_corner *a, const cut_corner *b)
{
    double d[3];
    for (size_t k = 0; k < 3; k++)
        d[k] = a->at[0][k] - b->at[0][k];
    return hypot(hypot(d[0], d[1]), d[2]);
}

/* Halves the longest side until none is longer than `most`. Only its length decides if a side is
 * halved, so triangles with a common side get the same points on it. */
static void divide(corners *out, const cut_corner t[3], double most)
{
    size_t at = 0;
    double longest = 0;
    for (size_t k = 0; k < 3; k++) {
        double length = side_length(&t[k], &t[(k + 1) % 3]);
        at = length > longest ? k : at;
        longest = fmax(length, longest);
    }
    if (!(longest > most)) {
        corners_add(out, 3, t);
        return;
    }
    cut_corner middle = t[at], a = t[at], b = t[(at + 1) % 3], c = t[(at + 2) % 3];
    for (size_t k = 0; k < 3; k++)
        middle.at[0][k] = a.at[0][k] / 2 + b.at[0][k] / 2;
    divide(out, (cut_corner[]){a, middle, c}, most);
    divide(out, (cut_corner[]){middle, b, c}, most);
}

/* For maps without a mesh: cuts the sheet into small triangles and maps their corners one by one.
 * Triangles without an image are dropped. */
static int map_sheet(solid *x)
{
    corners fine = {0};
    for (size_t i = 0; i + 2 < x->sheet.n; i += 3)
        divide(&fine, x->sheet.all + i, x->cell / 6);
    double *points = need(fine.n, 3 * sizeof *points);
    free(x->sheet.all);
    x->sheet = fine;
    for (size_t i = 0; i < fine.n; i++)
        memcpy(points + 3 * i, fine.all[i].at[0], 3 * sizeof *points);
    icc_status ran = icc_map_apply(x->job->map, fine.n, points, points, NULL, NULL, &x->job->env);
    for (size_t i = 0; i < fine.n; i++)
        memcpy(fine.all[i].at[1], points + 3 * i, 3 * sizeof *points);
    free(points);
    return ran == ICC_OK ? DONE : job_failed_status(x->job, ran);
}

/* Lays the grid upright, as seen from the front of the plane. */
static void lay_grid(solid *x)
{
    solid_view front = view_make(x->plane.normal);
    memcpy(x->ground, front.axes, sizeof x->ground);
    view_widen(&front, &x->sheet, 0);
    x->cell = fmax(front.box[2] - front.box[0], front.box[3] - front.box[1]) / CELLS;
    for (size_t k = 0; k < 3; k++)
        x->plane.at[k] += front.axes[0][k] * (front.box[0] + front.box[2]) / 2 +
                          front.axes[1][k] * (front.box[1] + front.box[3]) / 2;
}

static int cut(solid *x)
{
    const args *a = x->job->args;
    double facing = 1;
    x->plane = choose_plane(x);
    for (size_t k = 0; k < 3 && a->n_view > 0; k++)
        facing = (k == 0 ? 0 : facing) + a->view[k] * x->plane.normal[k];
    if (!(facing > 0))
        return misused(a->command, "--view must be in front of the plane, where its normal points");
    cut_sheet(&x->sheet, &x->body, &x->plane);
    if (x->sheet.n == 0)
        return failed(a->source, 0, "the plane of --slice misses the shape");
    cut_shell(&x->shell, &x->rim, &x->body, &x->plane);
    lay_grid(x);
    return x->exact ? DONE : map_sheet(x);
}

int solid_make(solid *out, job *j)
{
    *out = (solid){.job = j};
    int result = job_make_map(j);
    if (result == DONE)
        result = make_body(out);
    return result == DONE ? cut(out) : result;
}

void solid_free(solid *x)
{
    for (size_t side = 0; side < 2; side++)
        free(x->body.points[side]);
    free(x->body.tets);
    free(x->sheet.all);
    free(x->shell.all);
    free(x->rim.all);
}
