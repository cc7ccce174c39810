/* Tests whether triangles intersect. Two triangles meet if and only if a side of one meets the
 * other. Source: C. Ericson, Real-Time Collision Detection, section 5.2.10, with exact signs
 * instead of coordinates, and coplanar triangles in a projection.
 *
 * Triangles with a common corner meet elsewhere if and only if the opposite side of one meets the
 * other. The reason is that their common part beyond the corner reaches one of these sides. */
#include "geometry/triangles.h"

#include "geometry/fans.h"
#include "geometry/needles.h"
#include "geometry/segment.h"
#include "math/predicates.h"

#include <float.h>
#include <math.h>
#include <string.h>

typedef const double *const *triangle;

static void drop(double *out, const double *p, int axis)
{
    out[0] = p[(axis + 1) % 3];
    out[1] = p[(axis + 2) % 3];
}

/* Finds an axis along which the triangle's shadow has an area, and the shadow. */
static void cast_shadow(triangle t, double shadow[3][2], int *axis)
{
    for (*axis = 0; *axis < 3; ++*axis) {
        for (int i = 0; i < 3; ++i)
            drop(shadow[i], t[i], *axis);
        if (iccp_orient2d(shadow[0], shadow[1], shadow[2]) != 0)
            return;
    }
    *axis = 0;
}

static bool has_point(double t[3][2], const double *p)
{
    bool left = false, right = false;
    for (int i = 0; i < 3; ++i) {
        const int orientation = iccp_orient2d(t[i], t[(i + 1) % 3], p);
        left |= orientation > 0;
        right |= orientation < 0;
    }
    return !(left && right);
}

static bool coplanar_segment_meets(const double *p, const double *q, triangle t)
{
    double shadow[3][2], from[2], to[2];
    int axis;
    cast_shadow(t, shadow, &axis);
    drop(from, p, axis);
    drop(to, q, axis);
    for (int i = 0; i < 3; ++i)
        if (iccp_segments_meet(from, to, shadow[i], shadow[(i + 1) % 3]) != 0)
            return true;
    return has_point(shadow, from);
}

bool iccp_triangle_meets(triangle t, const double *p, const double *q)
{
    const int side = iccp_orient3d(t[0], t[1], t[2], p);
    if (side == iccp_orient3d(t[0], t[1], t[2], q))
        return side == 0 && coplanar_segment_meets(p, q, t);
    const int first = iccp_orient3d(p, q, t[0], t[1]);
    const int second = iccp_orient3d(p, q, t[1], t[2]);
    if (first * second < 0)
        return false;
    const int third = iccp_orient3d(p, q, t[2], t[0]);
    return first * third >= 0 && second * third >= 0;
}

/* Returns true if the points lie strictly on one side of a triangle's plane. */
static bool beside(triangle t, size_t n, triangle points)
{
    const int side = iccp_orient3d(t[0], t[1], t[2], points[0]);
    for (size_t i = 1; side != 0 && i < n; ++i)
        if (iccp_orient3d(t[0], t[1], t[2], points[i]) != side)
            return false;
    return side != 0;
}

/* Returns true if all of t lies beyond one side of s, which is oriented to the left (1) or right
 * (-1). */
static bool has_dividing_side(double s[3][2], int orientation, double t[3][2])
{
    for (int i = 0; i < 3; ++i) {
        int j = 0;
        while (j < 3 && iccp_orient2d(s[i], s[(i + 1) % 3], t[j]) == -orientation)
            ++j;
        if (j == 3)
            return true;
    }
    return false;
}

/* Two convex polygons that do not meet are separated by a side of one of them. The reason: the same
 * holds for zero and the polygons' difference, whose sides are theirs. */
static bool meet_coplanar(triangle s, triangle t)
{
    double shadow[3][2], other[3][2];
    int axis;
    cast_shadow(s, shadow, &axis);
    for (int i = 0; i < 3; ++i)
        drop(other[i], t[i], axis);
    const int left = iccp_orient2d(shadow[0], shadow[1], shadow[2]);
    const int other_left = iccp_orient2d(other[0], other[1], other[2]);
    return !has_dividing_side(shadow, left, other) && !has_dividing_side(other, other_left, shadow);
}

