/* Tests whether triangles meet, for surfaces with many long and thin triangles.
 *
 * The triangles around a vertex of many triangles form a group. Seen from that vertex, each
 * triangle is an arc. Two triangles of a group meet beyond the vertex if and only if their arcs
 * meet. Arcs are projected to the faces of a cube around the vertex and compared there. Triangles
 * of different groups are compared in space. */
#include "geometry/needles.h"

#include "base/sort.h"
#include "geometry/near_pairs.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* A vertex has a group if more than MANY triangles meet there. */
enum { MANY = 16 };

/* Arcs are cut this far beyond a face of the cube, which has size 1. */
static const double BEYOND = 1e-12;

/* If the chord of an arc passes the centre nearer than this, its projection is too inaccurate. */
static const double TOO_NEAR = 0x1p-7;

/* Pieces per triangle that need no budget. Long triangles in rows take about 60. */
static const double FREE_PIECES = 128;

/* A place of the tree and its group. The group is a vertex, or a number of its own for a triangle
 * whose corners have no group. */
typedef struct member {
    uint32_t group, place;
} member;

static const uint32_t *corners_at(const iccp_facet_tree *tree, uint32_t place)
{
    return tree->facets + 3 * (size_t)tree->order[place];
}

/* Lists triangles by group. A triangle belongs to the corner at which most triangles meet. */
static member *list_members(const iccp_facet_tree *tree, size_t n_vertices,
                            const iccp_memory *memory)
{
    const size_t n_groups = n_vertices + tree->n;
    uint32_t *count = iccp_alloc_zero(memory, n_vertices, sizeof *count);
    uint32_t *first = iccp_alloc_zero(memory, n_groups + 1, sizeof *first);
    member *members = iccp_alloc(memory, tree->n, sizeof *members);
    member *sorted = iccp_alloc(memory, tree->n, sizeof *sorted);
    const bool has_memory = count != NULL && first != NULL && members != NULL && sorted != NULL;
    for (size_t i = 0; has_memory && i < 3 * tree->n; ++i)
        ++count[tree->facets[i]];
    for (uint32_t place = 0; has_memory && place < tree->n; ++place) {
        const uint32_t *v = corners_at(tree, place);
        uint32_t hub = count[v[1]] > count[v[0]] ? v[1] : v[0];
        hub = count[v[2]] > count[hub] ? v[2] : hub;
        members[place] = (member){count[hub] > MANY ? hub : (uint32_t)n_vertices + place, place};
    }
    if (has_memory)
        iccp_sort_by_count(sorted, first, n_groups, members, tree->n, sizeof *members);
    iccp_free(memory, count);
    iccp_free(memory, first);
    iccp_free(memory, members);
    if (!has_memory)
        iccp_free(memory, sorted);
    return has_memory ? sorted : NULL;
}

/* Computes the direction from the centre to a point, scaled to the width of the cube. */
static void look(const double *centre, const double *point, double *direction)
{
    double size = 0;
    for (size_t k = 0; k < 3; ++k) {
        direction[k] = point[k] - centre[k];
        size = fabs(direction[k]) > size ? fabs(direction[k]) : size;
    }
    for (size_t k = 0; k < 3; ++k)
        direction[k] /= size;
}

/* Projects an arc to the face. An arc too near the cube's centre becomes the whole face. */
static void project(iccp_piece *piece, size_t axis, double side)
{
    const size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    bool is_near = false;
    for (uint32_t i = 0; i < piece->n; ++i)
        is_near |= side * piece->corner[i][axis] < TOO_NEAR;
    piece->n = is_near ? 4 : piece->n;
    for (uint32_t i = 0; i < piece->n; ++i) {
        double *c = piece->corner[i];
        const double height = fabs(c[axis]), u = c[x], v = c[y];
        c[0] = is_near ? (i % 3 == 0 ? -1 : 1) : u / height;
        c[1] = is_near ? (i < 2 ? -1 : 1) : v / height;
        c[2] = 0;
    }
}

