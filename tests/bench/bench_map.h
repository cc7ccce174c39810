/* A map between two domains in space, made with one thread, and what it is like. ICC_LOG in the
 * environment: what the library tells goes to the error output. */
#ifndef TESTS_BENCH_MAP_H
#define TESTS_BENCH_MAP_H

#include "../reports.h"
#include "bench.h"

#include <stdbool.h>

static inline void bench_tell(void *user, const char *message)
{
    (void)user;
    (void)fprintf(stderr, "    %s\n", message);
}

/* Prints kind and certificate, what is left where it is not of kind mesh, energy (6: an isometry),
 * tetrahedra, processor time. Whether it is of kind mesh, certified. */
static inline bool bench_map(const icc_domain *source, const icc_domain *target)
{
    const icc_env env = {
        .size = sizeof env, .threads = 1, .log = getenv("ICC_LOG") != NULL ? bench_tell : NULL};
    icc_error err = {.size = sizeof err};
    icc_map_info info = {.size = sizeof info};
    icc_map *map;
    const double start = bench_processor_seconds();
    const icc_status status = icc_map_create(&map, source, target, NULL, &env, &err);
    const double spent = bench_processor_seconds() - start;
    if (status != ICC_OK) {
        printf("%s: %s, %.1f s\n", icc_status_name(status), err.message, spent);
        return false;
    }
    bench_check(icc_map_get_info(map, &info), NULL);
    printf("%s, %s, %zu left, energy %.4g, %zu tetrahedra, %.1f s\n",
           info.kind == ICC_MAP_MESH ? "mesh" : "curves",
           info.certified == 1 ? "certified" : "not certified", report_of(map).n_unrepaired,
           info.energy, info.n_simplices, spent);
    (void)fflush(stdout);
    icc_map_free(map);
    return info.kind == ICC_MAP_MESH && info.certified == 1;
}

#endif
