/* Walks every edge of a drawing on the sphere through the faces of another drawing. */
#include "match/common_mesh/arc_walk.h"

#include "base/error.h"
#include "match/surface/perturbed.h"

#include <string.h>

typedef struct walker {
    iccp_arc_walk *walk;
    const iccp_drawing *x, *y; /* x walks through y */
    uint32_t *queue;           /* vertices of x whose place is known */
    uint8_t *is_known;
    size_t most;
} walker;

/* A vertex with its direction. */
typedef struct vertex {
    const double *p;
    uint32_t number;
} vertex;

static vertex vertex_of(const iccp_drawing *d, uint32_t v)
{
    return (vertex){d->directions + 3 * (size_t)v, d->number[v]};
}

static int sign(vertex a, vertex b, vertex c)
{
    const double *const p[3] = {a.p, b.p, c.p};
    const uint32_t number[3] = {a.number, b.number, c.number};
    return iccp_perturbed_sign(p, number);
}

/* The vertex where a half-edge of y starts. */
static vertex origin(const walker *w, uint32_t h)
{
    return vertex_of(w->y, w->y->m->origin[h]);
}

static icc_status add_crossing(walker *w, uint32_t h, const iccp_env *env)
{
    iccp_arc_walk *const walk = w->walk;
    if (walk->n_crossed == walk->room) {
        const size_t room = 2 * walk->room + 1024;
        if (!iccp_enlarge(&env->memory, &walk->crossed, walk->room, room, sizeof *walk->crossed))
            return ICC_ERR_MEMORY;
        walk->room = room;
    }
    walk->crossed[walk->n_crossed++] = h;
    return walk->n_crossed <= w->most ? ICC_OK : ICC_ERR_RESOLUTION;
}

/* ---- one edge ---- */

/* The start of a walk from u to v: the first half-edge of y that the path meets, from right to
 * left. It also tells if v is a corner of the face or lies before that half-edge. */
typedef struct start {
    uint32_t exit;
    uint32_t corner; /* the half-edge of the face that starts at v; or ICCP_NO_EDGE */
    bool ends;
} start;

/* Starts inside a face: v lies in one of the three angles at u between the corners. */
static start start_inside(const walker *w, uint32_t face, vertex u, vertex v)
{
    start s = {ICCP_NO_EDGE, ICCP_NO_EDGE, false};
    for (uint32_t h = 3 * face; h < 3 * face + 3; ++h)
        if (origin(w, h).number == v.number) {
            s.corner = h;
            s.ends = true;
            return s;
        }
    for (uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const vertex a = origin(w, h), b = origin(w, iccp_after(h));
        if (sign(u, v, a) < 0 && sign(u, v, b) > 0) {
            s.exit = h;
            s.ends = sign(a, b, v) > 0;
        }
    }
    return s;
}

/* Starts at a vertex of y: v lies in the angle of one of the faces there, or is one of the
 * neighbours. */
static start start_at(const walker *w, uint32_t h, uint32_t at, vertex u, vertex v)
{
    const iccp_half_edges *const m = w->y->m;
    start s = {ICCP_NO_EDGE, ICCP_NO_EDGE, false};
    uint32_t e = m->out[at];
    do {
        const vertex a = origin(w, iccp_after(e)), b = origin(w, iccp_before(e));
        if (a.number == v.number) {
            w->walk->sector[h] = e;
            w->walk->sector[w->x->m->twin[h]] = m->twin[e];
            w->walk->is_common[h] = w->walk->is_common[w->x->m->twin[h]] = 1;
            s.ends = true;
            return s;
        }
        if (b.number != v.number && sign(u, a, v) > 0 && sign(u, v, b) > 0) {
            s.exit = iccp_after(e);
            s.ends = sign(a, b, v) > 0;
            w->walk->sector[h] = e;
        }
        e = iccp_edge_turn(m, e);
    } while (e != m->out[at]);
    return s;
}

/* Follows half-edge h of x to its end, face by face of y. Behind a crossed edge from p to q there
 * is a face with a third corner r. Either the face contains the end, or the path leaves between r
 * and p or between r and q. Records the crossings and the place of the end. */
