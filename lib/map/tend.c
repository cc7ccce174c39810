#include "map/tend.h"

#include "map/coarsen.h"
#include "map/dirichlet.h"
#include "map/flips.h"
#include "map/descent.h"
#include <stdio.h>

#include <stdlib.h>
static double P(const char *name, double d) { const char *s = getenv(name); return s ? atof(s) : d; }

static double density(const iccp_simplicial_map *map, size_t t)
{
    const double *image[3];
    double element[ICCP_ELEMENT(2)];
    iccp_simplicial_images(2, map, t, image);
    iccp_simplicial_element(map, t, element);
    return iccp_dirichlet_energy2(element, image) / element[0];
}

static uint32_t longest_edge(const iccp_plmap *map, uint32_t t)
{
    const uint32_t *v = map->corners.vertex;
    uint32_t best = 3 * t;
    double most = -1;
    for (uint32_t c = 3 * t; c < 3 * t + 3; ++c) {
        const double l = iccp_plmap_length2(map, v[iccp_after(c)], v[iccp_before(c)]);
        if (l > most) { most = l; best = c; }
    }
    return best;
}

icc_status iccp_tend(iccp_plmap *map, double longest, iccp_work *work, bool *changed,
                     const iccp_env *env)
{
    const double HIGH = iccp_max(P("HIGH", 50), P("REL",0) * iccp_plmap_energy(map)), SHORT = P("SHORT", 0.1) * longest;
    icc_status status = ICC_OK;
    *changed = false;
    const int ROUNDS = (int)P("ROUNDS", 1);
    for (int round = 0; status == ICC_OK && round < ROUNDS; ++round) {
        size_t n_bad = 0, n_cut = 0, n_flips = 0, n_gone = 0;
        const size_t n = map->corners.n_triangles;
        for (uint32_t t = 0; status == ICC_OK && t < n; ++t) {
            const iccp_simplicial_map s = iccp_plmap_simplicial(map);
            if (!(density(&s, t) > HIGH))
                continue;
            ++n_bad;
            const uint32_t c = longest_edge(map, t), *v = map->corners.vertex;
            bool done = false;
            if (iccp_plmap_length2(map, v[iccp_after(c)], v[iccp_before(c)]) > SHORT * SHORT)
                status = iccp_plmap_cut(map, c, &done);
            n_cut += done;
        }
        if (n_bad == 0)
            break;
        *changed = true;
        map->plan = NULL;
        if (status == ICC_OK)
            status = iccp_flip_edges(map, &n_flips, env);
        if (status == ICC_OK && P("COARSEN", 0.02) > 0)
            status = iccp_coarsen_within(map, P("COARSEN", 0.02), P("LONG", 1) * longest, &n_gone, env);
        const iccp_descent descent = {0, (size_t)P("STEPS", 2), 1e-2, 0, false};
        for (int side = 0; side < 2; ++side) {
            const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
            iccp_improvement ignored = {0};
            if (status == ICC_OK)
                status = iccp_improve_images(&simplicial, &descent, work, &ignored, env);
            iccp_plmap_swap(map);
        }
        if (getenv("TEND")) fprintf(stderr, "      bad %zu cut %zu flips %zu gone %zu -> %zu, E %g\n", n_bad, n_cut, n_flips, n_gone, map->corners.n_triangles, iccp_plmap_energy(map));
    }
    return status;
}
