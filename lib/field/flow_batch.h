/* Follows LANES curves side by side, each at its own place. A lane whose curve has ended takes the
 * next curve. If a lane's step did not finish its piece, that lane tries again while the others
 * continue. Source: see flow_step.h.
 *
 * The file that includes this one defines LANES and TARGET, the processor for which the
 * arithmetic is compiled. */
#ifndef ICCP_FLOW_BATCH_H
#define ICCP_FLOW_BATCH_H

#include "field/flow_follow.h"
#include "field/flow_piece.h"
#include "field/flow_step.h"
#include "math/elementary.h"

typedef struct lane {
    iccp_flow_walk walk;
    iccp_flow_curve *curve; /* NULL if no curve is left */
    int n_tries;
    iccp_path path;
} lane;

/* Lanes that try a step together. */
typedef struct group {
    lane lane[LANES];
    piece_step step;
} group;

/* While one group computes, the vectors for the other arrive from memory. */
enum { GROUPS = 2 };

typedef struct batch {
    const iccp_flow *flow;
    iccp_flow_curve *next, *end; /* curves still to be followed */
    size_t n_busy;
    icc_status status;
    group group[GROUPS];
} batch;

/* The loops over dimensions are unrolled in compiled copies for 2 and 3. */
TARGET static void try_exits(piece_step *a, int32_t dim)
{
    if (dim == 3)
        try_exit(a, 3);
    else if (dim == 2)
        try_exit(a, 2);
    else
        try_exit(a, dim > 4 ? dim : 4);
}

/* Gives a lane the next curve, if there is one. */
TARGET static void take_curve(batch *c, lane *x)
{
    x->curve = NULL;
    if (c->next == c->end) {
        --c->n_busy;
        return;
    }
    x->curve = c->next++;
    iccp_flow_begin(&x->walk, c->flow, x->curve->sign, &x->curve->start);
    x->path.n_marks = 0;
}

/* Computes the volume of a bundle of curves. The bundle's flux grows with the flow's volume, and
 * is its cross-section times the speed. `s` is the parameter of the wanted place, or of the
 * boundary point below it. Curves that run straight to the root have speed 1. */
TARGET static void measure_volume(iccp_flow_curve *curve, const iccp_flow_walk *w, double s)
{
    const iccp_flow *flow = w->flow;
    const int32_t dim = flow->grid->dim;
    const double *normal = flow->incidence->normal + (size_t)dim * curve->facet;
    double first[ICC_MAX_DIM], last[ICC_MAX_DIM], across = 0, speed2 = 0;
    iccp_flow_vector(flow, &curve->start, first);
    iccp_flow_velocity(w, s, last);
    const bool up = w->sign > 0;
    const double *below = up ? first : last, *above = up ? last : first;
    const iccp_flow_place *place = up ? &w->place : &curve->start;
    for (int32_t k = 0; k < dim; ++k) {
        across += below[k] * normal[k];
        speed2 += above[k] * above[k];
    }
    if (iccp_flow_root_corner(flow, place, dim) != ICCP_FLOW_WITHIN)
        speed2 = 1;
    const double growth = w->growth + iccp_flow_growth(w, s);
    curve->volume = iccp_ln(fabs(across)) - 0.5 * iccp_ln(speed2) + w->sign * growth;
}

/* Finds the wanted place on a curve uphill. */
TARGET static icc_status find_place(lane *x)
{
    iccp_flow_curve *curve = x->curve;
    iccp_flow_walk *w = &x->walk;
    const double length = curve->length * curve->share;
    const icc_status status = iccp_flow_rewind(w, &x->path, length);
    if (status != ICC_OK)
        return status;
    const double s = iccp_flow_at_length(w, length - w->length);
    curve->place = w->place;
    iccp_flow_at(w, s, curve->place.at);
    if (curve->measured)
        measure_volume(curve, w, s);
    return ICC_OK;
}

/* Ends the curve of a lane. */
TARGET static void finish_curve(lane *x, icc_status status)
{
    x->curve->status = status == ICC_OK && x->curve->share > 0 ? find_place(x) : status;
}

/* Returns true if the curve continues after the piece just found. `a` is the step that holds its
 * series, or NULL. */