static icc_status walk_edge(walker *w, uint32_t h, const iccp_env *env)
{
    const iccp_half_edges *const m = w->y->m;
    const uint32_t from = w->x->m->origin[h], to = iccp_edge_end(w->x->m, h);
    const uint32_t twin = w->x->m->twin[h], partner = w->x->partner[from];
    const vertex u = vertex_of(w->x, from), v = vertex_of(w->x, to);
    w->walk->begin[h] = (uint32_t)w->walk->n_crossed;
    const start s = partner == ICCP_NO_EDGE ? start_inside(w, w->walk->face[from], u, v)
                                            : start_at(w, h, partner, u, v);
    uint32_t exit = s.exit, corner = s.corner;
    for (bool ends = s.ends; !ends;) {
        const icc_status status = add_crossing(w, exit, env);
        if (status != ICC_OK)
            return status;
        const uint32_t g = m->twin[exit], pr = iccp_after(g), rq = iccp_before(g);
        const vertex p = origin(w, pr), q = origin(w, g), r = origin(w, rq);
        exit = pr;
        if (r.number == v.number) {
            corner = rq;
            ends = true;
        } else if (sign(p, r, v) > 0 && sign(r, q, v) > 0) {
            ends = true;
        } else if (sign(u, v, r) < 0) {
            exit = rq;
        }
    }
    w->walk->n[h] = w->walk->n[twin] = (uint32_t)w->walk->n_crossed - w->walk->begin[h];
    if (w->x->partner[to] == ICCP_NO_EDGE)
        w->walk->face[to] = exit / 3;
    else if (corner != ICCP_NO_EDGE)
        w->walk->sector[twin] = corner;
    return ICC_OK;
}

/* ---- all edges ---- */

/* Finds the face of y that contains a vertex. */
static uint32_t find_face(const walker *w, vertex v)
{
    uint32_t face = 0;
    for (; face < w->y->m->n_faces; ++face) {
        const vertex a = origin(w, 3 * face), b = origin(w, 3 * face + 1);
        const vertex c = origin(w, 3 * face + 2);
        if (sign(a, b, v) > 0 && sign(b, c, v) > 0 && sign(c, a, v) > 0)
            break;
    }
    return face;
}

/* Walks all edges, starting at a first vertex. From each vertex reached, it walks those edges that
 * have not been walked in the other direction. So each vertex is found on the way. */
static icc_status walk_all(walker *w, const iccp_env *env)
{
    const iccp_half_edges *const m = w->x->m;
    size_t n_known = 1;
    icc_status status = ICC_OK;
    uint32_t first = 0;
    while (m->degree[first] == 0)
        ++first;
    w->queue[0] = first;
    w->is_known[first] = 1;
    if (w->x->partner[first] == ICCP_NO_EDGE)
        w->walk->face[first] = find_face(w, vertex_of(w->x, first));
    for (size_t k = 0; k < n_known && status == ICC_OK; ++k) {
        const uint32_t v = w->queue[k];
        uint32_t h = m->out[v];
        do {
            const uint32_t end = iccp_edge_end(m, h);
            if (w->walk->begin[m->twin[h]] == ICCP_NO_EDGE)
                status = walk_edge(w, h, env);
            if (!w->is_known[end])
                w->queue[n_known++] = end;
            w->is_known[end] = 1;
            h = iccp_edge_turn(m, h);
        } while (h != m->out[v] && status == ICC_OK);
        if (k % 256 == 0 && status == ICC_OK)
            status = iccp_progress(env, "match", (double)k / (double)m->n_vertices);
    }
    return status;
}

icc_status iccp_arc_walk_create(iccp_arc_walk *walk, const iccp_drawing *walked,
                                const iccp_drawing *other, size_t most, const iccp_env *env,
                                icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n = 3 * walked->m->n_faces, n_vertices = walked->m->n_vertices;
    walker w = {.walk = walk, .x = walked, .y = other, .most = most};
    icc_status status = ICC_ERR_MEMORY;
    *walk = (iccp_arc_walk){0};
    walk->begin = iccp_alloc(memory, n, sizeof *walk->begin);
    walk->n = iccp_alloc(memory, n, sizeof *walk->n);
    walk->sector = iccp_alloc(memory, n, sizeof *walk->sector);
    walk->is_common = iccp_alloc_zero(memory, n, 1);
    walk->face = iccp_alloc(memory, n_vertices, sizeof *walk->face);
    w.queue = iccp_alloc(memory, n_vertices, sizeof *w.queue);
    w.is_known = iccp_alloc_zero(memory, n_vertices, 1);
    if (walk->begin != NULL && walk->n != NULL && walk->sector != NULL && walk->is_common != NULL &&
        walk->face != NULL && w.queue != NULL && w.is_known != NULL) {
        memset(walk->begin, 0xff, n * sizeof *walk->begin);
        status = walk_all(&w, env);
    }
    iccp_free(memory, w.queue);
    iccp_free(memory, w.is_known);
    return status == ICC_ERR_RESOLUTION
               ? iccp_fail(err, status, "the edges of the two drawings cross more than %zu times",
                           most)
               : iccp_explain(err, status);
}

void iccp_arc_walk_free(iccp_arc_walk *walk, const iccp_memory *memory)
{
    iccp_free(memory, walk->begin);
    iccp_free(memory, walk->n);
    iccp_free(memory, walk->sector);
    iccp_free(memory, walk->is_common);
    iccp_free(memory, walk->face);
    iccp_free(memory, walk->crossed);
    *walk = (iccp_arc_walk){0};
}
