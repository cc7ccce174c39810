/* Configurations of features in time. Shapes are blended in the turn of the source, and turns by
 * linear interpolation of unit quaternions, scaled to length 1. */
#include "map/solid/feature_motion.h"

#include "base/minmax.h"
#include "base/random.h"
#include "domain/solid_domain.h"
#include "geometry/simplex.h"
#include "map/energy/singular.h"
#include "math/elementary.h"
#include "math/vec.h"

#include <string.h>

/* ---- small rotations ---- */

static const double UNIT[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};

static void apply(const double *matrix, const double *x, double *y)
{
    for (int r = 0; r < 3; ++r)
        y[r] = iccp_vec_dot(3, matrix + 3 * r, x);
}

static void apply_transposed(const double *matrix, const double *x, double *y)
{
    for (int c = 0; c < 3; ++c)
        y[c] = matrix[c] * x[0] + matrix[3 + c] * x[1] + matrix[6 + c] * x[2];
}

static void multiply(const double *a, const double *b, double *product)
{
    for (int r = 0; r < 3; ++r)
        apply_transposed(b, a + 3 * r, product + 3 * r);
}

/* Finds the rotation next to a matrix. */
static void set_rotation(const double *matrix, double *rotation)
{
    iccp_singular s;
    iccp_singular_find(3, matrix, &s);
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
            rotation[3 * r + c] =
                s.u[0][r] * s.v[0][c] + s.u[1][r] * s.v[1][c] + s.u[2][r] * s.v[2][c];
}

/* Finds the unit quaternion of a rotation whose real part q[0] is not negative. The largest of its
 * squares, which have sum 1, is not small. */
static void set_quaternion(const double *m, double *q)
{
    const double trace = m[0] + m[4] + m[8];
    const double square[4] = {1 + trace, 1 + 2 * m[0] - trace, 1 + 2 * m[4] - trace,
                              1 + 2 * m[8] - trace};
    int most = 0;
    for (int k = 1; k < 4; ++k)
        most = square[k] > square[most] ? k : most;
    for (int k = 0; k < 3; ++k) {
        const int a = (k + 1) % 3, b = (k + 2) % 3, i = most - 1;
        const double odd = m[3 * b + a] - m[3 * a + b];
        if (most == 0)
            q[k + 1] = odd;
        else if (k == i)
            q[0] = odd;
        if (most > 0)
            q[k + 1] = k == i ? square[most] : m[3 * i + k] + m[3 * k + i];
    }
    if (most == 0)
        q[0] = square[0];
    const double length = copysign(iccp_vec_norm(4, q), q[0]);
    for (int k = 0; k < 4; ++k)
        q[k] /= length;
}