static bool meet_apart(triangle s, triangle t)
{
    const int sides[3] = {iccp_orient3d(s[0], s[1], s[2], t[0]),
                          iccp_orient3d(s[0], s[1], s[2], t[1]),
                          iccp_orient3d(s[0], s[1], s[2], t[2])};
    if (sides[0] == sides[1] && sides[0] == sides[2])
        return sides[0] == 0 && meet_coplanar(s, t);
    if (beside(t, 3, s))
        return false;
    for (int i = 0; i < 3; ++i)
        if (iccp_triangle_meets(t, s[i], s[(i + 1) % 3]) ||
            iccp_triangle_meets(s, t[i], t[(i + 1) % 3]))
            return true;
    return false;
}

/* Returns true if a segment's box meets another box. */
static ICCP_INLINE bool segment_reaches(const double *p, const double *q, const float *box)
{
    bool reaches = true;
    for (int k = 0; k < 3; ++k) {
        const double low = p[k] < q[k] ? p[k] : q[k], high = p[k] < q[k] ? q[k] : p[k];
        reaches &= (low <= box[3 + k]) & (box[k] <= high);
    }
    return reaches;
}

/* s[0] and t[0] are the common corner. Both opposite sides are within reach. */
static bool meet_at_corner(triangle s, triangle t)
{
    if (beside(s, 2, t + 1) || beside(t, 2, s + 1))
        return false;
    return iccp_triangle_meets(t, s[1], s[2]) || iccp_triangle_meets(s, t[1], t[2]);
}

/* The first two corners are common. The triangles overlap if they are coplanar and their third
 * corners lie on the same side. */
static bool meet_at_side(triangle s, triangle t)
{
    if (iccp_orient3d(s[0], s[1], s[2], t[2]) != 0)
        return false;
    double shadow[3][2], other[2];
    int axis;
    cast_shadow(s, shadow, &axis);
    drop(other, t[2], axis);
    return iccp_orient2d(shadow[0], shadow[1], shadow[2]) ==
           iccp_orient2d(shadow[0], shadow[1], other);
}

/* Sets bit 3 i + j if s[i] = t[j]. */
static ICCP_INLINE unsigned match(const uint32_t *s, const uint32_t *t)
{
    unsigned same = 0;
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned j = 0; j < 3; ++j)
            same |= (unsigned)(s[i] == t[j]) << (3 * i + j);
    return same;
}

/* Lists the corners of a triangle, beginning with corner i. */
static ICCP_INLINE void list_from(const double *vertices, const uint32_t *t, unsigned i,
                                  const double **corners)
{
    static const unsigned next[5] = {0, 1, 2, 0, 1};
    for (unsigned k = 0; k < 3; ++k)
        corners[k] = vertices + 3 * (size_t)t[next[i + k]];
}

/* Tests triangles with one common corner: one bit of `same` is set. Most pairs are of this kind,
 * and for most of them boxes decide. */
static ICCP_INLINE bool meet_at_one(const double *vertices, const uint32_t *s, const uint32_t *t,
                                    unsigned same, const float *box_s, const float *box_t)
{
    const double *a[3], *b[3];
    const unsigned i = same > 32 ? 2 : same > 4 ? 1 : 0, row = same >> 3 * i;
    list_from(vertices, s, i, a);
    list_from(vertices, t, row >> 1, b); /* 1, 2, 4: corner 0, 1, 2 */
    bool reach = segment_reaches(a[1], a[2], box_t);
    /* Both at once: a branch here would be mispredicted */
    reach |= segment_reaches(b[1], b[2], box_s);
    return reach && meet_at_corner(a, b);
}

/* Tests triangles with two common corners: two bits of `same` are set. Lists these two first, in
 * the same order in both. */
static bool meet_at_two(const double *vertices, const uint32_t *s, const uint32_t *t, unsigned same)
{
    const double *a[3], *b[3];
    int n = 0;
    for (unsigned i = 0; i < 3; ++i)
        for (unsigned j = 0; j < 3; ++j)
            if (same >> (3 * i + j) & 1) {
                a[n] = b[n] = vertices + 3 * (size_t)s[i];
                ++n;
            }
    for (unsigned i = 0; i < 3; ++i) {
        if ((same >> 3 * i & 7) == 0)
            a[2] = vertices + 3 * (size_t)s[i];
        if ((same >> i & 0111) == 0)
            b[2] = vertices + 3 * (size_t)t[i];
    }
    return meet_at_side(a, b);
}

/* The search's copy of a triangle, in the order of the tree. */
typedef struct place {
    float box[6];      /* lower and upper, slightly enlarged */
    uint32_t triangle; /* number of the triangle */
    /* Its vertices at which no triangles intersect. Other entries hold a number that is no
     * vertex. */
    uint32_t corner[3];
} place;

