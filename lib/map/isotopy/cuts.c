/* Chooses cuts that join all components: R. C. Prim, Shortest connection networks and some
 * generalizations, 1957. The next cut is the shortest one that joins another component to the
 * components joined before. The length of a cut depends on the cuts that it has to go around. So it
 * is computed only when the cut comes first by its known lower bound.
 *
 * The path in the source decides between which walls and cuts the path in the target leaves and
 * arrives. Then each point there has only one image under a map that takes one path to the
 * other. */
#include "map/isotopy/cuts.h"

#include "base/minmax.h"
#include "base/random.h"

#include <math.h>
#include <string.h>

/* A cut is accepted if it exceeds the lower bound of the next candidate by at most this share. */
static const double SLACK = 0.1;

/* Random trees multiply each length by a random factor between 1 and 1 + JITTER. */
#define JITTER 1.5

/* Weight of the lengths in the less important domain, for trees that prefer one domain. */
#define MINOR 0.2

/* Number of searches before the first path found is accepted: a constant, plus a number for each
 * component. */
enum { MOST_SEARCHES = 64, MOST_SEARCHES_EACH = 16 };

typedef struct iccp_candidate_cut {
    uint32_t from, to;
    double length[2]; /* of the straight line, in each domain */
    uint32_t known;   /* the number of cuts when its path was searched */
    double first_key; /* from the straight lines */
} candidate;

/* ---- candidates: edges of either triangulation between components ---- */

static void visit_edges(iccp_cutter *k, int side, bool enters)
{
    const iccp_domain_pair *s = k->domains;
    const iccp_corners *mesh = &s->mesh[side];
    for (size_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->vertex[iccp_after((uint32_t)c)];
        const uint32_t b = mesh->vertex[iccp_before((uint32_t)c)];
        if (s->component[a] == s->component[b])
            continue;
        if (!enters)
            ++k->first[s->component[a]];
        else
            k->candidate[--k->first[s->component[a]]] = (candidate){
                .from = a,
                .to = b,
                .length = {iccp_distance_between(s->domain[0]->vertices, a, b),
                           s->scale * iccp_distance_between(s->domain[1]->vertices, a, b)}};
    }
}

static icc_status list_candidates(iccp_cutter *k, const iccp_memory *memory)
{
    const size_t n = k->domains->n_components;
    k->first = iccp_alloc_zero(memory, n + 1, sizeof *k->first);
    if (k->first == NULL)
        return ICC_ERR_MEMORY;
    for (int side = 0; side < 2; ++side)
        visit_edges(k, side, false);
    for (size_t i = 0; i < n; ++i)
        k->first[i + 1] += k->first[i];
    k->candidate = iccp_alloc(memory, k->first[n], sizeof *k->candidate);
    if (k->candidate == NULL || !iccp_heap_create(&k->queue, k->first[n], memory))
        return ICC_ERR_MEMORY;
    for (int side = 0; side < 2; ++side)
        visit_edges(k, side, true);
    return ICC_OK;
}

/* ---- the tree ---- */

/* How the cuts of a tree are chosen. */
typedef struct kind_of_tree {
    double weight[2]; /* factors for the lengths in the two domains */
    int first;        /* the domain searched first; its path may pass other cuts on either side */
    double jitter;    /* the largest random change of a key, as a share */
} kind_of_tree;

static kind_of_tree kind_of(uint64_t tree)
{
    static const kind_of_tree kinds[] = {
        {{1, 1}, 0, JITTER}, {{1, MINOR}, 0, JITTER}, {{MINOR, 1}, 1, JITTER}};
    kind_of_tree kind = kinds[tree % 3];
    if (tree < 3)
        kind.jitter = 0;
    return kind;
}

/* The state of a tree that grows. */
typedef struct growth {
    uint8_t *joined; /* of each component */
    uint32_t *size;  /* of the first component of each part: how many it has */
    uint64_t random;
    size_t n_searches; /* that are left */
    size_t n_done;     /* cuts, and the one that is being made */
} growth;

static double weigh(const kind_of_tree *kind, const double length[2])
{
    return kind->weight[0] * length[0] + kind->weight[1] * length[1];
}

static void offer_component(iccp_cutter *k, const uint8_t *joined, uint32_t component,
                            const kind_of_tree *kind, uint64_t *random)
{
    for (size_t i = k->first[component]; i < k->first[component + 1]; ++i) {
        candidate *c = &k->candidate[i];
        const double u = kind->jitter * (double)(iccp_random(random) >> 11) * 0x1p-53;
        c->known = UINT32_MAX;
        c->first_key = (1 + u) * weigh(kind, c->length);
        if (!joined[k->domains->component[c->to]])
            iccp_heap_put(&k->queue, (uint32_t)i, c->first_key);
    }
}

