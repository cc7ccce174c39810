/* The energy of the map from one surface to the other, on the pieces that pairs of triangles have
 * in common on the sphere. Based on: P. Schmidt, M. Campen, J. Born, L. Kobbelt, Inter-Surface Maps
 * via Constant-Curvature Metrics, 2020.
 *
 * Here each surface gives the sphere a metric. It is seen in the plane that touches the sphere at
 * the vertex, where straight lines stay straight. The energy compares the two metrics. */
#include "match/sphere/composed_star.h"

#include "base/minmax.h"
#include "match/surface/direction.h"

#include <string.h>

/* This share of a face's squared sides is added to each of them, so that no face is too thin.
 * `thickness` is added too, so that faces without area have a metric. */
static const double fatter = 1e-4, thickness = 1e-14;

/* The smallest cosine between the vertex and a direction of its ring. */
static const double least_cosine = 0.1;

/* Smaller overlaps of two faces are caused by rounding. */
static const double least_area = 1e-24;

/* Faces that a star may overlap, and corners of a piece. */
enum { MOST_OTHERS = 4000, MOST_CORNERS = 8 };

bool iccp_composed_star_create(iccp_composed_star *star, size_t most_neighbours, size_t n_faces,
                               const iccp_memory *memory)
{
    *star = (iccp_composed_star){.memory = *memory, .room = most_neighbours};
    star->ring = iccp_alloc(memory, most_neighbours + 1, sizeof *star->ring);
    star->face = iccp_alloc(memory, most_neighbours, sizeof *star->face);
    star->seen = iccp_alloc_zero(memory, n_faces, sizeof *star->seen);
    star->other = iccp_alloc(memory, MOST_OTHERS, sizeof *star->other);
    star->list = iccp_alloc(memory, MOST_OTHERS, sizeof *star->list);
    return star->ring != NULL && star->face != NULL && star->seen != NULL && star->other != NULL &&
           star->list != NULL;
}

void iccp_composed_star_free(iccp_composed_star *star)
{
    iccp_free(&star->memory, star->ring);
    iccp_free(&star->memory, star->face);
    iccp_free(&star->memory, star->seen);
    iccp_free(&star->memory, star->other);
    iccp_free(&star->memory, star->list);
    iccp_free(&star->memory, star->piece);
    *star = (iccp_composed_star){.memory = star->memory};
}

void iccp_composed_star_see(double seen[3], const iccp_composed_star *star, const double q[3])
{
    double d[3];
    for (int k = 0; k < 3; ++k)
        d[k] = q[k] - star->p[k];
    seen[0] = iccp_vec_dot(3, d, star->axis[0]);
    seen[1] = iccp_vec_dot(3, d, star->axis[1]);
    seen[2] = 1 + iccp_vec_dot(3, d, star->p);
}

/* ---- faces ---- */

/* The products of a face's sides on the surface. */
static void measure(iccp_seen_face *f, const iccp_drawn_surface *s, uint32_t a, uint32_t b,
                    uint32_t c)
{
    double g[3], h[3];
    for (int k = 0; k < 3; ++k) {
        const double o = s->x[3 * (size_t)a + (size_t)k];
        g[k] = s->scale * (s->x[3 * (size_t)b + (size_t)k] - o);
        h[k] = s->scale * (s->x[3 * (size_t)c + (size_t)k] - o);
    }
    f->gram[0] = iccp_vec_dot(3, g, g);
    f->gram[1] = iccp_vec_dot(3, g, h);
    f->gram[2] = iccp_vec_dot(3, h, h);
    const double more = fatter * 2 * (f->gram[0] - f->gram[1] + f->gram[2]) + thickness;
    f->gram[0] += more;
    f->gram[1] += 0.5 * more;
    f->gram[2] += more;
    f->root = sqrt(f->gram[0] * f->gram[2] - f->gram[1] * f->gram[1]);
}

static void find_planes(iccp_seen_face *f)
{
    double g[3], h[3];
    for (int i = 0; i < 3; ++i)
        iccp_vec_cross(f->corner[(i + 1) % 3], f->corner[(i + 2) % 3], f->plane[i]);
    for (int k = 0; k < 3; ++k) {
        g[k] = f->corner[1][k] - f->corner[0][k];
        h[k] = f->corner[2][k] - f->corner[0][k];
    }
    iccp_vec_cross(g, h, f->sum);
}

static double side(const double plane[3], const double p[3])
{
    return plane[0] * p[0] + plane[1] * p[1] + plane[2] * p[2];
}

/* Keeps the part of a polygon on the positive side of a plane. *p becomes `out`, unless the whole
 * polygon is kept. */