TARGET static ICCP_INLINE bool curve_continues(lane *x, int32_t dim, const piece_step *a, int l)
{
    iccp_flow_walk *w = &x->walk;
    iccp_flow_curve *curve = x->curve;
    double s;
    if (w->ends) {
        curve->length = w->length + w->end_length;
        return false;
    }
    if (w->sign > 0 || !iccp_flow_near_boundary(w->flow, &w->place))
        return true;
    if (a != NULL)
        store_series(a, dim, l, w);
    if (!iccp_flow_leaves(w, &s, &curve->facet, curve->bary))
        return true;
    curve->length = w->length + iccp_flow_length(w, s);
    if (curve->measured)
        measure_volume(curve, w, s);
    return false;
}

/* Leaves a finished piece: goes on to the next simplex, or to the next curve. */
TARGET static ICCP_INLINE void leave_piece(batch *c, lane *x, int32_t dim, const piece_step *a,
                                           int l, icc_status status)
{
    const bool more = status == ICC_OK && curve_continues(x, dim, a, l);
    if (more)
        status = iccp_flow_cross_in(&x->walk, dim);
    if (more && status == ICC_OK)
        return;
    finish_curve(x, status);
    take_curve(c, x);
}

/* Advances a lane until it has a piece whose exit must be computed. */
TARGET static ICCP_INLINE void advance_to_exit(batch *c, lane *x, int32_t dim)
{
    int32_t corner;
    while (x->curve != NULL) {
        if (x->curve->share > 0 && iccp_flow_note(&x->walk, &x->path) != ICC_OK) {
            c->status = ICC_ERR_MEMORY;
            return;
        }
        corner = iccp_flow_root_corner(x->walk.flow, &x->walk.place, dim);
        if (corner == ICCP_FLOW_WITHIN) {
            x->n_tries = 0;
            return;
        }
        leave_piece(c, x, dim, NULL, 0, iccp_flow_find_radial(&x->walk, corner));
    }
}

/* Handles the outcome of a step in one lane. */
TARGET static ICCP_INLINE void finish_try(batch *c, group *g, int l, int32_t dim)
{
    lane *x = &g->lane[l];
    piece_step *a = &g->step;
    icc_status status = ICC_OK;
    const bool found = (int)LANE(a->outcome, l) == FOUND;
    if (!found && ++x->n_tries < MOST_TRIES && prepare_retry(a, l))
        return;
    if (found)
        store_end(a, dim, l, &x->walk);
    else
        status = iccp_flow_find_piece_slowly(&x->walk, LANE(a->end, l));
    leave_piece(c, x, dim, found ? a : NULL, l, status);
    advance_to_exit(c, x, dim);
}

/* Loads the lanes that have a new piece. The others keep the piece that they have. */
TARGET static ICCP_INLINE void load_group(group *g, int32_t dim)
{
    for (int l = 0; l < LANES; ++l)
        if (g->lane[l].curve != NULL && g->lane[l].n_tries == 0)
            load_start(&g->step, dim, l, &g->lane[l].walk);
}

/* Two groups take turns. The loads of one group are issued before the other's arithmetic, and
 * arrive meanwhile. */
TARGET static ICCP_INLINE void run_batch_in(batch *c, int32_t dim)
{
    for (int g = 0; g < GROUPS; ++g)
        for (int l = 0; l < LANES; ++l) {
            take_curve(c, &c->group[g].lane[l]);
            advance_to_exit(c, &c->group[g].lane[l], dim);
        }
    load_group(&c->group[0], dim);
    for (int g = 0; c->n_busy > 0 && c->status == ICC_OK; g = (g + 1) % GROUPS) {
        group *this = &c->group[g];
        try_exits(&this->step, dim);
        load_group(&c->group[(g + 1) % GROUPS], dim);
        for (int l = 0; l < LANES; ++l)
            if (this->lane[l].curve != NULL)
                finish_try(c, this, l, dim);
    }
}

TARGET static void run_batch(batch *c, int32_t dim)
{
    if (dim == 3)
        run_batch_in(c, 3);
    else
        run_batch_in(c, dim);
}

TARGET static icc_status follow_batch(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                                      const iccp_memory *memory)
{
    batch c = {.flow = flow, .next = curves, .end = curves + n, .n_busy = GROUPS * LANES};
    for (int l = 0; l < GROUPS * LANES; ++l)
        iccp_path_init(&c.group[l / LANES].lane[l % LANES].path, memory);
    run_batch(&c, flow->grid->dim);
    for (int l = 0; l < GROUPS * LANES; ++l)
        iccp_path_clear(&c.group[l / LANES].lane[l % LANES].path);
    return c.status;
}

#endif
