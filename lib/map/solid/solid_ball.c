/* Finds the apex of the target and fills the ball of directions. */
#include "map/solid/solid_ball.h"

#include "base/minmax.h"
#include "fill/fill_domain.h"
#include "map/solid/apex.h"
#include "math/vec.h"
#include "method/chart_create.h"

#include <string.h>

/* The target counts as a ball if its greatest distance from the apex is at most this multiple of
 * the least one. */
static const double ROUND = 1.02;

static bool find_directions(size_t n, const double *vertices, const double *apex,
                            double *directions)
{
    double least = HUGE_VAL, most = 0;
    for (size_t v = 0; v < n; ++v) {
        const double distance = iccp_vec_distance(3, vertices + 3 * v, apex);
        least = iccp_min(least, distance);
        most = iccp_max(most, distance);
        for (size_t k = 0; k < 3; ++k)
            directions[3 * v + k] = (vertices[3 * v + k] - apex[k]) / distance;
    }
    return most > ROUND * least;
}

static icc_status make(icc_chart **ball, size_t n, const double *directions,
                       const icc_domain *source, const iccp_env *env)
{
    static const icc_chart_options chart = {.size = sizeof chart};
    static const iccp_fill_options options = {ICCP_FILL_RATIO, UINT64_MAX};
    icc_domain *surface = NULL, *filled = NULL;
    icc_status status =
        iccp_domain_create(&surface, 3, n, directions, source->n_facets, source->facets, env, NULL);
    if (status == ICC_OK)
        status = iccp_domain_fill(&filled, surface, &options, env, NULL);
    if (status == ICC_OK)
        status = iccp_chart_create(ball, filled, &chart, env, NULL);
    iccp_domain_release(surface);
    iccp_domain_release(filled);
    return status;
}

icc_status iccp_solid_ball(icc_chart **ball, double apex[3], const icc_domain *source,
                           const icc_domain *target, const iccp_env *env)
{
    const size_t n = source->n_vertices;
    bool sees;
    *ball = NULL;
    icc_status status = iccp_find_apex(&sees, apex, source->mesh, target->vertices, &env->memory);
    if (status != ICC_OK || !sees)
        return status;
    double *directions = iccp_alloc(&env->memory, n, 3 * sizeof *directions);
    if (directions == NULL)
        return ICC_ERR_MEMORY;
    if (find_directions(n, target->vertices, apex, directions))
        status = make(ball, n, directions, source, env);
    iccp_free(&env->memory, directions);
    if (status == ICC_OK || status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED)
        return status;
    iccp_log(env, "no ball of the target's directions: %s", icc_status_name(status));
    return ICC_OK;
}
