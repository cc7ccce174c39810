#include "mesh/tally.h"

#include "base/orientation.h"
#include "mesh/mesh_boundary.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* So many numbers are named on stderr; a report has them all. */
enum { MOST_NAMED = 10 };

typedef enum fate { KEPT, INVERTED, COLLAPSED, FLAT_BEFORE, WITHOUT_IMAGE } fate;

static bool has_image(const mesh_file *m, const double *points, const uint32_t *corners)
{
    for (size_t k = 0; k < m->dim * (m->dim + 1); k++)
        if (!isfinite(points[m->dim * corners[k / m->dim] + k % m->dim]))
            return false;
    return true;
}

static int element_sign(const mesh_file *m, const double *points, const uint32_t *corners)
{
    const double *at[4] = {NULL, NULL, NULL, NULL};
    for (size_t k = 0; k <= m->dim; k++)
        at[k] = points + m->dim * corners[k];
    return m->dim == 2 ? orientation(at[0], at[1], at[2])
                       : orientation_3d(at[0], at[1], at[2], at[3]);
}

/* What became of one element. */
static fate fate_of(const mesh_file *m, const double *images, size_t i)
{
    const uint32_t *elements = m->dim == 2 ? m->triangles : m->tetrahedra;
    const uint32_t *corners = elements + (m->dim + 1) * i;
    if (!has_image(m, images, corners))
        return WITHOUT_IMAGE;
    int before = element_sign(m, m->points, corners), after = element_sign(m, images, corners);
    return before == 0 ? FLAT_BEFORE : after == 0 ? COLLAPSED : after == before ? KEPT : INVERTED;
}

static size_t count_elements(const mesh_file *m)
{
    return m->dim == 2 ? m->n_triangles : m->n_tetrahedra;
}

static const uint32_t *all_elements(const mesh_file *m)
{
    return m->dim == 2 ? m->triangles : m->tetrahedra;
}

tally tally_count(const mesh_file *m, const double *images)
{
    tally t = {.all = count_elements(m)};
    for (size_t i = 0; i < t.all; i++) {
        fate f = fate_of(m, images, i);
        t.kept += f == KEPT;
        t.inverted += f == INVERTED;
        t.collapsed += f == COLLAPSED;
        t.flat_before += f == FLAT_BEFORE;
        t.without_image += f == WITHOUT_IMAGE;
    }
    return t;
}

size_t tally_spoilt(const tally *t)
{
    return t->inverted + t->collapsed;
}

static bool is_spoilt(const mesh_file *m, const double *images, size_t i)
{
    fate f = fate_of(m, images, i);
    return f == INVERTED || f == COLLAPSED;
}

/* Whether the boundary alone decides what becomes of an element. */
static bool is_on_boundary(const mesh_file *m, const bool *on, size_t i)
{
    bool all = true;
    for (size_t k = 0; k <= m->dim; k++)
        all = all && on[all_elements(m)[(m->dim + 1) * i + k]];
    return all;
}

static bool *boundary_vertices(const mesh_file *m)
{
    mesh_boundary b;
    mesh_boundary_find(&b, m->dim, count_elements(m), all_elements(m));
    bool *on = mesh_boundary_vertices(&b, m->n_vertices);
    mesh_boundary_free(&b);
    return on;
}

void tally_print(const tally *t, const mesh_file *m, char *text, size_t room)
{
    if (m->dim == 3 && t->all == 0) {
        snprintf(text, room, "%zu face%s carried; only tetrahedra can be certified", m->n_faces,
                 m->n_faces == 1 ? "" : "s");
        return;
    }
    snprintf(text, room,
             "%zu %s: %zu keep their orientation, %zu inverted, %zu collapsed, %zu flat "
             "before, %zu without image",
             t->all, elements_name((int32_t)m->dim), t->kept, t->inverted, t->collapsed,
             t->flat_before, t->without_image);
}

/* The numbers of all; with `on` of those whose corners are all on the boundary. */
static void list_spoilt(const mesh_file *m, const double *images, const bool *on, const char *name,
                        json *out)
{
    json_open(out, name, '[');
    for (size_t i = 0; i < count_elements(m); i++)
        if (is_spoilt(m, images, i) && (on == NULL || is_on_boundary(m, on, i)))
            json_count(out, NULL, i);
    json_close(out, ']');
}

void tally_report(const tally *t, const mesh_file *m, const double *images, json *out)
{
    json_open(out, elements_name((int32_t)m->dim), '{');
    json_count(out, "all", t->all);
    json_count(out, "kept", t->kept);
    json_count(out, "inverted", t->inverted);
    json_count(out, "collapsed", t->collapsed);
    json_count(out, "flat_before", t->flat_before);
    json_count(out, "without_image", t->without_image);
    list_spoilt(m, images, NULL, "turned", out);
    bool *on = boundary_vertices(m);
    list_spoilt(m, images, on, "turned_on_boundary", out);
    free(on);
    json_close(out, '}');
}

/* The first numbers of those that are on the boundary, or not, and how many there are. */
static size_t name_spoilt(char *text, size_t room, const mesh_file *m, const double *images,
                          const bool *on, bool wanted)
{
    size_t n = 0, used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < count_elements(m); i++) {
        if (!is_spoilt(m, images, i) || is_on_boundary(m, on, i) != wanted)
            continue;
        if (++n <= MOST_NAMED)
            used += (size_t)snprintf(text + used, room - used, "%s%zu", n > 1 ? ", " : "", i);
        else if (n == MOST_NAMED + 1)
            snprintf(text + used, room - used, ", ..");
    }
    return n;
}

void tally_tell(const tally *t, const mesh_file *m, const double *images, const char *name,
                const char *inner)
{
    if (tally_spoilt(t) == 0)
        return;
    char numbers[256];
    bool *on = boundary_vertices(m);
    for (int wanted = 1; wanted >= 0; wanted--) {
        size_t n = name_spoilt(numbers, sizeof numbers, m, images, on, wanted == 1);
        if (n > 0)
            note("%s: %zu of %zu %s %s inverted or collapsed (numbers from 0: %s): %s", name, n,
                 t->all, elements_name((int32_t)m->dim), n == 1 ? "is" : "are", numbers,
                 wanted == 0 ? inner
                 : m->dim == 2
                     ? "all three corners lie on the boundary of the mesh, whose images stay"
                     : "all four corners lie on the boundary of the mesh, whose images stay");
    }
    free(on);
}
