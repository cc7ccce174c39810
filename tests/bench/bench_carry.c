/* A tetrahedral mesh carried along: usage: bench_carry NAME.src.obj ..., with NAME.tgt.obj beside
 * each and the program tetgen installed. How many tetrahedra are inverted in the image under
 * methods field and foliation, how many of those cannot be mended because all their corners are on
 * the boundary, how many are left after the repair, and what it costs. Run by hand on a quiet
 * machine. */
#include "../flat_mesh.h"
#include <icc/icc.h>

#include "../meshes.h"
#include "bench.h"

static double determinant(const double *points, const uint32_t *v)
{
    double e[3][3];
    for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < 3; ++k)
            e[i][k] = points[3 * v[i + 1] + k] - points[3 * v[0] + k];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/* Inverted tetrahedra none of whose corners may move. */
static size_t count_stuck(const test_mesh *m, const double *images, size_t n_rim)
{
    size_t n = 0;
    for (size_t s = 0; s < m->n_simplices; ++s) {
        const uint32_t *v = m->simplices + 4 * s;
        const int fixed = v[0] < n_rim && v[1] < n_rim && v[2] < n_rim && v[3] < n_rim;
        n += fixed && !(determinant(m->vertices, v) * determinant(images, v) > 0);
    }
    return n;
}

static void carry(const icc_map *map, const test_mesh *m, size_t n_rim, const char *method)
{
    icc_error err = {.size = sizeof err};
    icc_certificate before = {.size = sizeof before}, after = {.size = sizeof after};
    double *images = bench_alloc(3 * m->n_vertices, sizeof *images);
    const double start = bench_processor_seconds();
    bench_check(flat_certify(map, m->n_vertices, m->vertices, m->n_simplices, m->simplices, images,
                             &before, NULL, &err),
                &err);
    const double middle = bench_processor_seconds();
    bench_check(flat_repair(map, m->n_vertices, m->vertices, m->n_simplices, m->simplices, images,
                            &after, NULL, &err),
                &err);
    const double end = bench_processor_seconds();
    printf(
        "  %-9s certified in %5.2f s: %zu inverted, %zu vertices without an image, %zu hopeless; "
        "repaired in %5.2f s more: %zu inverted, %zu flat%s\n",
        method, middle - start, before.n_inverted, before.n_no_image, count_stuck(m, images, n_rim),
        end - middle - (middle - start), after.n_inverted, after.n_flat,
        after.certified ? ", certified" : "");
    free(images);
}

static void measure(const icc_domain *source, const icc_domain *target, const test_mesh *m,
                    int32_t method, const char *name)
{
    icc_error err = {.size = sizeof err};
    icc_domain_info info = {.size = sizeof info};
    const icc_chart_options chart = {.size = sizeof chart, .method = method};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    icc_map *map;
    (void)icc_domain_get_info(source, &info);
    if (icc_map_create(&map, source, target, &options, NULL, &err) != ICC_OK) {
        printf("  %-9s %s\n", name, err.message);
        return;
    }
    carry(map, m, info.n_vertices, name);
    icc_map_free(map);
}

static test_mesh read_mesh(const char *path, const char *tag)
{
    obj o;
    test_mesh m;
    if (!obj_read(&o, path) ||
        !mesh_tetgen(&m, o.n_vertices, o.vertices, o.n_faces, o.faces, tag)) {
        fprintf(stderr, "%s cannot be read, or not be meshed\n", path);
        exit(EXIT_FAILURE);
    }
    obj_free(&o);
    return m;
}

int main(int argc, char **argv)
{
    for (int i = 1; i < argc; ++i) {
        char path[512];
        icc_error err = {.size = sizeof err};
        icc_domain *source, *target;
        (void)snprintf(path, sizeof path, "%s", argv[i]);
        test_mesh from = read_mesh(path, "bench_carry_src");
        char *side = strstr(path, ".src.obj");
        if (side == NULL)
            return EXIT_FAILURE;
        memcpy(side, ".tgt.obj", strlen(".tgt.obj"));
        test_mesh to = read_mesh(path, "bench_carry_tgt");
        bench_check(mesh_domain(&source, &from, NULL, &err), &err);
        bench_check(mesh_domain(&target, &to, NULL, &err), &err);
        printf("%s: %zu tetrahedra\n", argv[i], from.n_simplices);
        measure(source, target, &from, ICC_METHOD_FIELD, "field");
        measure(source, target, &from, ICC_METHOD_FOLIATION, "foliation");
        (void)fflush(stdout);
        icc_domain_free(source);
        icc_domain_free(target);
        mesh_free(&from);
        mesh_free(&to);
    }
    return EXIT_SUCCESS;
}
