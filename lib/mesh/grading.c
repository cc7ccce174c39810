/* Graded inner points from a quadtree that is built level by level. Every cell carries the samples
 * that can still split it. Based on M. Bern, D. Eppstein, J. Gilbert, Provably good mesh
 * generation, 1994, but without warping, because the triangulation handles the boundary. */
#include "mesh/grading.h"

#include "base/minmax.h"
#include "geometry/locate.h"

#include <math.h>
#include <string.h>

/* Least distance of a point from the boundary, in widths of its leaf. Closer points would make flat
 * triangles. */
static const double CLEARANCE = 0.45;

/* Half a cell's diagonal, in widths; and the distance in widths beyond which a cell keeps no
 * sample. */
static const double HALF_DIAGONAL = 0.71, FARTHEST = 1.72;

/* Levels below the top. Edges shorter than the step by more than this power of two count as
 * longer. */
enum { MAX_LEVELS = 12 };

typedef struct cell {
    double x, y;     /* centre */
    size_t first, n; /* its samples */
} cell;

/* The cells of one level and their samples. */
typedef struct level {
    size_t n_cells, cell_room, n_entries, entry_room;
    cell *cells;
    uint32_t *entries;
    double width;
} level;

typedef struct builder {
    const icc_domain *domain;
    const iccp_samples *samples;
    const iccp_memory *memory;
    double *points;
    size_t n_points, point_room;
} builder;

static icc_status push_cell(level *l, const cell *c, const iccp_memory *memory)
{
    if (l->n_cells == l->cell_room) {
        const size_t room = 2 * l->cell_room + 64;
        cell *cells = iccp_grow(memory, l->cells, l->n_cells, room, sizeof *cells);
        if (cells == NULL)
            return ICC_ERR_MEMORY;
        l->cells = cells;
        l->cell_room = room;
    }
    l->cells[l->n_cells++] = *c;
    return ICC_OK;
}

/* Makes room for n more entries. */
static icc_status reserve_entries(level *l, size_t n, const iccp_memory *memory)
{
    if (n <= l->entry_room - l->n_entries)
        return ICC_OK;
    const size_t room = 2 * l->entry_room + n + 256;
    uint32_t *entries = iccp_grow(memory, l->entries, l->n_entries, room, sizeof *entries);
    if (entries == NULL)
        return ICC_ERR_MEMORY;
    l->entries = entries;
    l->entry_room = room;
    return ICC_OK;
}

/* Returns true if a sample forbids cells of the given width at a point. That is so if its length
 * plus the distance, less `slack`, is below the width. If cells grew 0.6 times as fast, there would
 * be twice as many triangles, but distortion would hardly improve. */
static bool forbids(const iccp_samples *samples, uint32_t i, double x, double y, double width,
                    double slack)
{
    const double spare = width - samples->length[i], reach = spare + slack;
    const double dx = samples->points[2 * (size_t)i] - x;
    const double dy = samples->points[2 * (size_t)i + 1] - y;
    return (spare > 0) & (dx * dx + dy * dy < reach * reach);
}

static bool must_split(const builder *b, const level *l, const cell *c)
{
    for (size_t e = c->first; e < c->first + c->n; ++e)
        if (forbids(b->samples, l->entries[e], c->x, c->y, l->width, 0))
            return true;
    return false;
}

/* Returns true if a cell keeps a sample because it can split the cell or one of its children. */
static bool is_kept(const iccp_samples *samples, uint32_t i, double x, double y, double width)
{
    return forbids(samples, i, x, y, width, HALF_DIAGONAL * width);
}

/* Adds a child that keeps some of its parent's samples. Whether it keeps one is hard to predict, so
 * each is written, and the next one takes its place if it is not kept. */
static icc_status add_child(const builder *b, const level *from, const cell *parent, level *to,
                            double x, double y)
{
    cell child = {x, y, to->n_entries, 0};
    if (reserve_entries(to, parent->n, b->memory) != ICC_OK)
        return ICC_ERR_MEMORY;
    uint32_t *own = to->entries + child.first;
    for (size_t e = parent->first; e < parent->first + parent->n; ++e) {
        const uint32_t i = from->entries[e];
        own[child.n] = i;
        child.n += is_kept(b->samples, i, x, y, to->width);
    }
    to->n_entries += child.n;
    return push_cell(to, &child, b->memory);
}

/* Returns true if the squared distance of a point from the boundary is at most `distance2`. A
 * domain with features has no locator. */
static bool is_near_boundary(const icc_domain *domain, const double *p, double distance2)
{
    if (domain->locator != NULL)
        return iccp_boxtree_reaches(&iccp_locator_trees(domain->locator)->edges, p, distance2);
    uint32_t facet = 0;
    double bary[2], q[2];
    (void)iccp_domain_locate(domain, p, false, &facet, bary);
    iccp_domain_facet_point(domain, facet, bary, q);
    const double dx = q[0] - p[0], dy = q[1] - p[1];
    return dx * dx + dy * dy <= distance2;
}

/* Turns a cell that is not split any further into a vertex at its centre. Skips it if the centre is
 * outside, or too near the boundary for the cell's width. */
static icc_status emit_leaf(builder *b, const level *l, const cell *c)
{
    const double p[2] = {c->x, c->y};
    const double clearance2 = CLEARANCE * l->width * CLEARANCE * l->width;
    if (is_near_boundary(b->domain, p, clearance2) ||
        iccp_domain_locate(b->domain, p, true, NULL, NULL) != ICC_INSIDE)
        return ICC_OK;
    if (b->n_points == b->point_room) {
        const size_t room = 2 * b->point_room + 256;
        double *points = iccp_grow(b->memory, b->points, 2 * b->n_points, 2 * room, sizeof *points);
        if (points == NULL)
            return ICC_ERR_MEMORY;
        b->points = points;
        b->point_room = room;
    }
    memcpy(b->points + 2 * b->n_points++, p, sizeof p);
    return ICC_OK;
}

