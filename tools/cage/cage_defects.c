/* Describes the library's defects by the lines of a cage's file. */
#include "cage/cage_defects.h"

#include "base/allocate.h"

#include <stdio.h>
#include <stdlib.h>

icc_status defects_find(defect_list *out, const cage *c, size_t limit, size_t *n_all,
                        const icc_env *env, icc_error *err)
{
    size_t n = 0;
    *out = (defect_list){0};
    icc_status status = icc_boundary_defects(c->n, c->points, 0, NULL, NULL, &n, env, err);
    if (n_all != NULL)
        *n_all = n;
    if (status != ICC_OK || n == 0)
        return status;
    out->n = limit > 0 && limit < n ? limit : n;
    out->kinds = need(out->n, sizeof *out->kinds);
    out->items = need(out->n, 2 * sizeof *out->items);
    status = icc_boundary_defects(c->n, c->points, out->n, out->kinds, out->items, &n, env, err);
    if (status != ICC_OK)
        defects_free(out);
    return status;
}

bool defects_may_be_more(const defect_list *list, const cage *c)
{
    return list->n >= 10000 + 4 * c->n;
}

void defects_free(defect_list *list)
{
    free(list->kinds);
    free(list->items);
    *list = (defect_list){0};
}

static const char *place(char out[64], const cage *c, uint32_t vertex)
{
    if (c->lines[vertex] > 0)
        snprintf(out, 64, "%u (line %zu)", (unsigned)vertex, c->lines[vertex]);
    else
        snprintf(out, 64, "%u", (unsigned)vertex);
    return out;
}

const char *defect_text(char out[200], const defect_list *list, size_t i, const cage *c)
{
    unsigned a = list->items[2 * i];
    char other[64];
    place(other, c, list->items[2 * i + 1]);
    switch (list->kinds[i]) {
    case ICC_DEFECT_NOT_FINITE:
        snprintf(out, 200, "vertex %u is not finite", a);
        break;
    case ICC_DEFECT_REPEATED:
        snprintf(out, 200,
                 "vertex %u coincides with vertex %s; drop one of them; 'libicc check --repair "
                 "FILE' does",
                 a, other);
        break;
    case ICC_DEFECT_SPIKE:
        snprintf(out, 200,
                 "at vertex %u the boundary runs back over itself; drop the vertex; 'libicc check "
                 "--repair FILE' does",
                 a);
        break;
    case ICC_DEFECT_CROSSING:
        snprintf(out, 200, "the edge from vertex %u crosses the edge from vertex %s; move one", a,
                 other);
        break;
    case ICC_DEFECT_TOUCH:
        snprintf(out, 200, "the edge from vertex %u touches the edge from vertex %s; move one", a,
                 other);
        break;
    default:
        snprintf(out, 200, "the shape has no area");
    }
    return out;
}
