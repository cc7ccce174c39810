/* Halving edges of a surface, and undoing it. */
#include "match/sphere/split_surface.h"

#include <string.h>

bool iccp_split_surface_create(iccp_split_surface *s, const iccp_half_edges *m, const double *x,
                               const iccp_memory *memory)
{
    const size_t n = m->n_vertices, n_half = 3 * m->n_faces;
    *s = (iccp_split_surface){.memory = *memory, .n_vertices = n, .n_faces = m->n_faces};
    s->n_given = s->room_vertices = n;
    s->room_faces = m->n_faces;
    s->x = iccp_alloc(memory, n, 3 * sizeof *s->x);
    s->origin = iccp_alloc(memory, n_half, sizeof *s->origin);
    s->twin = iccp_alloc(memory, n_half, sizeof *s->twin);
    s->part_of = iccp_alloc(memory, m->n_faces, sizeof *s->part_of);
    s->path = iccp_alloc(memory, n_half, sizeof *s->path);
    s->out = iccp_alloc(memory, n, sizeof *s->out);
    s->holder = iccp_alloc(memory, n, sizeof *s->holder);
    s->halves = iccp_alloc(memory, n, sizeof *s->halves);
    if (s->x == NULL || s->origin == NULL || s->twin == NULL || s->part_of == NULL ||
        s->path == NULL || s->out == NULL || s->holder == NULL || s->halves == NULL)
        return false;
    memcpy(s->x, x, 3 * n * sizeof *s->x);
    memcpy(s->origin, m->origin, n_half * sizeof *s->origin);
    memcpy(s->twin, m->twin, n_half * sizeof *s->twin);
    memcpy(s->out, m->out, n * sizeof *s->out);
    for (uint32_t f = 0; f < m->n_faces; ++f)
        s->part_of[f] = f;
    memset(s->path, 0xff, n_half * sizeof *s->path);
    memset(s->holder, 0xff, n * sizeof *s->holder);
    return true;
}

void iccp_split_surface_free(iccp_split_surface *s)
{
    iccp_free(&s->memory, s->x);
    iccp_free(&s->memory, s->origin);
    iccp_free(&s->memory, s->twin);
    iccp_free(&s->memory, s->part_of);
    iccp_free(&s->memory, s->path);
    iccp_free(&s->memory, s->out);
    iccp_free(&s->memory, s->holder);
    iccp_free(&s->memory, s->halves);
    *s = (iccp_split_surface){.memory = s->memory};
}

static bool enlarge(iccp_split_surface *s)
{
    if (s->n_vertices == s->room_vertices) {
        const size_t n = s->room_vertices, room = n + n / 2 + 64;
        if (!iccp_enlarge(&s->memory, &s->x, n, room, 3 * sizeof *s->x) ||
            !iccp_enlarge(&s->memory, &s->out, n, room, sizeof *s->out) ||
            !iccp_enlarge(&s->memory, &s->holder, n, room, sizeof *s->holder) ||
            !iccp_enlarge(&s->memory, &s->halves, n, room, sizeof *s->halves))
            return false;
        s->room_vertices = room;
    }
    if (s->n_faces + 2 > s->room_faces) {
        const size_t n = s->room_faces, room = n + n / 2 + 128;
        if (!iccp_enlarge(&s->memory, &s->origin, n, room, 3 * sizeof *s->origin) ||
            !iccp_enlarge(&s->memory, &s->twin, n, room, 3 * sizeof *s->twin) ||
            !iccp_enlarge(&s->memory, &s->part_of, n, room, sizeof *s->part_of) ||
            !iccp_enlarge(&s->memory, &s->path, n, room, 3 * sizeof *s->path))
            return false;
        s->room_faces = room;
    }
    return true;
}

static void join(iccp_split_surface *s, uint32_t h, uint32_t g)
{
    s->twin[h] = g;
    s->twin[g] = h;
}

/* Half-edge h of face (a, b, c) gets the new vertex m. The face becomes (a, m, c), and a new face
 * (m, b, c) is made. Returns the first half-edge of the new face. */
