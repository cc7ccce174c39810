/* Writes the features of a domain with knots between their vertices. Features that run along the
 * same side get the same vertices there, bit for bit. */
#include "map/slide/added_vertices.h"

#include "base/minmax.h"

#include <string.h>

/* ---- numbers ---- */

typedef struct writer {
    iccp_added_vertices *a;
    const iccp_slide *slide;
    const icc_domain *domain;
    const iccp_network *network;
    size_t *corner; /* the knots at the source's corners: chain by chain, where each side begins,
                       and where the last one ends */
} writer;

/* Returns where `corner` has the knots at both ends of a side, along its chain. */
static size_t *ends_of(const writer *w, uint32_t side)
{
    const iccp_chains *chains = &w->slide->chains;
    return w->corner + chains->order[side] + chains->chain[side];
}

/* Whether a side, taken along its chain, begins at a vertex. */
static bool begins_at(const writer *w, uint32_t side, uint32_t vertex)
{
    const iccp_chains *chains = &w->slide->chains;
    return iccp_network_origin(w->network, w->domain, chains->half[chains->order[side]]) ==
           w->network->node[vertex];
}

static void find_corners(writer *w)
{
    const iccp_chains *chains = &w->slide->chains;
    for (size_t c = 0; c < chains->n; ++c)
        for (size_t k = w->slide->first[c]; k < w->slide->first[c + 1]; ++k)
            if (iccp_knot_is_corner(&w->slide->knot[k], 0))
                w->corner[chains->first[c] + c + w->slide->knot[k].at[0]] = k;
}

static void add(writer *w, size_t knot, size_t after)
{
    w->a->knot[w->a->n] = (uint32_t)knot;
    w->a->after[w->a->n++] = (uint32_t)after;
}

/* Adds the vertex where a facet begins, and the knots inside the facet. */
static void add_facet(writer *w, uint32_t facet)
{
    const uint32_t side = w->network->side[facet], begin = w->domain->facets[2 * (size_t)facet];
    const size_t *corner = ends_of(w, side);
    const bool is_forward = begins_at(w, side, begin);
    w->a->vertex[begin] = (uint32_t)w->a->n;
    for (size_t k = corner[0]; is_forward && k < corner[1]; ++k)
        add(w, k, 2 * k);
    for (size_t k = corner[1]; !is_forward && k > corner[0]; --k)
        add(w, k, 2 * (k - 1) + 1);
}

/* Adds the vertices of a feature with n_facets facets. Returns their number. */
static size_t add_feature(writer *w, int32_t kind, uint32_t first_facet, uint32_t n_facets)
{
    const size_t before = w->a->n;
    const uint32_t *facets = w->domain->facets + 2 * (size_t)first_facet;
    if (kind == ICC_FEATURE_POINT) {
        w->a->vertex[facets[0]] = (uint32_t)w->a->n;
        add(w, UINT32_MAX, UINT32_MAX);
        return 1;
    }
    for (uint32_t f = 0; f < n_facets; ++f)
        add_facet(w, first_facet + f);
    if (kind == ICC_FEATURE_LINE) {
        const uint32_t last = first_facet + n_facets - 1, end = facets[2 * n_facets - 1];
        const uint32_t side = w->network->side[last];
        w->a->vertex[end] = (uint32_t)w->a->n;
        add(w, ends_of(w, side)[begins_at(w, side, end) ? 0 : 1], UINT32_MAX);
    }
    return w->a->n - before;
}

static void add_all(writer *w)
{
    const iccp_features *features = w->domain->features;
    w->a->count[0] = add_feature(w, ICC_FEATURE_HOLE, 0, (uint32_t)features->n_outer);
    for (size_t f = 0; f < features->n; ++f) {
        const iccp_feature *feature = &features->item[f];
        w->a->count[f + 1] = add_feature(w, feature->kind, feature->first_facet, feature->n_facets);
    }
}

/* Returns an upper bound on the number of vertices: one more for each feature, and for each facet
 * its knots. */
static size_t count_most(const writer *w)
{
    size_t n = w->domain->features->n;
    for (size_t f = 0; f < w->domain->features->n_places; ++f) {
        const uint32_t side = w->network->side[f];
        if (w->slide->chains.chain[side] != UINT32_MAX) /* not a lone point */
            n += ends_of(w, side)[1] - ends_of(w, side)[0];
    }
    return n;
}