/* The rotation a share of the way from none to a unit quaternion with q[0] >= 0. */
static void set_part_of_turn(const double *turn, double share, double *m)
{
    double q[4];
    for (int k = 0; k < 4; ++k)
        q[k] = share * turn[k] + (k == 0 ? 1 - share : 0);
    const double length = iccp_vec_norm(4, q);
    for (int k = 0; k < 4; ++k)
        q[k] /= length;
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double rows[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
        2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
        2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    memcpy(m, rows, sizeof rows);
}

/* ---- making a motion ---- */

void iccp_feature_centre(const icc_domain *domain, size_t feature, double *centre)
{
    const iccp_feature *item = &domain->features->item[feature];
    const double *first = domain->given + 3 * (size_t)item->first;
    for (size_t k = 0; k < 3; ++k) {
        double sum = 0;
        for (size_t i = 0; i < item->n; ++i)
            sum += first[3 * i + k] - first[k];
        centre[k] = first[k] + sum / item->n;
    }
}

/* Finds the rotation that takes n points a to b as well as possible, both around 0. What they leave
 * open, as around a straight line, is turned little: the correlation of all points, which the
 * rotation agrees with best, gets a small multiple of 1. */
static void fit_rotation(size_t n, const double *a, const double *b, double *rotation)
{
    double sum[9] = {0}, size = 0;
    for (size_t i = 0; i < n; ++i)
        for (int k = 0; k < 9; ++k)
            sum[k] += b[3 * i + (size_t)k / 3] * a[3 * i + (size_t)k % 3];
    for (int k = 0; k < 9; ++k)
        size = iccp_max(size, fabs(sum[k]));
    for (int k = 0; k < 9; ++k)
        sum[k] += UNIT[k] * (size > 0 ? 0x1p-10 * size : 1);
    set_rotation(sum, rotation);
}

/* Sets the shapes of a feature and its rotation in the target. */
static void set_shapes(iccp_feature_motion *motion, size_t f)
{
    const icc_domain *const domain[2] = {motion->source, motion->target};
    const size_t n_outer = motion->source->features->n_outer;
    const iccp_feature *item = &motion->source->features->item[f];
    iccp_moving *m = &motion->item[f];
    double *shape[2];
    for (int side = 0; side < 2; ++side) {
        double *centre = side == 0 ? m->place : m->last;
        iccp_feature_centre(domain[side], f, centre);
        shape[side] = motion->shape[side] + 3 * (item->first - n_outer);
        for (size_t i = 0; i < 3 * (size_t)item->n; ++i)
            shape[side][i] = domain[side]->given[3 * (size_t)item->first + i] - centre[i % 3];
    }
    fit_rotation(item->n, shape[0], shape[1], m->final);
    for (size_t i = 0; i < item->n; ++i) {
        double turned[3];
        apply_transposed(m->final, shape[1] + 3 * i, turned);
        memcpy(shape[1] + 3 * i, turned, sizeof turned);
    }
}

/* Returns the feature whose inside is a region, or the number of features for region 0. */
static uint32_t find_parent(const iccp_features *features, uint32_t region)
{
    uint32_t n = 0;
    for (uint32_t f = 0; region > 0 && f < features->n; ++f) {
        n += features->item[f].kind == ICC_FEATURE_REGION;
        if (n == region)
            return f;
    }
    return (uint32_t)features->n;
}

/* Sets the way of a feature at the outer surface, which the carrier describes. */
static void set_way(iccp_moving *m, const iccp_carrier *carrier)
{
    double turn[9], back[9];
    for (int k = 0; k < 9; ++k)
        back[k] = carrier->rotation[3 * (k % 3) + k / 3];
    multiply(back, m->final, turn);
    set_quaternion(turn, m->turn);
    memcpy(m->via, carrier->from, sizeof m->via);
}

/* Makes places and turns of a feature in a region relative to that region. */
static void set_inner_way(const iccp_feature_motion *motion, size_t f)
{
    iccp_moving *m = &motion->item[f];
    const double *around = motion->item[m->parent].final;
    double centre[2][3], turn[9], back[9];
    for (int k = 0; k < 9; ++k)
        back[k] = around[3 * (k % 3) + k / 3];
    multiply(back, m->final, turn);
    set_quaternion(turn, m->turn);
    iccp_feature_centre(motion->source, m->parent, centre[0]);
    iccp_feature_centre(motion->target, m->parent, centre[1]);
    for (int k = 0; k < 3; ++k) {
        m->place[k] -= centre[0][k];
        centre[1][k] = m->last[k] - centre[1][k];
    }
    apply_transposed(around, centre[1], m->last);
    for (int k = 0; k < 3; ++k)
        m->via[k] = m->shrinkage * m->last[k];
}

/* Sets the largest distance of a vertex from the centre. */
static void set_radius(const iccp_feature_motion *motion, size_t f)
{
    const iccp_features *features = motion->source->features;
    const iccp_feature *item = &features->item[f];
    iccp_moving *m = &motion->item[f];
    for (size_t i = 0; i < item->n; ++i) {
        const size_t v = 3 * (item->first - features->n_outer + i);
        m->radius = iccp_max(m->radius, iccp_vec_norm(3, motion->shape[0] + v));
        m->radius = iccp_max(m->radius, m->shrinkage * iccp_vec_norm(3, motion->shape[1] + v));
    }
}

static void set_items(iccp_feature_motion *motion, const iccp_carrier *carriers)
{
    const iccp_features *features = motion->source->features;
    for (size_t f = 0; f < motion->n; ++f) {
        motion->item[f].parent = find_parent(features, features->item[f].around);
        set_shapes(motion, f);
    }
    for (size_t f = 0; f < motion->n; ++f) {
        iccp_moving *m = &motion->item[f];
        size_t outermost = f;
        while (motion->item[outermost].parent < motion->n)
            outermost = motion->item[outermost].parent;
        m->shrinkage = 1 / carriers[outermost].scale;
        if (outermost == f)
            set_way(m, &carriers[f]);
        else
            set_inner_way(motion, f);
        set_radius(motion, f);
    }
}

/* Sets what all waypoints share: the outer surface of the source and the features' triangles. */
static void set_given(iccp_feature_motion *motion)
{
    const icc_domain *source = motion->source;
    size_t next = 0;
    for (size_t f = 0; f < motion->n; ++f) {
        const iccp_feature *item = &source->features->item[f];
        icc_feature *given = &motion->given[f];
        given->size = sizeof *given;
        given->kind = item->kind;
        given->n_vertices = item->n;
        given->vertices = motion->places + 3 * (size_t)item->first;
        given->n_facets = item->n_facets;
        given->facets = item->n_facets > 0 ? motion->triangles + next : NULL;
        for (size_t i = 0; i < 3 * (size_t)item->n_facets; ++i)
            motion->triangles[next++] =
                source->facets[3 * (size_t)item->first_facet + i] - item->first;
    }
}

icc_status iccp_feature_motion_create(iccp_feature_motion *motion, const icc_domain *source,
                                      const icc_domain *target, const iccp_carrier *carriers,
                                      const iccp_memory *memory)
{
    const iccp_features *features = source->features;
    const size_t n_inner = source->n_vertices - features->n_outer;
    *motion = (iccp_feature_motion){
        .memory = *memory, .source = source, .target = target, .n = features->n, .scale = 1};
    motion->item = iccp_alloc_zero(memory, motion->n, sizeof *motion->item);
    motion->shape[0] = iccp_alloc(memory, n_inner, 3 * sizeof *motion->shape[0]);
    motion->shape[1] = iccp_alloc(memory, n_inner, 3 * sizeof *motion->shape[1]);
    motion->places = iccp_alloc(memory, source->n_vertices, 3 * sizeof *motion->places);
    motion->given = iccp_alloc_zero(memory, motion->n, sizeof *motion->given);
    motion->triangles = iccp_alloc(memory, features->n_places, 3 * sizeof *motion->triangles);
    if (motion->item == NULL || motion->shape[0] == NULL || motion->shape[1] == NULL ||
        motion->places == NULL || motion->given == NULL || motion->triangles == NULL)
        return ICC_ERR_MEMORY;
    set_items(motion, carriers);
    set_given(motion);
    return ICC_OK;
}

void iccp_feature_motion_free(iccp_feature_motion *motion)
{
    iccp_free(&motion->memory, motion->item);
    iccp_free(&motion->memory, motion->shape[0]);
    iccp_free(&motion->memory, motion->shape[1]);
    iccp_free(&motion->memory, motion->places);
    iccp_free(&motion->memory, motion->given);
    iccp_free(&motion->memory, motion->triangles);
}

/* ---- configurations ---- */

/* Where features are at a time. */
typedef struct moment {
    bool in_target; /* their bodies are the target's, else the source's */
    double scale;   /* of each feature, relative to the region that contains it */
    double share;   /* of their ways */
} moment;

/* Where a feature is: x -> place + scale rotation x. */
typedef struct pose {
    double place[3], rotation[9], scale;
} pose;

/* Finds a feature's place relative to the region that contains it. */
static void place_on_way(const iccp_moving *m, const moment *at, double *place)
{
    double arc[2];
    iccp_cis_turns(at->share / 2, arc);
    for (int k = 0; k < 3; ++k)
        place[k] = at->in_target ? m->last[k]
                                 : (1 - at->share) * m->place[k] + at->share * m->via[k] +
                                       arc[1] * m->bend[k];
}

static pose pose_of(const iccp_feature_motion *motion, const moment *at, size_t f)
{
    const iccp_moving *m = &motion->item[f];
    pose p = {.scale = 1}, own;
    double turn[9], place[3];
    memcpy(p.rotation, UNIT, sizeof UNIT);
    if (m->parent < motion->n)
        p = pose_of(motion, at, m->parent);
    place_on_way(m, at, place);
    if (at->in_target && m->parent == motion->n)
        memcpy(turn, m->final, sizeof turn);
    else
        set_part_of_turn(m->turn, at->share, turn);
    apply(p.rotation, place, own.place);
    for (int k = 0; k < 3; ++k)
        own.place[k] = p.place[k] + p.scale * own.place[k];
    multiply(p.rotation, turn, own.rotation);
    own.scale = p.scale * at->scale;
    return own;
}

/* Computes where vertex i of a feature is, relative to its centre, before scaling and turning. */
static void shape_of(const iccp_feature_motion *motion, const moment *at, size_t f, size_t i,
                     double *x)
{
    const iccp_features *features = motion->source->features;
    const size_t v = 3 * (features->item[f].first - features->n_outer + i);
    const double after = at->in_target ? 1 : at->share * motion->item[f].shrinkage;
    for (size_t k = 0; k < 3; ++k)
        x[k] = (1 - at->share) * motion->shape[0][v + k] + after * motion->shape[1][v + k];
}

static void place_feature(iccp_feature_motion *motion, const moment *at, size_t f)
{
    const iccp_feature *item = &motion->source->features->item[f];
    const pose own = pose_of(motion, at, f);
    for (size_t i = 0; i < item->n; ++i) {
        double x[3], *place = motion->places + 3 * (item->first + i);
        shape_of(motion, at, f, i, x);
        apply(own.rotation, x, place);
        for (size_t k = 0; k < 3; ++k)
            place[k] = own.place[k] + own.scale * place[k];
    }
}

icc_status iccp_feature_waypoint(icc_domain **out, iccp_feature_motion *motion,
                                 iccp_motion_stage stage, double time, const iccp_env *env)
{
    const double small = motion->scale;
    const moment at[ICCP_MOTION_STAGES] = {{false, 1 - (1 - small) * time, 0},
                                           {false, small, time},
                                           {true, small, 1},
                                           {true, small + (1 - small) * time, 1}};
    const icc_domain *body = at[stage].in_target ? motion->target : motion->source;
    const iccp_features *features = body->features;
    if (stage == ICCP_MOTION_GROWS && time == 1) {
        *out = iccp_domain_retain(motion->target);
        return ICC_OK;
    }
    memcpy(motion->places, body->given, 3 * features->n_outer * sizeof *motion->places);
    for (size_t f = 0; f < motion->n; ++f)
        place_feature(motion, &at[stage], f);
    const iccp_outer outer = {features->n_outer, features->n_outer_facets, motion->places,
                              body->facets};
    const icc_status status =
        iccp_domain_create_solid(out, &outer, motion->n, motion->given, env, NULL);
    return status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED ? status : ICC_OK;
}

/* ---- bends ---- */

/* Moments of the way at which room is measured, attempts at a bend, and how often each feature has
 * its turn. */
enum { MOMENTS = 12, ATTEMPTS = 60, PASSES = 2 };

/* Room that need not grow, and the longest bend, as shares of the
 * size of what contains the feature. */
static const double ENOUGH_ROOM = 0.03, LONGEST_BEND = 0.5;

/* Measures how far inside the body a place is; negative if it is outside. */
static double depth_in_body(const icc_domain *body, const double *place)
{
    double local[3], bary[3], distance2;
    iccp_frame_in(&body->frame, 3, place, local);
    if (iccp_domain_locate(body, local, true, NULL, NULL) != ICC_INSIDE)
        return -HUGE_VAL;
    iccp_facet_tree_nearest(iccp_domain_tree(body), local, bary, &distance2);
    return sqrt(distance2) * body->frame.out[0] * body->frame.out[1];
}

/* Measures how far inside a region a place in its coordinates is. The sign is that at the nearest
 * triangle. */
static double depth_in_region(const iccp_feature_motion *motion, const moment *at, size_t region,
                              const double *place)
{
    const iccp_features *features = motion->source->features;
    const iccp_feature *item = &features->item[region];
    double depth = 0, least = HUGE_VAL;
    for (size_t t = item->first_facet; t < (size_t)item->first_facet + item->n_facets; ++t) {
        double corner[3][3], side[2][3], normal[3], bary[3];
        for (size_t c = 0; c < 3; ++c)
            shape_of(motion, at, region, motion->source->facets[3 * t + c] - item->first,
                     corner[c]);
        const double *const corners[3] = {corner[0], corner[1], corner[2]};
        const double distance2 = iccp_simplex_nearest(3, 3, corners, place, bary);
        if (!(distance2 < least))
            continue;
        for (size_t k = 0; k < 3; ++k) {
            side[0][k] = corner[1][k] - corner[0][k];
            side[1][k] = corner[2][k] - corner[0][k];
        }
        iccp_vec_cross(side[0], side[1], normal);
        least = distance2;
        depth = sqrt(distance2);
        const bool in_front = iccp_vec_dot(3, normal, place) > iccp_vec_dot(3, normal, corner[0]);
        if (in_front == (features->sides[2 * t] == item->around))
            depth = -depth;
    }
    return depth;
}

/* Measures the room of feature f at a moment: from other features in the same region and from what
 * contains them, in the coordinates of the latter. */
static double room_at(const iccp_feature_motion *motion, const icc_domain *body, const moment *at,
                      size_t f)
{
    const iccp_moving *m = &motion->item[f];
    double own[3], its[3];
    place_on_way(m, at, own);
    double room = m->parent == motion->n ? depth_in_body(body, own)
                                         : depth_in_region(motion, at, m->parent, own);
    room -= at->scale * m->radius;
    for (size_t g = 0; g < motion->n; ++g) {
        const iccp_moving *other = &motion->item[g];
        if (g == f || other->parent != m->parent)
            continue;
        place_on_way(other, at, its);
        room = iccp_min(room,
                        iccp_vec_distance(3, own, its) - at->scale * (m->radius + other->radius));
    }
    return room;
}

/* Measures the least room of a feature on its way. */
static double room_of(const iccp_feature_motion *motion, const icc_domain *body, size_t f)
{
    double least = HUGE_VAL;
    for (int k = 0; k <= MOMENTS; ++k) {
        const moment at = {false, motion->scale, (double)k / MOMENTS};
        least = iccp_min(least, room_at(motion, body, &at, f));
    }
    return least;
}

/* Draws bends for a feature, short ones first, and keeps the one with the most room. */
static void bend_one(iccp_feature_motion *motion, const icc_domain *body, size_t f, double longest,
                     uint64_t *random)
{
    iccp_moving *m = &motion->item[f];
    double best[3], room = room_of(motion, body, f);
    memcpy(best, m->bend, sizeof best);
    for (int k = 1; k <= ATTEMPTS; ++k) {
        for (int c = 0; c < 3; ++c)
            m->bend[c] = longest * k / ATTEMPTS * (2 * iccp_random_unit(random) - 1);
        const double found = room_of(motion, body, f);
        if (found > room) {
            room = found;
            memcpy(best, m->bend, sizeof best);
        }
    }
    memcpy(m->bend, best, sizeof best);
}

double iccp_feature_motion_bend(iccp_feature_motion *motion, const icc_domain *body)
{
    const double size = body->frame.out[0] * body->frame.out[1];
    uint64_t random = 1;
    double least = HUGE_VAL;
    for (size_t k = 0; k < PASSES * motion->n; ++k) {
        const size_t f = k % motion->n;
        const uint32_t parent = motion->item[f].parent;
        const double longest = parent == motion->n ? size : motion->item[parent].radius;
        if (room_of(motion, body, f) < ENOUGH_ROOM * longest)
            bend_one(motion, body, f, LONGEST_BEND * longest, &random);
    }
    for (size_t f = 0; f < motion->n; ++f)
        least = iccp_min(least, room_of(motion, body, f));
    return least / size;
}
