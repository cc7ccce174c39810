/* Maps a ball onto a star-shaped region by putting one tetrahedron after the other into place:
 * docs/theory.md, the mesh map in space. V. Nigolian, M. Campen, D. Bommes, Expansion Cones: A
 * Progressive Volumetric Mapping Framework, 2023, also begin with all inner vertices in one point,
 * and move one vertex after the other out of it. Here tetrahedra come out of it one after the
 * other. Their order reverses that of M. Campen, C. Silva, D. Zorin, Bijective Maps from Simplicial
 * Foliations, 2016: from the ends of limbs to the middle. */
#include "map/solid/cone_map.h"

#include "base/heap.h"
#include "map/solid/cone.h"
#include "math/vec.h"

#include <string.h>

/* MOST_GROWTH: limit on the number of tetrahedra, as a multiple of the first number. MOST_WORK:
 * limit on the work for each tetrahedron at first, counted in tetrahedra tried and images moved.
 * Solids with limbs grew by up to a half on spheres and cubes. They took 40 to 460 units of work,
 * larger ones more. */
enum { MOST_GROWTH = 4, MOST_WORK = 1000 };

/* LAST_SWEEPS: final sweeps over all images. STEPS: Newton steps for the points of a tetrahedron in
 * place. REPORT: work between two progress reports. */
enum { LAST_SWEEPS = 10, STEPS = 2, REPORT = 1024 };

typedef struct job {
    iccp_cone cone;
    double *far; /* of each point: its distance from the middle, along edges */
    size_t room;
    iccp_heap ready, next; /* tetrahedra to try in this pass and in the next one; so the front
                              moves everywhere, not only at the ends of limbs */
    iccp_heap blocked;
    size_t n_first, most;  /* tetrahedra at first, and the limit */
    size_t work, reported; /* until now, and at the last report */
    size_t n_placed;       /* in this pass */
} job;

/* ---- order ---- */

/* Finds the distances along edges from all points whose distance is 0. O(n log n). */
static icc_status find_distances(iccp_tets *m, double *far, const iccp_memory *memory)
{
    iccp_heap heap;
    icc_status status = iccp_heap_create(&heap, m->points.n, memory) ? ICC_OK : ICC_ERR_MEMORY;
    for (uint32_t v = 0; status == ICC_OK && v < m->points.n; ++v)
        if (far[v] <= 0)
            iccp_heap_put(&heap, v, 0);
    while (status == ICC_OK && heap.n_entries > 0) {
        const uint32_t v = iccp_heap_pop(&heap);
        if (!iccp_tets_star(m, v))
            status = ICC_ERR_MEMORY;
        for (size_t s = 0; status == ICC_OK && s < m->star.n; ++s)
            for (int k = 0; k < 4; ++k) {
                const uint32_t w = m->tet[m->star.item[s]].v[k];
                const double sum = far[v] + iccp_vec_distance(3, iccp_point(&m->points, v),
                                                              iccp_point(&m->points, w));
                if (sum < far[w]) {
                    far[w] = sum;
                    iccp_heap_put(&heap, w, sum);
                }
            }
    }
    iccp_heap_free(&heap, memory);
    return status;
}

/* Takes the point deepest inside as the middle. */
static icc_status find_order(job *j, const iccp_memory *memory)
{
    iccp_tets *m = &j->cone.mesh;
    uint32_t middle = 0;
    for (size_t v = 0; v < m->points.n; ++v)
        j->far[v] = v < j->cone.n_fixed ? 0 : HUGE_VAL;
    icc_status status = find_distances(m, j->far, memory);
    for (uint32_t v = 0; v < m->points.n; ++v)
        if (j->far[v] > j->far[middle])
            middle = v;
    for (uint32_t v = 0; v < m->points.n; ++v)
        j->far[v] = v == middle ? 0 : HUGE_VAL;
    return status == ICC_OK ? find_distances(m, j->far, memory) : status;
}

