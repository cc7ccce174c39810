/* Lists the defects of a polygon. It visits points and edges in their order, so the list is sorted
 * and need not be stored. */
#include "geometry/defects.h"

#include "geometry/point_order.h"
#include "geometry/segment.h"
#include "math/predicates.h"

/* Pairs of edges, per edge, that iccp_defects_first() looks at before it gives up. Outlines need
 * less than 2. The diagonal comb of tests/unit/domain/test_domain.c, whose boxes all overlap, needs
 * n / 2. */
enum { PATIENCE = 64 };

/* A list ends after LISTED defects plus LISTED_EACH for each vertex, because as many pairs of edges
 * can cross as there are. Every vertex may be both repeated and a spike. */
enum { LISTED = 10000, LISTED_EACH = 4 };

static const uint32_t NONE = UINT32_MAX;

typedef struct walk {
    const iccp_polygon *polygon;
    const iccp_boxtree *tree;
    uint32_t *order; /* finite points, sorted by x, y, index */
    uint32_t *twin;  /* for each point: the next equal one */
    size_t n_finite;
    iccp_defect_list *list;
    size_t enough; /* stop after this many defects */
    size_t n_pairs, patience;
} walk;

static const double *point(const walk *w, uint32_t k)
{
    return w->polygon->points + 2 * (size_t)k;
}

static bool finite(const walk *w, uint32_t k)
{
    const double *p = point(w, k);
    return p[0] == p[0] && p[1] == p[1];
}

/* Returns false also if an end is not finite. */
static bool has_length(const walk *w, uint32_t edge)
{
    return finite(w, edge) && finite(w, edge + 1) &&
           !iccp_point_equal(point(w, edge), point(w, edge + 1));
}

static void emit(walk *w, int32_t kind, uint32_t a, uint32_t b)
{
    iccp_defect_list *list = w->list;
    if (list->n < list->capacity) {
        list->kinds[list->n] = kind;
        list->items[2 * list->n] = a;
        list->items[2 * list->n + 1] = b;
    }
    ++list->n;
}

/* Returns true if all finite points lie on one line, which the first point and the first different
 * one determine. */
static bool flat(const walk *w)
{
    const uint32_t n = (uint32_t)w->polygon->n;
    uint32_t a = 0, b;
    while (a < n && !finite(w, a))
        ++a;
    for (b = a; b < n; ++b)
        if (finite(w, b) && !iccp_point_equal(point(w, a), point(w, b)))
            break;
    for (uint32_t c = b; c < n; ++c)
        if (finite(w, c) && iccp_orient2d(point(w, a), point(w, b), point(w, c)) != 0)
            return false;
    return true;
}

static bool spike(const walk *w, uint32_t v)
{
    const uint32_t before = iccp_polygon_before(w->polygon, v);
    return has_length(w, before) && has_length(w, v) &&
           iccp_point_folds(point(w, v), point(w, before), point(w, v + 1));
}

/* Returns true if two segments with a common end overlap beyond it. */
static bool overlap_from(const double *common, const double *p, const double *q)
{
    return iccp_point_equal(p, q) || iccp_point_folds(common, p, q);
}

/* Tells how two edges meet, beyond what repeated points and spikes already show. */
static int32_t meet(const walk *w, uint32_t e, uint32_t f)
{
    if (e == iccp_polygon_before(w->polygon, f) || f == iccp_polygon_before(w->polygon, e) ||
        !has_length(w, e) || !has_length(w, f))
        return 0;
    for (uint32_t i = 0; i < 2; ++i)
        for (uint32_t j = 0; j < 2; ++j)
            if (iccp_point_equal(point(w, e + i), point(w, f + j)))
                return overlap_from(point(w, e + i), point(w, e + 1 - i), point(w, f + 1 - j))
                           ? ICC_DEFECT_TOUCH
                           : 0;
    return iccp_segments_meet(point(w, e), point(w, e + 1), point(w, f), point(w, f + 1));
}

static bool done(const walk *w)
{
    return w->list->n >= w->enough || w->n_pairs > w->patience;
}

