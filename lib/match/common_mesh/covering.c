/* Keeps the points of a surface assigned to a coarser one while that changes. Based on: J. Cohen,
 * D. Manocha, M. Olano, Simplifying Polygonal Models Using Successive Mappings, 1997. Each point of
 * the given surface keeps a partner on the coarser one. So only the surroundings of a change have
 * to be measured. */
#include "match/common_mesh/covering.h"

#include "match/surface/corner_angle.h"

/* A point that was accepted as close stays close if it is measured another way. */
static const double rounding = 1 - 1e-9;

bool iccp_covering_create(iccp_covering *c, const iccp_half_edges *given, const double *x_given,
                          size_t n_points, const double *points, double most,
                          const iccp_facet_tree *coarse, const iccp_memory *memory)
{
    *c = (iccp_covering){.x = points, .most2 = rounding * most * most};
    iccp_facet_tree_create(&c->given, 3, x_given, given->n_faces, given->origin, memory);
    c->first = iccp_alloc(memory, coarse->n, sizeof *c->first);
    c->next = iccp_alloc(memory, n_points, sizeof *c->next);
    if (c->given.boxes == NULL || c->first == NULL || c->next == NULL)
        return false;
    for (size_t f = 0; f < coarse->n; ++f)
        c->first[f] = ICCP_NO_EDGE;
    for (uint32_t i = 0; i < n_points; ++i) {
        double off2;
        const uint32_t f = iccp_triangle_near(coarse, points + 3 * (size_t)i, -1, HUGE_VAL, &off2);
        c->next[i] = c->first[f];
        c->first[f] = i;
    }
    return true;
}

void iccp_covering_free(iccp_covering *c, const iccp_memory *memory)
{
    iccp_facet_tree_free(&c->given, memory);
    iccp_free(memory, c->first);
    iccp_free(memory, c->next);
}

static double distance2(const iccp_corners *t, const double *p)
{
    return iccp_triangle_distance2(t->at[0], t->at[1], t->at[2], p);
}

/* Returns true if a weighted mean of a triangle's corners is close to the surface. *faces_so
 * becomes true if the triangle faces the same way as the surface there. */
static bool look_at(const iccp_covering *c, const iccp_corners *t, const double weight[3],
                    const double normal[3], bool *faces_so)
{
    const double *right[3];
    double p[3], wanted[3], off2;
    for (int k = 0; k < 3; ++k)
        p[k] = weight[0] * t->at[0][k] + weight[1] * t->at[1][k] + weight[2] * t->at[2][k];
    const uint32_t f = iccp_triangle_near(&c->given, p, *faces_so ? c->most2 : -1, c->most2, &off2);
    if (f == UINT32_MAX)
        return false;
    if (*faces_so)
        return true;
    iccp_facet_corners(&c->given, f, right);
    iccp_triangle_normal(wanted, right[0], right[1], right[2]);
    *faces_so = iccp_vec_dot(3, normal, wanted) >
                iccp_least_cosine * iccp_vec_norm(3, normal) * iccp_vec_norm(3, wanted);
    return true;
}

/* Returns true if a triangle fits: its middle and that of its first side are close to the surface,
 * and it faces the same way at one of them. Its other sides are first sides of other triangles, or
 * were there before. */
static bool fits(const iccp_covering *c, const iccp_corners *t)
{
    static const double middles[4][3] = {
        {1 / 3., 1 / 3., 1 / 3.}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.5, 0, 0.5}};
    bool faces_so = false;
    double normal[3];
    iccp_triangle_normal(normal, t->at[0], t->at[1], t->at[2]);
    for (int i = 0; i < 2; ++i)
        if (!look_at(c, t, middles[i], normal, &faces_so))
            return false;
    for (int i = 2; i < 4 && !faces_so; ++i)
        (void)look_at(c, t, middles[i], normal, &faces_so);
    return faces_so;
}

bool iccp_covering_allows(iccp_covering *c, size_t n_old, const uint32_t *old, size_t n,
                          const iccp_corners *triangles)
{
    size_t t = 0;
    for (size_t k = 0; k < n_old; ++k)
        for (uint32_t before = ICCP_NO_EDGE, i = c->first[old[k]]; i != ICCP_NO_EDGE;
             before = i, i = c->next[i]) {
            size_t tries = 0;
            /* The point before it was close to this triangle. */
            while (tries < n && !(distance2(&triangles[t], c->x + 3 * (size_t)i) <= c->most2)) {
                t = t + 1 == n ? 0 : t + 1;
                ++tries;
            }
            if (tries == n) {
                /* A point that was too far away is tested first next time. */
                if (before != ICCP_NO_EDGE) {
                    c->next[before] = c->next[i];
                    c->next[i] = c->first[old[k]];
                    c->first[old[k]] = i;
                }
                return false;
            }
        }
    for (t = 0; t < n; ++t)
        if (!fits(c, &triangles[t]))
            return false;
    return true;
}

void iccp_covering_replace(iccp_covering *c, size_t n_old, const uint32_t *old, size_t n,
                           const iccp_corners *triangles, const uint32_t *numbers)
{
    uint32_t list = ICCP_NO_EDGE;
    for (size_t k = 0; k < n_old; ++k) {
        for (uint32_t i = c->first[old[k]], next; i != ICCP_NO_EDGE; i = next) {
            next = c->next[i];
            c->next[i] = list;
            list = i;
        }
        c->first[old[k]] = ICCP_NO_EDGE;
    }
    for (uint32_t i = list, next; i != ICCP_NO_EDGE; i = next) {
        double least = HUGE_VAL;
        size_t best = 0;
        next = c->next[i];
        for (size_t t = 0; t < n; ++t) {
            const double off2 = distance2(&triangles[t], c->x + 3 * (size_t)i);
            if (off2 < least) {
                least = off2;
                best = t;
            }
        }
        c->next[i] = c->first[numbers[best]];
        c->first[numbers[best]] = i;
    }
}
