/* Tells whether the mesh of a file lies in the plane. */
#include "mesh/mesh_flat.h"

#include "mesh/element_kinds.h"

#include <math.h>
#include <string.h>

/* True if all faces lie in one plane z = constant, so they enclose nothing. */
static bool is_flat(const mesh_file *m)
{
    for (size_t i = 0; i < m->n_vertices; i++)
        if (m->points[3 * i + 2] < m->points[2] || m->points[3 * i + 2] > m->points[2])
            return false;
    return m->n_triangles > 0;
}

bool mesh_has_bodies(const mesh_file *m)
{
    for (size_t i = 0; i < m->n_elements; i++)
        if (element_kind_find(m->kinds[i])->dim == 3)
            return true;
    return false;
}

/* True if a mesh could not be read in space because its vertices have two coordinates only. */
static bool lacks_height(const mesh_file *m, const problem *wrong)
{
    return (m->n_vertices == 0 && strncmp(wrong->text, "'' is not a finite", 18) == 0) ||
           strstr(wrong->text, "have no property z") != NULL ||
           strncmp(wrong->text, "a mesh of dimension 2", 21) == 0;
}

bool mesh_read_in_own_space(mesh_file *out, const char *text, size_t n, size_t *n_heights,
                            problem *wrong)
{
    problem other;
    bool good = mesh_read(out, 3, text, n, wrong);
    bool flat = good && !mesh_has_bodies(out) && is_flat(out);
    *n_heights = 0;
    if (good ? !flat : !lacks_height(out, wrong))
        return good;
    *n_heights = flat && fabs(out->points[2]) > 0 ? out->n_vertices : 0;
    mesh_free(out);
    return mesh_read(out, 2, text, n, &other) ||
           (good && spoilt(wrong, other.line, "%s", other.text));
}
