/* Finds the tetrahedra around edges and beside faces, and adds or removes tetrahedra. */
#include "map/solid/solid_edit.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "domain/solid_mesh.h"
#include "map/energy/dirichlet.h"
#include "math/predicates.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* A tetrahedron is flat if six times its volume is less than this share of the cube of its longest
 * edge. */
static const double FLAT = 1e-6;

static iccp_simplices *mesh_of(const iccp_solid_edit *edit)
{
    return edit->map->own;
}

icc_status iccp_solid_edit_create(iccp_solid_edit *edit, iccp_solid_map *map,
                                  const icc_domain *source)
{
    *edit = (iccp_solid_edit){
        .map = map, .point_room = map->own->n_points, .simplex_room = map->own->n_simplices};
    edit->is_new = iccp_alloc(&map->memory, edit->simplex_room, 1);
    if (edit->is_new == NULL)
        return ICC_ERR_MEMORY;
    memset(edit->is_new, 1, edit->simplex_room);
    return iccp_solid_marks_create(&edit->marks, source, map->own, &map->memory);
}

static void free_pass(iccp_solid_edit *edit)
{
    const iccp_memory *memory = &edit->map->memory;
    iccp_free(memory, edit->first);
    iccp_free(memory, edit->star);
    iccp_free(memory, edit->is_gone);
    edit->first = NULL;
    edit->star = NULL;
    edit->is_gone = NULL;
}

void iccp_solid_edit_free(iccp_solid_edit *edit)
{
    free_pass(edit);
    iccp_free(&edit->map->memory, edit->is_new);
    edit->is_new = NULL;
    iccp_solid_marks_free(&edit->marks);
}

icc_status iccp_solid_edit_begin(iccp_solid_edit *edit)
{
    const iccp_simplices *mesh = mesh_of(edit);
    const iccp_memory *memory = &edit->map->memory;
    free_pass(edit);
    edit->n_simplices = mesh->n_simplices;
    edit->first = iccp_alloc_zero(memory, mesh->n_points + 1, sizeof *edit->first);
    edit->star = iccp_alloc(memory, mesh->n_simplices, 4 * sizeof *edit->star);
    edit->is_gone = iccp_alloc_zero(memory, mesh->n_simplices, 1);
    if (edit->first == NULL || edit->star == NULL || edit->is_gone == NULL)
        return ICC_ERR_MEMORY;
    iccp_list_groups(edit->star, edit->first, mesh->n_points, mesh->corners, mesh->n_simplices, 4);
    return ICC_OK;
}

void iccp_solid_edit_end(iccp_solid_edit *edit)
{
    iccp_simplices *mesh = mesh_of(edit);
    size_t n = 0;
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        if (t < edit->n_simplices && edit->is_gone[t])
            continue;
        edit->is_new[n] = edit->is_new[t];
        memmove(mesh->corners + 4 * n++, mesh->corners + 4 * t, 4 * sizeof *mesh->corners);
    }
    mesh->n_simplices = n;
    free_pass(edit);
}

/* ---- rings of edges ---- */

/* Returns true if a, at corner i, and b, at corner j, come before the other two corners in an even
 * permutation. Sets these two, k < l. */
static bool is_even(size_t i, size_t j, size_t *k, size_t *l)
{
    *k = 0;
    while (*k == i || *k == j)
        ++*k;
    *l = 6 - i - j - *k;
    return ((i > j) + (i > *k) + (i > *l) + (j > *k) + (j > *l)) % 2 == 0;
}

/* Returns true if a tetrahedron has both points. Then *p and *q are its other points, and a, b, *p,
 * *q is positive. */
static bool find_edge(const uint32_t *v, uint32_t a, uint32_t b, uint32_t *p, uint32_t *q)
{
    size_t i = 4, j = 4, k, l;
    for (size_t c = 0; c < 4; ++c) {
        i = v[c] == a ? c : i;
        j = v[c] == b ? c : j;
    }
    if (i == 4 || j == 4)
        return false;
    const bool even = is_even(i, j, &k, &l);
    *p = v[even ? k : l];
    *q = v[even ? l : k];
    return true;
}

