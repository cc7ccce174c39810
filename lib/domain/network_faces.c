/* Pieces, walks and faces. A face has one walk for each piece at its border. All walks but one of a
 * piece go around faces of their own. The other one, the outer walk, belongs to the face around the
 * piece. The half-side just below the first node of the piece tells which that is. */
#include "domain/network_faces.h"

static const uint32_t NONE = UINT32_MAX;

typedef struct faces {
    iccp_network *net;
    const icc_domain *domain;
    const iccp_graph *graph;
    const int32_t *left;
    const uint32_t *below;
    uint32_t *walk; /* by half-side */
    uint32_t *root; /* by walk: the walk that stands for its face, or NONE outside all rings */
    uint32_t *stack;
} faces;

/* ---- pieces ---- */

/* Gives a number to all nodes that sides connect with v. */
static void flood(const faces *s, uint32_t v, uint32_t number)
{
    iccp_network *net = s->net;
    size_t n = 0;
    s->stack[n++] = v;
    net->piece[v] = number;
    while (n > 0) {
        const uint32_t u = s->stack[--n];
        for (uint32_t i = net->first[u]; i < net->first[u + 1]; ++i) {
            const uint32_t w = iccp_network_origin(net, s->domain, net->leaving[i] ^ 1);
            if (net->piece[w] == NONE) {
                net->piece[w] = number;
                s->stack[n++] = w;
            }
        }
    }
}

static void find_pieces(const faces *s)
{
    iccp_network *net = s->net;
    const size_t n = s->domain->n_vertices;
    for (size_t v = 0; v < n; ++v)
        net->piece[v] = NONE;
    for (uint32_t v = 0; v < n; ++v)
        if (net->piece[net->node[v]] == NONE)
            flood(s, net->node[v], (uint32_t)net->n_pieces++);
        else
            net->piece[v] = net->piece[net->node[v]];
}

/* ---- walks ---- */

/* Numbers the walks. At first each stands for a face of its own. */
static uint32_t find_walks(const faces *s)
{
    const iccp_network *net = s->net;
    const size_t n = 2 * s->domain->features->n_places;
    uint32_t n_walks = 0;
    for (size_t h = 0; h < n; ++h)
        s->walk[h] = NONE;
    for (size_t i = 0; i < 2 * net->n_sides; ++i) {
        uint32_t h = net->leaving[i];
        if (s->walk[h] != NONE)
            continue;
        for (; s->walk[h] == NONE; h = iccp_network_next(net, s->domain, h))
            s->walk[h] = n_walks;
        s->root[n_walks] = n_walks;
        ++n_walks;
    }
    return n_walks;
}

/* Returns the walk that stands for the face around the first node of a piece. */
static uint32_t root_around(const faces *s, uint32_t v)
{
    return s->below[v] == ICCP_NO_HALF ? NONE : s->root[s->walk[s->below[v]]];
}

/* Joins the outer walk of each piece to the face around it. The sweep visits the first node of the
 * piece below earlier. All sides leave a first node forwards, so the outer walk turns from the
 * lowest to the highest one. Returns false in `seen` for pieces that are still to come. */
static void join_walks(const faces *s, uint8_t *seen)
{
    const iccp_network *net = s->net;
    for (size_t i = 0; i < net->n_nodes; ++i) {
        const uint32_t v = s->graph->nodes[i];
        if (seen[net->piece[v]])
            continue;
        seen[net->piece[v]] = 1;
        if (iccp_network_degree(net, v) > 0)
            s->root[s->walk[net->leaving[net->first[v + 1] - 1]]] = root_around(s, v);
    }
}

/* ---- faces ---- */

static uint32_t number_face(const faces *s, uint32_t *number, uint32_t root, int32_t count)
{
    if (count <= 0 || root == NONE)
        return ICCP_NO_FACE;
    if (number[root] == NONE)
        number[root] = (uint32_t)s->net->n_faces++;
    return number[root];
}

/* Returns the number of rings around places on the left of half-side h. */
static int32_t count_left(const faces *s, uint32_t h)
{
    return h % 2 == 0 ? s->left[h / 2] : s->left[h / 2] - s->graph->gain[h / 2];
}

/* Returns the face around a node without sides. */
static uint32_t face_around(const faces *s, uint32_t *number, uint32_t v)
{
    return s->below[v] == ICCP_NO_HALF
               ? ICCP_NO_FACE
               : number_face(s, number, root_around(s, v), count_left(s, s->below[v]));
}

static void number_faces(const faces *s, uint32_t *number, uint32_t n_walks)
{
    iccp_network *net = s->net;
    const size_t n_places = s->domain->features->n_places;
    for (uint32_t w = 0; w < n_walks; ++w)
        number[w] = NONE;
    for (uint32_t h = 0; h < 2 * n_places; ++h)
        net->face[h] = s->walk[h] == NONE
                           ? ICCP_NO_FACE
                           : number_face(s, number, s->root[s->walk[h]], count_left(s, h));
    for (size_t i = 0; i < net->n_nodes; ++i) {
        const uint32_t v = s->graph->nodes[i], h = net->place[v];
        if (iccp_network_degree(net, v) == 0)
            net->face[h] = net->face[h + 1] = face_around(s, number, v);
    }
}

icc_status iccp_network_find_faces(iccp_network *net, const icc_domain *domain,
                                   const iccp_graph *graph, const int32_t *left,
                                   const uint32_t *below, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = 2 * domain->features->n_places;
    faces s = {.net = net, .domain = domain, .graph = graph, .left = left, .below = below};
    s.walk = iccp_alloc(memory, n, sizeof *s.walk);
    s.root = iccp_alloc(memory, n, sizeof *s.root);
    /* Also the numbers of faces, at most one a half-side */
    s.stack = iccp_alloc(memory, n + domain->n_vertices, sizeof *s.stack);
    uint8_t *seen = iccp_alloc_zero(memory, domain->n_vertices, sizeof *seen);
    icc_status status = ICC_ERR_MEMORY;
    if (s.walk != NULL && s.root != NULL && s.stack != NULL && seen != NULL) {
        find_pieces(&s);
        const uint32_t n_walks = find_walks(&s);
        join_walks(&s, seen);
        number_faces(&s, s.stack, n_walks);
        status = ICC_OK;
    }
    iccp_free(memory, s.walk);
    iccp_free(memory, s.root);
    iccp_free(memory, s.stack);
    iccp_free(memory, seen);
    return status;
}
