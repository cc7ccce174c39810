/* Four dimensions, exactly: a block cut into 4-simplices by Kuhn's rule, and the same block
 * twisted, with other vertices inside. Points inside go along and come back, and the derivative of
 * the map is positive everywhere. */
#include <icc/icc.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    N = 3,
    M = N + 1,
    N_VERTICES = M * M * M * M,
    N_SIMPLICES = 24 * N * N * N * N,
    N_POINTS = 2000
};

typedef struct mesh {
    double vertices[N_VERTICES][4];
    uint32_t corners[N_SIMPLICES][5];
} mesh;

static void check(icc_status status, const icc_error *err)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "mesh_4d: %s\n", err != NULL ? err->message : icc_status_name(status));
    exit(EXIT_FAILURE);
}

/* Numbers in [0, 1), the same on every machine. */
static double draw(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state / 4294967296.0;
}

/* From the lowest corner of each box along its edges to the highest, in all 24 orders of the
 * axes. */
static void cut(mesh *m)
{
    static const uint32_t step[4] = {1, M, M * M, M * M * M};
    size_t n = 0;
    for (uint32_t v = 0; v < N_VERTICES; ++v) {
        int has_box = 1;
        for (size_t k = 0; k < 4; ++k) {
            m->vertices[v][k] = v / step[k] % M;
            has_box &= v / step[k] % M < N;
        }
        for (uint32_t order = 0; order < 256 && has_box; ++order) {
            const uint32_t axis[4] = {order & 3, order >> 2 & 3, order >> 4 & 3, order >> 6};
            if ((1u << axis[0] | 1u << axis[1] | 1u << axis[2] | 1u << axis[3]) != 15)
                continue;
            m->corners[n][0] = v;
            for (size_t k = 0; k < 4; ++k)
                m->corners[n][k + 1] = m->corners[n][k] + step[axis[k]];
            ++n;
        }
    }
}

static void turn(double *a, double *b, double angle)
{
    const double x = *a - N / 2., y = *b - N / 2.;
    *a = N / 2. + x * cos(angle) - y * sin(angle);
    *b = N / 2. + x * sin(angle) + y * cos(angle);
}

/* The x-y planes are turned, the farther along z and w the more. Vertices inside go elsewhere
 * first. */
static void twist(mesh *m)
{
    uint32_t state = 4;
    for (size_t v = 0; v < N_VERTICES; ++v) {
        double *p = m->vertices[v];
        int is_inner = 1;
        for (size_t k = 0; k < 4; ++k)
            is_inner &= p[k] > 0 && p[k] < N;
        for (size_t k = 0; k < 4 && is_inner; ++k)
            p[k] += 0.2 * (draw(&state) - 0.5);
        turn(&p[0], &p[1], 0.25 * (p[2] + p[3]));
    }
}

static icc_domain *make_domain(const mesh *m)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    const icc_mesh own = {.size = sizeof own,
                          .dim = 4,
                          .n_vertices = N_VERTICES,
                          .vertices = (double *)m->vertices[0],
                          .n_cells = N_SIMPLICES,
                          .cells = (uint32_t *)m->corners[0]};
    check(icc_domain_create_mesh(&domain, &own, 0, NULL, NULL, &err), &err);
    return domain;
}

static void describe(const char *name, const icc_chart *chart)
{
    icc_chart_info info = {.size = sizeof info};
    icc_shelling_info own = {.size = sizeof own};
    check(icc_chart_get_info(chart, &info), NULL);
    check(icc_chart_get_shelling_info(chart, &own), NULL);
    printf(
        "%s: %zu simplices, %d complete orders, maximum at (%.2f, %.2f, %.2f, %.2f): %scertified\n",
        name, own.n_mesh_simplices, (int)own.n_orders, info.maximum[0], info.maximum[1],
        info.maximum[2], info.maximum[3], info.certified ? "" : "not ");
}

static double determinant(double a[4][4])
{
    double product = 1;
    for (size_t c = 0; c < 4; ++c) {
        size_t pivot = c;
        for (size_t r = c + 1; r < 4; ++r)
            pivot = fabs(a[r][c]) > fabs(a[pivot][c]) ? r : pivot;
        for (size_t k = 0; k < 4 && pivot != c; ++k) {
            const double swap = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        product *= pivot != c ? -a[c][c] : a[c][c];
        for (size_t r = c + 1; r < 4 && fabs(a[c][c]) > 0; ++r)
            for (size_t k = 4; k-- > c;)
                a[r][k] -= a[r][c] / a[c][c] * a[c][k];
    }
    return product;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void carry(const icc_map *map, const icc_env *env)
{
    static double points[N_POINTS][4], images[N_POINTS][4], back[N_POINTS][4],
        jacobians[N_POINTS][4][4];
    double dets[N_POINTS], farthest = 0;
    uint32_t state = 1;
    size_t n_lost = 0, n_lost_back = 0, n_none = 0;
    for (size_t i = 0; i < 4 * N_POINTS; ++i)
        points[i / 4][i % 4] = N * draw(&state);
    check(icc_map_apply(map, N_POINTS, points[0], images[0], NULL, &n_lost, env), NULL);
    check(icc_map_apply_inverse(map, N_POINTS, images[0], back[0], NULL, &n_lost_back, env), NULL);
    check(icc_map_jacobian(map, N_POINTS, points[0], jacobians[0][0], NULL, &n_none, env), NULL);
    for (size_t i = 0; i < N_POINTS; ++i) {
        for (size_t k = 0; k < 4; ++k)
            farthest = fmax(farthest, fabs(back[i][k] - points[i][k]));
        dets[i] = determinant(jacobians[i]);
    }
    qsort(dets, N_POINTS, sizeof *dets, compare);
    printf("%d points: %zu have no image, %zu do not come back, the others come back within %.1e\n",
           (int)N_POINTS, n_lost, n_lost_back, farthest);
    printf(
        "determinants of the derivative: %zu missing, least %.4f, median %.4f, greatest %.4f: %s\n",
        n_none, dets[0], dets[N_POINTS / 2], dets[N_POINTS - 1],
        dets[0] > 0 ? "all positive" : "NOT all positive");
}

int main(void)
{
    static mesh m;
    const icc_env env = {.size = sizeof env, .threads = 4};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    cut(&m);
    icc_domain *source = make_domain(&m);
    twist(&m);
    icc_domain *target = make_domain(&m);
    check(icc_map_create(&map, source, target, NULL, &env, &err), &err);
    describe("block", icc_map_source_chart(map));
    describe("twisted block", icc_map_target_chart(map));
    carry(map, &env);
    icc_map_free(map);
    icc_domain_free(target);
    icc_domain_free(source);
    return EXIT_SUCCESS;
}
