/* The surfaces and lines to be filled. */
#include "fill/constraints.h"

#include "base/error.h"
#include "domain/complex.h"
#include "domain/features.h"

/* Numbers the edges. Each is counted in the facet where it runs from its smaller vertex to the
 * larger one. */
static void number_edges(iccp_constraints *s, const uint32_t *across)
{
    for (uint32_t i = 0; i < 3 * s->n_facets; ++i) {
        const uint32_t f = i / 3, *const v = s->facets + 3 * (size_t)f;
        const uint32_t a = v[(i + 1) % 3], b = v[(i + 2) % 3];
        if (a > b)
            continue;
        const uint32_t other = across[i], *const w = s->facets + 3 * (size_t)other;
        uint32_t j = 0;
        while (w[j] == a || w[j] == b)
            ++j;
        s->side[i] = s->side[3 * other + j] = (uint32_t)s->n_segments;
        s->segment[s->n_segments++] = (iccp_segment){a, b, b, f};
    }
}

/* Lists the segments of all lines. */
static bool list_lines(iccp_constraints *s, const iccp_features *features)
{
    size_t n = 0;
    for (size_t i = 0; i < features->n; ++i)
        n += features->item[i].kind == ICC_FEATURE_LINE ? features->item[i].n - 1 : 0;
    s->line = iccp_alloc(&s->memory, n, sizeof *s->line);
    if (s->line == NULL)
        return false;
    for (uint32_t i = 0; i < features->n; ++i) {
        const iccp_feature *const f = &features->item[i];
        for (uint32_t v = f->first; f->kind == ICC_FEATURE_LINE && v + 1 < f->first + f->n; ++v)
            s->line[s->n_lines++] = (iccp_segment){v, v + 1, v + 1, i};
    }
    return true;
}

icc_status iccp_constraints_create(iccp_constraints *s, const icc_domain *domain,
                                   const iccp_env *env, icc_error *err)
{
    const size_t n = domain->features == NULL ? domain->n_facets : domain->features->n_places;
    *s = (iccp_constraints){.memory = env->memory,
                            .n_facets = n,
                            .n_boundary = domain->n_facets,
                            .facets = domain->facets};
    s->edges.memory = env->memory;
    iccp_complex c = {3, domain->n_vertices, n, domain->facets, NULL};
    s->side = iccp_alloc(&env->memory, n, 3 * sizeof *s->side);
    s->segment = iccp_alloc(&env->memory, n, 3 * sizeof *s->segment / 2 + 1);
    c.across = iccp_alloc(&env->memory, n, 3 * sizeof *c.across);
    icc_status status = ICC_ERR_MEMORY;
    if (s->side != NULL && s->segment != NULL && c.across != NULL &&
        (domain->features == NULL || list_lines(s, domain->features)))
        status = iccp_complex_join(&c, env, err);
    else
        iccp_fail_memory(err);
    if (status == ICC_OK)
        number_edges(s, c.across);
    iccp_free(&env->memory, c.across);
    for (size_t e = 0; e < s->n_segments && status == ICC_OK; ++e)
        if (iccp_pairs_add(&s->edges, s->segment[e].a, s->segment[e].b) == ICCP_PAIR_MEMORY)
            status = iccp_fail_memory(err);
    return status;
}

void iccp_constraints_free(iccp_constraints *s)
{
    iccp_free(&s->memory, s->side);
    iccp_free(&s->memory, s->segment);
    iccp_free(&s->memory, s->line);
    iccp_free(&s->memory, s->on_line);
    iccp_pairs_free(&s->edges);
    *s = (iccp_constraints){.memory = s->memory, .edges.memory = s->memory};
}

static const iccp_dyadic *dyadic(const iccp_tets *m, uint32_t p)
{
    return &m->points.dyadic[p - m->points.n_fixed];
}

uint32_t iccp_segment_next(const iccp_tets *m, const iccp_segment *segment, uint32_t p)
{
    return p == segment->a ? segment->first : dyadic(m, p)->next;
}

double iccp_segment_share(const iccp_tets *m, const iccp_segment *segment, uint32_t p)
{
    return p == segment->a ? 0.0 : p == segment->b ? 1.0 : dyadic(m, p)->share[1];
}

static bool is_corner(const uint32_t corners[3], uint32_t p)
{
    return corners[0] == p || corners[1] == p || corners[2] == p;
}

bool iccp_is_on_facet(const iccp_tets *m, const uint32_t corners[3], uint32_t p)
{
    if (!iccp_is_dyadic(&m->points, p))
        return is_corner(corners, p);
    const iccp_dyadic *const d = dyadic(m, p);
    return is_corner(corners, d->of[0]) && is_corner(corners, d->of[1]) &&
           (d->share[2] == 0.0 || is_corner(corners, d->of[2]));
}

uint32_t iccp_tets_add_dyadic(iccp_tets *m, const iccp_dyadic *point)
{
    iccp_points *const p = &m->points;
    if (p->n_dyadic == p->dyadic_room) {
        const size_t room = 2 * p->dyadic_room + 16;
        if (!iccp_enlarge(&m->memory, &p->dyadic, p->dyadic_room, room, sizeof *p->dyadic)) {
            m->no_memory = true;
            return ICCP_NO_TET;
        }
        p->dyadic_room = room;
    }
    double x[3] = {0};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3 && point->share[i] > 0.0; ++k)
            x[k] += point->share[i] * iccp_point(p, point->of[i])[k];
    const uint32_t number = iccp_tets_add_point(m, x);
    if (number != ICCP_NO_TET)
        p->dyadic[p->n_dyadic++] = *point;
    return number;
}

void iccp_tets_drop_dyadic(iccp_tets *m)
{
    --m->points.n_dyadic;
    iccp_tets_drop_point(m);
}

icc_status iccp_fail_facet(icc_error *err, uint32_t facet, const char *what)
{
    return iccp_fail_at(err, ICC_ERR_RESOLUTION, ICC_ITEM_FACET, (int64_t)facet, "face %lu: %s",
                        (unsigned long)facet, what);
}
