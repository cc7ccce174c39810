#include "mesh/tally.h"

#include "base/orientation.h"

#include <math.h>

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

void tally_report(const tally *t, const mesh_file *m, const double *images, json *out)
{
    json_open(out, elements_name((int32_t)m->dim), '{');
    json_count(out, "all", t->all);
    json_count(out, "kept", t->kept);
    json_count(out, "inverted", t->inverted);
    json_count(out, "collapsed", t->collapsed);
    json_count(out, "flat_before", t->flat_before);
    json_count(out, "without_image", t->without_image);
    json_open(out, "turned", '[');
    for (size_t i = 0; i < t->all; i++) {
        fate f = fate_of(m, images, i);
        if (f == INVERTED || f == COLLAPSED)
            json_count(out, NULL, i);
    }
    json_close(out, ']');
    json_close(out, '}');
}
