/* Maps between surfaces that have little in common but their triangles: usage: bench_pairs A.obj
 * B.obj ..., two by two, both ways each. Kind and certificate, what is left where it is not of kind
 * mesh, energy (6: an isometry), tetrahedra, processor time with one thread; and the sum. ICC_LOG
 * in the environment: what the library tells goes to the error output. */
#include <icc/icc.h>

#include "../obj.h"
#include "bench.h"

static void tell(void *user, const char *message)
{
    (void)user;
    (void)fprintf(stderr, "    %s\n", message);
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static icc_domain *read_domain(const char *path)
{
    obj o;
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    if (!obj_read(&o, path)) {
        (void)fprintf(stderr, "%s cannot be read\n", path);
        exit(EXIT_FAILURE);
    }
    bench_check(
        icc_domain_create(&domain, 3, o.n_vertices, o.vertices, o.n_faces, o.faces, NULL, &err),
        &err);
    obj_free(&o);
    return domain;
}

/* Whether it is of kind mesh. */
static bool run(const icc_domain *source, const icc_domain *target, const char *from,
                const char *to)
{
    const icc_env env = {
        .size = sizeof env, .threads = 1, .log = getenv("ICC_LOG") != NULL ? tell : NULL};
    icc_error err = {.size = sizeof err};
    icc_map_info info = {.size = sizeof info};
    icc_map *map;
    const double start = bench_processor_seconds();
    const icc_status status = icc_map_create(&map, source, target, NULL, &env, &err);
    const double spent = bench_processor_seconds() - start;
    printf("%s -> %s: ", name_of(from), name_of(to));
    if (status != ICC_OK) {
        printf("%s: %s, %.1f s\n", icc_status_name(status), err.message, spent);
    } else {
        bench_check(icc_map_get_info(map, &info), NULL);
        printf("%s, %s, %zu left, energy %.4g, %zu tetrahedra, %.1f s\n",
               info.kind == ICC_MAP_MESH ? "mesh" : "curves",
               info.certified == 1 ? "certified" : "not certified", info.n_unrepaired, info.energy,
               info.n_simplices, spent);
        icc_map_free(map);
    }
    (void)fflush(stdout);
    return status == ICC_OK && info.kind == ICC_MAP_MESH && info.certified == 1;
}

int main(int argc, char **argv)
{
    size_t n = 0, n_mesh = 0;
    for (int k = 1; k + 1 < argc; k += 2) {
        icc_domain *const d[2] = {read_domain(argv[k]), read_domain(argv[k + 1])};
        n += 2;
        n_mesh += run(d[0], d[1], argv[k], argv[k + 1]);
        n_mesh += run(d[1], d[0], argv[k + 1], argv[k]);
        icc_domain_free(d[0]);
        icc_domain_free(d[1]);
    }
    printf("%zu of %zu of kind mesh, certified\n", n_mesh, n);
    return n_mesh == n ? EXIT_SUCCESS : EXIT_FAILURE;
}
