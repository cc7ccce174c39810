/* Delaunay refinement as in J. R. Shewchuk, Tetrahedral mesh generation by Delaunay refinement,
 * 1998, without changing the surface. Circumcentres of slender tetrahedra are inserted, the worst
 * first. If a circumcentre lies outside, near the surface or near another point, a point nearer to
 * the middle of the tetrahedron is tried. Local sizes are those of the surface's edges, spread to
 * the inside. */
#include "fill/inner_points.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/sort.h"
#include "fill/insert.h"
#include "fill/quality.h"

/* In units of the local size: shorter edges count as this long, for maps in tetrahedra with four
 * corners on the surface and elsewhere; least distance of a new point from the surface. */
static const double least_edge_4 = 0.38, least_edge = 0.6, least_height = 0.3;

typedef struct bad {
    double key;
    uint32_t tet;
} bad;

typedef struct refinement {
    iccp_tets *m;
    const iccp_fill_options *options;
    double *size; /* by point, n_sizes of them; 0: unknown */
    size_t n_sizes;
    bad *queue;
    size_t n_queue, room;
} refinement;

static bool circumcentre(const iccp_tets *m, const iccp_tet *tet, double centre[3], double *radius)
{
    const double *const o = iccp_point(&m->points, tet->v[0]);
    double e[3][3], square[3], x[3] = {0};
    for (int i = 0; i < 3; ++i) {
        const double *const p = iccp_point(&m->points, tet->v[i + 1]);
        for (int k = 0; k < 3; ++k)
            e[i][k] = p[k] - o[k];
        square[i] = e[i][0] * e[i][0] + e[i][1] * e[i][1] + e[i][2] * e[i][2];
    }
    double det = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double *const u = e[(i + 1) % 3], *const v = e[(i + 2) % 3];
        for (int k = 0; k < 3; ++k) {
            const double cross = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
            x[k] += square[i] * cross;
            det += i == 0 ? e[0][k] * cross : 0.0;
        }
    }
    *radius = 0.0;
    for (int k = 0; k < 3; ++k) {
        x[k] *= 0.5 / det;
        centre[k] = o[k] + x[k];
        *radius += x[k] * x[k];
    }
    *radius = sqrt(*radius);
    return *radius < 16.0;
}

/* Returns the length that a tetrahedron's circumradius is compared with. */
static double scale_of(const refinement *r, const iccp_tet *tet)
{
    const iccp_points *const p = &r->m->points;
    double shortest = HUGE_VAL, size = HUGE_VAL;
    bool on_surface = r->options->for_map;
    for (int i = 0; i < 4; ++i) {
        size = iccp_min(size, r->size[tet->v[i]]);
        on_surface &= tet->v[i] < p->n_given;
        for (int j = i + 1; j < 4; ++j)
            shortest = iccp_min(
                shortest, iccp_square_distance(iccp_point(p, tet->v[i]), iccp_point(p, tet->v[j])));
    }
    return iccp_max(on_surface ? 0.0 : sqrt(shortest),
                    (on_surface ? least_edge_4 : least_edge) * size);
}

static bool is_bad(const refinement *r, uint32_t t, double centre[3], double *badness,
                   double *scale)
{
    double radius;
    const iccp_tet *const tet = &r->m->tet[t];
    *scale = scale_of(r, tet);
    const bool proper = circumcentre(r->m, tet, centre, &radius);
    *badness = proper ? radius / *scale : HUGE_VAL;
    return *badness > r->options->ratio;
}

/* Returns true if a point is too near to the corners of the tetrahedra in m->cavity, or to walls
 * there. In Delaunay tetrahedra, the circumcentre makes edges longer than `ratio` times those that
 * it repairs. Other points must do the same. Otherwise refinement would go on until the whole
 * inside were as fine as the finest edges allow. For maps, new edges may be as short as those. */
static bool is_crowded(const refinement *r, const double *x, double scale)
{
    const iccp_tets *const m = r->m;
    const double gap = r->options->for_map ? scale : r->options->ratio * scale;
    const iccp_points *const p = &m->points;
    for (size_t k = 0; k < m->cavity.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->cavity.item[k]];
        for (int i = 0; i < 4; ++i) {
            const double *const corner = iccp_point(p, tet->v[i]);
            if (iccp_square_distance(corner, x) < gap * gap)
                return true;
            if (!iccp_is_wall_side(tet->across[i]))
                continue;
            const uint8_t *const f = iccp_tet_face[i];
            const double *const a = iccp_point(p, tet->v[f[0]]);
            const double *const b = iccp_point(p, tet->v[f[1]]);
            const double *const c = iccp_point(p, tet->v[f[2]]);
            double square = 0.0;
            for (int j = 0; j < 3; ++j) {
                const int u = (j + 1) % 3, v = (j + 2) % 3;
                const double cross = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
                square += cross * cross;
            }
            if (iccp_points_volume(a, b, c, x) < least_height * scale * sqrt(square))
                return true;
        }
    }
    return false;
}

