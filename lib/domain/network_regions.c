/* A flood from face to face finds what lies within the ring of each region. It crosses all sides
 * but those of the ring, and also fills holes. A ring within another one has fewer faces inside, so
 * these numbers tell which region is the innermost one. */
#include "domain/network_regions.h"

static const uint32_t NONE = UINT32_MAX;

/* A walk that goes around a face tells the face, also outside the domain. */
typedef struct flood {
    const icc_domain *domain;
    const iccp_network *net;
    uint32_t *head;   /* by walk: a half-side with this walk around its face, or NONE */
    uint32_t *next;   /* by half-side: another one of the same face, or NONE */
    uint32_t *wall;   /* by facet: the last region with this side */
    uint32_t *met;    /* by walk: the last region that contains its face */
    uint32_t *size;   /* by walk: number of faces within the region that was chosen for it */
    uint32_t *queue;  /* walks within a region */
    uint32_t *region; /* by walk */
} flood;

static void list_faces(const flood *s, uint32_t n)
{
    for (uint32_t h = 0; h < n; ++h)
        s->head[h] = NONE;
    for (uint32_t h = 0; h < n; ++h) {
        const uint32_t walk = s->net->around[h];
        if (walk == ICCP_NO_WALK)
            continue;
        s->next[h] = s->head[walk];
        s->head[walk] = h;
    }
}

/* Returns the half-side that has the inside of a ring on its left, at facet f of the ring. */
static uint32_t inner_half(const flood *s, const iccp_feature *ring, uint32_t f)
{
    const uint32_t half = 2 * s->net->side[f];
    const bool same = iccp_network_origin(s->net, s->domain, half) ==
                      iccp_network_origin(s->net, s->domain, 2 * f);
    return half + (same != (ring->orientation > 0));
}

static void meet(const flood *s, uint32_t walk, uint32_t number, size_t *n)
{
    if (walk == ICCP_NO_WALK || s->met[walk] == number)
        return;
    s->met[walk] = number;
    s->queue[(*n)++] = walk;
}

/* Lists the faces within a ring, and returns how many there are. */
static size_t list_inside(const flood *s, const iccp_feature *ring, uint32_t number)
{
    size_t n = 0;
    for (uint32_t f = ring->first_facet; f < ring->first_facet + ring->n_facets; ++f)
        s->wall[s->net->side[f]] = number;
    meet(s, s->net->around[inner_half(s, ring, ring->first_facet)], number, &n);
    for (size_t done = 0; done < n; ++done)
        for (uint32_t h = s->head[s->queue[done]]; h != NONE; h = s->next[h])
            if (s->wall[h / 2] != number)
                meet(s, s->net->around[h ^ 1], number, &n);
    return n;
}

static void find_all(const flood *s, uint32_t n_halves)
{
    const iccp_features *features = s->domain->features;
    uint32_t number = 0;
    list_faces(s, n_halves);
    for (size_t i = 0; i < features->n; ++i) {
        if (features->item[i].kind != ICC_FEATURE_REGION)
            continue;
        const size_t n = list_inside(s, &features->item[i], ++number);
        for (size_t k = 0; k < n; ++k) {
            const uint32_t walk = s->queue[k];
            if (s->region[walk] != 0 && s->size[walk] <= n)
                continue;
            s->region[walk] = number;
            s->size[walk] = (uint32_t)n;
        }
    }
    for (uint32_t h = 0; h < n_halves; ++h)
        s->region[h] = s->net->around[h] != ICCP_NO_WALK ? s->region[s->net->around[h]] : 0;
}

icc_status iccp_network_find_regions(uint32_t *region, const icc_domain *domain,
                                     const iccp_memory *memory)
{
    const size_t n = 2 * domain->features->n_places;
    flood s = {.domain = domain, .net = domain->features->network, .region = region};
    s.head = iccp_alloc(memory, n, sizeof *s.head);
    s.next = iccp_alloc(memory, n, sizeof *s.next);
    s.wall = iccp_alloc_zero(memory, n / 2, sizeof *s.wall);
    s.met = iccp_alloc_zero(memory, n, sizeof *s.met);
    s.size = iccp_alloc(memory, n, sizeof *s.size);
    s.queue = iccp_alloc(memory, n, sizeof *s.queue);
    const bool is_there = s.head != NULL && s.next != NULL && s.wall != NULL && s.met != NULL &&
                          s.size != NULL && s.queue != NULL;
    for (size_t h = 0; h < n && is_there; ++h)
        region[h] = 0;
    if (is_there)
        find_all(&s, (uint32_t)n);
    iccp_free(memory, s.head);
    iccp_free(memory, s.next);
    iccp_free(memory, s.wall);
    iccp_free(memory, s.met);
    iccp_free(memory, s.size);
    iccp_free(memory, s.queue);
    return is_there ? ICC_OK : ICC_ERR_MEMORY;
}