static size_t clip(double (*out)[3], const double (**p)[3], size_t n, const double plane[3])
{
    const double(*const in)[3] = *p;
    double at[MOST_CORNERS];
    size_t n_out = 0, n_in = 0;
    for (size_t i = 0; i < n; ++i) {
        at[i] = side(plane, in[i]);
        n_in += at[i] > 0;
    }
    if (n_in == 0)
        return 0;
    if (n_in == n)
        return n;
    *p = (const double(*)[3])out;
    for (size_t i = 0, before = n - 1; i < n; before = i++) {
        if ((at[i] > 0) != (at[before] > 0)) {
            const double s = at[before] / (at[before] - at[i]);
            for (int k = 0; k < 3; ++k)
                out[n_out][k] = in[before][k] + s * (in[i][k] - in[before][k]);
            ++n_out;
        }
        if (at[i] > 0)
            memcpy(out[n_out++], in[i], sizeof *in);
    }
    return n_out;
}

/* ---- what the star overlaps ---- */

static bool add_piece(iccp_composed_star *star, uint32_t sector, uint32_t face)
{
    if (star->n_pieces == star->room_pieces) {
        const size_t room = 2 * star->room_pieces + 256;
        iccp_star_piece *const more = iccp_alloc(&star->memory, room, sizeof *more);
        if (more == NULL)
            return false;
        if (star->n_pieces > 0)
            memcpy(more, star->piece, star->n_pieces * sizeof *more);
        iccp_free(&star->memory, star->piece);
        star->piece = more;
        star->room_pieces = room;
    }
    iccp_star_piece *const piece = &star->piece[star->n_pieces];
    const double(*p)[3] = (const double(*)[3])star->other[face].corner;
    piece->sector = sector;
    piece->face = face;
    piece->is_known = false;
    piece->n = (uint32_t)clip(piece->corner, &p, 3, star->face[sector].plane[0]);
    if (piece->n == 3 && p != (const double(*)[3])piece->corner)
        memcpy(piece->corner, p, 3 * sizeof *p);
    if (piece->n >= 3)
        ++star->n_pieces;
    return true;
}

/* Returns true if a face of the star and a face of the other drawing may overlap: no side of one
 * separates them. */
static bool overlaps(const iccp_seen_face *a, const iccp_seen_face *b)
{
    for (int i = 0; i < 3; ++i) {
        if (!(side(a->plane[i], b->corner[0]) > 0 || side(a->plane[i], b->corner[1]) > 0 ||
              side(a->plane[i], b->corner[2]) > 0))
            return false;
        if (!(side(b->plane[i], a->corner[0]) > 0 || side(b->plane[i], a->corner[1]) > 0 ||
              side(b->plane[i], a->corner[2]) > 0))
            return false;
    }
    return true;
}

static icc_status look_at(iccp_composed_star *star, const iccp_drawn_surface *other, uint32_t face)
{
    if (star->seen[face] == star->stamp)
        return ICC_OK;
    if (star->n_other == MOST_OTHERS)
        return ICC_ERR_RESOLUTION;
    star->seen[face] = star->stamp;
    iccp_seen_face *const f = &star->other[star->n_other];
    const uint32_t *const v = other->m->origin + 3 * (size_t)face;
    for (int i = 0; i < 3; ++i)
        iccp_composed_star_see(f->corner[i], star, other->directions + 3 * (size_t)v[i]);
    find_planes(f);
    bool does = star->n_other == 0;
    for (size_t i = 0; i < star->n && !does; ++i)
        does = overlaps(&star->face[i], f);
    if (does) {
        measure(f, other, v[0], v[1], v[2]);
        star->list[star->n_other++] = face;
    }
    return ICC_OK;
}

icc_status iccp_composed_star_gather(iccp_composed_star *star, const iccp_drawn_surface *one,
                                     uint32_t vertex, const iccp_drawn_surface *other,
                                     uint32_t start)
{
    const iccp_half_edges *const m = one->m;
    memcpy(star->p, one->directions + 3 * (size_t)vertex, sizeof star->p);
    iccp_direction_axes(star->p, star->axis);
    star->n = star->n_other = star->n_pieces = 0;
    star->radius = HUGE_VAL;
    star->farthest = 0;
    uint32_t h = m->out[vertex];
    do {
        const uint32_t a = iccp_edge_end(m, h), b = m->origin[iccp_before(h)];
        iccp_seen_face *const f = &star->face[star->n];
        star->ring[star->n++] = one->directions + 3 * (size_t)a;
        star->ring[star->n] = one->directions + 3 * (size_t)b;
        f->corner[0][0] = f->corner[0][1] = 0;
        f->corner[0][2] = 1;
        iccp_composed_star_see(f->corner[1], star, one->directions + 3 * (size_t)a);
        iccp_composed_star_see(f->corner[2], star, one->directions + 3 * (size_t)b);
        if (f->corner[1][2] < least_cosine)
            return ICC_ERR_RESOLUTION;
        find_planes(f);
        measure(f, one, vertex, a, b);
        const double across = iccp_vec_norm(2, f->plane[0]);
        star->radius = iccp_min(star->radius, f->plane[0][2] / across);
        star->farthest = iccp_max(star->farthest, iccp_vec_norm(2, f->corner[1]));
        h = iccp_edge_turn(m, h);
    } while (h != m->out[vertex]);
    ++star->stamp;
    icc_status status = look_at(star, other, start);
    for (size_t k = 0; k < star->n_other && status == ICC_OK; ++k)
        for (uint32_t e = 3 * star->list[k]; e < 3 * star->list[k] + 3 && status == ICC_OK; ++e)
            status = look_at(star, other, other->m->twin[e] / 3);
    for (uint32_t k = 0; k < star->n_other && status == ICC_OK; ++k)
        for (uint32_t i = 0; i < star->n && status == ICC_OK; ++i)
            if (!add_piece(star, i, k))
                status = ICC_ERR_MEMORY;
    return status;
}

