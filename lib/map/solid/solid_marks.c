/* Lists marked facets and edges by their fixed points. */
#include "map/solid/solid_marks.h"

#include "base/sort.h"
#include "domain/features.h"

#include <string.h>

/* Lists the pieces of all lines. The points on segments are in the order of the segments. */
static void list_pieces(iccp_solid_marks *marks, const icc_domain *domain,
                        const iccp_simplices *mesh)
{
    size_t next = 0;
    for (size_t f = 0; f < domain->features->n; ++f) {
        const iccp_feature *line = &domain->features->item[f];
        for (uint32_t i = 1; i < line->n && line->kind == ICC_FEATURE_LINE; ++i) {
            const uint32_t a = line->first + i - 1, b = line->first + i;
            uint32_t last = a;
            for (; next < mesh->n_on_lines && mesh->on_line[next].a == a &&
                   mesh->on_line[next].b == b;
                 ++next) {
                marks->edges[2 * marks->n_edges] = last;
                marks->edges[2 * marks->n_edges++ + 1] = last = mesh->on_line[next].point;
            }
            marks->edges[2 * marks->n_edges] = last;
            marks->edges[2 * marks->n_edges++ + 1] = b;
        }
    }
}

icc_status iccp_solid_marks_create(iccp_solid_marks *marks, const icc_domain *domain,
                                   const iccp_simplices *mesh, const iccp_memory *memory)
{
    iccp_solid_marks *m = marks;
    *m = (iccp_solid_marks){.memory = *memory,
                            .n_fixed = domain->n_vertices + mesh->n_on_lines,
                            .n_facets = iccp_domain_n_listed(domain),
                            .facets = domain->facets};
    if (domain->features == NULL)
        return ICC_OK;
    const size_t n_most = m->n_fixed;
    m->edges = iccp_alloc(memory, n_most, 2 * sizeof *m->edges);
    m->edge = iccp_alloc(memory, n_most, 2 * sizeof *m->edge);
    m->facet = iccp_alloc(memory, m->n_facets, 3 * sizeof *m->facet);
    m->first_edge = iccp_alloc_zero(memory, m->n_fixed + 1, sizeof *m->first_edge);
    m->first_facet = iccp_alloc_zero(memory, m->n_fixed + 1, sizeof *m->first_facet);
    if (m->edges == NULL || m->edge == NULL || m->facet == NULL || m->first_edge == NULL ||
        m->first_facet == NULL) {
        iccp_solid_marks_free(m);
        return ICC_ERR_MEMORY;
    }
    list_pieces(m, domain, mesh);
    iccp_list_groups(m->facet, m->first_facet, m->n_fixed, m->facets, m->n_facets, 3);
    iccp_list_groups(m->edge, m->first_edge, m->n_fixed, m->edges, m->n_edges, 2);
    return ICC_OK;
}

void iccp_solid_marks_free(iccp_solid_marks *marks)
{
    const iccp_memory memory = marks->memory;
    iccp_free(&memory, marks->edges);
    iccp_free(&memory, marks->edge);
    iccp_free(&memory, marks->facet);
    iccp_free(&memory, marks->first_edge);
    iccp_free(&memory, marks->first_facet);
    *marks = (iccp_solid_marks){.memory = memory};
}

static bool has(const uint32_t *facet, uint32_t point)
{
    return facet[0] == point || facet[1] == point || facet[2] == point;
}

/* Returns true if a facet contains three points, of which two may be equal. */
static bool has_facet(const iccp_solid_marks *m, uint32_t a, uint32_t b, uint32_t c)
{
    for (uint32_t k = m->first_facet[a]; k < m->first_facet[a + 1]; ++k) {
        const uint32_t *facet = m->facets + 3 * (size_t)m->facet[k];
        if (has(facet, b) && has(facet, c))
            return true;
    }
    return false;
}

bool iccp_solid_keeps_edge(const iccp_solid_marks *marks, uint32_t a, uint32_t b)
{
    if (marks->first_facet == NULL || a >= marks->n_fixed || b >= marks->n_fixed)
        return false;
    for (uint32_t k = marks->first_edge[a]; k < marks->first_edge[a + 1]; ++k) {
        const uint32_t *piece = marks->edges + 2 * (size_t)marks->edge[k];
        if (piece[0] == b || piece[1] == b)
            return true;
    }
    return has_facet(marks, a, b, b);
}

bool iccp_solid_keeps_face(const iccp_solid_marks *marks, const uint32_t face[3])
{
    for (size_t k = 0; k < 3; ++k)
        if (marks->first_facet == NULL || face[k] >= marks->n_fixed)
            return false;
    return has_facet(marks, face[0], face[1], face[2]);
}