static uint32_t halve_face(iccp_split_surface *s, uint32_t h, uint32_t m)
{
    const uint32_t next = iccp_after(h), last = iccp_before(h), p = (uint32_t)(3 * s->n_faces++);
    s->part_of[p / 3] = s->part_of[h / 3];
    s->origin[p] = m;
    s->origin[p + 1] = s->origin[next];
    s->origin[p + 2] = s->origin[last];
    join(s, p + 1, s->twin[next]);
    join(s, p + 2, next);
    s->path[p + 1] = s->path[next];
    s->path[p] = s->path[p + 2] = s->path[next] = ICCP_NO_EDGE;
    s->out[s->origin[next]] = p + 1;
    s->origin[next] = m;
    return p;
}

bool iccp_split_halve(iccp_split_surface *s, uint32_t h)
{
    if (!enlarge(s))
        return false;
    const uint32_t g = s->twin[h], m = (uint32_t)s->n_vertices++;
    for (size_t k = 0; k < 3; ++k)
        s->x[3 * (size_t)m + k] =
            0.5 * (s->x[3 * (size_t)s->origin[h] + k] + s->x[3 * (size_t)iccp_split_end(s, h) + k]);
    /* Both faces keep the half where their half-edge starts: (a, m) and (b, m). */
    const uint32_t p = halve_face(s, h, m), q = halve_face(s, g, m);
    join(s, h, q);
    join(s, g, p);
    s->out[m] = p;
    s->holder[m] = ICCP_NO_EDGE;
    s->halves[m][0] = s->origin[h];
    s->halves[m][1] = s->origin[g];
    return true;
}

/* The last face takes the number of a face that is removed. */
static void remove_face(iccp_split_surface *s, uint32_t face)
{
    const uint32_t last = (uint32_t)--s->n_faces;
    s->part_of[face] = s->part_of[last];
    for (uint32_t i = 0; i < 3 && face != last; ++i) {
        const uint32_t h = 3 * last + i, to = 3 * face + i;
        s->origin[to] = s->origin[h];
        s->path[to] = s->path[h];
        join(s, to, s->twin[h]);
        s->out[s->origin[to]] = to;
    }
}

static bool are_joined(const iccp_split_surface *s, uint32_t a, uint32_t b)
{
    const uint32_t first = s->out[a];
    uint32_t h = first;
    do {
        if (iccp_split_end(s, h) == b)
            return true;
        h = iccp_split_turn(s, h);
    } while (h != first);
    return false;
}

/* The four faces at m are (m, a, c), (m, c, b), (m, b, d), (m, d, a). The second becomes (a, c, b)
 * and the last (b, d, a). */
bool iccp_split_unite(iccp_split_surface *s, uint32_t m)
{
    const uint32_t a = s->halves[m][0], b = s->halves[m][1];
    uint32_t h[4] = {s->out[m], 0, 0, 0};
    for (int i = 0; i < 4 && iccp_split_end(s, h[0]) != a; ++i)
        h[0] = iccp_split_turn(s, h[0]);
    for (int i = 1; i < 4; ++i)
        h[i] = iccp_split_turn(s, h[i - 1]);
    if (iccp_split_end(s, h[0]) != a || iccp_split_end(s, h[2]) != b ||
        iccp_split_turn(s, h[3]) != h[0] || are_joined(s, a, b))
        return false;
    for (int i = 0; i < 4; i += 2) {
        const uint32_t side = iccp_after(h[i]), kept = h[i + 1];
        s->origin[kept] = i == 0 ? a : b;
        s->path[kept] = s->path[side];
        join(s, kept, s->twin[side]);
        s->out[s->origin[kept]] = kept;
        s->out[iccp_split_end(s, kept)] = iccp_after(kept);
    }
    join(s, iccp_before(h[1]), iccp_before(h[3]));
    s->out[m] = ICCP_NO_EDGE;
    const uint32_t f = h[0] / 3, g = h[2] / 3;
    remove_face(s, f > g ? f : g);
    remove_face(s, f > g ? g : f);
    return true;
}
