/* Where two paths cross the same edge, their order there shows where they part, ahead or behind; if
 * they do not cross, each place where they part tells the same. M. Schaefer, E. Sedgwick, D.
 * Stefankovic, Algorithms for normal curves and surfaces, 2002, know curves by such lists. */
#include "map/isotopy/strands.h"

#include "base/budget.h"
#include "base/sort.h"

#include <string.h>

enum { BYTES_PER_CROSSING = 64 };

/* Crossings are numbered through, word by word. */
typedef struct strands {
    const iccp_words *words;
    uint32_t *word;  /* of each crossing */
    uint32_t *first; /* of each word: its first crossing */
    uint32_t *order, *work;
    iccp_routes routes; /* as it would be if the paths had been laid */
} strands;

/* Travelling along a word, forth or back. */
typedef struct traveller {
    const iccp_word *word;
    size_t at;
    bool is_forth;
} traveller;

/* What is on the right and on the left. */
static void look(const traveller *t, uint32_t sides[2])
{
    const uint32_t *s = t->word->sides + 2 * t->at;
    sides[0] = s[t->is_forth ? 0 : 1];
    sides[1] = s[t->is_forth ? 1 : 0];
}

/* Goes on to the next edge: -1 if the one on the right is taken, +1 on the left; 0 where the path
 * ends instead. */
static int go_on(traveller *t)
{
    uint32_t before[2], after[2];
    if (t->is_forth ? t->at + 1 == t->word->n : t->at == 0)
        return 0;
    look(t, before);
    t->at = t->is_forth ? t->at + 1 : t->at - 1;
    look(t, after);
    return before[0] == after[0] ? -1 : 1;
}

/* Where two travellers that cross the same edge in the same sense part: negative when the first one
 * turns to the right of the second; 0 if they do not part. */
static int part(traveller a, traveller b)
{
    for (;;) {
        const int x = go_on(&a), y = go_on(&b);
        if (x != y)
            return x - y;
        if (x == 0)
            return 0;
    }
}

static traveller traveller_at(const strands *s, uint32_t crossing, bool is_forth)
{
    const uint32_t i = s->word[crossing];
    return (traveller){&s->words->word[i], crossing - s->first[i], is_forth};
}

/* By edge, and along the edge from its beginning, which is on the right of those that cross it
 * forward. */
static bool is_less(const void *context, uint32_t a, uint32_t b)
{
    const strands *s = context;
    const iccp_crossing *x = &s->routes.crossing[a], *y = &s->routes.crossing[b];
    if (x->edge != y->edge)
        return x->edge < y->edge;
    const int ahead = part(traveller_at(s, a, x->is_forward), traveller_at(s, b, y->is_forward));
    if (ahead != 0)
        return ahead < 0;
    return part(traveller_at(s, a, !x->is_forward), traveller_at(s, b, !y->is_forward)) > 0;
}

static icc_status make_room(strands *s, size_t n, size_t n_corners, const iccp_memory *memory)
{
    iccp_routes *r = &s->routes;
    s->word = iccp_alloc(memory, n, sizeof *s->word);
    s->first = iccp_alloc(memory, s->words->n, sizeof *s->first);
    s->order = iccp_alloc(memory, n, sizeof *s->order);
    s->work = iccp_alloc(memory, n, sizeof *s->work);
    r->crossing = iccp_alloc(memory, n, sizeof *r->crossing);
    r->first = iccp_alloc(memory, n_corners, sizeof *r->first);
    r->path = iccp_alloc(memory, s->words->n, sizeof *r->path);
    return s->word != NULL && s->first != NULL && s->order != NULL && s->work != NULL &&
                   r->crossing != NULL && r->first != NULL && r->path != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void enter_crossings(strands *s, const iccp_net *net)
{
    iccp_routes *r = &s->routes;
    uint32_t k = 0;
    for (uint32_t i = 0; i < s->words->n; ++i) {
        const iccp_word *word = &s->words->word[i];
        s->first[i] = k;
        r->path[i] = (iccp_path_ends){{word->ends[0], word->ends[1]},
                                      (uint32_t)r->scene->n + k,
                                      (uint32_t)word->n,
                                      word->n == 0};
        for (uint32_t place = 0; place < word->n; ++place, ++k) {
            const uint32_t right = word->sides[2 * place], left = word->sides[2 * place + 1];
            const uint32_t edge = iccp_net_edge(net, right, left);
            s->word[k] = i;
            s->order[k] = k;
            r->crossing[k] =
                (iccp_crossing){.path = i,
                                .place = place,
                                .edge = edge,
                                .next = ICCP_NO_NEIGHBOUR,
                                .is_forward = net->mesh->vertex[iccp_after(edge)] == right};
        }
    }
}

static void link_crossings(strands *s, size_t n)
{
    iccp_routes *r = &s->routes;
    const uint32_t n_bare = (uint32_t)r->scene->n;
    iccp_sort_indices(s->order, s->work, n, s, is_less);
    for (size_t k = n; k-- > 0;) {
        iccp_crossing *c = &r->crossing[s->order[k]];
        c->next = r->first[c->edge];
        r->first[c->edge] = n_bare + s->order[k];
    }
}

icc_status iccp_strands_draw(iccp_polyline *line, const iccp_words *words, const iccp_scene *scene,
                             int side, const iccp_net *net, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_corners = 3 * scene->mesh[side].n_triangles;
    strands s = {.words = words, .routes = {.memory = *memory, .scene = scene, .side = side}};
    iccp_lanes lanes = {NULL};
    size_t n = 0;
    for (size_t i = 0; i < words->n; ++i)
        n += words->word[i].n;
    icc_status status = n < UINT32_MAX - scene->n
                            ? iccp_budget_borrow(env, BYTES_PER_CROSSING * (double)n)
                            : ICC_ERR_RESOLUTION;
    if (status == ICC_OK)
        status = make_room(&s, n, n_corners, memory);
    if (status == ICC_OK) {
        s.routes.points = scene->domain[side]->vertices;
        s.routes.n_vertices = scene->n + n;
        s.routes.n_paths = words->n;
        memset(s.routes.first, 0xff, n_corners * sizeof *s.routes.first);
        enter_crossings(&s, net);
        link_crossings(&s, n);
        status = iccp_lanes_create(&lanes, &s.routes);
    }
    for (size_t i = 0; status == ICC_OK && i < words->n; ++i)
        status = iccp_taut(&line[i], &s.routes, &lanes, i);
    iccp_lanes_free(&lanes, memory);
    iccp_free(memory, s.word);
    iccp_free(memory, s.first);
    iccp_free(memory, s.order);
    iccp_free(memory, s.work);
    iccp_free(memory, s.routes.crossing);
    iccp_free(memory, s.routes.first);
    iccp_free(memory, s.routes.path);
    return status;
}
