/* Patches round inverted tetrahedra are untangled, larger ones in turn, as map/repair.c does with
 * triangles. */
#include "map/tet_repair.h"

#include "map/distortion.h"
#include "map/tet_newton.h"
#include "math/predicates.h"

#include <math.h>
#include <string.h>

/* Rings of neighbours round the inverted tetrahedra that are free to move, in turn, 0 means all; steps of the
 * untangling, and steps without fewer inverted tetrahedra after which it is given up. From a start that has
 * little to do with the map many steps go by before epsilon is small enough for anything to happen. What is
 * left after that in few places, patches mend more often than not. */
static const struct {
    int rings, steps, patience;
} ROUNDS[] = {{2, 60, 15}, {5, 60, 15}, {12, 60, 15}, {0, 150, 40},
              {2, 60, 15}, {5, 60, 15}, {12, 60, 15}};

/* Where more than one tetrahedron in MANY is inverted, patches would cost more than all at once and leave the
 * inverted ones beside them in worse places. */
enum { MANY = 20 };

/* V. Garanzha et al., Foldover-free maps in 50 lines of code, 2021: the faster the energy fell, the faster
 * epsilon goes to zero. Its lower bound falls by at least this share a step. */
static const double SLOWEST = 0.3;

bool iccp_tet_is_positive(const iccp_simplices *mesh, const double *points, size_t simplex)
{
    const uint32_t *v = mesh->corners + 4 * simplex;
    return iccp_orient3d(points + 3 * (size_t)v[0], points + 3 * (size_t)v[1],
                         points + 3 * (size_t)v[2], points + 3 * (size_t)v[3]) > 0;
}

static size_t count_inverted(const iccp_simplices *mesh, const double *images)
{
    size_t n = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        n += !iccp_tet_is_positive(mesh, images, s);
    return n;
}

/* Inverted, and not with all corners on the boundary, where nothing can be done. */
static bool is_task(const iccp_simplices *mesh, const double *images, size_t simplex)
{
    bool is_free = false;
    for (size_t c = 4 * simplex; c < 4 * simplex + 4; ++c)
        is_free |= mesh->corners[c] >= mesh->n_rim;
    return is_free && !iccp_tet_is_positive(mesh, images, simplex);
}

static size_t count_tasks(const iccp_simplices *mesh, const double *images)
{
    size_t n = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        n += is_task(mesh, images, s);
    return n;
}

/* Marks the corners of simplices to be repaired and `rings` rings of neighbours. */
static void mark_patch(const iccp_simplices *mesh, const double *images, int rings,
                       uint8_t *movable)
{
    memset(movable, 0, mesh->n_points);
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        for (size_t c = 4 * s; c < 4 * s + 4 && is_task(mesh, images, s); ++c)
            movable[mesh->corners[c]] = 1;
    for (int ring = 1; ring < rings; ++ring) {
        const uint8_t old = (uint8_t)ring, fresh = (uint8_t)(ring + 1);
        for (size_t s = 0; s < mesh->n_simplices; ++s) {
            bool touches = false;
            for (size_t c = 4 * s; c < 4 * s + 4; ++c)
                touches |= movable[mesh->corners[c]] == old;
            for (size_t c = 4 * s; touches && c < 4 * s + 4; ++c)
                if (movable[mesh->corners[c]] == 0)
                    movable[mesh->corners[c]] = fresh;
        }
    }
}

/* Half of the steps of a round, as far as progress goes. */
static const double TYPICAL_STEPS = 10;

static icc_status untangle(iccp_tet_newton *newton, int steps, int patience, const iccp_env *env)
{
    size_t n_bad, fewest;
    int since = 0;
    icc_status status = ICC_OK;
    double least = iccp_tet_newton_least(newton, &n_bad);
    double epsilon = iccp_untangle_start(least);
    fewest = n_bad;
    for (int k = 0; k < steps && since < patience && newton->n_free > 0; ++k) {
        double slope;
        const double before = iccp_tet_newton_energy(newton, epsilon);
        const iccp_env part = iccp_round(env, (size_t)k, TYPICAL_STEPS);
        status = iccp_tet_newton_solve(newton, epsilon, &slope, &part);
        if (status != ICC_OK)
            break;
        const double after = iccp_tet_newton_move(newton, epsilon, before, slope);
        least = iccp_tet_newton_least(newton, &n_bad);
        since = n_bad < fewest ? 0 : since + 1;
        fewest = n_bad < fewest ? n_bad : fewest;
        if (least > 0 && after >= 0.99 * before)
            break;
        epsilon = iccp_untangle_next(epsilon, least, fmax(1 - after / before, SLOWEST));
    }
    return status;
}

static double volume_of(const iccp_simplices *mesh, const double *points)
{
    double sum = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const uint32_t *v = mesh->corners + 4 * s;
        const double *const corner[4] = {points + 3 * (size_t)v[0], points + 3 * (size_t)v[1],
                                         points + 3 * (size_t)v[2], points + 3 * (size_t)v[3]};
        iccp_tet tet;
        iccp_tet_create(&tet, corner);
        sum += fabs(tet.volume);
    }
    return sum;
}

icc_status iccp_tet_repair(const iccp_simplices *mesh, double *images, size_t *n_left,
                           const iccp_env *env)
{
    uint8_t *movable = iccp_alloc(&env->memory, mesh->n_points, 1);
    icc_status status = movable != NULL ? ICC_OK : ICC_ERR_MEMORY;
    const double before = volume_of(mesh, mesh->points), after = volume_of(mesh, images);
    const double stretch = before > 0 && after > 0 ? cbrt(after / before) : 1;
    size_t n_tasks = count_tasks(mesh, images);
    for (size_t k = 0; status == ICC_OK && n_tasks > 0 && k < sizeof ROUNDS / sizeof *ROUNDS; ++k) {
        iccp_tet_newton newton;
        const iccp_env part = iccp_round(env, k, 1);
        if (ROUNDS[k].rings > 0 && n_tasks > mesh->n_simplices / MANY)
            continue;
        if (ROUNDS[k].rings > 0)
            mark_patch(mesh, images, ROUNDS[k].rings, movable);
        status = iccp_tet_newton_create(&newton, mesh, images, ROUNDS[k].rings > 0 ? movable : NULL,
                                        stretch, env);
        if (status == ICC_OK)
            status = untangle(&newton, ROUNDS[k].steps, ROUNDS[k].patience, &part);
        iccp_tet_newton_free(&newton);
        n_tasks = count_tasks(mesh, images);
    }
    *n_left = count_inverted(mesh, images);
    iccp_free(&env->memory, movable);
    return status;
}
