/* Cuts tetrahedra and triangles by a plane. A corner on the plane counts as in front, so that every
 * corner of a cut lies on an edge that crosses the plane. The map is linear along an edge, so these
 * corners are mapped as exactly as the vertices. */
#include "plot/cut.h"

#include "base/allocate.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

double plane_distance(const plane *p, const double at[3])
{
    double sum = 0;
    for (size_t k = 0; k < 3; k++)
        sum += (at[k] - p->at[k]) * p->normal[k];
    return sum;
}

void corners_add(corners *c, size_t n, const cut_corner *more)
{
    c->all = grow(c->all, &c->room, c->n + n, sizeof *c->all);
    memcpy(c->all + c->n, more, n * sizeof *more);
    c->n += n;
}

/* The place where the edge between two corners on different sides meets the plane. */
static cut_corner between(const plane *p, const cut_corner *a, const cut_corner *b)
{
    double da = plane_distance(p, a->at[0]), db = plane_distance(p, b->at[0]), t = da / (da - db);
    cut_corner c;
    for (size_t side = 0; side < 2; side++)
        for (size_t k = 0; k < 3; k++) {
            c.at[side][k] = a->at[side][k] * (1 - t) + b->at[side][k] * t;
            c.normal[side][k] = a->normal[side][k] * (1 - t) + b->normal[side][k] * t;
        }
    return c;
}

static void cut_tetrahedron(corners *out, const cut_corner from[4], const plane *p)
{
    const cut_corner *front[4], *back[4];
    cut_corner at[6];
    size_t n_front = 0, n_back = 0;
    for (size_t k = 0; k < 4; k++)
        if (plane_distance(p, from[k].at[0]) >= 0)
            front[n_front++] = &from[k];
        else
            back[n_back++] = &from[k];
    if (n_front == 0 || n_back == 0)
        return;
    const cut_corner **one = n_front == 1 ? front : back, **other = n_front == 1 ? back : front;
    if (n_front != 2)
        for (size_t k = 0; k < 3; k++)
            at[k] = between(p, one[0], other[k]);
    else {
        at[0] = at[3] = between(p, front[0], back[0]);
        at[1] = between(p, front[0], back[1]);
        at[2] = at[4] = between(p, front[1], back[1]);
        at[5] = between(p, front[1], back[0]);
    }
    corners_add(out, n_front == 2 ? 6 : 3, at);
}

void cut_sheet(corners *out, const body *b, const plane *p)
{
    for (size_t i = 0; i < b->n_tets; i++) {
        cut_corner from[4] = {{{{0}}, {{0}}}};
        for (size_t k = 0; k < 4; k++)
            for (size_t side = 0; side < 2; side++)
                memcpy(from[k].at[side], b->points[side] + 3 * b->tets[4 * i + k],
                       3 * sizeof(double));
        cut_tetrahedron(out, from, p);
    }
}

/* ------------------------------------------------------------------- the surface */

/* A normal vector of a triangle whose length is twice the area. */
static void stand(const double *a, const double *b, const double *c, double out[3])
{
    for (size_t k = 0; k < 3; k++) {
        size_t i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* On a smooth surface the normal at a vertex is the mean of its faces' normals. Across a crease of
 * 45 degrees or more, each side has its own normal. So every corner of a face averages the faces at
 * its vertex that do not turn away from it. */
typedef struct normals {
    double *of_faces; /* 3 for each face */
    uint32_t *first;  /* the faces at vertex v: at[first[v]] .. at[first[v + 1] - 1] */
    uint32_t *at;
} normals;

static normals make_normals(const body *b, size_t side)
{
    normals n = {.of_faces = need(b->n_faces, 3 * sizeof *n.of_faces),
                 .first = need(b->n_vertices + 2, sizeof *n.first),
                 .at = need(3 * b->n_faces, sizeof *n.at)};
    const double *v = b->vertices[side];
    for (size_t i = 0; i < b->n_faces; i++)
        stand(v + 3 * b->faces[3 * i], v + 3 * b->faces[3 * i + 1], v + 3 * b->faces[3 * i + 2],
              n.of_faces + 3 * i);
    for (size_t i = 0; i < 3 * b->n_faces; i++)
        n.first[b->faces[i] + 2]++;
    for (size_t v1 = 2; v1 < b->n_vertices + 2; v1++)
        n.first[v1] += n.first[v1 - 1];
    for (size_t i = 0; i < 3 * b->n_faces; i++)
        n.at[n.first[b->faces[i] + 1]++] = (uint32_t)(i / 3);
    return n;
}

static void free_normals(normals *n)
{
    free(n->of_faces);
    free(n->first);
    free(n->at);
}

static void normal_at(const normals *n, size_t face, uint32_t vertex, double out[3])
{
    static const double crease = 0.7; /* the cosine */
    const double *own = n->of_faces + 3 * face;
    memset(out, 0, 3 * sizeof *out);
    for (uint32_t i = n->first[vertex]; i < n->first[vertex + 1]; i++) {
        const double *other = n->of_faces + 3 * (size_t)n->at[i];
        if (dot(own, other) >= crease * sqrt(dot(own, own)) * sqrt(dot(other, other)))
            for (size_t k = 0; k < 3; k++)
                out[k] += other[k];
    }
}

static void cut_face(corners *shell, corners *rim, const cut_corner from[3], const plane *p)
{
    cut_corner left[4], crossing[2];
    size_t n = 0, n_crossing = 0;
    for (size_t k = 0; k < 3; k++) {
        const cut_corner *a = &from[k], *b = &from[(k + 1) % 3];
        bool behind = plane_distance(p, a->at[0]) < 0;
        if (behind)
            left[n++] = *a;
        if (behind != (plane_distance(p, b->at[0]) < 0))
            left[n++] = crossing[n_crossing++] = between(p, a, b);
    }
    for (size_t k = 1; k + 1 < n; k++)
        corners_add(shell, 3, (cut_corner[]){left[0], left[k], left[k + 1]});
    if (n_crossing == 2)
        corners_add(rim, 2, crossing);
}

void cut_shell(corners *shell, corners *rim, const body *b, const plane *p)
{
    normals of[2] = {make_normals(b, 0), make_normals(b, 1)};
    for (size_t i = 0; i < b->n_faces; i++) {
        cut_corner from[3];
        for (size_t k = 0; k < 3; k++)
            for (size_t side = 0; side < 2; side++) {
                uint32_t v = b->faces[3 * i + k];
                memcpy(from[k].at[side], b->vertices[side] + 3 * v, 3 * sizeof(double));
                normal_at(&of[side], i, v, from[k].normal[side]);
            }
        cut_face(shell, rim, from, p);
    }
    free_normals(&of[0]);
    free_normals(&of[1]);
}

double corners_area(const corners *c)
{
    double sum = 0;
    for (size_t i = 0; i + 2 < c->n; i += 3) {
        double out[3];
        stand(c->all[i].at[0], c->all[i + 1].at[0], c->all[i + 2].at[0], out);
        sum += sqrt(dot(out, out)) / 2;
    }
    return sum;
}