/* Tests whether two triangles meet, unless they share a vertex at which that is impossible. */
static bool places_meet(const double *vertices, const uint32_t *triangles, const place *p,
                        const place *q)
{
    const uint32_t *s = triangles + 3 * (size_t)p->triangle,
                   *t = triangles + 3 * (size_t)q->triangle;
    const double *a[3], *b[3];
    if (match(p->corner, q->corner) != 0)
        return false;
    const unsigned same = match(s, t), others = same & (same - 1);
    if (same != 0 && others == 0)
        return meet_at_one(vertices, s, t, same, p->box, q->box);
    if (same != 0)
        return (others & (others - 1)) != 0 || meet_at_two(vertices, s, t, same);
    list_from(vertices, s, 0, a);
    list_from(vertices, t, 0, b);
    return meet_apart(a, b);
}

/* Rounds a box to float so that it only grows. */
static void round_box(const double *exact, float *box)
{
    for (int k = 0; k < 6; ++k) {
        const float x = (float)exact[k], slack = fabsf(x) * 0x1p-22f + FLT_MIN;
        box[k] = k < 3 ? x - slack : x + slack;
    }
}

static void find_box(const double *vertices, const uint32_t *corners, float *box)
{
    double exact[6];
    const iccp_facet_tree one = {.vertices = vertices, .facets = corners};
    iccp_facet_box_of(&one, 3, 3, 0, exact);
    round_box(exact, box);
}

bool iccp_triangles_meet(const double *vertices, const uint32_t *s, const uint32_t *t)
{
    const uint32_t corners[6] = {s[0], s[1], s[2], t[0], t[1], t[2]};
    place p = {.corner = {UINT32_MAX, UINT32_MAX, UINT32_MAX}}, q = {.triangle = 1};
    find_box(vertices, s, p.box);
    find_box(vertices, t, q.box);
    q.corner[0] = q.corner[1] = q.corner[2] = UINT32_MAX - 1;
    return places_meet(vertices, corners, &p, &q);
}

/* ------------------------------------------------------------ all pairs */

/* Pairs of boxes per triangle that are compared one by one. Ordinary surfaces have about 10. */
enum { PATIENCE = 64 };

typedef struct search {
    const iccp_facet_tree *tree;
    const iccp_env *env;
    place *places;
    size_t first[2]; /* places of the first known pair that meets; tree->n: none */
    size_t n_left;   /* pairs of boxes that may still be compared */
    icc_status status;
} search;

static ICCP_INLINE bool boxes_meet(const float *a, const float *b)
{
    return (a[0] <= b[3]) & (b[0] <= a[3]) & (a[1] <= b[4]) & (b[1] <= a[4]) & (a[2] <= b[5]) &
           (b[2] <= a[5]);
}

static ICCP_INLINE bool nodes_meet(const double *a, const double *b)
{
    return (a[0] <= b[3]) & (b[0] <= a[3]) & (a[1] <= b[4]) & (b[1] <= a[4]) & (a[2] <= b[5]) &
           (b[2] <= a[5]);
}

/* Compares a pair unless an earlier one is known to meet. */
static void compare_places(search *s, size_t p, size_t q)
{
    const place *a = &s->places[p], *b = &s->places[q];
    s->n_left -= s->n_left > 0;
    if (!boxes_meet(a->box, b->box) || p > s->first[0] || (p == s->first[0] && q > s->first[1]))
        return;
    if (places_meet(s->tree->vertices, s->tree->facets, a, b)) {
        s->first[0] = p;
        s->first[1] = q;
    }
}

static size_t leaf_start(const search *s, size_t node)
{
    return (node - s->tree->n_leaves) * ICCP_FACET_LEAF;
}

static size_t leaf_end(const search *s, size_t node)
{
    const size_t end = leaf_start(s, node) + ICCP_FACET_LEAF;
    return end < s->tree->n ? end : s->tree->n;
}

static void compare_in_leaf(search *s, size_t node)
{
    const size_t start = leaf_start(s, node), end = leaf_end(s, node);
    if (s->status == ICC_OK && start % (64 * ICCP_FACET_LEAF) == 0)
        s->status = iccp_progress(s->env, "check", (double)start / (double)s->tree->n);
    for (size_t p = start; p < end; ++p)
        for (size_t q = p + 1; q < end; ++q)
            compare_places(s, p, q);
}

