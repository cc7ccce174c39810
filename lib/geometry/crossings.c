/* Where lines, rays and segments cross a boundary, by exact signs of determinants. */
#include "geometry/crossings.h"

#include "math/orient.h"

#include <math.h>

enum { MAX = ICC_MAX_DIM };

/* A facet and a point, projected along an axis. */
typedef struct shadow {
    double at[MAX + 1][MAX];
} shadow;

static void cast(double *out, size_t dim, size_t axis, const double *x)
{
    for (size_t k = 0; k + 1 < dim; ++k)
        out[k] = x[k < axis ? k : k + 1];
}

/* p lies within the shadow, which is a simplex, if for each of its facets p and the opposite corner
 * lie on the same side. */
int iccp_facet_crossed(const iccp_facet_tree *tree, uint32_t facet, size_t axis, const double *p)
{
    const size_t dim = tree->dim;
    const double *corners[MAX], *at[MAX];
    shadow s;
    int common = 0;
    iccp_facet_corners(tree, facet, corners);
    for (size_t i = 0; i < dim; ++i)
        cast(s.at[i], dim, axis, corners[i]);
    cast(s.at[dim], dim, axis, p);
    for (size_t i = 0; i < dim; ++i) {
        for (size_t j = 0; j < dim; ++j)
            at[j] = s.at[j < i ? j : j + 1];
        const int sign = iccp_orient_beside(dim - 1, at);
        const int oriented = (dim - 1 - i) % 2 == 0 ? sign : -sign;
        if (oriented == 0 || oriented == -common)
            return 0;
        common = oriented;
    }
    return common;
}

/* Returns on which side of a facet's plane p lies. The determinant of the corners and p grows along
 * the axis, at a rate of +-1 times the orientation of the shadow. */
static bool is_before(const iccp_facet_tree *tree, uint32_t facet, size_t axis, const double *p,
                      int crossed)
{
    const double *points[MAX + 1];
    iccp_facet_corners(tree, facet, points);
    points[tree->dim] = p;
    const int side = iccp_orient(tree->dim, points);
    return side * crossed * ((tree->dim - 1 + axis) % 2 == 0 ? 1 : -1) < 0;
}

/* Returns the coordinate along the axis where the line meets the plane of a facet, limited to the
 * facet's box. */
static double crossing_at(const iccp_facet_tree *tree, uint32_t facet, size_t axis, const double *p)
{
    const size_t dim = tree->dim;
    const double *corners[MAX + 1], *at[MAX];
    double start[MAX], box[2 * MAX];
    shadow s;
    iccp_facet_corners(tree, facet, corners);
    iccp_facet_box(tree, facet, box);
    for (size_t i = 0; i < dim; ++i) {
        start[i] = i == axis ? 0.5 * (box[i] + box[dim + i]) : p[i];
        cast(s.at[i], dim, axis, corners[i]);
        at[i] = s.at[i];
    }
    corners[dim] = start;
    const double height = iccp_orient_value(dim, corners);
    const double rate = iccp_orient_value(dim - 1, at);
    const double step = height / ((dim - 1 + axis) % 2 == 0 ? -rate : rate);
    const double x = start[axis] + (step == step ? step : 0);
    return x < box[axis] ? box[axis] : x > box[dim + axis] ? box[dim + axis] : x;
}

static bool comes_after(const iccp_line_crossing *a, const iccp_line_crossing *b)
{
    return a->at > b->at || (!(a->at < b->at) && a->facet > b->facet);
}

static void sift(iccp_line_crossing *heap, size_t root, size_t n)
{
    const iccp_line_crossing item = heap[root];
    for (size_t child; (child = 2 * root + 1) < n; root = child) {
        child += child + 1 < n && comes_after(&heap[child + 1], &heap[child]);
        if (!comes_after(&heap[child], &item))
            break;
        heap[root] = heap[child];
    }
    heap[root] = item;
}

/* Heapsort, which needs no memory. */
static void sort(iccp_line_crossing *crossings, size_t n)
{
    for (size_t i = n / 2; i-- > 0;)
        sift(crossings, i, n);
    for (size_t i = n; i-- > 1;) {
        const iccp_line_crossing last = crossings[i];
        crossings[i] = crossings[0];
        crossings[0] = last;
        sift(crossings, 0, i);
    }
}

static void line_box(size_t dim, size_t axis, const double *p, double *box)
{
    for (size_t k = 0; k < dim; ++k) {
        box[k] = k == axis ? -HUGE_VAL : p[k];
        box[dim + k] = k == axis ? HUGE_VAL : p[k];
    }
}