/* Finds the paths of a candidate in both domains. *weight is HUGE_VAL if there is none. */
static icc_status find_paths(iccp_cutter *k, const candidate *c, const kind_of_tree *kind,
                             double *weight)
{
    iccp_found_path *own = &k->found[kind->first], *other = &k->found[1 - kind->first];
    icc_status status = iccp_path_search_find(&k->search[kind->first], c->from, ICCP_ANY_SECTOR,
                                              c->to, ICCP_ANY_SECTOR, HUGE_VAL, own);
    other->length = HUGE_VAL;
    if (status == ICC_OK && own->length < HUGE_VAL)
        status = iccp_path_search_find(&k->search[1 - kind->first], c->from, own->sector[0], c->to,
                                       own->sector[1], HUGE_VAL, other);
    *weight =
        weigh(kind, (const double[]){k->found[0].length, k->domains->scale * k->found[1].length});
    return status;
}

static icc_status lay_paths(iccp_cutter *k)
{
    icc_status status = iccp_path_search_lay(&k->search[0], &k->found[0]);
    return status == ICC_OK ? iccp_path_search_lay(&k->search[1], &k->found[1]) : status;
}

/* Tries candidates until one is laid. *component is the component that it joins. ICC_ERR_TOPOLOGY
 * if no candidate is left. */
static icc_status next_cut(iccp_cutter *k, const kind_of_tree *kind, const uint8_t *joined,
                           size_t *n_searches, uint32_t *component)
{
    const uint32_t n_cuts = (uint32_t)k->search[0].n_paths;
    icc_status status = ICC_OK;
    while (status == ICC_OK && k->queue.n_entries > 0) {
        const double key = k->queue.entry[0].key;
        const uint32_t i = iccp_heap_pop(&k->queue);
        candidate *c = &k->candidate[i];
        double weight;
        *component = k->domains->component[c->to];
        if (joined[*component])
            continue;
        status = find_paths(k, c, kind, &weight);
        if (status != ICC_OK || !(weight < HUGE_VAL))
            continue;
        /* The new key keeps the candidate's random factor. */
        const double own = iccp_max(key, weight * (c->first_key / weigh(kind, c->length)));
        const double next = k->queue.n_entries > 0 ? k->queue.entry[0].key : HUGE_VAL;
        if (c->known == n_cuts || own <= (1 + SLACK) * next || *n_searches == 0)
            return lay_paths(k);
        --*n_searches;
        c->known = n_cuts;
        iccp_heap_put(&k->queue, i, own);
    }
    return status == ICC_OK ? ICC_ERR_TOPOLOGY : status;
}

/* Joins the components of one part of the domain. *n_done counts the cuts of all parts. */
static icc_status grow_part(iccp_cutter *k, uint32_t component, const kind_of_tree *kind, growth *g,
                            const iccp_env *env)
{
    const size_t n = k->domains->n_cuts;
    icc_status status = ICC_OK;
    iccp_heap_clear(&k->queue);
    for (size_t left = g->size[component]; status == ICC_OK && left > 1; --left) {
        g->joined[component] = 1;
        offer_component(k, g->joined, component, kind, &g->random);
        status = iccp_progress(env, "mesh", (double)++g->n_done / (double)(n + 1));
        if (status == ICC_OK)
            status = next_cut(k, kind, g->joined, &g->n_searches, &component);
    }
    return status;
}

static icc_status grow(iccp_cutter *k, uint64_t tree, const iccp_env *env)
{
    const iccp_domain_pair *domains = k->domains;
    const kind_of_tree kind = kind_of(tree);
    const size_t n = domains->n_components;
    growth g = {iccp_alloc_zero(&env->memory, n, 1),
                iccp_alloc_zero(&env->memory, n, sizeof *g.size), tree,
                MOST_SEARCHES + MOST_SEARCHES_EACH * n, 0};
    icc_status status = g.joined != NULL && g.size != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (uint32_t c = 0; status == ICC_OK && c < n; ++c)
        ++g.size[domains->part[c]];
    for (int side = 0; side < 2; ++side)
        iccp_path_search_reset(&k->search[side]);
    for (uint32_t c = 0; status == ICC_OK && c < n; ++c)
        if (domains->part[c] == c)
            status = grow_part(k, c, &kind, &g, env);
    iccp_free(&env->memory, g.joined);
    iccp_free(&env->memory, g.size);
    return status;
}

/* ---- polylines ---- */

/* Puts another bend in the middle of the longest piece. */
static icc_status bend_once(iccp_polyline *line, const iccp_memory *memory)
{
    uint32_t at = 1;
    for (uint32_t i = 2; i < line->n; ++i)
        if (iccp_distance_between(line->points, i - 1, i) >
            iccp_distance_between(line->points, at - 1, at))
            at = i;
    const double *p = line->points + 2 * (size_t)(at - 1);
    const double middle[2] = {0.5 * (p[0] + p[2]), 0.5 * (p[1] + p[3])};
    const icc_status status = iccp_polyline_add(line, middle, memory);
    if (status != ICC_OK)
        return status;
    memmove(line->points + 2 * (at + 1), line->points + 2 * at,
            2 * (line->n - 1 - at) * sizeof *line->points);
    memcpy(line->points + 2 * at, middle, sizeof middle);
    return ICC_OK;
}

