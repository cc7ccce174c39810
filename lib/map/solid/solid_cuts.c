/* Longest-edge bisection: M. C. Rivara, Algorithms for refining triangular grids suitable for
 * adaptive and multigrid techniques, 1984. A map is linear along an edge. So a cut in the middle,
 * before and after the map, changes only how the images may move afterwards. */
#include "map/solid/solid_cuts.h"

#include "base/sort.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* Share of the tetrahedra whose longest edge is cut. */
static const double WORST = 0.2;

static const uint8_t ENDS[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/* The sum of the squared lengths before and after the map. */
static double length_of(const iccp_solid_edit *edit, uint32_t a, uint32_t b)
{
    const double *points = edit->map->mesh->points, *images = edit->map->images;
    const double stretch = edit->map->stretch;
    return stretch * stretch *
               iccp_vec_distance2(3, points + 3 * (size_t)a, points + 3 * (size_t)b) +
           iccp_vec_distance2(3, images + 3 * (size_t)a, images + 3 * (size_t)b);
}

static void set_middle(const double *points, uint32_t a, uint32_t b, double middle[3])
{
    for (size_t k = 0; k < 3; ++k)
        middle[k] = 0.5 * points[3 * (size_t)a + k] + 0.5 * points[3 * (size_t)b + k];
    iccp_simplicial_round(3, middle);
}

/* Puts one half of each tetrahedron around an edge in its place and adds the other. Undoes
 * everything if rounding has made a half flat. */
static bool halve(iccp_solid_edit *edit, uint32_t a, uint32_t b, const iccp_ring *ring)
{
    iccp_simplices *mesh = edit->map->own;
    const size_t n_before = mesh->n_simplices;
    double point[3], image[3];
    bool good = true;
    set_middle(mesh->points, a, b, point);
    set_middle(edit->map->images, a, b, image);
    const uint32_t middle = iccp_solid_add_point(edit, point, image);
    for (size_t k = 0; k < 2 * ring->n && good; ++k) {
        const uint32_t p = ring->point[k / 2], q = ring->point[(k / 2 + 1) % ring->n];
        const uint32_t half[4] = {k % 2 == 0 ? a : middle, k % 2 == 0 ? middle : b, p, q};
        iccp_solid_add(edit, half);
        good = iccp_solid_is_positive(edit, half);
    }
    if (!good) {
        mesh->n_simplices = n_before;
        --mesh->n_points;
    }
    for (size_t k = 0; k < ring->n && good; ++k)
        edit->is_gone[ring->simplex[k]] = 1;
    return good;
}

/* Cuts an edge if nothing around it has changed in this pass. */
static icc_status cut(iccp_solid_edit *edit, uint32_t a, uint32_t b, size_t *n_cut)
{
    iccp_ring ring;
    if (iccp_solid_keeps_edge(&edit->marks, a, b) || !iccp_solid_ring(edit, a, b, &ring) ||
        !iccp_ring_is_there(edit, &ring))
        return ICC_OK;
    const icc_status status = iccp_solid_reserve(edit, 1, 2 * ring.n);
    if (status == ICC_OK)
        *n_cut += halve(edit, a, b, &ring);
    return status;
}

/* ---- chords ---- */

typedef struct listed {
    double length;
    uint32_t ends[2];
} listed;

/* Sorts the longest edges first. Equal edges come together. */
static int by_length(const void *a, const void *b)
{
    const listed *p = a, *q = b;
    if (p->length < q->length || p->length > q->length)
        return p->length < q->length ? 1 : -1;
    if (p->ends[0] != q->ends[0])
        return p->ends[0] < q->ends[0] ? -1 : 1;
    return (p->ends[1] > q->ends[1]) - (p->ends[1] < q->ends[1]);
}

/* Lists the edges between fixed points, including surface edges, which have no ring. Only counts
 * them if `edges` is NULL. */
static size_t list_edges(const iccp_solid_edit *edit, listed *edges)
{
    const iccp_simplices *mesh = edit->map->mesh;
    size_t n = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const uint32_t *v = mesh->corners + 4 * s;
        for (size_t e = 0; e < 6; ++e) {
            uint32_t a = v[ENDS[e][0]], b = v[ENDS[e][1]];
            if (a >= edit->marks.n_fixed || b >= edit->marks.n_fixed)
                continue;
            if (a > b) {
                const uint32_t swap = a;
                a = b;
                b = swap;
            }
            if (edges != NULL)
                edges[n] = (listed){length_of(edit, a, b), {a, b}};
            ++n;
        }
    }
    return n;
}