size_t iccp_line_crossings(const iccp_facet_tree *tree, size_t axis, const double *p,
                           size_t capacity, iccp_line_crossing *crossings)
{
    double box[2 * MAX];
    iccp_facet_query query;
    uint32_t facet;
    size_t n = 0;
    line_box(tree->dim, axis, p, box);
    iccp_facet_query_start(&query, tree, box);
    while (iccp_facet_query_next(&query, &facet))
        if (iccp_facet_crossed(tree, facet, axis, p) != 0) {
            if (n < capacity)
                crossings[n] = (iccp_line_crossing){crossing_at(tree, facet, axis, p), facet};
            ++n;
        }
    sort(crossings, n < capacity ? n : capacity);
    return n;
}

bool iccp_ray_start(iccp_ray *ray, const iccp_facet_tree *tree, const double *p)
{
    const double *whole = tree->boxes + 2 * tree->dim;
    double shortest = HUGE_VAL, box[2 * MAX];
    *ray = (iccp_ray){.from = p};
    for (size_t k = 0; k < tree->dim; ++k) {
        const double down = p[k] - whole[k], up = whole[tree->dim + k] - p[k];
        const double way = up < down ? up : down;
        if (way < 0)
            return false;
        if (way < shortest) {
            shortest = way;
            ray->axis = k;
            ray->upwards = up < down;
        }
    }
    line_box(tree->dim, ray->axis, p, box);
    box[ray->upwards ? ray->axis : tree->dim + ray->axis] = p[ray->axis];
    iccp_facet_query_start(&ray->query, tree, box);
    return true;
}

bool iccp_ray_next(iccp_ray *ray, uint32_t *facet)
{
    const iccp_facet_tree *tree = ray->query.tree;
    while (iccp_facet_query_next(&ray->query, facet)) {
        const int crossed = iccp_facet_crossed(tree, *facet, ray->axis, ray->from);
        if (crossed != 0 && is_before(tree, *facet, ray->axis, ray->from, crossed) == ray->upwards)
            return true;
    }
    return false;
}

/* Tests whether a segment meets a facet. Its ends lie on different sides of the facet's plane, or
 * one lies on it. It meets the facet if it passes all of the facet's sides in the same
 * direction. */
static bool within_sides(const iccp_facet_tree *tree, const double *const *corners,
                         const double *from, const double *to)
{
    const size_t dim = tree->dim;
    bool seen[2] = {false, false};
    for (size_t i = 0; i < dim; ++i) {
        const double *at[MAX + 1];
        size_t n = 0;
        for (size_t j = 0; j < dim; ++j)
            if (j != i)
                at[n++] = corners[j];
        at[n++] = from;
        at[n] = to;
        const int sign = iccp_orient(dim, at);
        const int oriented = i % 2 == 0 ? sign : -sign;
        seen[0] |= oriented < 0;
        seen[1] |= oriented > 0;
    }
    return !(seen[0] && seen[1]);
}

bool iccp_segment_meets(const iccp_facet_tree *tree, uint32_t facet, const double *from,
                        const double *to, double *share)
{
    const double *points[MAX + 1];
    iccp_facet_corners(tree, facet, points);
    points[tree->dim] = from;
    const int sign_from = iccp_orient(tree->dim, points);
    points[tree->dim] = to;
    const int sign_to = iccp_orient(tree->dim, points);
    if (sign_from == sign_to || !within_sides(tree, points, from, to))
        return false;
    const double height_to = fabs(iccp_orient_value(tree->dim, points));
    points[tree->dim] = from;
    const double height_from = fabs(iccp_orient_value(tree->dim, points));
    const double height = height_from + height_to;
    *share = sign_from == 0 ? 0 : sign_to == 0 ? 1 : height > 0 ? height_from / height : 0;
    return true;
}

static void segment_box(size_t dim, const double *from, const double *to, double *box)
{
    for (size_t k = 0; k < dim; ++k) {
        box[k] = from[k] < to[k] ? from[k] : to[k];
        box[dim + k] = from[k] < to[k] ? to[k] : from[k];
    }
}

bool iccp_segment_crossing(const iccp_facet_tree *tree, const double *from, const double *to,
                           double *share, uint32_t *facet)
{
    double box[2 * MAX], at;
    iccp_facet_query query;
    uint32_t next;
    bool found = false;
    segment_box(tree->dim, from, to, box);
    iccp_facet_query_start(&query, tree, box);
    query.from = from;
    query.to = to;
    while (iccp_facet_query_next(&query, &next)) {
        if (!iccp_segment_meets(tree, next, from, to, &at))
            continue;
        if (!found || at < *share || (!(at > *share) && next < *facet)) {
            *share = at;
            *facet = next;
        }
        found = true;
    }
    return found;
}