/* ---- energy ---- */

/* The metric g that a face's surface gives the plane at a point. Returns the root of its
 * determinant. */
static double metric(double g[3], const iccp_seen_face *f, const double q[2])
{
    const double d = 1 / (f->sum[0] * q[0] + f->sum[1] * q[1] + f->sum[2]);
    const double a = d * (f->plane[1][0] * q[0] + f->plane[1][1] * q[1] + f->plane[1][2]);
    const double b = d * (f->plane[2][0] * q[0] + f->plane[2][1] * q[1] + f->plane[2][2]);
    const double a0 = d * (f->plane[1][0] - a * f->sum[0]);
    const double a1 = d * (f->plane[1][1] - a * f->sum[1]);
    const double b0 = d * (f->plane[2][0] - b * f->sum[0]);
    const double b1 = d * (f->plane[2][1] - b * f->sum[1]);
    const double *const e = f->gram;
    g[0] = e[0] * a0 * a0 + 2 * e[1] * a0 * b0 + e[2] * b0 * b0;
    g[1] = e[0] * a0 * a1 + e[1] * (a0 * b1 + a1 * b0) + e[2] * b0 * b1;
    g[2] = e[0] * a1 * a1 + 2 * e[1] * a1 * b1 + e[2] * b1 * b1;
    return fabs(f->root * (a0 * b1 - a1 * b0));
}

/* The area of a polygon in the plane, and its middle. */
static double middle(double q[2], const double (*corner)[3], size_t n)
{
    double p[MOST_CORNERS][2], twice = 0;
    q[0] = q[1] = 0;
    for (size_t i = 0; i < n; ++i) {
        const double d = 1 / corner[i][2];
        p[i][0] = d * corner[i][0];
        p[i][1] = d * corner[i][1];
    }
    for (size_t i = 1; i + 1 < n; ++i) {
        const double g[2] = {p[i][0] - p[0][0], p[i][1] - p[0][1]};
        const double h[2] = {p[i + 1][0] - p[0][0], p[i + 1][1] - p[0][1]};
        const double area = g[0] * h[1] - g[1] * h[0];
        twice += area;
        for (int k = 0; k < 2; ++k)
            q[k] += area * (g[k] + h[k]);
    }
    for (int k = 0; k < 2; ++k)
        q[k] = p[0][k] + q[k] / (3 * twice);
    return 0.5 * twice;
}

static iccp_star_overlap measure_overlap(const iccp_seen_face *other, const double (*corner)[3],
                                         size_t n)
{
    iccp_star_overlap o;
    o.area = middle(o.middle, corner, n);
    o.root = o.area > least_area ? metric(o.metric, other, o.middle) : 0;
    return o;
}

/* Most pieces lie inside their sector, wherever the vertex moves. These are measured once. */
double iccp_composed_star_energy(iccp_composed_star *star, const double seen[3], double most)
{
    double sum = 0;
    star->weight = 0;
    for (size_t i = 0; i < star->n; ++i) {
        memcpy(star->face[i].corner[0], seen, 3 * sizeof *seen);
        find_planes(&star->face[i]);
    }
    for (size_t k = 0; k < star->n_pieces; ++k) {
        iccp_star_piece *const piece = &star->piece[k];
        const iccp_seen_face *const a = &star->face[piece->sector], *const b =
                                                                        &star->other[piece->face];
        const double(*const whole)[3] = (const double(*)[3])piece->corner, (*p)[3] = whole;
        double work[2][MOST_CORNERS][3], g[3];
        size_t n = clip(work[0], &p, piece->n, a->plane[1]);
        if (n >= 3)
            n = clip(work[1], &p, n, a->plane[2]);
        if (n < 3)
            continue;
        iccp_star_overlap o;
        if (p == whole && piece->is_known) {
            o = piece->whole;
        } else {
            o = measure_overlap(b, p, n);
            if (p == whole) {
                piece->whole = o;
                piece->is_known = true;
            }
        }
        if (!(o.area > least_area))
            continue;
        const double *const h = o.metric, u = metric(g, a, o.middle), v = o.root;
        const double e =
            (g[0] * h[2] - 2 * g[1] * h[1] + g[2] * h[0]) * (1 / (u * u) + 1 / (v * v));
        star->weight += o.area * (u + v);
        sum += o.area * (u + v) * e * (star->is_severe ? sqrt(e) : 1);
        if (!(sum < most))
            return HUGE_VAL;
    }
    return sum;
}