/* Adds the part of a triangle's arc that lies on one face of the cube. */
static void add_arc(iccp_near_pairs *pairs, const double ends[2][3], uint32_t place, int face)
{
    iccp_piece *piece = iccp_near_pairs_add(pairs);
    const size_t axis = (size_t)face / 2;
    const double side = face % 2 == 0 ? 1 : -1;
    if (piece == NULL)
        return;
    memcpy(piece->corner, ends, 2 * sizeof *ends);
    piece->n = 2;
    piece->item = piece->group = place;
    for (size_t k = 1; k < 3; ++k)
        for (int sign = -1; sign < 2; sign += 2) {
            double u[3] = {0};
            u[axis] = -side;
            u[(axis + k) % 3] = sign;
            if (!iccp_piece_cut(piece, u, BEYOND)) {
                --pairs->n;
                return;
            }
        }
    project(piece, axis, side);
}

static void compare_round_vertex(iccp_near_pairs *pairs, const iccp_facet_tree *tree,
                                 const member *members, size_t n)
{
    const uint32_t hub = members[0].group;
    for (int face = 0; face < 6 && pairs->status == ICC_OK && !pairs->met; ++face) {
        for (size_t i = 0; i < n; ++i) {
            const uint32_t *v = corners_at(tree, members[i].place);
            double ends[2][3];
            for (size_t k = 0, j = 0; k < 3; ++k)
                if (v[k] != hub)
                    look(tree->vertices + 3 * (size_t)hub, tree->vertices + 3 * (size_t)v[k],
                         ends[j++]);
            add_arc(pairs, (const double(*)[3])ends, members[i].place, face);
        }
        iccp_near_pairs_within(pairs, 0, pairs->n);
        pairs->n = 0;
    }
}

static void compare_in_space(iccp_near_pairs *pairs, const iccp_facet_tree *tree,
                             const member *members, size_t n_vertices)
{
    pairs->size = 0;
    for (size_t i = 0; i < tree->n && pairs->status == ICC_OK; ++i) {
        const uint32_t *v = corners_at(tree, members[i].place);
        iccp_piece *piece = iccp_near_pairs_add(pairs);
        for (size_t k = 0; piece != NULL && k < 9; ++k) {
            const double x = tree->vertices[3 * (size_t)v[k / 3] + k % 3];
            piece->corner[k / 3][k % 3] = x;
            pairs->size = fabs(x) > pairs->size ? fabs(x) : pairs->size;
        }
        if (piece == NULL)
            break;
        piece->n = 3;
        piece->item = members[i].place;
        piece->group = members[i].group;
    }
    if (pairs->status != ICC_OK)
        return;
    size_t n_hubs = 0;
    while (n_hubs < tree->n && members[n_hubs].group < n_vertices)
        ++n_hubs;
    iccp_near_pairs_within(pairs, 0, n_hubs);
    iccp_near_pairs_within(pairs, n_hubs, tree->n);
    iccp_near_pairs_between(pairs, 0, n_hubs, tree->n);
}

icc_status iccp_needles_compare(const iccp_facet_tree *tree, size_t n_vertices,
                                bool (*meet)(void *context, uint32_t p, uint32_t q), void *context,
                                const iccp_env *env)
{
    iccp_near_pairs pairs = {.env = env,
                             .meet = meet,
                             .context = context,
                             .share = 0.5,
                             .n_free = FREE_PIECES * (double)tree->n,
                             .size = 1};
    member *members = list_members(tree, n_vertices, &env->memory);
    pairs.status = members != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t i = 0, end; i < tree->n && pairs.status == ICC_OK && !pairs.met; i = end) {
        for (end = i + 1; end < tree->n && members[end].group == members[i].group;)
            ++end;
        if (end - i > 1)
            compare_round_vertex(&pairs, tree, members + i, end - i);
    }
    if (pairs.status == ICC_OK && !pairs.met)
        compare_in_space(&pairs, tree, members, n_vertices);
    iccp_near_pairs_free(&pairs);
    iccp_free(&env->memory, members);
    return pairs.status;
}
