/* Cuts the edges from a vertex to the points below it where, in the image, a plane across its
 * direction meets them. Then the vertex's star has a flat bottom, which it sees from wherever it is
 * raised to.
 *
 * The depth of the plane is found by trial. Volumes are linear in the height, and next to the
 * vertex the cells with a cut edge are positive at both ends. If a neighbour has no point below
 * either, the plane must contain the edge to it. Seen from far away, the neighbour is a point
 * without a cut edge. It then sees the bottom in the order in which the vertex saw it around the
 * edge. */
#include "map/solid/coat_raise.h"

#include "base/minmax.h"
#include "math/elementary.h"
#include "math/vec.h"

#include <string.h>

/* MOST_TRIES: how often the plane's depth is halved, and how often the way of a sinking image is
 * halved. MOST_ROUNDS: how often all images are sunk. */
enum { MOST_TRIES = 30, MOST_ROUNDS = 8 };

/* Smallest sine of an angle below the plane. */
static const double FLAT = 0.02;

/* Largest angle, in turns, between the first and the last point around an edge. */
static const double MOST_TURNS = 0.49999;

/* Lists the points of a vertex's star once: those inside, and the vertices without a point
 * below. */
static bool list_star(iccp_coat_mesh *mesh, const uint32_t *nothing, uint32_t vertex,
                      iccp_list *inside, iccp_list *beside)
{
    iccp_tets *m = &mesh->tets;
    if (!iccp_tets_star(m, vertex))
        return false;
    const uint32_t stamp = iccp_tets_stamp(m);
    m->seen[vertex] = stamp;
    for (size_t s = 0; s < m->star.n; ++s)
        for (int k = 0; k < 4; ++k) {
            const uint32_t v = m->tet[m->star.item[s]].v[k];
            const bool is_inside = v >= mesh->n_fixed;
            if (m->seen[v] == stamp || !(is_inside || nothing[v] == ICCP_NOTHING_BELOW))
                continue;
            m->seen[v] = stamp;
            if (!iccp_list_push(m, is_inside ? inside : beside, v))
                return false;
        }
    return true;
}

/* How far the image of a point lies below that of the vertex. */
static double depth_of(const iccp_coat_mesh *mesh, uint32_t point, const double *from,
                       const double *direction)
{
    const double *x = iccp_coat_image(mesh, point);
    double sum = 0;
    for (int k = 0; k < 3; ++k)
        sum += (from[k] - x[k]) * direction[k];
    return sum;
}

/* Cuts the edges to the points, which are replaced by the new points. */
static bool cut_all(iccp_coat_mesh *mesh, uint32_t vertex, iccp_list *inside)
{
    for (size_t k = 0; k < inside->n; ++k)
        if (!iccp_coat_cut(mesh, vertex, inside->item[k], &inside->item[k]))
            return false;
    return true;
}

/* Moves the new points to a plane at a share of the depth of the nearest one. */
static void lower_plane(iccp_coat_mesh *mesh, const double *from, const double *direction,
                        const iccp_list *inside, double share, double *least)
{
    *least *= share;
    for (size_t k = 0; k < inside->n; ++k) {
        double x[3];
        const uint32_t point = inside->item[k];
        const double part = *least / depth_of(mesh, point, from, direction);
        for (int i = 0; i < 3; ++i)
            x[i] = from[i] + part * (iccp_coat_image(mesh, point)[i] - from[i]);
        iccp_coat_put(mesh, point, x);
    }
}

/* Tests all cells that are changed by raising. */
static bool is_good(iccp_coat_mesh *mesh, uint32_t vertex, const iccp_list *inside)
{
    bool good = iccp_coat_is_star_good(mesh, vertex);
    for (size_t k = 0; k < inside->n && good; ++k)
        good = iccp_coat_is_star_good(mesh, inside->item[k]);
    return good;
}

static bool normalize(double *d)
{
    const double length = iccp_vec_norm(3, d);
    for (int k = 0; k < 3; ++k)
        d[k] /= length;
    return length > 0;
}

/* Removes from a vector its parts along the axes. */
static void reject(double *d, size_t n, double axis[2][3])
{
    for (size_t j = 0; j < n; ++j) {
        const double dot = iccp_vec_dot(3, d, axis[j]);
        for (int k = 0; k < 3; ++k)
            d[k] -= dot * axis[j][k];
    }
}

/* Finds a normal of a plane that contains the directions in `beside`, two at most, and has the
 * inner points below it. If there are many, it takes the middle one. Returns false if there is
 * none; then the normal is the one closest to `up`. */