/* Sets the new point's size to the mean of its neighbours' sizes. */
static bool set_size(refinement *r, uint32_t p)
{
    const iccp_tets *const m = r->m;
    if (p >= r->n_sizes) {
        const size_t n = m->points.room;
        if (!iccp_enlarge(&m->memory, &r->size, r->n_sizes, n, sizeof *r->size))
            return false;
        r->n_sizes = n;
    }
    double sum = 0.0;
    for (size_t k = 0; k < m->fresh.n; ++k)
        for (int i = 0; i < 3; ++i)
            sum += r->size[m->tet[m->fresh.item[k]].v[i]];
    r->size[p] = sum / (3.0 * (double)m->fresh.n);
    return true;
}

static iccp_inserted insert_at(refinement *r, uint32_t t, const double *x, double scale)
{
    iccp_tets *const m = r->m;
    double place[3] = {x[0], x[1], x[2]};
    iccp_points_snap(&m->points, place);
    const uint32_t p = iccp_tets_add_point(m, place);
    if (p == ICCP_NO_TET)
        return ICCP_INSERT_MEMORY;
    const uint32_t at = iccp_tets_locate(m, p, t);
    iccp_inserted done = ICCP_NOT_INSERTED;
    if (at != ICCP_NO_TET) {
        if (!iccp_tets_holders(m, p, at))
            return ICCP_INSERT_MEMORY;
        if (!is_crowded(r, place, scale))
            done = iccp_tets_insert(m, p, m->cavity.n, true);
    }
    if (done == ICCP_INSERTED)
        return set_size(r, p) ? done : ICCP_INSERT_MEMORY;
    iccp_tets_drop_point(m);
    return done;
}

/* Inserts the circumcentre, or a point between it and the middle. */
static iccp_inserted split(refinement *r, uint32_t t)
{
    static const double way[] = {1.0, 0.7, 0.4};
    const iccp_points *const p = &r->m->points;
    const iccp_tet tet = r->m->tet[t];
    double centre[3], middle[3], x[3], badness, scale;
    if (!is_bad(r, t, centre, &badness, &scale) || badness == HUGE_VAL)
        return ICCP_NOT_INSERTED;
    for (int k = 0; k < 3; ++k)
        middle[k] = 0.25 * (iccp_point(p, tet.v[0])[k] + iccp_point(p, tet.v[1])[k] +
                            iccp_point(p, tet.v[2])[k] + iccp_point(p, tet.v[3])[k]);
    for (size_t i = 0; i < sizeof way / sizeof *way; ++i) {
        for (int k = 0; k < 3; ++k)
            x[k] = middle[k] + way[i] * (centre[k] - middle[k]);
        const iccp_inserted done = insert_at(r, t, x, scale);
        if (done != ICCP_NOT_INSERTED)
            return done;
    }
    return ICCP_NOT_INSERTED;
}

static int compare(const void *a, const void *b)
{
    const bad *const x = a, *const y = b;
    return x->key != y->key ? (x->key > y->key ? -1 : 1) : x->tet < y->tet ? -1 : x->tet > y->tet;
}

/* Returns true if a tetrahedron is new or much has changed around it. Another try hardly ever
 * improves others. */
static bool is_worth_a_try(const iccp_tets *m, uint32_t t)
{
    for (int i = 0; i < 4; ++i)
        if (!iccp_point_touched(m, m->tet[t].v[i]))
            return false;
    return true;
}

/* Lists the tetrahedra to refine, the worst first. */
static bool fill_queue(refinement *r, bool first)
{
    const iccp_tets *const m = r->m;
    r->n_queue = 0;
    for (uint32_t t = 0; t < m->n_tets; ++t) {
        double centre[3], badness, scale;
        if (!iccp_tet_alive(m, t) || !(first || is_worth_a_try(m, t)) ||
            !is_bad(r, t, centre, &badness, &scale))
            continue;
        if (r->n_queue == r->room) {
            const size_t room = 2 * r->room + 256;
            if (!iccp_enlarge(&m->memory, &r->queue, r->room, room, sizeof *r->queue))
                return false;
            r->room = room;
        }
        r->queue[r->n_queue++] = (bad){badness, t};
    }
    iccp_sort(r->queue, r->n_queue, sizeof *r->queue, compare);
    return true;
}