/* The top level: cells as wide as the step, centred over the bounding box, row by row. */
typedef struct top_cells {
    const builder *b;
    level *level;
    size_t size[2];
    double first[2]; /* centre of the first cell */
} top_cells;

static icc_status place_top(top_cells *t)
{
    const icc_domain *domain = t->b->domain;
    level *top = t->level;
    for (int k = 0; k < 2; ++k) {
        const double extent = domain->upper[k] - domain->lower[k];
        t->size[k] = (size_t)ceil(extent / top->width);
        t->first[k] = domain->lower[k] + 0.5 * (extent - (double)t->size[k] * top->width);
    }
    top->cell_room = t->size[0] * t->size[1];
    top->cells = iccp_alloc(t->b->memory, top->cell_room, sizeof *top->cells);
    if (top->cells == NULL)
        return ICC_ERR_MEMORY;
    for (size_t j = 0; j < t->size[1]; ++j)
        for (size_t i = 0; i < t->size[0]; ++i)
            top->cells[top->n_cells++] = (cell){t->first[0] + ((double)i + 0.5) * top->width,
                                                t->first[1] + ((double)j + 0.5) * top->width, 0, 0};
    return ICC_OK;
}

/* Finds the cells along an axis whose centres are within FARTHEST widths of a place: [begin,
 * end). */
static void near_cells(const top_cells *t, int axis, double place, size_t *begin, size_t *end)
{
    const double at = (place - t->first[axis]) / t->level->width - 0.5;
    *begin = (size_t)iccp_max(at - FARTHEST, 0);
    *end = (size_t)iccp_min(at + FARTHEST + 1, (double)t->size[axis]);
}

/* Counts a sample in the cells that keep it, or enters it into them. */
static void visit_top(const top_cells *t, uint32_t sample, bool enters)
{
    const double *p = t->b->samples->points + 2 * (size_t)sample;
    level *top = t->level;
    size_t begin[2], end[2];
    for (int k = 0; k < 2; ++k)
        near_cells(t, k, p[k], &begin[k], &end[k]);
    for (size_t j = begin[1]; j < end[1]; ++j)
        for (size_t i = begin[0]; i < end[0]; ++i) {
            cell *c = &top->cells[t->size[0] * j + i];
            if (!is_kept(t->b->samples, sample, c->x, c->y, top->width))
                continue;
            if (enters)
                top->entries[c->first + c->n] = sample;
            ++c->n;
        }
}

/* Makes two passes over the samples: the first counts those of each cell, the second fills them
 * in. */
static icc_status build_top(const builder *b, level *top)
{
    top_cells t = {.b = b, .level = top};
    const icc_status status = place_top(&t);
    if (status != ICC_OK)
        return status;
    for (uint32_t i = 0; i < b->samples->n; ++i)
        visit_top(&t, i, false);
    for (size_t k = 0; k < top->n_cells; ++k) {
        top->cells[k].first = top->n_entries;
        top->n_entries += top->cells[k].n;
        top->cells[k].n = 0;
    }
    top->entry_room = top->n_entries;
    top->entries = iccp_alloc(b->memory, top->n_entries, sizeof *top->entries);
    if (top->entries == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t i = 0; i < b->samples->n; ++i)
        visit_top(&t, i, true);
    return ICC_OK;
}

/* Splits or emits every cell of a level. */
static icc_status descend(builder *b, const level *from, level *to, bool last)
{
    icc_status status = ICC_OK;
    for (size_t k = 0; status == ICC_OK && k < from->n_cells; ++k) {
        const cell *c = &from->cells[k];
        if (last || !must_split(b, from, c)) {
            status = emit_leaf(b, from, c);
            continue;
        }
        const double h = 0.5 * to->width;
        for (int child = 0; status == ICC_OK && child < 4; ++child)
            status = add_child(b, from, c, to, c->x + (child % 2 == 0 ? -h : h),
                               c->y + (child < 2 ? -h : h));
    }
    return status;
}

/* Goes level by level, so that only two levels of the tree are in memory. A cell either becomes a
 * point or is split into four cells of the next level. */
icc_status iccp_graded_points(const icc_domain *domain, const iccp_samples *samples, double step,
                              double **points, size_t *n_points, const iccp_env *env)
{
    builder b = {.domain = domain, .samples = samples, .memory = &env->memory};
    level levels[2] = {{.width = step}, {.width = 0.5 * step}};
    icc_status status = build_top(&b, &levels[0]);
    for (int k = 0; status == ICC_OK && levels[k % 2].n_cells > 0; ++k) {
        level *from = &levels[k % 2], *to = &levels[(k + 1) % 2];
        to->n_cells = to->n_entries = 0;
        to->width = 0.5 * from->width;
        status = iccp_progress(env, "mesh", (double)k / (MAX_LEVELS + 1));
        if (status == ICC_OK)
            status = descend(&b, from, to, k == MAX_LEVELS);
    }
    for (int k = 0; k < 2; ++k) {
        iccp_free(&env->memory, levels[k].cells);
        iccp_free(&env->memory, levels[k].entries);
    }
    if (status != ICC_OK) {
        iccp_free(&env->memory, b.points);
        b.points = NULL;
        b.n_points = 0;
    }
    *points = b.points;
    *n_points = b.n_points;
    return status;
}