icc_status iccp_solid_halve_chords(iccp_solid_edit *edit, size_t *n_cut)
{
    const iccp_memory *memory = &edit->map->memory;
    const size_t n = list_edges(edit, NULL);
    listed *edges = iccp_alloc(memory, n, sizeof *edges);
    icc_status status = edges != NULL ? iccp_solid_edit_begin(edit) : ICC_ERR_MEMORY;
    *n_cut = 0;
    if (status == ICC_OK) {
        (void)list_edges(edit, edges);
        iccp_sort(edges, n, sizeof *edges, by_length);
    }
    for (size_t k = 0; status == ICC_OK && k < n; ++k)
        if (k == 0 || by_length(&edges[k - 1], &edges[k]) != 0)
            status = cut(edit, edges[k].ends[0], edges[k].ends[1], n_cut);
    if (status == ICC_OK)
        iccp_solid_edit_end(edit);
    iccp_free(memory, edges);
    return status;
}

/* ---- the worst tetrahedra ---- */

typedef struct ranked {
    double excess;
    uint32_t simplex;
} ranked;

static int by_excess(const void *a, const void *b)
{
    const ranked *p = a, *q = b;
    if (p->excess < q->excess || p->excess > q->excess)
        return p->excess < q->excess ? 1 : -1;
    return (p->simplex > q->simplex) - (p->simplex < q->simplex);
}

/* Finds the longest inner edge. Returns false if there is none. */
static bool find_longest(const iccp_solid_edit *edit, const uint32_t *v, uint32_t ends[2])
{
    iccp_ring ring;
    double most = -1;
    for (size_t e = 0; e < 6; ++e) {
        const uint32_t a = v[ENDS[e][0]], b = v[ENDS[e][1]];
        const double length = length_of(edit, a, b);
        if (length > most && !iccp_solid_keeps_edge(&edit->marks, a, b) &&
            iccp_solid_ring(edit, a, b, &ring)) {
            most = length;
            ends[0] = a;
            ends[1] = b;
        }
    }
    return most >= 0;
}

icc_status iccp_solid_halve_worst(iccp_solid_edit *edit, size_t *n_cut)
{
    const iccp_memory *memory = &edit->map->memory;
    const size_t n = edit->map->mesh->n_simplices;
    ranked *list = iccp_alloc(memory, n, sizeof *list);
    icc_status status = list != NULL ? iccp_solid_edit_begin(edit) : ICC_ERR_MEMORY;
    *n_cut = 0;
    for (uint32_t s = 0; status == ICC_OK && s < n; ++s) {
        double volume;
        const double value =
            iccp_solid_value(edit, edit->map->mesh->corners + 4 * (size_t)s, &volume);
        list[s] = (ranked){value < HUGE_VAL ? value - 6 * volume : 0, s};
    }
    if (status == ICC_OK)
        iccp_sort(list, n, sizeof *list, by_excess);
    for (size_t k = 0; status == ICC_OK && (double)k < WORST * (double)n; ++k) {
        uint32_t ends[2];
        if (find_longest(edit, edit->map->mesh->corners + 4 * (size_t)list[k].simplex, ends))
            status = cut(edit, ends[0], ends[1], n_cut);
    }
    if (status == ICC_OK)
        iccp_solid_edit_end(edit);
    iccp_free(memory, list);
    return status;
}
