/* Barriers between a vertex and an edge: M. Li et al., Incremental potential contact, 2020, in the
 * plane. A pair that is near already before the map gets a shorter range, so the shape is at rest
 * there. */
#include "fit/elastic/contact.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* The range as a share of the median length of an edge of the free outline, and as a share of a
 * pair's distance before the map. */
static const double RANGE = 0.3, SHARE_OF_DISTANCE = 0.5;

/* Strength of a barrier as a share of the mean weight of a triangle. */
static const double STRENGTH = 1;

/* Lists the lengths of edges that are not told. */
static size_t list_lengths(const iccp_contact_shape *shape, double *length)
{
    const iccp_outlines *o = shape->outlines;
    size_t n = 0;
    for (size_t r = 0; r < o->n; ++r)
        for (uint32_t k = o->ring[r].first; k < o->ring[r].first + o->ring[r].n; ++k) {
            const uint32_t a = o->vertex[k], b = o->vertex[k + 1];
            const double *p = shape->points + 2 * (size_t)a, *q = shape->points + 2 * (size_t)b;
            if (!shape->fixed[a] || !shape->fixed[b])
                length[n++] = iccp_hypot(q[0] - p[0], q[1] - p[1]);
        }
    return n;
}

icc_status iccp_contact_measure(iccp_contact_shape *shape, double weight, const iccp_env *env)
{
    double *length = iccp_alloc(&env->memory, shape->outlines->n_points, sizeof *length);
    if (length == NULL)
        return ICC_ERR_MEMORY;
    const size_t n = list_lengths(shape, length);
    shape->range = n > 0 ? RANGE * iccp_select(length, n, n / 2) : 0;
    shape->strength = STRENGTH * weight;
    iccp_free(&env->memory, length);
    return ICC_OK;
}

/* ---- the grid ---- */

