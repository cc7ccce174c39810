/* Finds the links of a mesh by walking round its faces of dimension dim - 2. */
#include "shelling/links.h"

#include <stdbool.h>

#define NONE UINT32_MAX

/* Simplices between calls of the progress callback. */
enum { SIMPLICES_PER_REPORT = 1 << 14 };

typedef struct walk {
    const iccp_simplices *mesh;
    uint32_t *facet;   /* of each side: its number among iccp_links' facets, or NONE */
    uint32_t *visited; /* of each simplex: bit (a, b) marks its face without the corners a and b */
} walk;

static uint32_t pair_bit(size_t a, size_t b)
{
    return (uint32_t)1 << (a < b ? a + b * (b - 1) / 2 : b + a * (a - 1) / 2);
}

static bool touches(const iccp_simplices *mesh, size_t side, uint32_t vertex)
{
    const size_t first = side - side % (mesh->dim + 1);
    for (size_t s = first; s <= first + mesh->dim; ++s)
        if (s != side && mesh->corners[s] == vertex)
            return true;
    return false;
}

/* Numbers the facets between simplices in the order of the smaller of their sides. Facets on the
 * domain's boundary or within the star get NONE. */
static void number_facets(iccp_links *links, const walk *w, uint32_t centre)
{
    const iccp_simplices *mesh = w->mesh;
    for (uint32_t s = 0; s < (mesh->dim + 1) * mesh->n_simplices; ++s) {
        const uint32_t other = mesh->across[s];
        if ((other & ICCP_ON_BOUNDARY) != 0 || (other > s && touches(mesh, s, centre))) {
            w->facet[s] = NONE;
        } else if (other > s) {
            w->facet[s] = (uint32_t)links->n_facets;
            links->side[links->n_facets++] = s;
        } else {
            w->facet[s] = w->facet[other];
        }
    }
}

/* Writes the steps round the face of a simplex without the corners `out` and `in`. The walk
 * begins through the side opposite `out`. Returns the number of steps, or 0 if the walk reaches
 * the boundary or the face was visited before. */
static size_t walk_round_face(const walk *w, size_t simplex, size_t out, size_t in, uint32_t *step)
{
    const iccp_simplices *mesh = w->mesh;
    const size_t start = simplex, n_corners = mesh->dim + 1;
    size_t n = 0;
    while ((w->visited[simplex] & pair_bit(out, in)) == 0) {
        w->visited[simplex] |= pair_bit(out, in);
        const uint32_t side = (uint32_t)(n_corners * simplex + out), other = mesh->across[side];
        if ((other & ICCP_ON_BOUNDARY) != 0)
            return 0;
        if (w->facet[side] != NONE)
            step[n++] = 2 * w->facet[side] + (other < side);
        const uint32_t behind = mesh->corners[n_corners * simplex + in];
        simplex = iccp_simplex_of(mesh, other);
        in = other % n_corners;
        for (out = 0; mesh->corners[n_corners * simplex + out] != behind;)
            ++out;
    }
    return simplex == start ? n : 0;
}

/* Tries to walk round every face that a simplex has without two of its corners. `visited` stops
 * all but the first try at each face. */
static icc_status find_links(iccp_links *links, const walk *w, const iccp_env *env)
{
    const iccp_simplices *mesh = w->mesh;
    icc_status status = ICC_OK;
    links->first[0] = 0;
    for (size_t t = 0; t < mesh->n_simplices && status == ICC_OK; ++t) {
        if (t % SIMPLICES_PER_REPORT == 0)
            status = iccp_progress(env, "order", (double)t / (double)mesh->n_simplices);
        for (size_t b = 1; b <= mesh->dim; ++b)
            for (size_t a = 0; a < b; ++a) {
                const size_t end = links->first[links->n];
                const size_t n_steps = walk_round_face(w, t, a, b, links->step + end);
                if (n_steps > 0)
                    links->first[++links->n] = end + n_steps;
            }
    }
    return status;
}

/* There are at most as many steps as faces of simplices, and a link has at least two steps. */
static icc_status allocate(iccp_links *links, walk *w, const iccp_env *env)
{
    const iccp_simplices *mesh = w->mesh;
    const size_t n_sides = (mesh->dim + 1) * mesh->n_simplices, n_steps = n_sides * mesh->dim / 2;
    *links = (iccp_links){.memory = env->memory};
    links->side = iccp_alloc(&env->memory, n_sides / 2, sizeof *links->side);
    links->first = iccp_alloc(&env->memory, n_steps / 2 + 1, sizeof *links->first);
    links->step = iccp_alloc(&env->memory, n_steps, sizeof *links->step);
    w->facet = iccp_alloc(&env->memory, n_sides, sizeof *w->facet);
    w->visited = iccp_alloc_zero(&env->memory, mesh->n_simplices, sizeof *w->visited);
    return links->side != NULL && links->first != NULL && links->step != NULL && w->facet != NULL &&
                   w->visited != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

icc_status iccp_links_create(iccp_links *links, const iccp_simplices *mesh, uint32_t centre,
                             const iccp_env *env)
{
    walk w = {.mesh = mesh};
    icc_status status = allocate(links, &w, env);
    if (status == ICC_OK) {
        number_facets(links, &w, centre);
        status = find_links(links, &w, env);
    }
    iccp_free(&env->memory, w.facet);
    iccp_free(&env->memory, w.visited);
    if (status != ICC_OK)
        iccp_links_free(links);
    return status;
}

void iccp_links_free(iccp_links *links)
{
    iccp_free(&links->memory, links->side);
    iccp_free(&links->memory, links->first);
    iccp_free(&links->memory, links->step);
    *links = (iccp_links){.memory = links->memory};
}
