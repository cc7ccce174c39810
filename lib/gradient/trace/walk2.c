/* Walks along integral lines in the plane. Based on: L. Huynh, Bijective Deformations in R^n via
 * Integral Curve Coordinates, thesis, 2013, chapter 5, Algorithms 3-5 and Table 5.1 (Huynh and
 * Gingold, section 6, Table 1).
 *
 * Two decisions that the sources leave open: at a grid vertex, the line of steepest ascent among
 * the surrounding triangles and edges is taken. Equal values are ordered by vertex index, as if f
 * were perturbed. With both, f rises strictly along a walk, so it cannot loop. */
#include "gradient/trace/walk2.h"

#include "base/minmax.h"
#include "math/elementary.h"
#include "math/predicates.h"

#include <assert.h>
#include <math.h>

/* Corners of the two triangles of a cell, counter-clockwise. Edge k lies opposite corner k. */
static const int CORNER[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};

/* What lies across edge k of a triangle: a step to another cell, the edge's number there, and
 * whether u or v starts again at 0 or 1 in the new cell (-1: unchanged). */
typedef struct crossing {
    int di, dj, edge, u, v;
} crossing;
static const crossing ACROSS[2][3] = {
    {{1, 0, 1, 0, -1}, {0, 0, 2, -1, -1}, {0, -1, 0, -1, 1}},
    {{0, 1, 2, -1, 0}, {-1, 0, 0, 1, -1}, {0, 0, 1, -1, -1}},
};

/* Directions to the six neighbours of a vertex, counter-clockwise. For each, the triangle between
 * it and the next: its cell relative to the vertex, its side of the diagonal, and the vertex'
 * corner in it. */
static const int AROUND[6][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}};
static const struct {
    int di, dj, upper, corner;
} SECTOR[6] = {{0, 0, 0, 0},   {0, 0, 1, 0},   {-1, 0, 0, 1},
               {-1, -1, 1, 1}, {-1, -1, 0, 2}, {0, -1, 1, 2}};

/* The gradient of f in a triangle, times the direction of the walk. Its components are differences
 * of values, which are kept for exact signs: gu = f[ua] - f[ub], gv = f[va] - f[vb]. */
typedef struct gradient {
    double ua, ub, va, vb;
    double gu, gv;
} gradient;

/* In units of f. It is far above the square root of the smallest normal double. So rises that
 * matter beside one of this size have normal squares. */
static const double TINY_RISE = 1e-100;

/* If the sine of the angle is below this, a step runs along the boundary edge that it meets. Covers
 * the rounding of both. */
static const double PARALLEL = 1e-12;

static int sign(double x)
{
    return (x > 0) - (x < 0);
}

