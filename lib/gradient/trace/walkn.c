/* Walks along integral lines in any dimension. Based on: L. Huynh, Bijective Deformations in R^n
 * via Integral Curve Coordinates, thesis, 2013, chapter 5, Algorithms 3-5 (Huynh and Gingold,
 * section 6, where n dimensions are sketched).
 *
 * In a simplex the line follows the gradient to a facet. If the gradient of the simplex behind
 * points away from the facet, the line crosses it. Otherwise the line stays in the facet, or takes
 * the steepest of the faces around it (walkn_star.c). This continues in lower and lower faces down
 * to the vertices. f rises strictly, or the vertex index does where f is level, so a walk cannot
 * loop. */
#include "gradient/trace/walkn.h"

#include "base/minmax.h"
#include "math/vec.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* If the sine of the angle is below this, a step runs within the facet that it meets. Covers the
 * rounding of both. */
static const double PARALLEL = 1e-12;

static const icc_grid *grid_of(const iccp_walkn *w)
{
    return w->slope.function->tree->grid;
}

static unsigned all_corners(const iccp_walkn *w)
{
    return (2u << grid_of(w)->dim) - 1;
}

static void find_position(const iccp_walkn *w, double *x)
{
    for (int k = 0; k < grid_of(w)->dim; ++k) {
        const int8_t axis = w->place.simplex.axis[k];
        x[axis] = w->place.low[axis] + w->place.y[k + 1];
    }
}

/* ---- choosing a face ---- */

/* Returns +1 if the gradient of a simplex with these values leads away from the facet opposite
 * corner i, -1 if it leads to it. */
static int corner_sign(int dim, const double *f, int i)
{
    return iccp_kuhn_leads_away(f[i > 0 ? i - 1 : i], f[i], f[i < dim ? i + 1 : i]);
}

static bool has_values(const iccp_walkn *w, double *f)
{
    const int dim = grid_of(w)->dim;
    iccp_slope_values(&w->slope, (size_t)dim + 1, w->place.simplex.corner, f);
    for (int i = 0; i <= dim; ++i)
        if (isnan(f[i]))
            return false;
    return true;
}

/* Returns true if the gradient of the place's simplex leads from its face into the simplex or into
 * one of its faces. Writes the corners of that face. */
static bool leads_in(const iccp_walkn *w, const double *f, unsigned *corners)
{
    const int dim = grid_of(w)->dim;
    bool leads = false;
    *corners = all_corners(w);
    for (int i = 0; i <= dim; ++i) {
        const int sign = w->place.face >> i & 1 ? 1 : corner_sign(dim, f, i);
        if (sign < 0)
            return false;
        if (sign == 0)
            *corners &= ~(1u << i);
        leads = leads || (sign > 0 && !(w->place.face >> i & 1));
    }
    return leads;
}

/* Finds the corners of the face in which the line continues. */
static icc_status choose_face(iccp_walkn *w, unsigned *corners)
{
    double f[ICC_MAX_DIM + 1];
    w->slope.level = false;
    if (w->ahead) {
        if (!has_values(w, f))
            return ICC_ERR_TRACE;
        if (leads_in(w, f, corners))
            return ICC_OK;
    }
    return iccp_place_find_steepest(&w->place, &w->slope, corners);
}

/* ---- steps ---- */

/* Crosses the facet opposite corner i, on which the walk stands. */
static icc_status cross_facet(iccp_walkn *w, int i)
{
    iccp_place *p = &w->place;
    const int dim = grid_of(w)->dim;
    const int8_t lowest = p->simplex.axis[0], highest = p->simplex.axis[dim - 1];
    int32_t fresh;
    if (!iccp_kuhn_simplex_cross(&p->simplex, grid_of(w), i, &fresh))
        return ICC_ERR_TRACE;
    if (i == 0) {
        ++p->low[lowest];
        memmove(p->y + 1, p->y + 2, (size_t)dim * sizeof *p->y);
    } else if (i == dim) {
        --p->low[highest];
        memmove(p->y + 1, p->y, (size_t)dim * sizeof *p->y);
    }
    p->face = all_corners(w) & ~(1u << fresh);
    w->ahead = true;
    return ICC_OK;
}

static void record_step(iccp_walkn *w, const iccp_motion *m)
{
    const int dim = grid_of(w)->dim;
    for (int a = 1; a < m->n; ++a)
        for (int k = m->corner[a - 1]; k < m->corner[a]; ++k)
            w->place.y[k + 1] = m->y[a];
    memcpy(w->from, w->to, sizeof w->from);
    find_position(w, w->to);
    w->s += iccp_vec_distance((size_t)dim, w->from, w->to);
    if (!w->merged)
        w->alone = w->s;
    w->cell = w->place.simplex.corner[0];
}