/* Four times the mean distance of the corners. */
static double distance_of(const job *j, uint32_t tet)
{
    const uint32_t *v = j->cone.mesh.tet[tet].v;
    return j->far[v[0]] + j->far[v[1]] + j->far[v[2]] + j->far[v[3]];
}

static void put_next(job *j, uint32_t tet)
{
    int side[4];
    if (tet < j->most && iccp_cone_is_left(&j->cone, tet) &&
        iccp_cone_front_sides(&j->cone, tet, side) > 0)
        iccp_heap_put(&j->next, tet, -distance_of(j, tet));
}

/* Queues the tetrahedra at a point for the next pass, because a change there may have made them
 * possible. */
static void put_star_next(job *j, uint32_t point)
{
    iccp_tets *m = &j->cone.mesh;
    if (iccp_tets_star(m, point))
        for (size_t s = 0; s < m->star.n; ++s)
            put_next(j, m->star.item[s]);
}

/* ---- steps ---- */

/* Tries the first tetrahedron in the order. If it is placed, the tetrahedra that this affects are
 * tried again. */
static void try_next(job *j)
{
    iccp_cone *cone = &j->cone;
    const uint32_t t = iccp_heap_pop(&j->ready);
    if (!iccp_cone_is_left(cone, t))
        return;
    const iccp_cone_result result = iccp_cone_try(cone, t);
    if (result == ICCP_CONE_BLOCKED)
        iccp_heap_put(&j->blocked, t, -distance_of(j, t));
    j->n_placed += result == ICCP_CONE_PLACED;
    for (int k = 0; result == ICCP_CONE_PLACED && k < 4; ++k) {
        iccp_cone_smooth(cone, cone->mesh.tet[t].v[k], STEPS);
        put_star_next(j, cone->mesh.tet[t].v[k]);
    }
}

/* Makes room for another point. */
static bool reserve(job *j)
{
    iccp_tets *m = &j->cone.mesh;
    if (m->points.n < j->room)
        return true;
    if (!iccp_enlarge(&m->memory, &j->far, j->room, 2 * j->room, sizeof *j->far)) {
        m->no_memory = true;
        return false;
    }
    j->room *= 2;
    return true;
}

/* Splits the first blocked tetrahedron. */
static void split_next(job *j)
{
    iccp_cone *cone = &j->cone;
    uint32_t point;
    const uint32_t t = iccp_heap_pop(&j->blocked);
    if (!iccp_cone_is_left(cone, t))
        return;
    const double far = 0.25 * distance_of(j, t);
    uint32_t corner[4];
    memcpy(corner, cone->mesh.tet[t].v, sizeof corner);
    const size_t n = cone->mesh.points.n;
    if (!reserve(j))
        return;
    const bool done = iccp_cone_split(cone, t, &point);
    if (cone->mesh.points.n == n)
        return;
    j->far[point] = far;
    for (size_t k = 0; k < cone->mesh.fresh.n; ++k)
        put_next(j, cone->mesh.fresh.item[k]);
    for (int k = 0; done && k < 4; ++k)
        put_star_next(j, corner[k]);
    if (done)
        put_star_next(j, point);
}

/* Begins a pass: smooths all images and queues waiting and blocked tetrahedra. If the last pass
 * placed nothing, the first blocked one is split. */
static void begin_pass(job *j)
{
    const iccp_heap done = j->ready;
    if (j->n_placed == 0 && j->blocked.n_entries > 0)
        split_next(j);
    iccp_cone_smooth_all(&j->cone);
    j->work += j->cone.mesh.points.n;
    while (j->blocked.n_entries > 0)
        put_next(j, iccp_heap_pop(&j->blocked));
    j->ready = j->next;
    j->next = done;
    j->n_placed = 0;
}