/* Brings the tetrahedron that begins at `point` to place k. Returns false if there is none from k
 * on. */
static bool bring(iccp_ring *ring, uint32_t *after, size_t k, uint32_t point)
{
    size_t at = k;
    while (at < ring->n && ring->point[at] != point)
        ++at;
    if (at == ring->n)
        return false;
    const uint32_t other[3] = {ring->point[at], ring->simplex[at], after[at]};
    ring->point[at] = ring->point[k];
    ring->simplex[at] = ring->simplex[k];
    after[at] = after[k];
    ring->point[k] = other[0];
    ring->simplex[k] = other[1];
    after[k] = other[2];
    return true;
}

/* Around an edge of the surface the tetrahedra do not close up. */
bool iccp_solid_ring(const iccp_solid_edit *edit, uint32_t a, uint32_t b, iccp_ring *ring)
{
    const uint32_t *corners = mesh_of(edit)->corners;
    const uint32_t *first = edit->first;
    const uint32_t at = first[a + 1] - first[a] <= first[b + 1] - first[b] ? a : b;
    uint32_t after[ICCP_MOST_RING], p, q;
    ring->n = 0;
    for (size_t s = first[at]; s < first[at + 1]; ++s) {
        if (!find_edge(corners + 4 * (size_t)edit->star[s], a, b, &p, &q))
            continue;
        if (ring->n == ICCP_MOST_RING)
            return false;
        ring->point[ring->n] = p;
        after[ring->n] = q;
        ring->simplex[ring->n++] = edit->star[s];
    }
    for (size_t k = 1; k < ring->n; ++k)
        if (!bring(ring, after, k, after[k - 1]))
            return false;
    return ring->n >= 3 && after[ring->n - 1] == ring->point[0];
}

bool iccp_ring_is_there(const iccp_solid_edit *edit, const iccp_ring *ring)
{
    for (size_t k = 0; k < ring->n; ++k)
        if (edit->is_gone[ring->simplex[k]])
            return false;
    return true;
}

static bool has(const uint32_t *v, uint32_t point)
{
    return v[0] == point || v[1] == point || v[2] == point || v[3] == point;
}

bool iccp_solid_across(const iccp_solid_edit *edit, uint32_t t, size_t corner, uint32_t *other)
{
    const uint32_t *corners = mesh_of(edit)->corners, *v = corners + 4 * (size_t)t;
    const uint32_t x = v[(corner + 1) % 4], y = v[(corner + 2) % 4], z = v[(corner + 3) % 4];
    uint32_t at = x;
    at = edit->first[y + 1] - edit->first[y] < edit->first[at + 1] - edit->first[at] ? y : at;
    at = edit->first[z + 1] - edit->first[z] < edit->first[at + 1] - edit->first[at] ? z : at;
    for (size_t s = edit->first[at]; s < edit->first[at + 1]; ++s) {
        const uint32_t *w = corners + 4 * (size_t)edit->star[s];
        if (edit->star[s] != t && has(w, x) && has(w, y) && has(w, z)) {
            *other = edit->star[s];
            return true;
        }
    }
    return false;
}

/* ---- replacements ---- */

static int sign_of(const double *points, const uint32_t *v)
{
    return iccp_orient3d(points + 3 * (size_t)v[0], points + 3 * (size_t)v[1],
                         points + 3 * (size_t)v[2], points + 3 * (size_t)v[3]);
}

bool iccp_solid_is_positive(const iccp_solid_edit *edit, const uint32_t *corners)
{
    return sign_of(mesh_of(edit)->points, corners) > 0 && sign_of(edit->map->images, corners) > 0;
}

/* Returns true if six times the volume is tiny beside the cube of the longest edge. */
static bool is_flat(const double *points, const uint32_t *v, double six_volumes)
{
    double most = 0;
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < i; ++j)
            most = iccp_max(
                most, iccp_vec_distance2(3, points + 3 * (size_t)v[i], points + 3 * (size_t)v[j]));
    return !(six_volumes > FLAT * most * sqrt(most));
}

