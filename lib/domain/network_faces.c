/* Pieces, walks and faces. A face has one walk for each piece at its border. All walks but one of a
 * piece go around faces of their own. The other one, the outer walk, belongs to the face around the
 * piece. The half-side just below the first node of the piece tells which that is. */
#include "domain/network_faces.h"

static const uint32_t NONE = UINT32_MAX;

/* A walk is told by its smallest half-side. */
typedef struct faces {
    iccp_network *net;
    const icc_domain *domain;
    const iccp_graph *graph;
    const int32_t *left;
    const uint32_t *below;
    uint32_t *walk; /* by half-side: its walk */
    uint32_t *root; /* by walk: the walk around its face */
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

/* Finds the walks. At first each goes around a face of its own. */
static void find_walks(const faces *s)
{
    const iccp_network *net = s->net;
    const uint32_t n = 2 * (uint32_t)s->domain->features->n_places;
    for (uint32_t h = 0; h < n; ++h)
        s->walk[h] = s->root[h] = NONE;
    for (uint32_t h = 0; h < n; ++h) {
        if (s->walk[h] != NONE || !iccp_network_is_side(net, s->domain, h / 2))
            continue;
        s->root[h] = h;
        for (uint32_t g = h; s->walk[g] == NONE; g = iccp_network_next(net, s->domain, g))
            s->walk[g] = h;
    }
}

/* Returns the walk around the face where the first node of a piece lies. */
static uint32_t root_around(const faces *s, uint32_t v)
{
    return s->below[v] == ICCP_NO_HALF ? ICCP_NO_WALK : s->root[s->walk[s->below[v]]];
}

/* Joins the outer walk of each piece to the face around it. The sweep visits the first node of the
 * piece below earlier. All sides leave a first node forwards, so the outer walk passes it from the
 * lowest side to the highest one. `seen` is 0 for each piece. */
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

/* Returns the number of rings around places on the left of half-side h. */
static int32_t count_left(const faces *s, uint32_t h)
{
    return h % 2 == 0 ? s->left[h / 2] : s->left[h / 2] - s->graph->gain[h / 2];
}

/* Fills in what is on the left of half-side h: a face within walk `around`, where `count` rings lie
 * around each place. number[around] is the number of the face, or NONE at first. */
static void set_face(const faces *s, uint32_t *number, uint32_t h, uint32_t around, int32_t count)
{
    iccp_network *net = s->net;
    net->around[h] = around;
    net->face[h] = ICCP_NO_FACE;
    if (around == ICCP_NO_WALK || count <= 0)
        return;
    if (number[around] == NONE)
        number[around] = (uint32_t)net->n_faces++;
    net->face[h] = number[around];
}

static void set_faces(const faces *s, uint32_t *number)
{
    const iccp_network *net = s->net;
    const uint32_t n = 2 * (uint32_t)s->domain->features->n_places;
    for (uint32_t h = 0; h < n; ++h)
        number[h] = NONE;
    for (uint32_t h = 0; h < n; ++h)
        if (s->walk[h] != NONE)
            set_face(s, number, h, s->root[s->walk[h]], count_left(s, h));
        else
            set_face(s, number, h, ICCP_NO_WALK, 0);
    for (size_t i = 0; i < net->n_nodes; ++i) {
        const uint32_t v = s->graph->nodes[i], below = s->below[v];
        if (iccp_network_degree(net, v) > 0 || below == ICCP_NO_HALF)
            continue;
        set_face(s, number, net->place[v], root_around(s, v), count_left(s, below));
        set_face(s, number, net->place[v] + 1, root_around(s, v), count_left(s, below));
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
    /* Later the numbers of faces */
    s.stack = iccp_alloc(memory, n + domain->n_vertices, sizeof *s.stack);
    uint8_t *seen = iccp_alloc_zero(memory, domain->n_vertices, sizeof *seen);
    icc_status status = ICC_ERR_MEMORY;
    if (s.walk != NULL && s.root != NULL && s.stack != NULL && seen != NULL) {
        find_pieces(&s);
        find_walks(&s);
        join_walks(&s, seen);
        set_faces(&s, s.stack);
        status = ICC_OK;
    }
    iccp_free(memory, s.walk);
    iccp_free(memory, s.root);
    iccp_free(memory, s.stack);
    iccp_free(memory, seen);
    return status;
}
