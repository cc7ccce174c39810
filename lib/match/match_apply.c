/* Takes points of one boundary to the other, by the nearest facet. */
#include "match/match_apply.h"

#include "base/threads.h"
#include "domain/features.h"
#include "geometry/away.h"
#include "math/vec.h"

enum { AT_ONCE = 1024 };

typedef struct follow {
    const icc_domain *from, *to;
    const iccp_facet_tree *places;
    const double *points;
    double *images, *off;
} follow;

void iccp_match_index(icc_match *match)
{
    for (int e = 0; e < 2; ++e) {
        const icc_domain *const d = match->domain[e];
        if (d->features != NULL && d->features->n_places > d->n_facets)
            iccp_facet_tree_create(&match->places[e], 2, d->vertices, d->features->n_places,
                                   d->facets, &match->memory);
    }
}

/* Finds the facet nearest to a local point among those of the boundary, lines and points. */
static void find(const follow *f, const double *local, uint32_t *facet, double *bary)
{
    double reachable[ICC_MAX_DIM];
    if (f->places->n == 0) {
        (void)iccp_domain_locate(f->from, local, false, facet, bary);
        return;
    }
    iccp_away_reach(2, local, reachable);
    *facet = iccp_facet_tree_nearest_local(f->places, reachable, bary);
}

/* A place on a facet, in the caller's coordinates. At a vertex it is the vertex as given. */
static void place_of(const icc_domain *domain, uint32_t facet, const double *bary, double *out)
{
    const size_t dim = (size_t)domain->dim;
    double local[3];
    for (size_t i = 0; i < dim; ++i)
        if (bary[i] == 1) {
            iccp_domain_given(domain, domain->facets[dim * facet + i], out);
            return;
        }
    iccp_domain_facet_point(domain, facet, bary, local);
    iccp_frame_out(&domain->frame, domain->dim, local, out);
}

static icc_status follow_chunk(void *argument, size_t begin, size_t end)
{
    const follow *const f = argument;
    const size_t dim = (size_t)f->from->dim;
    for (size_t i = begin; i < end; ++i) {
        const double *const p = f->points + dim * i;
        double local[3], bary[3], nearest[3], image[3] = {NAN, NAN, NAN}, distance = NAN;
        uint32_t facet;
        if (iccp_all_finite(dim, p)) {
            iccp_frame_in(&f->from->frame, f->from->dim, p, local);
            find(f, local, &facet, bary);
            place_of(f->from, facet, bary, nearest);
            place_of(f->to, facet, bary, image);
            distance = iccp_vec_distance(dim, p, nearest);
        }
        if (f->off != NULL)
            f->off[i] = distance;
        for (size_t k = 0; k < dim; ++k)
            f->images[dim * i + k] = image[k];
    }
    return ICC_OK;
}

icc_status iccp_match_apply(const icc_match *match, int side, size_t n, const double *points,
                            double *images, double *off, const iccp_env *env)
{
    follow f = {
        match->domain[side], match->domain[1 - side], &match->places[side], points, images, off};
    return iccp_for_chunks(env, "trace", n, AT_ONCE, follow_chunk, &f);
}