/* Reports progress after some work, and returns an error if memory ran out. */
static icc_status report(job *j, const iccp_env *env)
{
    const iccp_cone *cone = &j->cone;
    if (cone->mesh.no_memory)
        return ICC_ERR_MEMORY;
    if (j->work - j->reported < REPORT)
        return ICC_OK;
    j->reported = j->work;
    return iccp_progress(env, "repair", 1 - (double)cone->n_left / (double)cone->mesh.n_alive);
}

/* Runs until all tetrahedra are in place, none can be tried, or a limit is reached. */
static icc_status run(job *j, const iccp_env *env)
{
    iccp_cone *cone = &j->cone;
    icc_status status = ICC_OK;
    for (uint32_t t = 0; t < cone->mesh.n_tets; ++t)
        put_next(j, t);
    while (status == ICC_OK && cone->n_left > 0 && j->work < MOST_WORK * j->n_first) {
        if (j->ready.n_entries == 0)
            begin_pass(j);
        if (j->ready.n_entries == 0 || cone->mesh.n_tets >= j->most)
            break;
        try_next(j);
        ++j->work;
        status = report(j, env);
    }
    for (int k = 0; k < LAST_SWEEPS && status == ICC_OK && cone->n_left == 0; ++k)
        iccp_cone_smooth_all(cone);
    return cone->mesh.no_memory ? ICC_ERR_MEMORY : status;
}

/* ---- all of it ---- */

icc_status iccp_cone_apex(bool *sees, double apex[3], const iccp_simplices *mesh,
                          const double *boundary, const iccp_env *env)
{
    iccp_cone cone;
    icc_status status = iccp_cone_create(&cone, mesh, boundary, &env->memory);
    *sees = status == ICC_OK && iccp_cone_find_apex(&cone);
    memcpy(apex, cone.apex, sizeof cone.apex);
    if (status == ICC_OK && cone.mesh.no_memory)
        status = ICC_ERR_MEMORY;
    iccp_cone_free(&cone);
    return status;
}

static icc_status prepare(job *j, const iccp_memory *memory)
{
    j->room = j->cone.mesh.points.room;
    j->far = iccp_alloc(memory, j->room, sizeof *j->far);
    const bool has_memory = iccp_heap_create(&j->ready, j->most, memory) &&
                            iccp_heap_create(&j->next, j->most, memory) &&
                            iccp_heap_create(&j->blocked, j->most, memory);
    return has_memory && j->far != NULL ? find_order(j, memory) : ICC_ERR_MEMORY;
}

icc_status iccp_cone_map(iccp_simplices **out, double **images, const iccp_simplices *mesh,
                         const double *boundary, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    job j = {.n_first = mesh->n_simplices, .most = MOST_GROWTH * mesh->n_simplices, .n_placed = 1};
    *out = NULL;
    *images = NULL;
    icc_status status = iccp_cone_create(&j.cone, mesh, boundary, memory);
    const bool sees = status == ICC_OK && iccp_cone_find_apex(&j.cone);
    if (sees)
        status = prepare(&j, memory);
    if (sees && status == ICC_OK)
        status = run(&j, env);
    if (status == ICC_OK && j.cone.mesh.no_memory)
        status = ICC_ERR_MEMORY;
    if (sees && status == ICC_OK && j.cone.n_left == 0)
        status = iccp_cone_give(&j.cone, out, images);
    if (status != ICC_OK) {
        iccp_simplices_free(*out);
        iccp_free(memory, *images);
        *out = NULL;
        *images = NULL;
    }
    if (sees && status == ICC_OK)
        iccp_log(env, "%zu of %zu tetrahedra came in place one by one; there were %zu at first",
                 j.cone.mesh.n_alive - j.cone.n_left, j.cone.mesh.n_alive, j.n_first);
    iccp_heap_free(&j.ready, memory);
    iccp_heap_free(&j.next, memory);
    iccp_heap_free(&j.blocked, memory);
    iccp_free(memory, j.far);
    iccp_cone_free(&j.cone);
    return status;
}