static void add_lengths(const refinement *r, size_t n, const iccp_segment *segments,
                        uint32_t *count)
{
    const iccp_points *const p = &r->m->points;
    for (size_t e = 0; e < n; ++e) {
        const uint32_t a = segments[e].a, b = segments[e].b;
        const double length = sqrt(iccp_square_distance(iccp_point(p, a), iccp_point(p, b)));
        r->size[a] += length, ++count[a];
        r->size[b] += length, ++count[b];
    }
}

/* Gives points without a size the mean of their neighbours' sizes. Sets *more if some get one and
 * others do not. Returns false if there is no memory. */
static bool spread_sizes(refinement *r, bool *more)
{
    iccp_tets *const m = r->m;
    bool some = false, others = false;
    for (uint32_t p = 0; p < m->points.n; ++p) {
        double sum = 0.0, count = 0.0;
        if (m->tet_of[p] == ICCP_NO_TET || r->size[p] > 0.0)
            continue;
        if (!iccp_tets_star(m, p))
            return false;
        for (size_t k = 0; k < m->star.n; ++k)
            for (int i = 0; i < 4; ++i) {
                const double size = r->size[m->tet[m->star.item[k]].v[i]];
                sum += size;
                count += size > 0.0;
            }
        r->size[p] = count > 0.0 ? sum / count : 0.0;
        *(count > 0.0 ? &some : &others) = true;
    }
    *more = some && others;
    return true;
}

/* Computes target edge lengths. At a vertex of a surface or line it is the mean length of its
 * edges. At other points it comes from nearby vertices. */
static bool make_sizes(refinement *r, const iccp_constraints *s)
{
    iccp_tets *const m = r->m;
    r->n_sizes = m->points.room;
    r->size = iccp_alloc_zero(&m->memory, r->n_sizes, sizeof *r->size);
    uint32_t *n = iccp_alloc_zero(&m->memory, m->points.n_given, sizeof *n);
    if (r->size != NULL && n != NULL) {
        add_lengths(r, s->n_segments, s->segment, n);
        add_lengths(r, s->n_lines, s->line, n);
    }
    for (size_t v = 0; v < m->points.n_given && r->size != NULL && n != NULL; ++v)
        r->size[v] = n[v] > 0 ? r->size[v] / n[v] : 0.0;
    bool done = r->size != NULL && n != NULL;
    iccp_free(&m->memory, n);
    for (bool more = true; more && done;)
        done = spread_sizes(r, &more);
    return done;
}

icc_status iccp_tets_refine(iccp_tets *m, const iccp_constraints *s,
                            const iccp_fill_options *options, const iccp_env *env, icc_error *err)
{
    enum { MOST_ROUNDS = 12 };
    /* Refinement goes on after a round with this many new points. One point can change the whole
     * mesh: all tetrahedra of a ball have the centre of the ball as their circumcentre. For maps,
     * a few points more are not worth a round. */
    const size_t few = options->for_map ? 5 : 1;
    refinement r = {.m = m, .options = options};
    icc_status status = make_sizes(&r, s) ? ICC_OK : iccp_fail_memory(err);
    const uint32_t before = m->round;
    uint64_t n_all = 0;
    size_t n = few;
    for (int round = 0; round < MOST_ROUNDS && n >= few && status == ICC_OK; ++round) {
        n = 0;
        ++m->round;
        if (!fill_queue(&r, round == 0))
            status = iccp_fail_memory(err);
        for (size_t k = 0; k < r.n_queue && n_all < options->max_points && status == ICC_OK; ++k) {
            if (k % 1024 == 0)
                status = iccp_explain(err, iccp_progress(env, "mesh", (double)round / MOST_ROUNDS));
            if (status != ICC_OK || !iccp_tet_alive(m, r.queue[k].tet))
                continue;
            const iccp_inserted done = split(&r, r.queue[k].tet);
            n += done == ICCP_INSERTED;
            n_all += done == ICCP_INSERTED;
            if (done == ICCP_INSERT_MEMORY)
                status = iccp_fail_memory(err);
        }
    }
    m->round = before; /* for later stages, all this is one round */
    for (size_t p = 0; p < m->points.n; ++p)
        m->touched[p] = m->touched[p] < before ? m->touched[p] : before;
    iccp_free(&m->memory, r.size);
    iccp_free(&m->memory, r.queue);
    return status;
}