icc_status iccp_walkn_step(iccp_walkn *walk)
{
    unsigned corners;
    iccp_motion m;
    if (walk->steps_left == 0 || choose_face(walk, &corners) != ICC_OK)
        return ICC_ERR_TRACE;
    --walk->steps_left;
    iccp_motion_find(&m, &walk->place, &walk->slope, corners);
    const unsigned left = iccp_motion_run(&m, walk->place.face);
    if (left == 0)
        return ICC_ERR_TRACE;
    if (walk->jet != NULL)
        iccp_motion_carry(&m, &walk->place, left, walk->jet);
    walk->merged = walk->merged || corners != all_corners(walk);
    record_step(walk, &m);
    walk->place.face = left;
    walk->ahead = false;
    int crossed = 0;
    while (crossed <= grid_of(walk)->dim && (left | 1u << crossed) != all_corners(walk))
        ++crossed;
    walk->merged = walk->merged || crossed > grid_of(walk)->dim;
    return crossed <= grid_of(walk)->dim ? cross_facet(walk, crossed) : ICC_OK;
}

bool iccp_walkn_at_root(const iccp_walkn *walk)
{
    const unsigned face = walk->place.face;
    int i = 0;
    if ((face & (face - 1)) != 0)
        return false;
    while (!(face >> i & 1))
        ++i;
    return walk->place.simplex.corner[i] == walk->slope.function->tree->root;
}

/* ---- the start ---- */

/* Finds the simplex that contains a point. If there are several, takes the one to which `ahead`
 * points. */
static bool find_simplex(iccp_walkn *w, const double *x, const double *ahead)
{
    const icc_grid *grid = grid_of(w);
    iccp_place *p = &w->place;
    double u[ICC_MAX_DIM];
    uint32_t lowest = 0;
    for (int k = 0; k < grid->dim; ++k) {
        const double last = (double)grid->shape[k] - 1;
        if (!(x[k] >= 0 && x[k] <= last) || last < 1)
            return false;
        const double cell = iccp_min(floor(x[k]), last - 1);
        const bool back = cell > 0 && x[k] <= cell && ahead[k] < 0;
        p->low[k] = (uint32_t)cell - back;
        u[k] = x[k] - p->low[k];
        lowest += p->low[k] * (uint32_t)grid->stride[k];
        int i = k;
        for (; i > 0; --i) {
            const int8_t other = p->simplex.axis[i - 1];
            if (u[other] > u[k] || (u[other] >= u[k] && ahead[other] >= ahead[k]))
                break;
            p->simplex.axis[i] = other;
        }
        p->simplex.axis[i] = (int8_t)k;
    }
    p->y[0] = 1;
    p->y[grid->dim + 1] = 0;
    p->face = 0;
    for (int k = 0; k <= grid->dim; ++k) {
        p->simplex.corner[k] = lowest;
        if (k < grid->dim) {
            p->y[k + 1] = u[p->simplex.axis[k]];
            lowest += (uint32_t)grid->stride[p->simplex.axis[k]];
        }
        if (p->y[k] > p->y[k + 1])
            p->face |= 1u << k;
    }
    return true;
}

icc_status iccp_walkn_start(iccp_walkn *walk, const icc_function *function, int direction,
                            const double *x, const double *ahead, iccp_jetn *jet)
{
    static const double NOWHERE[ICC_MAX_DIM] = {0};
    const icc_grid *grid = function->tree->grid;
    double f[ICC_MAX_DIM + 1];
    *walk = (iccp_walkn){.slope = {function, direction, false}, .jet = jet};
    if (!find_simplex(walk, x, ahead != NULL ? ahead : NOWHERE))
        return ICC_ERR_TRACE;
    memcpy(walk->to, x, (size_t)grid->dim * sizeof *x);
    walk->ahead = ahead != NULL && walk->place.face != all_corners(walk) && has_values(walk, f);
    /* A line meets each simplex and each of its facets at most once. */
    size_t per_cell = 4;
    for (int k = 2; k <= grid->dim; ++k)
        per_cell *= (size_t)k;
    walk->steps_left = per_cell * grid->n_vertices;
    for (int i = 0; i <= grid->dim; ++i)
        if ((walk->place.face >> i & 1) && isnan(function->values[walk->place.simplex.corner[i]]))
            return ICC_ERR_TRACE;
    return ICC_OK;
}

