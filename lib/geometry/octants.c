/* Tests whether cells around a corner form a ball. Based on: J. A. Barmak and E. G. Minian, Strong
 * Homotopy Types, Nerves and Collapses, Discrete & Computational Geometry 47, 2012, with cubes
 * instead of simplices.
 *
 * The orthants are the corners of a cube. On the sphere they overlap like those faces of the cube
 * whose corners are all in the set. So the union is contractible if these faces are. A corner may
 * be dropped along an axis if each of its faces lies in a larger face in the direction of that
 * axis. All its faces then fold onto the other side. Droppable corners on one side of an axis do
 * not depend on each other and are dropped together. */
#include "geometry/octants.h"

#include "icc/base.h"

#include <assert.h>

/* The corners on the lower side of each axis. */
static const uint64_t lower[ICC_MAX_DIM] = {0x5555555555555555, 0x3333333333333333,
                                            0x0f0f0f0f0f0f0f0f, 0x00ff00ff00ff00ff,
                                            0x0000ffff0000ffff, 0x00000000ffffffff};

/* Replaces every corner by the one across an axis. */
static uint64_t across(uint64_t set, int axis)
{
    return (set & lower[axis]) << (1 << axis) | (set >> (1 << axis) & lower[axis]);
}

/* faces[s] is the set of corners whose face along the axes of the bits of s lies in the set. */
static void find_faces(uint64_t set, int n_axes, uint64_t *faces)
{
    faces[0] = set;
    for (int axis = 0; axis < n_axes; ++axis)
        for (int s = 0; s < 1 << axis; ++s)
            faces[s | 1 << axis] = faces[s] & across(faces[s], axis);
}

/* The corners that may be dropped along an axis. */
static uint64_t foldable(const uint64_t *faces, int n_axes, int axis)
{
    uint64_t found = faces[0];
    for (int s = 0; s < 1 << n_axes; ++s)
        if ((s >> axis & 1) == 0)
            found &= ~faces[s] | faces[s | 1 << axis];
    return found;
}

/* Drops some corners from the set. Returns the same set if none can be dropped. */
static uint64_t fold(uint64_t set, int n_axes)
{
    uint64_t faces[1 << ICC_MAX_DIM];
    find_faces(set, n_axes, faces);
    for (int axis = 0; axis < n_axes; ++axis) {
        const uint64_t found = foldable(faces, n_axes, axis);
        const uint64_t below = found & lower[axis];
        if (found != 0)
            return set & ~(below != 0 ? below : found);
    }
    return set;
}

static bool folds_up(uint64_t set, int n_axes)
{
    uint64_t before = 0;
    while (set != before) {
        before = set;
        set = fold(set, n_axes);
    }
    return (set & (set - 1)) == 0;
}

bool iccp_octants_contractible(uint64_t set, int n_axes)
{
    const uint64_t all = n_axes == ICC_MAX_DIM ? UINT64_MAX : ((uint64_t)1 << (1 << n_axes)) - 1;
    assert(n_axes >= 1 && n_axes <= ICC_MAX_DIM && set != 0 && set != all);
    return folds_up(set, n_axes) || folds_up(all & ~set, n_axes);
}