static bool tilt(const iccp_coat_mesh *mesh, const double *from, const double *up,
                 const iccp_list *inside, const iccp_list *beside, double *normal)
{
    double axis[2][3], across[3], least = 0, most = 0;
    if (beside->n > 2)
        return false;
    for (size_t k = 0; k < beside->n; ++k) {
        for (int i = 0; i < 3; ++i)
            axis[k][i] = iccp_coat_image(mesh, beside->item[k])[i] - from[i];
        reject(axis[k], k, axis);
        if (!normalize(axis[k]))
            return false;
    }
    memcpy(normal, up, 3 * sizeof *normal);
    reject(normal, beside->n, axis);
    if (!normalize(normal))
        return false;
    if (beside->n == 2)
        return true;
    iccp_vec_cross(axis[0], normal, across);
    for (size_t k = 0; k < inside->n; ++k) {
        double d[3];
        for (int i = 0; i < 3; ++i)
            d[i] = from[i] - iccp_coat_image(mesh, inside->item[k])[i];
        const double turns =
            iccp_atan2_turns(iccp_vec_dot(3, d, across), iccp_vec_dot(3, d, normal));
        least = iccp_min(least, turns);
        most = iccp_max(most, turns);
    }
    if (!(most - least < MOST_TURNS))
        return false;
    double middle[2];
    iccp_cis_turns(0.5 * (least + most), middle);
    for (int i = 0; i < 3; ++i)
        normal[i] = middle[0] * normal[i] + middle[1] * across[i];
    return true;
}

/* Tries planes across a direction, one after the other. If it returns false, the vertex has not
 * moved. */
static bool raise_from(iccp_coat_mesh *mesh, uint32_t vertex, const double *direction,
                       const double place[3], const iccp_list *inside)
{
    double from[3], least = HUGE_VAL;
    memcpy(from, iccp_coat_image(mesh, vertex), sizeof from);
    for (size_t k = 0; k < inside->n; ++k)
        least = iccp_min(least, depth_of(mesh, inside->item[k], from, direction));
    for (int tried = 0; tried < MOST_TRIES && least > 0; ++tried) {
        lower_plane(mesh, from, direction, inside, tried == 0 ? 1 : 0.5, &least);
        iccp_coat_put(mesh, vertex, place);
        if (is_good(mesh, vertex, inside))
            return true;
        iccp_coat_put(mesh, vertex, from);
    }
    if (least > 0)
        lower_plane(mesh, from, direction, inside, ldexp(1, MOST_TRIES - 1), &least);
    return false;
}

/* Sinks the images of inner points that would not lie below a plane across `normal`, as far as
 * their stars allow. */
static void sink(iccp_coat_mesh *mesh, const double *from, const double *normal,
                 const iccp_list *inside)
{
    for (size_t k = 0; k < inside->n; ++k) {
        const uint32_t point = inside->item[k];
        double old[3], x[3], share = 1;
        memcpy(old, iccp_coat_image(mesh, point), sizeof old);
        const double length = iccp_vec_distance(3, old, from);
        bool good = depth_of(mesh, point, from, normal) > FLAT * length;
        for (int tried = 0; tried < MOST_TRIES && !good; ++tried) {
            share *= 0.5;
            for (int i = 0; i < 3; ++i)
                x[i] = old[i] - share * length * normal[i];
            iccp_coat_put(mesh, point, x);
            good = iccp_coat_is_star_good(mesh, point);
        }
        if (!good)
            iccp_coat_put(mesh, point, old);
    }
}

/* Raises the vertex with a plane straight across if possible, else with a tilted one. */
static bool raise(iccp_coat_mesh *mesh, uint32_t vertex, const double *apex, const double *place,
                  iccp_list *inside, const iccp_list *beside)
{
    double from[3], up[3], normal[3];
    memcpy(from, iccp_coat_image(mesh, vertex), sizeof from);
    for (int k = 0; k < 3; ++k)
        up[k] = place[k] - apex[k];
    if (!normalize(up))
        return false;
    for (int round = 0;
         round < MOST_ROUNDS && beside->n == 1 && !tilt(mesh, from, up, inside, beside, normal);
         ++round)
        sink(mesh, from, normal, inside);
    return cut_all(mesh, vertex, inside) &&
           (raise_from(mesh, vertex, up, place, inside) ||
            (beside->n != 0 && tilt(mesh, from, up, inside, beside, normal) &&
             raise_from(mesh, vertex, normal, place, inside)));
}

bool iccp_coat_raise(iccp_coat_mesh *mesh, const uint32_t *below, uint32_t vertex,
                     const double apex[3], const double place[3])
{
    const iccp_memory *memory = &mesh->tets.memory;
    iccp_list inside = {0}, beside = {0};
    const bool raised = list_star(mesh, below, vertex, &inside, &beside) &&
                        raise(mesh, vertex, apex, place, &inside, &beside);
    iccp_free(memory, inside.item);
    iccp_free(memory, beside.item);
    return raised;
}
