/* Tells whether two surfaces are the same except for motion, size and numbering. One half-edge and
 * its image determine all others (L. Weinberg, A Simple and Efficient Algorithm for Determining
 * Isomorphism of Planar Triply Connected Graphs, 1966). A half-edge from a vertex with the most
 * neighbours is taken. Each possible image of it is followed. */
#include "match/sphere/equal_surfaces.h"

#include "match/sphere/sphere.h"
#include "math/vec.h"

#include <string.h>

/* Largest number of faces visited in all, for each face of a surface. */
enum { MOST_VISITS = 200 };

/* Two lengths of edges count as equal if they differ by less than this share. */
static const double differ = 1e-3;

typedef struct comparison {
    const iccp_half_edges *const *m;
    const double *const *x;
    double scale;     /* makes the second surface as large as the first */
    uint32_t *image;  /* by half-edge of the first; ICCP_NO_EDGE if not known */
    uint32_t *list;   /* half-edges, one of each face whose image is known */
    uint32_t *vertex; /* by vertex of the first: its image */
    size_t n_visits;
} comparison;

static double length_of(const comparison *c, int side, uint32_t h)
{
    const iccp_half_edges *const m = c->m[side];
    return iccp_vec_distance(3, c->x[side] + 3 * (size_t)m->origin[h],
                             c->x[side] + 3 * (size_t)iccp_edge_end(m, h));
}

/* Sets the image of a half-edge, and of the other two half-edges of its face. Returns false if they
 * have other images already, or if numbers of neighbours or lengths differ. */
static bool set(comparison *c, size_t *n, uint32_t h, uint32_t g)
{
    if (c->image[h] != ICCP_NO_EDGE)
        return c->image[h] == g;
    c->list[(*n)++] = h;
    for (int i = 0; i < 3; ++i, h = iccp_after(h), g = iccp_after(g)) {
        const uint32_t v = c->m[0]->origin[h], w = c->m[1]->origin[g];
        const double length = length_of(c, 0, h);
        if (c->m[0]->degree[v] != c->m[1]->degree[w] ||
            !(fabs(c->scale * length_of(c, 1, g) - length) < differ * length))
            return false;
        c->image[h] = g;
        c->vertex[v] = w;
    }
    return true;
}

/* Follows a pair of half-edges to all others. *is_good if neighbours and twins of each half-edge
 * have the right images. Such a map onto a surface with as many faces is one-to-one. Returns the
 * number of faces visited. */
static size_t follow(comparison *c, uint32_t from, uint32_t to, bool *is_good)
{
    const iccp_half_edges *const a = c->m[0], *const b = c->m[1];
    size_t n = 0;
    *is_good = set(c, &n, from, to);
    for (size_t k = 0; k < n && *is_good; ++k) {
        uint32_t h = c->list[k];
        for (int i = 0; i < 3 && *is_good; ++i, h = iccp_after(h))
            *is_good = set(c, &n, a->twin[h], b->twin[c->image[h]]);
    }
    c->n_visits += n;
    return n;
}

static void compare(comparison *c, bool *found, size_t n, const uint32_t *const vertices[2])
{
    const iccp_half_edges *const a = c->m[0];
    const uint32_t n_edges = 3 * (uint32_t)a->n_faces;
    uint32_t from = 0;
    for (uint32_t h = 1; h < n_edges; ++h)
        from = a->degree[a->origin[h]] > a->degree[a->origin[from]] ? h : from;
    memset(c->image, 0xff, n_edges * sizeof *c->image);
    /* The half-edge with the same number is tried first. So a surface that equals the other as
     * numbered keeps its numbering. */
    for (uint32_t k = 0; k < n_edges && !*found && c->n_visits < MOST_VISITS * a->n_faces; ++k) {
        const uint32_t to = (from + k) % n_edges;
        const size_t n_faces = follow(c, from, to, found);
        for (size_t i = 0; i < n; ++i)
            *found = *found && c->vertex[vertices[0][i]] == vertices[1][i];
        for (size_t i = 0; i < n_faces; ++i)
            for (uint32_t h = c->list[i] / 3 * 3, end = h + 3; h < end; ++h)
                c->image[h] = ICCP_NO_EDGE;
    }
}

icc_status iccp_equal_surfaces_find(uint32_t *partner, bool *found,
                                    const iccp_half_edges *const m[2], const double *const x[2],
                                    size_t n, const uint32_t *const vertices[2],
                                    const iccp_memory *memory)
{
    *found = false;
    if (m[0]->n_left != m[1]->n_left || m[0]->n_faces != m[1]->n_faces)
        return ICC_OK;
    comparison c = {.m = m,
                    .x = x,
                    .vertex = partner,
                    .scale = iccp_sphere_scale(m[1], x[1]) / iccp_sphere_scale(m[0], x[0])};
    c.image = iccp_alloc(memory, m[0]->n_faces, 3 * sizeof *c.image);
    c.list = iccp_alloc(memory, m[0]->n_faces, sizeof *c.list);
    const bool has_memory = c.image != NULL && c.list != NULL;
    if (has_memory)
        compare(&c, found, n, vertices);
    iccp_free(memory, c.image);
    iccp_free(memory, c.list);
    return has_memory ? ICC_OK : ICC_ERR_MEMORY;
}