icc_status iccp_cuts_begin(iccp_cuts *cuts, size_t n, const iccp_memory *memory)
{
    *cuts = (iccp_cuts){.memory = *memory, .n = n};
    cuts->ends = iccp_alloc(memory, n, 2 * sizeof *cuts->ends);
    cuts->first = iccp_alloc_zero(memory, n + 1, sizeof *cuts->first);
    return cuts->ends != NULL && cuts->first != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_cuts_add(iccp_cuts *cuts, size_t cut, const uint32_t ends[2], iccp_polyline line[2])
{
    icc_status status = ICC_OK;
    for (int k = 0; k < 2; ++k) {
        cuts->length[k] += iccp_polyline_length(&line[k]);
        cuts->straight[k] += iccp_distance_between(line[k].points, 0, (uint32_t)line[k].n - 1);
    }
    while (status == ICC_OK && line[0].n != line[1].n)
        status = bend_once(&line[line[0].n < line[1].n ? 0 : 1], &cuts->memory);
    if (status != ICC_OK)
        return status;
    const size_t n_old = cuts->first[cut], n_bends = line[0].n - 2, n = n_old + n_bends;
    for (int k = 0; k < 2 && n > cuts->room; ++k) {
        double *points =
            iccp_grow(&cuts->memory, cuts->points[k], 2 * n_old, 4 * n, sizeof *points);
        if (points == NULL)
            return ICC_ERR_MEMORY;
        cuts->points[k] = points;
    }
    cuts->room = n > cuts->room ? 2 * n : cuts->room;
    for (int k = 0; k < 2 && n_bends > 0; ++k)
        memcpy(cuts->points[k] + 2 * n_old, line[k].points + 2, 2 * n_bends * sizeof(double));
    memcpy(cuts->ends + 2 * cut, ends, 2 * sizeof *ends);
    cuts->first[cut + 1] = (uint32_t)n;
    return ICC_OK;
}

static icc_status draw(iccp_cuts *cuts, const iccp_cutter *k)
{
    const iccp_path_ends *path = k->search[0].path;
    iccp_lanes lanes[2] = {{NULL}, {NULL}};
    iccp_polyline line[2] = {{0}, {0}};
    icc_status status = ICC_OK;
    for (int side = 0; status == ICC_OK && side < 2; ++side)
        status = iccp_lanes_create(&lanes[side], &k->search[side]);
    for (size_t i = 0; status == ICC_OK && i < cuts->n; ++i) {
        for (int side = 0; status == ICC_OK && side < 2; ++side) {
            line[side].n = 0;
            status = iccp_shorten_path(&line[side], &k->search[side], &lanes[side], i);
        }
        if (status == ICC_OK)
            status = iccp_cuts_add(cuts, i, path[i].vertex, line);
    }
    for (int side = 0; side < 2; ++side) {
        iccp_lanes_free(&lanes[side], &cuts->memory);
        iccp_polyline_free(&line[side], &cuts->memory);
    }
    return status;
}

/* ---- all of it ---- */

icc_status iccp_cuts_create(iccp_cuts *cuts, iccp_cutter *cutter, uint64_t tree,
                            const iccp_env *env)
{
    *cuts = (iccp_cuts){.memory = env->memory};
    icc_status status = grow(cutter, tree, env);
    if (status == ICC_OK)
        status = iccp_cuts_begin(cuts, cutter->domains->n_cuts, &env->memory);
    if (status == ICC_OK)
        status = draw(cuts, cutter);
    if (status != ICC_OK)
        iccp_cuts_free(cuts);
    return status;
}

void iccp_cuts_free(iccp_cuts *cuts)
{
    const iccp_memory *memory = &cuts->memory;
    iccp_free(memory, cuts->ends);
    iccp_free(memory, cuts->first);
    iccp_free(memory, cuts->points[0]);
    iccp_free(memory, cuts->points[1]);
    *cuts = (iccp_cuts){.memory = *memory};
}

icc_status iccp_cutter_create(iccp_cutter *k, const iccp_domain_pair *domains, const iccp_env *env)
{
    *k = (iccp_cutter){.memory = env->memory, .domains = domains};
    icc_status status = iccp_path_search_create(&k->search[0], domains, 0, env);
    if (status == ICC_OK)
        status = iccp_path_search_create(&k->search[1], domains, 1, env);
    if (status == ICC_OK)
        status = list_candidates(k, &env->memory);
    if (status != ICC_OK)
        iccp_cutter_free(k);
    return status;
}

void iccp_cutter_free(iccp_cutter *k)
{
    iccp_free(&k->memory, k->candidate);
    iccp_free(&k->memory, k->first);
    iccp_heap_free(&k->queue, &k->memory);
    for (int side = 0; side < 2; ++side) {
        iccp_found_path_free(&k->found[side], &k->memory);
        iccp_path_search_free(&k->search[side]);
    }
    *k = (iccp_cutter){.memory = k->memory};
}