double iccp_solid_value(const iccp_solid_edit *edit, const uint32_t *corners, double *volume)
{
    const iccp_simplicial_map map = {.dim = 3,
                                     .corners = corners,
                                     .points = mesh_of(edit)->points,
                                     .images = edit->map->images,
                                     .stretch = edit->map->stretch};
    const double *image[4];
    double element[ICCP_ELEMENT(3)], j[9];
    *volume = 0;
    if (!iccp_solid_is_positive(edit, corners))
        return HUGE_VAL;
    iccp_simplicial_element(&map, 0, element);
    iccp_simplicial_images(3, &map, 0, image);
    *volume = element[0];
    const double before = 6 * element[0] / (map.stretch * map.stretch * map.stretch);
    const double after = 6 * element[0] * iccp_element_jacobian(3, element, image, j);
    if (is_flat(map.points, corners, before) || is_flat(map.images, corners, after))
        return HUGE_VAL;
    return iccp_dirichlet_energy(3, element, image);
}

/* Room that is at least 1.5 times as large, so that moving an entry costs O(1) on average. */
static size_t room_for(size_t n)
{
    return n + n / 2 + 64;
}

icc_status iccp_solid_reserve(iccp_solid_edit *edit, size_t n_points, size_t n_simplices)
{
    iccp_simplices *mesh = mesh_of(edit);
    const iccp_memory *memory = &edit->map->memory;
    const size_t n = mesh->n_points + n_points, m = mesh->n_simplices + n_simplices;
    if (n > edit->point_room) {
        const size_t size = 3 * sizeof(double);
        if (!iccp_enlarge(memory, &mesh->points, mesh->n_points, room_for(n), size) ||
            !iccp_enlarge(memory, &edit->map->images, mesh->n_points, room_for(n), size))
            return ICC_ERR_MEMORY;
        edit->point_room = room_for(n);
    }
    if (m > edit->simplex_room) {
        if (!iccp_enlarge(memory, &mesh->corners, mesh->n_simplices, room_for(m),
                          4 * sizeof *mesh->corners) ||
            !iccp_enlarge(memory, &edit->is_new, mesh->n_simplices, room_for(m), 1))
            return ICC_ERR_MEMORY;
        edit->simplex_room = room_for(m);
    }
    return ICC_OK;
}

void iccp_solid_add(iccp_solid_edit *edit, const uint32_t *corners)
{
    iccp_simplices *mesh = mesh_of(edit);
    memcpy(mesh->corners + 4 * mesh->n_simplices, corners, 4 * sizeof *corners);
    edit->is_new[mesh->n_simplices++] = 1;
}

uint32_t iccp_solid_add_point(iccp_solid_edit *edit, const double *point, const double *image)
{
    iccp_simplices *mesh = mesh_of(edit);
    memcpy(mesh->points + 3 * mesh->n_points, point, 3 * sizeof *point);
    memcpy(edit->map->images + 3 * mesh->n_points, image, 3 * sizeof *image);
    return (uint32_t)mesh->n_points++;
}

icc_status iccp_solid_check(iccp_solid_map *map, const icc_domain *source, const iccp_env *env)
{
    iccp_simplices *mesh = map->own;
    if (source->features != NULL) {
        const icc_status result = iccp_solid_mesh_check(source, mesh, env, NULL);
        return result == ICC_OK || result == ICC_ERR_MEMORY || result == ICC_ERR_CANCELLED
                   ? result
                   : ICC_ERR_CERTIFICATE;
    }
    iccp_simplicial_map before = iccp_solid_simplicial(map);
    before.images = mesh->points;
    if (iccp_simplicial_count_at_once(&before, env) > 0)
        return ICC_ERR_CERTIFICATE;
    iccp_free(&mesh->memory, mesh->across);
    mesh->across = NULL;
    icc_status status = iccp_simplices_join(mesh, source->n_facets, source->facets, NULL);
    if (status == ICC_OK)
        status = iccp_simplices_check_shape(mesh, NULL);
    return status == ICC_OK || status == ICC_ERR_MEMORY ? status : ICC_ERR_CERTIFICATE;
}