static double clamp01(double x)
{
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

static uint32_t vertex_at(const iccp_walk2 *w, size_t i, size_t j)
{
    return (uint32_t)(i + w->nx * j);
}

/* Computes the gradient. Returns false if a corner has no value. A flat triangle gets the gradient
 * of the vertex order. */
static bool triangle_gradient(const iccp_walk2 *w, size_t i, size_t j, int upper, gradient *g)
{
    const uint32_t v = vertex_at(w, i, j), up = (uint32_t)w->nx;
    const uint32_t corners[3] = {v, v + 1 + up, upper ? v + up : v + 1};
    double f[3];
    iccp_function_local(w->function, 3, corners, f);
    const double f00 = f[0], f11 = f[1], other = f[2];
    *g = upper ? (gradient){.ua = f11, .ub = other, .va = other, .vb = f00}
               : (gradient){.ua = other, .ub = f00, .va = f11, .vb = other};
    if (isnan(f00) || isnan(f11) || isnan(other))
        return false;
    if (g->ua <= g->ub && g->ua >= g->ub && g->va <= g->vb && g->va >= g->vb)
        *g = (gradient){.ua = 1, .va = (double)w->nx};
    if (w->direction < 0)
        *g = (gradient){.ua = g->ub, .ub = g->ua, .va = g->vb, .vb = g->va};
    g->gu = g->ua - g->ub;
    g->gv = g->va - g->vb;
    return true;
}

/* Returns the exact sign of (cu - u) gv - (cv - v) gu. It tells on which side of the line from (u,
 * v) to the corner (cu, cv) the gradient points; + is left.
 *
 * The filter's bound: the error of each difference and product is at most 2^-53 of itself. So the
 * error of the result is less than 4 * 2^-53 times the sum of magnitudes. The values are scaled to
 * near 1 for the exact sign, because decay makes them tiny far from the maximum. */
static int turn_sign(const gradient *g, double cu, double cv, double u, double v)
{
    const double left = (cu - u) * g->gv, right = (cv - v) * g->gu;
    const double det = left - right;
    if (fabs(det) > 1e-15 * (fabs(left) + fabs(right)) && fabs(det) > 1e-290)
        return sign(det);
    int e;
    (void)frexp(iccp_max(iccp_max(fabs(g->ua), fabs(g->ub)), iccp_max(fabs(g->va), fabs(g->vb))),
                &e);
    return iccp_cross_sign(cu, u, ldexp(g->va, -e), ldexp(g->vb, -e), cv, v, ldexp(g->ua, -e),
                           ldexp(g->ub, -e));
}

/* Returns the exact sign of the gradient's component into the triangle across its edge k. */
static int inward_sign(const gradient *g, int upper, int k)
{
    if (!upper)
        return k == 0 ? sign(-g->gu) : k == 2 ? sign(g->gv) : turn_sign(g, -1, -1, 0, 0);
    return k == 0 ? sign(-g->gv) : k == 1 ? sign(g->gu) : turn_sign(g, 1, 1, 0, 0);
}

static double ratio(double a, double b)
{
    return fabs(b) > 0 ? a / b : 0;
}

/* Computes where the line from (u, v) along the gradient meets the line of edge k. */
static void meet_edge(const gradient *g, int upper, int k, double *u, double *v)
{
    const crossing *across = &ACROSS[upper][k];
    if (across->di != 0) {
        const double end = across->di > 0 ? 1 : 0;
        *v = clamp01(*v + (end - *u) * ratio(g->gv, g->gu));
        *u = end;
    } else if (across->dj != 0) {
        const double end = across->dj > 0 ? 1 : 0;
        *u = clamp01(*u + (end - *v) * ratio(g->gu, g->gv));
        *v = end;
    } else {
        *u = *v = clamp01(*u + (*v - *u) * ratio(g->gu, g->gu - g->gv));
    }
}

/* Updates the derivatives for a move along the gradient to edge k. The end moves by the start's
 * motion, projected along the gradient onto the edge: dq = dp - g (n . dp) / (n . g), with the
 * edge's normal n. */
static void carry_jet(iccp_walk2 *w, const gradient *g, int k)
{
    const crossing *across = &ACROSS[w->upper][k];
    const double nu = across->dj != 0 ? 0 : 1;
    const double nv = across->di != 0 ? 0 : across->dj != 0 ? 1 : -1;
    const double steepness = iccp_hypot(g->gu, g->gv);
    for (int c = 0; c < 2; ++c) {
        const double t = ratio(nu * w->jet->x[c] + nv * w->jet->y[c], nu * g->gu + nv * g->gv);
        w->jet->x[c] -= t * g->gu;
        w->jet->y[c] -= t * g->gv;
        w->jet->s[c] -= t * steepness;
    }
}

/* Updates the derivatives for a move that ends at a fixed point, whatever the start. */
static void fix_jet(iccp_walk2 *w, double du, double dv)
{
    const double length = sqrt(du * du + dv * dv);
    for (int c = 0; c < 2; ++c) {
        w->jet->s[c] -= ratio(du * w->jet->x[c] + dv * w->jet->y[c], length);
        w->jet->x[c] = w->jet->y[c] = 0;
    }
}

/* Records a step within cell (i, j) from the current position to (u, v) in that cell. */
static void record(iccp_walk2 *w, size_t i, size_t j, double u0, double v0, double u, double v)
{
    const double du = u - u0, dv = v - v0;
    w->cell[0] = i;
    w->cell[1] = j;
    w->from[0] = (double)i + u0;
    w->from[1] = (double)j + v0;
    w->to[0] = (double)i + u;
    w->to[1] = (double)j + v;
    w->s += sqrt(du * du + dv * dv);
    if (!w->merged)
        w->alone = w->s;
}

static void arrive_at_vertex(iccp_walk2 *w, size_t i, size_t j)
{
    w->at_vertex = true;
    w->merged = true;
    w->i = i;
    w->j = j;
    w->u = w->v = 0;
}

/* Goes from the current position straight to corner (cu, cv) of the current cell. */
static void go_to_corner(iccp_walk2 *w, int cu, int cv)
{
    if (w->jet != NULL)
        fix_jet(w, cu - w->u, cv - w->v);
    record(w, w->i, w->j, w->u, w->v, cu, cv);
    arrive_at_vertex(w, w->i + (size_t)cu, w->j + (size_t)cv);
}

/* Goes from the current position along the gradient to edge k, and across it into the next
 * triangle. */
static icc_status go_to_edge(iccp_walk2 *w, const gradient *g, int k)
{
    double u = w->u, v = w->v;
    meet_edge(g, w->upper, k, &u, &v);
    const bool at_corner = (u <= 0 || u >= 1) && (v <= 0 || v >= 1);
    if (at_corner) {
        go_to_corner(w, u >= 1, v >= 1);
        return ICC_OK;
    }
    if (w->jet != NULL)
        carry_jet(w, g, k);
    record(w, w->i, w->j, w->u, w->v, u, v);
    const crossing *across = &ACROSS[w->upper][k];
    w->i += (size_t)across->di;
    w->j += (size_t)across->dj;
    w->u = across->u < 0 ? u : across->u;
    w->v = across->v < 0 ? v : across->v;
    w->upper = !w->upper;
    w->edge = across->edge;
    w->at_vertex = false;
    return w->i < w->nx - 1 && w->j < w->ny - 1 ? ICC_OK : ICC_ERR_TRACE;
}

/* Follows edge k to its end where f is higher in the direction of the walk; ties by vertex
 * index. */
static icc_status follow_edge(iccp_walk2 *w, int k)
{
    const int *a = CORNER[w->upper][(k + 1) % 3], *b = CORNER[w->upper][(k + 2) % 3];
    const uint32_t ia = vertex_at(w, w->i + (size_t)a[0], w->j + (size_t)a[1]);
    const uint32_t ib = vertex_at(w, w->i + (size_t)b[0], w->j + (size_t)b[1]);
    const int by_value = iccp_function_compare(w->function, ib, ia);
    const int order = w->direction * (by_value != 0 ? by_value : ib > ia ? 1 : -1);
    const int *end = order > 0 ? b : a;
    w->merged = true;
    go_to_corner(w, end[0], end[1]);
    return ICC_OK;
}

/* Table 5.1: the walk stands on edge k. The side of the opposite corner to which the gradient
 * points decides between the two other edges. */
static icc_status step_from_edge(iccp_walk2 *w)
{
    const int k = w->edge;
    gradient g;
    if (!triangle_gradient(w, w->i, w->j, w->upper, &g))
        return ICC_ERR_TRACE;
    if (inward_sign(&g, w->upper, k) <= 0)
        return follow_edge(w, k);
    const int *opposite = CORNER[w->upper][k];
    const int side = turn_sign(&g, opposite[0], opposite[1], w->u, w->v);
    if (side == 0) {
        go_to_corner(w, opposite[0], opposite[1]);
        return ICC_OK;
    }
    return go_to_edge(w, &g, side > 0 ? (k + 2) % 3 : (k + 1) % 3);
}

/* The special case at the start: the walk stands anywhere in the triangle. The line leaves through
 * the edge between the two corners that it passes on different sides. */
static icc_status step_from_inside(iccp_walk2 *w)
{
    gradient g;
    if (!triangle_gradient(w, w->i, w->j, w->upper, &g))
        return ICC_ERR_TRACE;
    int side[3];
    for (int c = 0; c < 3; ++c)
        side[c] = turn_sign(&g, CORNER[w->upper][c][0], CORNER[w->upper][c][1], w->u, w->v);
    for (int k = 0; k < 3; ++k)
        if (side[(k + 1) % 3] > 0 && side[(k + 2) % 3] <= 0)
            return go_to_edge(w, &g, k);
    for (int k = 0; k < 3; ++k)
        if (side[(k + 1) % 3] >= 0 && side[(k + 2) % 3] < 0)
            return go_to_edge(w, &g, k);
    return ICC_ERR_TRACE;
}

/* Computes how much f rises from the vertex to its six neighbours, in the direction of the walk;
 * NaN: no value. If the largest rise is tiny, rises are in units of it, so that its square does not
 * vanish. */
static void find_rises(const iccp_walk2 *w, double rise[6])
{
    uint32_t star[7];
    double f[7], largest = 0;
    const uint32_t here = star[6] = vertex_at(w, w->i, w->j);
    for (int m = 0; m < 6; ++m) {
        const size_t i = w->i + (size_t)AROUND[m][0], j = w->j + (size_t)AROUND[m][1];
        star[m] = i < w->nx && j < w->ny ? vertex_at(w, i, j) : here;
    }
    iccp_function_local(w->function, 7, star, f);
    for (int m = 0; m < 6; ++m) {
        rise[m] = star[m] != here ? w->direction * (f[m] - f[6]) : NAN;
        if (rise[m] > largest)
            largest = rise[m];
    }
    for (int m = 0; m < 6 && largest > 0 && largest < TINY_RISE; ++m)
        rise[m] /= largest;
}

/* Returns the square of the slope in the sector between neighbours m and m + 1 if its gradient
 * points into the open sector, else -1. One of the two is an axis and the other a diagonal, or both
 * are axes. */
static double sector_slope(const double rise[6], int m)
{
    const double a = rise[m], b = rise[(m + 1) % 6];
    if (m % 3 == 2)
        return a > 0 && b > 0 ? a * a + b * b : -1;
    const double axis = m % 3 == 0 ? a : b, diagonal = m % 3 == 0 ? b : a;
    if (!(diagonal > axis && 2 * axis > diagonal))
        return -1;
    return axis * axis + (diagonal - axis) * (diagonal - axis);
}

static icc_status leave_into_sector(iccp_walk2 *w, int m)
{
    w->i += (size_t)SECTOR[m].di;
    w->j += (size_t)SECTOR[m].dj;
    w->upper = SECTOR[m].upper;
    w->u = CORNER[w->upper][SECTOR[m].corner][0];
    w->v = CORNER[w->upper][SECTOR[m].corner][1];
    w->at_vertex = false;
    gradient g;
    if (!triangle_gradient(w, w->i, w->j, w->upper, &g))
        return ICC_ERR_TRACE;
    return go_to_edge(w, &g, SECTOR[m].corner);
}

static void leave_along_edge(iccp_walk2 *w, int m)
{
    const int du = AROUND[m][0], dv = AROUND[m][1];
    w->i -= du < 0;
    w->j -= dv < 0;
    w->u = du < 0;
    w->v = dv < 0;
    w->merged = true;
    go_to_corner(w, du > 0 || (du == 0 && w->u > 0), dv > 0 || (dv == 0 && w->v > 0));
}

/* Takes the steepest ascent from a vertex. Neighbours as high as the vertex are a last resort, in
 * vertex order. */
static icc_status step_from_vertex(iccp_walk2 *w)
{
    double rise[6], best = 0;
    int edge = -1, sector = -1, level = -1;
    find_rises(w, rise);
    for (int m = 0; m < 6; ++m) {
        const double slope = rise[m] > 0 ? rise[m] * rise[m] / (m % 3 == 1 ? 2 : 1) : -1;
        if (slope > best) {
            best = slope;
            edge = m;
            sector = -1;
        }
        const double inside = sector_slope(rise, m);
        if (inside > best) {
            best = inside;
            sector = m;
            edge = -1;
        }
        const bool higher_index = m < 3;
        if (rise[m] <= 0 && rise[m] >= 0 && higher_index == (w->direction > 0) && level < 0)
            level = m;
    }
    if (sector >= 0)
        return leave_into_sector(w, sector);
    if (edge < 0)
        edge = level;
    if (edge < 0)
        return ICC_ERR_TRACE;
    leave_along_edge(w, edge);
    return ICC_OK;
}

/* For a walk that stands on an edge of its triangle, as is possible at a start, finds the direction
 * to the triangle on the other side. Returns false if it stands on none. */
static bool across_edge(const iccp_walk2 *w, int side[2])
{
    side[0] = w->upper ? -(w->u <= 0 && w->i > 0) : -(w->v > 0 && w->v >= w->u);
    side[1] = w->upper ? 0 : w->v > 0 ? w->v >= w->u : -(w->j > 0);
    return side[0] != 0 || side[1] != 0;
}

/* Crosses to that triangle, if it has values. */
static bool cross_edge(iccp_walk2 *w, const int side[2])
{
    iccp_walk2 there = *w;
    gradient g;
    there.upper = !w->upper;
    if (side[1] == 0) {
        --there.i;
        there.u = 1;
    } else if (side[0] == 0) {
        --there.j;
        there.v = 1;
    }
    if (!triangle_gradient(&there, there.i, there.j, there.upper, &g))
        return false;
    *w = there;
    return true;
}

icc_status iccp_walk2_start(iccp_walk2 *walk, const icc_function *function, int direction, double x,
                            double y, iccp_jet2 *jet)
{
    const icc_grid *grid = function->tree->grid;
    assert(grid->dim == 2);
    *walk = (iccp_walk2){.function = function, .direction = direction, .jet = jet, .edge = -1};
    walk->nx = grid->shape[0];
    walk->ny = grid->shape[1];
    walk->root = function->tree->root;
    /* A line meets the edges and corners of each triangle at most once. */
    walk->steps_left = 8 * grid->n_vertices + 64;
    if (!(x >= 0 && y >= 0 && x < (double)(walk->nx - 1) && y < (double)(walk->ny - 1)))
        return ICC_ERR_TRACE;
    walk->i = (size_t)x;
    walk->j = (size_t)y;
    walk->u = x - (double)walk->i;
    walk->v = y - (double)walk->j;
    walk->upper = walk->v > walk->u;
    if (walk->u <= 0 && walk->v <= 0) {
        walk->at_vertex = true;
        return isnan(function->values[vertex_at(walk, walk->i, walk->j)]) ? ICC_ERR_TRACE : ICC_OK;
    }
    gradient g;
    int side[2];
    if (triangle_gradient(walk, walk->i, walk->j, walk->upper, &g) ||
        (across_edge(walk, side) && cross_edge(walk, side)))
        return ICC_OK;
    return ICC_ERR_TRACE;
}

void iccp_walk2_face(iccp_walk2 *walk, const double ahead[2])
{
    int side[2];
    if (!walk->at_vertex && across_edge(walk, side) && side[0] * ahead[0] + side[1] * ahead[1] > 0)
        (void)cross_edge(walk, side);
}

icc_status iccp_walk2_step(iccp_walk2 *walk)
{
    if (walk->steps_left-- == 0) {
        walk->steps_left = 0;
        return ICC_ERR_TRACE;
    }
    return walk->at_vertex  ? step_from_vertex(walk)
           : walk->edge < 0 ? step_from_inside(walk)
                            : step_from_edge(walk);
}

bool iccp_walk2_at_root(const iccp_walk2 *walk)
{
    return walk->at_vertex && vertex_at(walk, walk->i, walk->j) == walk->root;
}

void iccp_walk2_position(const iccp_walk2 *walk, double p[2])
{
    p[0] = (double)walk->i + walk->u;
    p[1] = (double)walk->j + walk->v;
}

static icc_status begin_path(const iccp_walk2 *walk, iccp_path *path)
{
    if (path == NULL)
        return ICC_OK;
    double p[2];
    iccp_walk2_position(walk, p);
    iccp_path_start(path, 2);
    return iccp_path_append(path, p, walk->s);
}

icc_status iccp_trace_uphill(iccp_walk2 *walk, iccp_path *path)
{
    icc_status status = begin_path(walk, path);
    while (status == ICC_OK && !iccp_walk2_at_root(walk)) {
        const double before = walk->s;
        status = iccp_walk2_step(walk);
        /* A step may lead to the end of the values, and fail there. */
        if (path == NULL || (status != ICC_OK && walk->s <= before))
            continue;
        const icc_status appended = iccp_path_append(path, walk->to, walk->s);
        status = appended != ICC_OK ? appended : status;
    }
    return status;
}

/* Cuts the last step short at the boundary. */
static void end_at_boundary(iccp_walk2 *w, double s_before, const iccp_jet2 *jet_before,
                            const iccp_boundary_cells2 *cells, const iccp_boundary_hit2 *hit)
{
    const double dx = hit->share * (w->to[0] - w->from[0]);
    const double dy = hit->share * (w->to[1] - w->from[1]);
    const double length = sqrt(dx * dx + dy * dy);
    w->s = s_before + length;
    if (w->alone > s_before)
        w->alone = w->s;
    w->to[0] = w->from[0] + dx;
    w->to[1] = w->from[1] + dy;
    if (w->jet == NULL)
        return;
    const double *a = cells->vertices + 2 * (size_t)cells->ends[2 * (size_t)hit->facet];
    const double *b = cells->vertices + 2 * (size_t)cells->ends[2 * (size_t)hit->facet + 1];
    double nx = a[1] - b[1], ny = b[0] - a[0];
    /* A step along the edge that it meets ends at the edge's end. */
    if (fabs(nx * dx + ny * dy) <= PARALLEL * iccp_hypot(nx, ny) * length) {
        nx = dx;
        ny = dy;
    }
    *w->jet = *jet_before;
    for (int c = 0; c < 2; ++c) {
        const double t = ratio(nx * w->jet->x[c] + ny * w->jet->y[c], nx * dx + ny * dy);
        w->jet->x[c] -= t * dx;
        w->jet->y[c] -= t * dy;
        w->jet->s[c] -= t * length;
    }
}

icc_status iccp_trace_downhill(iccp_walk2 *walk, const iccp_boundary_cells2 *cells, iccp_path *path,
                               iccp_boundary_hit2 *hit)
{
    icc_status status = begin_path(walk, path);
    bool hit_boundary = false;
    iccp_jet2 jet_before = {{0}, {0}, {0}};
    while (status == ICC_OK && !hit_boundary) {
        const double s_before = walk->s;
        if (walk->jet != NULL)
            jet_before = *walk->jet;
        status = iccp_walk2_step(walk);
        /* A step that leaves the grid may have passed the boundary first. */
        if (walk->s <= s_before && status != ICC_OK)
            return status;
        hit_boundary =
            cells != NULL && iccp_boundary_cells2_first(cells, walk->cell[0], walk->cell[1],
                                                        walk->from, walk->to, hit);
        if (hit_boundary)
            end_at_boundary(walk, s_before, &jet_before, cells, hit);
        if (path != NULL) {
            const icc_status appended = iccp_path_append(path, walk->to, walk->s);
            if (appended != ICC_OK)
                return appended;
        }
    }
    return hit_boundary ? ICC_OK : status;
}

int iccp_slope_sign(const icc_function *function, const double p[2], const double direction[2])
{
    iccp_walk2 walk;
    gradient g;
    if (iccp_walk2_start(&walk, function, ICCP_UPHILL, p[0], p[1], NULL) != ICC_OK ||
        !triangle_gradient(&walk, walk.i, walk.j, walk.upper, &g))
        return 0;
    return sign(g.gu * direction[0] + g.gv * direction[1]);
}
