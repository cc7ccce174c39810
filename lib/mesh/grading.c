/* A quadtree built level by level; every cell carries the samples that can still make it split.
 * After M. Bern, D. Eppstein, J. Gilbert, Provably good mesh generation, 1994, without their
 * warping: the triangulation takes care of the boundary. */
#include "mesh/grading.h"

#include "domain/locate.h"

#include <math.h>
#include <string.h>

/* Of a leaf's width: points closer to the boundary would make flat triangles. */
static const double CLEARANCE = 0.45;

/* Levels below the top: edges shorter than the step by more than this factor of two count as
 * longer. */
enum { MAX_LEVELS = 12 };

typedef struct cell {
    double x, y;     /* centre */
    size_t first, n; /* its samples */
} cell;

/* Cells of one level and their samples. */
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

static icc_status push_entry(level *l, uint32_t sample, const iccp_memory *memory)
{
    if (l->n_entries == l->entry_room) {
        const size_t room = 2 * l->entry_room + 256;
        uint32_t *entries = iccp_grow(memory, l->entries, l->n_entries, room, sizeof *entries);
        if (entries == NULL)
            return ICC_ERR_MEMORY;
        l->entries = entries;
        l->entry_room = room;
    }
    l->entries[l->n_entries++] = sample;
    return ICC_OK;
}

/* Whether a sample is so near a point that it forbids cells of the given width there: its length
 * and the distance, less `slack`, do not reach the width. Where cells grow .6 times as fast, twice
 * as many triangles make hardly a fairer map. */
static bool forbids(const iccp_samples *samples, uint32_t i, double x, double y, double width,
                    double slack)
{
    const double spare = width - samples->length[i], reach = spare + slack;
    const double dx = samples->points[2 * (size_t)i] - x;
    const double dy = samples->points[2 * (size_t)i + 1] - y;
    return spare > 0 && dx * dx + dy * dy < reach * reach;
}

static bool must_split(const builder *b, const level *l, const cell *c)
{
    for (size_t e = c->first; e < c->first + c->n; ++e)
        if (forbids(b->samples, l->entries[e], c->x, c->y, l->width, 0))
            return true;
    return false;
}

/* A child keeps the samples that can split it or one of its own children. */
static icc_status add_child(const builder *b, const level *from, const cell *parent, level *to,
                            double x, double y)
{
    cell child = {x, y, to->n_entries, 0};
    for (size_t e = parent->first; e < parent->first + parent->n; ++e) {
        const uint32_t i = from->entries[e];
        if (forbids(b->samples, i, x, y, to->width, 0.71 * to->width) &&
            push_entry(to, i, b->memory) != ICC_OK)
            return ICC_ERR_MEMORY;
    }
    child.n = to->n_entries - child.first;
    return push_cell(to, &child, b->memory);
}

/* A cell that is not split any further becomes a vertex at its centre, unless that is outside,
 * or nearer to the boundary than suits the cell's width. */
static icc_status emit_leaf(builder *b, const level *l, const cell *c)
{
    const double p[2] = {c->x, c->y};
    const double clearance2 = CLEARANCE * l->width * CLEARANCE * l->width;
    if (iccp_boxtree_reaches(&iccp_locator_trees(b->domain->locator)->edges, p, clearance2) ||
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

/* The top level: cells of the step's width, centred over the bounding box, all with all samples
 * that can split them. */
static icc_status build_top(const builder *b, level *top)
{
    const icc_domain *domain = b->domain;
    const double width = domain->upper[0] - domain->lower[0];
    const double height = domain->upper[1] - domain->lower[1];
    const size_t nx = (size_t)ceil(width / top->width), ny = (size_t)ceil(height / top->width);
    const double x0 = domain->lower[0] + 0.5 * (width - (double)nx * top->width);
    const double y0 = domain->lower[1] + 0.5 * (height - (double)ny * top->width);
    level all = {.width = 2 * top->width};
    icc_status status = ICC_OK;
    for (uint32_t i = 0; status == ICC_OK && i < b->samples->n; ++i)
        status = push_entry(&all, i, b->memory);
    const cell whole = {0, 0, 0, all.n_entries};
    for (size_t j = 0; status == ICC_OK && j < ny; ++j)
        for (size_t i = 0; status == ICC_OK && i < nx; ++i)
            status = add_child(b, &all, &whole, top, x0 + ((double)i + 0.5) * top->width,
                               y0 + ((double)j + 0.5) * top->width);
    iccp_free(b->memory, all.entries);
    return status;
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

/* Level by level, so that only two levels of the tree are in memory: a cell either becomes a
 * point or is split into four of the next level. */
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