/* Lists the places of a leaf whose boxes meet that of another place. Returns their number. Has no
 * branches. */
static ICCP_INLINE size_t list_places(const search *s, size_t node, size_t other, size_t *list)
{
    const size_t start = leaf_start(s, node), end = leaf_end(s, node);
    float box[6];
    size_t n = 0;
    round_box(s->tree->boxes + 6 * other, box);
    for (size_t p = start; p < end; ++p) {
        list[n] = p;
        n += boxes_meet(s->places[p].box, box);
    }
    return n;
}

static void compare_leaves(search *s, size_t a, size_t b)
{
    size_t of_a[ICCP_FACET_LEAF], of_b[ICCP_FACET_LEAF];
    const size_t n_a = list_places(s, a, b, of_a);
    const size_t n_b = n_a > 0 ? list_places(s, b, a, of_b) : 0;
    for (size_t i = 0; i < n_a; ++i)
        for (size_t j = 0; j < n_b; ++j)
            compare_places(s, of_a[i], of_b[j]);
}

static double extent(const double *box)
{
    return (box[3] - box[0]) + (box[4] - box[1]) + (box[5] - box[2]);
}

/* Compares the triangles below two nodes. The places below the second come later. If two boxes
 * overlap, the larger one is halved. */
static void compare(search *s, size_t a, size_t b)
{
    const double *box_a = s->tree->boxes + 6 * a, *box_b = s->tree->boxes + 6 * b;
    if (s->status != ICC_OK || s->n_left == 0 || !nodes_meet(box_a, box_b))
        return;
    --s->n_left;
    const bool a_leaf = a >= s->tree->n_leaves, b_leaf = b >= s->tree->n_leaves;
    if (a_leaf && b_leaf) {
        compare_leaves(s, a, b);
    } else if (b_leaf || (!a_leaf && extent(box_a) > extent(box_b))) {
        compare(s, 2 * a, b);
        compare(s, 2 * a + 1, b);
    } else {
        compare(s, a, 2 * b);
        compare(s, a, 2 * b + 1);
    }
}

static void compare_within(search *s, size_t node)
{
    if (node >= s->tree->n_leaves) {
        compare_in_leaf(s, node);
        return;
    }
    compare_within(s, 2 * node);
    compare_within(s, 2 * node + 1);
    compare(s, 2 * node, 2 * node + 1);
}

/* Fills in the places of the triangles. Of their corners it keeps those in `good`. */
static void fill_places(search *s, const uint8_t *good)
{
    const iccp_facet_tree *tree = s->tree;
    for (size_t k = 0; k < tree->n; ++k) {
        place *p = &s->places[k];
        const uint32_t *corners = tree->facets + 3 * (size_t)tree->order[k];
        p->triangle = tree->order[k];
        find_box(tree->vertices, corners, p->box);
        for (uint32_t i = 0; i < 3; ++i)
            p->corner[i] = good[corners[i]] ? corners[i] : UINT32_MAX - 3 * p->triangle - i;
    }
}

/* The callback for iccp_needles_compare(). */
static bool find_meeting(void *context, uint32_t p, uint32_t q)
{
    search *s = context;
    compare_places(s, p < q ? p : q, p < q ? q : p);
    return s->first[0] < s->tree->n;
}

icc_status iccp_triangles_find(const iccp_facet_tree *tree, size_t n_vertices, uint32_t pair[2],
                               const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    search s = {.tree = tree,
                .env = env,
                .first = {tree->n, tree->n},
                .n_left = PATIENCE * (tree->n + PATIENCE)};
    uint8_t *good = iccp_fans_find(tree, n_vertices, memory);
    s.places = iccp_alloc(memory, tree->n, sizeof *s.places);
    s.status = good != NULL && s.places != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (s.status == ICC_OK) {
        fill_places(&s, good);
        compare_within(&s, 1);
    }
    if (s.status == ICC_OK && s.n_left == 0 && s.first[0] == tree->n)
        s.status = iccp_needles_compare(tree, n_vertices, find_meeting, &s, env);
    iccp_free(memory, s.places);
    iccp_free(memory, good);
    pair[0] = pair[1] = 0;
    if (s.status == ICC_OK && s.first[0] < tree->n) {
        const uint32_t f = tree->order[s.first[0]], g = tree->order[s.first[1]];
        pair[0] = f < g ? f : g;
        pair[1] = f < g ? g : f;
    }
    return s.status;
}