icc_status iccp_added_vertices_create(iccp_added_vertices *added, const iccp_slide *slide,
                                      const iccp_memory *memory)
{
    const icc_domain *domain = slide->given[0];
    const iccp_network *network = iccp_network_of(domain);
    const size_t n_corners = network->n_sides + slide->chains.n;
    iccp_added_vertices *a = added;
    *a = (iccp_added_vertices){.memory = *memory};
    writer w = {a, slide, domain, network, iccp_alloc(memory, n_corners, sizeof *w.corner)};
    if (w.corner == NULL)
        return ICC_ERR_MEMORY;
    find_corners(&w);
    const size_t n = count_most(&w);
    a->count = iccp_alloc(memory, domain->features->n + 1, sizeof *a->count);
    a->knot = iccp_alloc(memory, n, sizeof *a->knot);
    a->after = iccp_alloc(memory, n, sizeof *a->after);
    a->vertex = iccp_alloc(memory, domain->n_vertices, sizeof *a->vertex);
    const bool is_there =
        a->count != NULL && a->knot != NULL && a->after != NULL && a->vertex != NULL;
    if (is_there)
        add_all(&w);
    else
        iccp_added_vertices_free(a);
    iccp_free(memory, w.corner);
    return is_there ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_added_vertices_free(iccp_added_vertices *added)
{
    iccp_free(&added->memory, added->count);
    iccp_free(&added->memory, added->knot);
    iccp_free(&added->memory, added->after);
    iccp_free(&added->memory, added->vertex);
    *added = (iccp_added_vertices){.memory = added->memory};
}

/* ---- places ---- */

/* Interpolates between the ends of a side, and never leaves their box. So the frame of the domain
 * stays the same. */
static void find_place(const iccp_slide *slide, size_t chain, const iccp_knot *knot, int side,
                       const double *vertices, double place[2])
{
    const icc_domain *domain = slide->given[side];
    const uint32_t *half = slide->chains.half + slide->chains.first[chain];
    const bool is_end =
        slide->chains.first[chain] + knot->at[side] == slide->chains.first[chain + 1];
    const uint32_t h = is_end ? half[knot->at[side] - 1] ^ 1 : half[knot->at[side]];
    const double *a = vertices + 2 * (size_t)domain->facets[h];
    const double *b = vertices + 2 * (size_t)domain->facets[h ^ 1];
    const double along = knot->along[side];
    for (size_t d = 0; d < 2; ++d) {
        const double x = (1 - along) * a[d] + along * b[d];
        place[d] = iccp_min(iccp_max(x, iccp_min(a[d], b[d])), iccp_max(a[d], b[d]));
    }
}

void iccp_knot_place(const iccp_slide *slide, size_t chain, const iccp_knot *knot, int side,
                     double place[2])
{
    find_place(slide, chain, knot, side, slide->given[side]->vertices, place);
}

/* ---- domains ---- */

typedef struct parts {
    iccp_added_vertices added;
    double *knots;    /* 2 for each knot */
    double *vertices; /* 2 for each vertex */
    icc_feature *features;
} parts;

static void place_knots(parts *p, const iccp_slide *slide, int side)
{
    for (size_t c = 0; c < slide->chains.n; ++c)
        for (size_t k = slide->first[c]; k < slide->first[c + 1]; ++k)
            find_place(slide, c, &slide->knot[k], side, slide->given[side]->given,
                       p->knots + 2 * k);
}

static void write_features(parts *p, const icc_domain *given)
{
    const iccp_features *features = given->features;
    for (size_t v = 0; v < given->n_vertices; ++v)
        memcpy(p->vertices + 2 * (size_t)p->added.vertex[v], given->given + 2 * v,
               2 * sizeof *p->vertices);
    for (size_t v = 0; v < p->added.n; ++v)
        if (p->added.knot[v] != UINT32_MAX)
            memcpy(p->vertices + 2 * v, p->knots + 2 * (size_t)p->added.knot[v],
                   2 * sizeof *p->vertices);
    const double *next = p->vertices + 2 * p->added.count[0];
    for (size_t f = 0; f < features->n; ++f) {
        p->features[f] = (icc_feature){.size = sizeof *p->features,
                                       .kind = features->item[f].kind,
                                       .n_vertices = p->added.count[f + 1],
                                       .vertices = next};
        next += 2 * p->added.count[f + 1];
    }
}

static icc_status make(icc_domain **out, parts *p, const icc_domain *given, const iccp_env *env,
                       icc_error *err)
{
    const icc_status status = iccp_domain_create_features(
        out, p->added.count[0], p->vertices, given->features->n, p->features, env, err);
    for (size_t f = 0; status == ICC_OK && f < given->features->n; ++f)
        (*out)->features->item[f].rim_of = given->features->item[f].rim_of;
    return status;
}

icc_status iccp_domain_with_knots(icc_domain **out, const iccp_slide *slide, int side,
                                  const iccp_env *env, icc_error *err)
{
    const icc_domain *given = slide->given[side];
    parts p = {.added.memory = env->memory};
    *out = NULL;
    icc_status status = iccp_added_vertices_create(&p.added, slide, &env->memory);
    if (status == ICC_OK) {
        p.knots = iccp_alloc(&env->memory, slide->first[slide->chains.n], 2 * sizeof *p.knots);
        p.vertices = iccp_alloc(&env->memory, p.added.n, 2 * sizeof *p.vertices);
        p.features = iccp_alloc(&env->memory, given->features->n, sizeof *p.features);
        if (p.knots == NULL || p.vertices == NULL || p.features == NULL)
            status = ICC_ERR_MEMORY;
    }
    if (status == ICC_OK) {
        place_knots(&p, slide, side);
        write_features(&p, given);
        status = make(out, &p, given, env, err);
    }
    iccp_added_vertices_free(&p.added);
    iccp_free(&env->memory, p.knots);
    iccp_free(&env->memory, p.vertices);
    iccp_free(&env->memory, p.features);
    return status;
}
