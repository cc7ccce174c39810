/* Lines of OBJ, or its vertices as points. */
#include "solid/marks.h"

#include "base/allocate.h"
#include "mesh/mesh_file.h"

#include <string.h>

/* The part that a line belongs to, or NULL. Objects count, and groups if there are no objects. */
static const mesh_part *part_of(const mesh_file *m, size_t line)
{
    const mesh_part *found = NULL;
    bool has_objects = false;
    for (size_t i = 0; i < m->n_parts; i++)
        has_objects = has_objects || !m->parts[i].is_group;
    for (size_t i = 0; i < m->n_parts && m->parts[i].first_line <= line; i++)
        found = m->parts[i].is_group && has_objects ? found : &m->parts[i];
    return found;
}

static void add(marks *out, const mesh_file *m, const mesh_part *part, size_t n,
                const uint32_t *vertices)
{
    mark *added =
        marks_add(out, part != NULL ? part->name : "", part != NULL ? part->n_name : 0, 0);
    added->n[0] = n;
    added->points[0] = need(n, 3 * sizeof *added->points[0]);
    for (size_t i = 0; i < n; i++)
        memcpy(added->points[0] + 3 * i, m->points + 3 * (size_t)vertices[i],
               3 * sizeof *m->points);
}

bool marks_read_obj(marks *out, mark_kind kind, const char *text, size_t n, problem *wrong)
{
    mesh_file m;
    bool good = mesh_read(&m, 3, text, n, wrong);
    for (size_t i = 0; good && kind == MARK_LINE && i < m.n_lines; i++)
        add(out, &m, part_of(&m, i), m.line_starts[i + 1] - m.line_starts[i],
            m.line_nodes + m.line_starts[i]);
    for (uint32_t v = 0; good && kind == MARK_POINT && v < m.n_vertices; v++)
        add(out, &m, NULL, 1, &v);
    mesh_free(&m);
    return good;
}