/* Emits the defects that are listed under number a. */
static void visit(walk *w, uint32_t a)
{
    if (!finite(w, a)) {
        emit(w, ICC_DEFECT_NOT_FINITE, a, a);
        return;
    }
    if (spike(w, a))
        emit(w, ICC_DEFECT_SPIKE, a, a);
    uint32_t twin = w->twin[a], b;
    iccp_boxtree_query query;
    iccp_boxtree_start(&query, w->tree, a);
    while (!done(w) && iccp_boxtree_next(&query, &b)) {
        ++w->n_pairs;
        const int32_t kind = meet(w, a, b);
        if (kind == 0)
            continue;
        if (twin <= b) {
            emit(w, ICC_DEFECT_REPEATED, a, twin);
            twin = NONE;
        }
        emit(w, kind, a, b);
    }
    if (twin != NONE)
        emit(w, ICC_DEFECT_REPEATED, a, twin);
}

static void find_twins(walk *w, uint32_t *work)
{
    w->n_finite = 0;
    for (uint32_t v = 0; v < w->polygon->n; ++v) {
        w->twin[v] = NONE;
        if (finite(w, v))
            w->order[w->n_finite++] = v;
    }
    iccp_order_points(w->order, work, w->n_finite, w->polygon->points);
    for (size_t i = 1; i < w->n_finite; ++i)
        if (iccp_point_equal(point(w, w->order[i - 1]), point(w, w->order[i])))
            w->twin[w->order[i - 1]] = w->order[i];
}

static icc_status run(walk *w, const iccp_env *env)
{
    if (flat(w))
        emit(w, ICC_DEFECT_FLAT, 0, 0);
    for (uint32_t a = 0; a < w->polygon->n && !done(w); ++a) {
        if (a % 64 == 0) {
            const icc_status status =
                iccp_progress(env, "check", (double)a / (double)w->polygon->n);
            if (status != ICC_OK)
                return status;
        }
        visit(w, a);
    }
    return ICC_OK;
}

/* Lists all defects, or finds the first one with at most `patience` pairs of edges. Stops after
 * `enough` defects. */
static icc_status list_up_to(iccp_defect_list *list, size_t enough, size_t patience,
                             const iccp_polygon *polygon, const iccp_boxtree *tree,
                             const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    walk w = {
        .polygon = polygon, .tree = tree, .list = list, .enough = enough, .patience = patience};
    w.order = iccp_alloc(memory, polygon->n, sizeof *w.order);
    w.twin = iccp_alloc(memory, polygon->n, sizeof *w.twin);
    uint32_t *work = iccp_alloc(memory, polygon->n, sizeof *work);
    icc_status status = ICC_ERR_MEMORY;
    list->n = 0;
    if (w.order != NULL && w.twin != NULL && work != NULL) {
        find_twins(&w, work);
        status = run(&w, env);
    }
    iccp_free(memory, work);
    iccp_free(memory, w.twin);
    iccp_free(memory, w.order);
    return status;
}

icc_status iccp_defects_list(iccp_defect_list *list, const iccp_polygon *polygon,
                             const iccp_boxtree *tree, const iccp_env *env)
{
    const size_t most = LISTED + LISTED_EACH * polygon->n;
    const icc_status status = list_up_to(list, most, SIZE_MAX, polygon, tree, env);
    list->n = list->n < most ? list->n : most;
    return status;
}

iccp_defect iccp_defects_at(const iccp_polygon *polygon, uint32_t a)
{
    const walk w = {.polygon = polygon};
    const iccp_box box = iccp_box_of(point(&w, a), point(&w, a + 1));
    if (flat(&w))
        return (iccp_defect){ICC_DEFECT_FLAT, 0, 0};
    if (spike(&w, a))
        return (iccp_defect){ICC_DEFECT_SPIKE, a, a};
    for (uint32_t b = a + 1; b < polygon->n; ++b) {
        const iccp_box other = iccp_box_of(point(&w, b), point(&w, b + 1));
        if (!iccp_boxes_meet(&box, &other))
            continue;
        if (iccp_point_equal(point(&w, a), point(&w, b)))
            return (iccp_defect){ICC_DEFECT_REPEATED, a, b};
        const int32_t kind = meet(&w, a, b);
        if (kind != 0)
            return (iccp_defect){kind, a, b};
    }
    return (iccp_defect){0, 0, 0};
}

icc_status iccp_defects_first(iccp_defect *first, const iccp_polygon *polygon,
                              const iccp_boxtree *tree, const iccp_env *env)
{
    int32_t kind = 0;
    uint32_t items[2] = {0, 0};
    iccp_defect_list list = {.capacity = 1, .kinds = &kind, .items = items};
    const icc_status status = list_up_to(&list, 1, PATIENCE * polygon->n, polygon, tree, env);
    *first = (iccp_defect){kind, items[0], items[1]};
    return status;
}