icc_status iccp_contact_create(iccp_contact *contact, const iccp_contact_shape *shape,
                               const iccp_env *env)
{
    const size_t n = shape->outlines->n_points;
    iccp_contact *s = contact;
    *s = (iccp_contact){.memory = env->memory, .shape = shape};
    s->side = (uint32_t)sqrt((double)n) + 2;
    s->first = iccp_alloc(&s->memory, (size_t)s->side * s->side + 1, sizeof *s->first);
    s->cell = iccp_alloc(&s->memory, n, sizeof *s->cell);
    s->listed = iccp_alloc(&s->memory, n, sizeof *s->listed);
    return s->first != NULL && s->cell != NULL && s->listed != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

void iccp_contact_free(iccp_contact *contact)
{
    const iccp_memory memory = contact->memory;
    iccp_free(&memory, contact->touch);
    iccp_free(&memory, contact->first);
    iccp_free(&memory, contact->cell);
    iccp_free(&memory, contact->listed);
    *contact = (iccp_contact){.memory = memory};
}

/* The grid over the present images of the outlines. */
typedef struct grid {
    const double *images;
    double lower[2], rate; /* 1 / width of a cell */
    uint32_t side;
} grid;

static uint32_t column_of(const grid *g, double x, size_t axis)
{
    const double at = (x - g->lower[axis]) * g->rate;
    return at <= 0 ? 0 : at >= g->side - 1 ? g->side - 1 : (uint32_t)at;
}

/* Computes the bounding box of the outlines. */
static double fit_grid(const iccp_contact *s, grid *g)
{
    const iccp_outlines *o = s->shape->outlines;
    double upper[2] = {-HUGE_VAL, -HUGE_VAL};
    g->lower[0] = g->lower[1] = HUGE_VAL;
    for (size_t k = 0; k < o->n_points; ++k)
        for (size_t d = 0; d < 2; ++d) {
            const double x = g->images[2 * (size_t)o->vertex[k] + d];
            g->lower[d] = iccp_min(g->lower[d], x);
            upper[d] = iccp_max(upper[d], x);
        }
    return iccp_max(upper[0] - g->lower[0], upper[1] - g->lower[1]);
}

/* Sorts the outlines' vertices into cells that are no narrower than `least`. The repeated first
 * vertex of a ring does not count. */
static grid fill_cells(iccp_contact *s, const double *images, double least)
{
    const iccp_outlines *o = s->shape->outlines;
    const size_t n_cells = (size_t)s->side * s->side;
    grid g = {.images = images, .side = s->side};
    g.rate = 1 / iccp_max(fit_grid(s, &g) / (s->side - 1), least);
    memset(s->first, 0, (n_cells + 1) * sizeof *s->first);
    for (size_t r = 0; r < o->n; ++r)
        for (uint32_t k = o->ring[r].first; k < o->ring[r].first + o->ring[r].n; ++k) {
            const double *x = images + 2 * (size_t)o->vertex[k];
            s->cell[k] = column_of(&g, x[1], 1) * s->side + column_of(&g, x[0], 0);
            ++s->first[s->cell[k]];
        }
    for (size_t c = 0; c < n_cells; ++c)
        s->first[c + 1] += s->first[c];
    for (size_t r = 0; r < o->n; ++r)
        for (uint32_t k = o->ring[r].first; k < o->ring[r].first + o->ring[r].n; ++k)
            s->listed[--s->first[s->cell[k]]] = o->vertex[k];
    return g;
}

/* ---- distances ---- */

/* The share s of the way from a to b that is nearest to p, and the vector r from there to p.
 * Returns its length. */
static double distance(const double *a, const double *b, const double *p, double *s, double *r)
{
    const double ux = b[0] - a[0], uy = b[1] - a[1], vx = p[0] - a[0], vy = p[1] - a[1];
    const double along = (ux * vx + uy * vy) / (ux * ux + uy * uy);
    *s = along > 0 ? iccp_min(along, 1) : 0;
    r[0] = vx - *s * ux;
    r[1] = vy - *s * uy;
    return sqrt(r[0] * r[0] + r[1] * r[1]);
}

static double distance_of(const iccp_touch *t, const double *images)
{
    double s, r[2];
    return distance(images + 2 * (size_t)t->a, images + 2 * (size_t)t->b, images + 2 * (size_t)t->p,
                    &s, r);
}

/* ---- pairs ---- */

static icc_status add_pair(iccp_contact *s, const double *images, iccp_touch *t, double reach)
{
    const iccp_contact_shape *shape = s->shape;
    if (shape->fixed[t->a] && shape->fixed[t->b] && shape->fixed[t->p])
        return ICC_OK;
    const double d = distance_of(t, images);
    if (d >= reach * shape->range)
        return ICC_OK;
    t->range = iccp_min(shape->range, SHARE_OF_DISTANCE * distance_of(t, shape->points));
    if (d >= reach * t->range)
        return ICC_OK;
    if (s->n == s->room) {
        const size_t room = 2 * s->room + 64;
        if (!iccp_enlarge(&s->memory, &s->touch, s->n, room, sizeof *s->touch))
            return ICC_ERR_MEMORY;
        s->room = room;
    }
    s->touch[s->n++] = *t;
    return ICC_OK;
}

/* Finds the vertices near the edge from a to b. */
static icc_status search_edge(iccp_contact *s, const grid *g, uint32_t a, uint32_t b, double reach)
{
    const double far = reach * s->shape->range;
    const double *p = g->images + 2 * (size_t)a, *q = g->images + 2 * (size_t)b;
    uint32_t from[2], to[2];
    for (size_t d = 0; d < 2; ++d) {
        from[d] = column_of(g, iccp_min(p[d], q[d]) - far, d);
        to[d] = column_of(g, iccp_max(p[d], q[d]) + far, d);
    }
    for (uint32_t y = from[1]; y <= to[1]; ++y) {
        const uint32_t begin = s->first[y * g->side + from[0]],
                       end = s->first[y * g->side + to[0] + 1];
        for (uint32_t k = begin; k < end; ++k) {
            iccp_touch t = {a, b, s->listed[k], 0};
            if (t.p == a || t.p == b)
                continue;
            const icc_status status = add_pair(s, g->images, &t, reach);
            if (status != ICC_OK)
                return status;
        }
    }
    return ICC_OK;
}

icc_status iccp_contact_find(iccp_contact *contact, const double *images, double reach)
{
    iccp_contact *s = contact;
    const iccp_outlines *o = s->shape->outlines;
    s->n = 0;
    if (!(s->shape->range > 0))
        return ICC_OK;
    const grid g = fill_cells(s, images, reach * s->shape->range);
    icc_status status = ICC_OK;
    for (size_t r = 0; r < o->n; ++r)
        for (uint32_t k = o->ring[r].first; status == ICC_OK && k < o->ring[r].first + o->ring[r].n;
             ++k)
            status = search_edge(s, &g, o->vertex[k], o->vertex[k + 1], reach);
    return status;
}

/* ---- barriers ---- */

double iccp_contact_energy(const iccp_contact *contact, const double *images)
{
    double sum = 0;
    for (size_t k = 0; k < contact->n; ++k) {
        const double share = distance_of(&contact->touch[k], images) / contact->touch[k].range;
        if (share < 1)
            sum -= (share - 1) * (share - 1) * iccp_ln(share);
    }
    return contact->shape->strength * sum;
}

bool iccp_contact_local(const iccp_touch *touch, double strength, const double *images,
                        iccp_local *local)
{
    double s, r[2];
    const double d = distance(images + 2 * (size_t)touch->a, images + 2 * (size_t)touch->b,
                              images + 2 * (size_t)touch->p, &s, r);
    const double x = d / touch->range, y = x - 1;
    if (!(x < 1) || !(d > 0))
        return false;
    const double log = iccp_ln(x);
    const double slope = -strength * (2 * y * log + y * y / x) / touch->range;
    const double bend =
        -strength * (2 * log + 4 * y / x - y * y / (x * x)) / (touch->range * touch->range);
    const double factor[3] = {s - 1, -s, 1};
    double by[6];
    for (int i = 0; i < 6; ++i) {
        by[i] = factor[i / 2] * r[i % 2] / d;
        local->gradient[i] = slope * by[i];
    }
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            local->hessian[6 * i + j] = bend * by[i] * by[j];
    return true;
}
