/* Maps between surfaces that have little in common but their triangles: usage: bench_pairs A.obj
 * B.obj ..., two by two, both ways each. Kind and certificate, what is left where it is not of kind
 * mesh, energy (6: an isometry), tetrahedra, processor time with one thread; and the sum. ICC_LOG
 * in the environment: what the library tells goes to the error output. */
#include <icc/icc.h>

#include "../obj.h"
#include "bench.h"
#include "bench_map.h"

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

/* From one of the two to the other; whether it is of kind mesh, certified. */
static bool run(const icc_domain *const d[2], const char *const path[2], int from)
{
    printf("%s -> %s: ", name_of(path[from]), name_of(path[1 - from]));
    return bench_map(d[from], d[1 - from]);
}

int main(int argc, char **argv)
{
    size_t n = 0, n_mesh = 0;
    for (int k = 1; k + 1 < argc; k += 2) {
        icc_domain *const d[2] = {read_domain(argv[k]), read_domain(argv[k + 1])};
        n += 2;
        const char *const path[2] = {argv[k], argv[k + 1]};
        for (int from = 0; from < 2; ++from)
            n_mesh += run((const icc_domain *const[]){d[0], d[1]}, path, from);
        icc_domain_free(d[0]);
        icc_domain_free(d[1]);
    }
    printf("%zu of %zu of kind mesh, certified\n", n_mesh, n);
    return n_mesh == n ? EXIT_SUCCESS : EXIT_FAILURE;
}