int iccp_walkn_slope_sign(const icc_function *function, const double *x, const double *direction)
{
    iccp_walkn w = {.slope = {function, 1, false}};
    double f[ICC_MAX_DIM + 1], rise = 0;
    if (!find_simplex(&w, x, direction) || !has_values(&w, f))
        return 0;
    for (int k = 0; k < function->tree->grid->dim; ++k)
        rise += (f[k + 1] - f[k]) * direction[w.place.simplex.axis[k]];
    return (rise > 0) - (rise < 0);
}

/* ---- whole lines ---- */

static icc_status begin_path(const iccp_walkn *walk, iccp_path *path)
{
    if (path == NULL)
        return ICC_OK;
    iccp_path_start(path, (size_t)grid_of(walk)->dim);
    return iccp_path_append(path, walk->to, walk->s);
}

icc_status iccp_walkn_uphill(iccp_walkn *walk, iccp_path *path)
{
    icc_status status = begin_path(walk, path);
    while (status == ICC_OK && !iccp_walkn_at_root(walk)) {
        const double before = walk->s;
        status = iccp_walkn_step(walk);
        /* A step may lead to the end of the values, and fail there. */
        if (path == NULL || (status != ICC_OK && walk->s <= before))
            continue;
        const icc_status appended = iccp_path_append(path, walk->to, walk->s);
        status = appended != ICC_OK ? appended : status;
    }
    return status;
}

/* Finds what stays constant along the boundary where a step meets it. Usually that is the distance
 * from the facet's plane. A step in that plane ends at the facet's border, and the constant is how
 * far it goes. */
static void find_constraint(const iccp_walkn *w, const icc_domain *domain, uint32_t facet,
                            double *normal)
{
    const int dim = domain->dim;
    double step[ICC_MAX_DIM], along = 0, square = 0, length = 0;
    iccp_facet_inward(domain, facet, normal);
    for (int k = 0; k < dim; ++k) {
        step[k] = w->to[k] - w->from[k];
        along += normal[k] * step[k];
        square += normal[k] * normal[k];
        length += step[k] * step[k];
    }
    if (fabs(along) <= PARALLEL * sqrt(square) * sqrt(length))
        memcpy(normal, step, (size_t)dim * sizeof *step);
}

/* Cuts the last step short at the boundary. Needs the arc length and the jet before that step. */
static void end_at_boundary(iccp_walkn *w, double s_before, const iccp_jetn *jet_before,
                            const iccp_boundary_cellsn *cells, const iccp_boundary_hitn *hit)
{
    const int dim = grid_of(w)->dim;
    const double length = hit->share * (w->s - s_before);
    memcpy(w->to, hit->point, sizeof w->to);
    w->s = s_before + length;
    if (w->alone > s_before)
        w->alone = w->s;
    if (w->jet == NULL)
        return;
    double normal[ICC_MAX_DIM], along = 0;
    find_constraint(w, cells->domain, hit->facet, normal);
    for (int k = 0; k < dim; ++k)
        along += normal[k] * (w->to[k] - w->from[k]);
    *w->jet = *jet_before;
    for (int c = 0; c < dim; ++c) {
        double off = 0;
        for (int k = 0; k < dim; ++k)
            off += normal[k] * w->jet->x[k][c];
        const double dt = fabs(along) > 0 ? off / along : 0;
        for (int k = 0; k < dim; ++k)
            w->jet->x[k][c] -= dt * (w->to[k] - w->from[k]);
        w->jet->s[c] -= dt * length;
    }
}

icc_status iccp_walkn_downhill(iccp_walkn *walk, const iccp_boundary_cellsn *cells, iccp_path *path,
                               iccp_boundary_hitn *hit)
{
    icc_status status = begin_path(walk, path);
    bool met = false;
    iccp_jetn jet_before;
    while (status == ICC_OK && !met) {
        const double before = walk->s;
        if (walk->jet != NULL)
            jet_before = *walk->jet;
        status = iccp_walkn_step(walk);
        /* A step that leaves the grid may have passed the boundary first. */
        if (cells != NULL && (walk->s > before || status == ICC_OK))
            met = iccp_boundary_cellsn_cross(cells, walk->cell, walk->from, walk->to, hit);
        if (met) {
            end_at_boundary(walk, before, &jet_before, cells, hit);
        } else if (status != ICC_OK) {
            if (cells != NULL && iccp_boundary_cellsn_touch(cells, walk->to, hit))
                return ICC_OK;
            if (path != NULL && walk->s > before &&
                iccp_path_append(path, walk->to, walk->s) != ICC_OK)
                return ICC_ERR_MEMORY;
            return status;
        }
        if (path != NULL) {
            const icc_status appended = iccp_path_append(path, walk->to, walk->s);
            if (appended != ICC_OK)
                return appended;
        }
    }
    return met ? ICC_OK : status;
}
