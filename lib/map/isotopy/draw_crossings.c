/* Draws paths from the edges that they cross: finds their order on each edge, and a place for each
 * crossing.
 *
 * Two paths that cross the same edge cross it in a certain order. The place where they part, ahead
 * or behind, tells the order. If the paths do not cross each other, each such place tells the same.
 * M. Schaefer, E. Sedgwick, D. Stefankovic, Algorithms for normal curves and surfaces, 2002,
 * represent curves by such sequences. */
#include "map/isotopy/draw_crossings.h"

#include "base/budget.h"
#include "base/sort.h"

#include <string.h>

enum { BYTES_PER_CROSSING = 64 };

/* Crossings are numbered from sequence to sequence. */
typedef struct drawing {
    const iccp_sequences *sequences;
    uint32_t *sequence; /* of each crossing */
    uint32_t *first;    /* of each sequence: its first crossing */
    uint32_t *order, *work;
    iccp_path_search search; /* what it would hold if the paths had been laid */
} drawing;

/* A position on a path that is followed forwards or backwards. */
typedef struct traveller {
    const iccp_sequence *sequence;
    size_t at;
    bool is_forth;
} traveller;

/* The edge's ends on the right and on the left. */
static void look(const traveller *t, uint32_t sides[2])
{
    const uint32_t *s = t->sequence->sides + 2 * t->at;
    sides[0] = s[t->is_forth ? 0 : 1];
    sides[1] = s[t->is_forth ? 1 : 0];
}

/* Goes on to the next edge of the triangle. Returns -1 if that is the right one, +1 if it is the
 * left one, and 0 if the path ends there. */
static int go_on(traveller *t)
{
    uint32_t before[2], after[2];
    if (t->is_forth ? t->at + 1 == t->sequence->n : t->at == 0)
        return 0;
    look(t, before);
    t->at = t->is_forth ? t->at + 1 : t->at - 1;
    look(t, after);
    return before[0] == after[0] ? -1 : 1;
}

/* Follows two paths that cross the same edge in the same direction until they part. Negative if the
 * first one turns to the right of the second; 0 if they do not part. */
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

static traveller traveller_at(const drawing *s, uint32_t crossing, bool is_forth)
{
    const uint32_t i = s->sequence[crossing];
    return (traveller){&s->sequences->sequence[i], crossing - s->first[i], is_forth};
}

/* Sorts crossings by edge, then along the edge. Paths that cross an edge forward have its beginning
 * on their right. */
static bool is_less(const void *context, uint32_t a, uint32_t b)
{
    const drawing *s = context;
    const iccp_crossing *x = &s->search.crossing[a], *y = &s->search.crossing[b];
    if (x->edge != y->edge)
        return x->edge < y->edge;
    const int ahead = part(traveller_at(s, a, x->is_forward), traveller_at(s, b, y->is_forward));
    if (ahead != 0)
        return ahead < 0;
    return part(traveller_at(s, a, !x->is_forward), traveller_at(s, b, !y->is_forward)) > 0;
}

static icc_status make_room(drawing *s, size_t n, size_t n_corners, const iccp_memory *memory)
{
    iccp_path_search *r = &s->search;
    s->sequence = iccp_alloc(memory, n, sizeof *s->sequence);
    s->first = iccp_alloc(memory, s->sequences->n, sizeof *s->first);
    s->order = iccp_alloc(memory, n, sizeof *s->order);
    s->work = iccp_alloc(memory, n, sizeof *s->work);
    r->crossing = iccp_alloc(memory, n, sizeof *r->crossing);
    r->first = iccp_alloc(memory, n_corners, sizeof *r->first);
    r->path = iccp_alloc(memory, s->sequences->n, sizeof *r->path);
    return s->sequence != NULL && s->first != NULL && s->order != NULL && s->work != NULL &&
                   r->crossing != NULL && r->first != NULL && r->path != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void enter_crossings(drawing *s, const iccp_triangulation *triangulation)
{
    iccp_path_search *r = &s->search;
    uint32_t k = 0;
    for (uint32_t i = 0; i < s->sequences->n; ++i) {
        const iccp_sequence *sequence = &s->sequences->sequence[i];
        s->first[i] = k;
        r->path[i] = (iccp_path_ends){{sequence->ends[0], sequence->ends[1]},
                                      (uint32_t)r->domains->n + k,
                                      (uint32_t)sequence->n,
                                      sequence->n == 0};
        for (uint32_t place = 0; place < sequence->n; ++place, ++k) {
            const uint32_t right = sequence->sides[2 * place],
                           left = sequence->sides[2 * place + 1];
            const uint32_t edge =
                iccp_fans_edge(&triangulation->fans, triangulation->mesh, right, left);
            s->sequence[k] = i;
            s->order[k] = k;
            r->crossing[k] = (iccp_crossing){
                .path = i,
                .place = place,
                .edge = edge,
                .next = ICCP_NO_NEIGHBOUR,
                .is_forward = triangulation->mesh->vertex[iccp_after(edge)] == right};
        }
    }
}

static void link_crossings(drawing *s, size_t n)
{
    iccp_path_search *r = &s->search;
    const uint32_t n_bare = (uint32_t)r->domains->n;
    iccp_sort_indices(s->order, s->work, n, s, is_less);
    for (size_t k = n; k-- > 0;) {
        iccp_crossing *c = &r->crossing[s->order[k]];
        c->next = r->first[c->edge];
        r->first[c->edge] = n_bare + s->order[k];
    }
}

icc_status iccp_draw_crossings(iccp_polyline *line, const iccp_sequences *sequences,
                               const iccp_domain_pair *domains, int side,
                               const iccp_triangulation *triangulation, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_corners = 3 * domains->mesh[side].n_triangles;
    drawing s = {.sequences = sequences,
                 .search = {.memory = *memory, .domains = domains, .side = side}};
    iccp_lanes lanes = {NULL};
    size_t n = 0;
    for (size_t i = 0; i < sequences->n; ++i)
        n += sequences->sequence[i].n;
    icc_status status = n < UINT32_MAX - domains->n
                            ? iccp_budget_borrow(env, BYTES_PER_CROSSING * (double)n)
                            : ICC_ERR_RESOLUTION;
    if (status == ICC_OK)
        status = make_room(&s, n, n_corners, memory);
    if (status == ICC_OK) {
        s.search.points = domains->domain[side]->vertices;
        s.search.n_vertices = domains->n + n;
        s.search.n_paths = sequences->n;
        memset(s.search.first, 0xff, n_corners * sizeof *s.search.first);
        enter_crossings(&s, triangulation);
        link_crossings(&s, n);
        status = iccp_lanes_create(&lanes, &s.search);
    }
    for (size_t i = 0; status == ICC_OK && i < sequences->n; ++i)
        status = iccp_shorten_path(&line[i], &s.search, &lanes, i);
    iccp_lanes_free(&lanes, memory);
    iccp_free(memory, s.sequence);
    iccp_free(memory, s.first);
    iccp_free(memory, s.order);
    iccp_free(memory, s.work);
    iccp_free(memory, s.search.crossing);
    iccp_free(memory, s.search.first);
    iccp_free(memory, s.search.path);
    return status;
}
