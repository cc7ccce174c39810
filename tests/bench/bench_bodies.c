/* Maps of bodies onto spheres, cubes and other poses: usage: bench_bodies SEED COUNT A.obj B.obj
 * ..., two by two with the same triangles. Each pair is made of one of these by chance: made coarse
 * to 300 to 2,500 vertices by the order of either of the two, turned, its target its drawing on the
 * sphere, that drawing on a cube, or the other pose, one after the other, either way round; pairs
 * that icc_domain_create() refuses are drawn again. Kind and certificate, what is left where it is
 * not of kind mesh, energy (6: an isometry), tetrahedra, processor time with one thread; and the
 * sum. ICC_LOG in the environment: what the library tells goes to the error output. */
#include <icc/icc.h>

#include "../obj.h"
#include "../random.h"
#include "bench.h"
#include "bench_map.h"
#include "match/sphere/decimate.h"
#include "match/sphere/sphere.h"

typedef enum target_kind { SPHERE, CUBE, POSE, KINDS } target_kind;

static const char *const NAME[KINDS] = {"sphere", "cube", "pose"};

/* Vertices, and pairs that are drawn for one that is accepted. */
static const double FEWEST = 300, MOST = 2500;

enum { MOST_DRAWN = 50 };

/* Into the box from -1 to 1. */
static void scale(size_t n, double *x)
{
    double low[3], high[3], most = 0;
    for (size_t k = 0; k < 3; ++k) {
        low[k] = HUGE_VAL;
        high[k] = -HUGE_VAL;
        for (size_t i = 0; i < n; ++i) {
            low[k] = fmin(low[k], x[3 * i + k]);
            high[k] = fmax(high[k], x[3 * i + k]);
        }
        most = fmax(most, high[k] - low[k]);
    }
    for (size_t i = 0; i < 3 * n; ++i)
        x[i] = (2 * x[i] - low[i % 3] - high[i % 3]) / most;
}

static void turn(size_t n, double *x, random_source *r)
{
    for (size_t k = 0; k < 3; ++k) {
        const double angle = random_between(r, 0, 6.28), c = cos(angle), s = sin(angle);
        for (size_t i = 0; i < n; ++i) {
            double *a = x + 3 * i + k, *b = x + 3 * i + (k + 1) % 3;
            const double old = *a;
            *a = c * old - s * *b;
            *b = s * old + c * *b;
        }
    }
}

static void place_on_cube(size_t n, double *x)
{
    for (size_t i = 0; i < n; ++i) {
        double *p = x + 3 * i;
        const double most = fmax(fabs(p[0]), fmax(fabs(p[1]), fabs(p[2])));
        for (size_t k = 0; k < 3; ++k)
            p[k] /= most;
    }
}

/* The vertices and faces that are left of both. */
static void keep(obj *out, double **other, const iccp_half_edges *m, const double *const x[2])
{
    uint32_t *number = bench_alloc(m->n_vertices, sizeof *number);
    *out = (obj){.vertices = bench_alloc(m->n_left, 3 * sizeof(double)),
                 .faces = bench_alloc(2 * m->n_left, 3 * sizeof(uint32_t))};
    *other = bench_alloc(m->n_left, 3 * sizeof **other);
    for (size_t v = 0; v < m->n_vertices; ++v)
        if (m->out[v] != ICCP_NO_EDGE) {
            memcpy(out->vertices + 3 * out->n_vertices, x[0] + 3 * v, 3 * sizeof(double));
            memcpy(*other + 3 * out->n_vertices, x[1] + 3 * v, 3 * sizeof(double));
            number[v] = (uint32_t)out->n_vertices++;
        }
    for (size_t v = 0; v < m->n_vertices; ++v)
        for (uint32_t h = m->out[v], k = 0; k < m->degree[v]; h = iccp_edge_turn(m, h), ++k) {
            const uint32_t a = iccp_edge_end(m, h), b = m->origin[iccp_before(h)];
            if (v > a || v > b)
                continue;
            uint32_t *f = out->faces + 3 * out->n_faces++;
            f[0] = number[v];
            f[1] = number[a];
            f[2] = number[b];
        }
    free(number);
}

/* False where one of the two surfaces is refused. */
static bool draw(icc_domain *d[2], size_t *n_vertices, const obj pose[2], target_kind kind,
                 random_source *r)
{
    const iccp_env env = {.memory = iccp_memory_default};
    const int first = random_unit(r) < 0.5, way = random_unit(r) < 0.5;
    const double *const x[2] = {pose[first].vertices, pose[1 - first].vertices};
    iccp_half_edges m;
    obj o;
    double *y;
    icc_error err = {.size = sizeof err};
    *n_vertices = (size_t)(FEWEST * pow(MOST / FEWEST, random_unit(r)));
    bench_check(
        iccp_half_edges_create(&m, pose[0].n_vertices, pose[0].n_faces, pose[0].faces, &env, &err),
        &err);
    bench_check(iccp_decimate(&m, x[0], *n_vertices, &env), NULL);
    keep(&o, &y, &m, x);
    iccp_half_edges_free(&m);
    if (kind != POSE)
        bench_check(iccp_sphere_draw(y, o.n_vertices, o.vertices, o.n_faces, o.faces, &env, &err),
                    &err);
    turn(o.n_vertices, o.vertices, r);
    turn(o.n_vertices, y, r);
    if (kind == CUBE)
        place_on_cube(o.n_vertices, y);
    icc_status status = ICC_OK;
    d[0] = d[1] = NULL;
    for (int k = 0; k < 2 && status == ICC_OK; ++k)
        status = icc_domain_create(&d[k == 0 ? way : 1 - way], 3, o.n_vertices,
                                   k == 0 ? o.vertices : y, o.n_faces, o.faces, NULL, &err);
    free(y);
    obj_free(&o);
    if (status == ICC_OK)
        return true;
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
    return false;
}

int main(int argc, char **argv)
{
    if (argc < 5 || argc % 2 == 0)
        return EXIT_FAILURE;
    random_source r = {(uint64_t)strtoull(argv[1], NULL, 10)};
    const size_t n = (size_t)strtoull(argv[2], NULL, 10), n_given = ((size_t)argc - 3) / 2;
    size_t n_mesh = 0;
    for (size_t i = 0; i < n; ++i) {
        const target_kind kind = (target_kind)(i % KINDS);
        bool drawn = false;
        for (int k = 0; k < MOST_DRAWN && !drawn; ++k) {
            const size_t g = (size_t)((double)n_given * random_unit(&r));
            obj pose[2];
            icc_domain *d[2];
            size_t n_vertices;
            for (size_t side = 0; side < 2; ++side) {
                if (!obj_read(&pose[side], argv[3 + 2 * g + side]))
                    return EXIT_FAILURE;
                scale(pose[side].n_vertices, pose[side].vertices);
            }
            drawn = draw(d, &n_vertices, pose, kind, &r);
            obj_free(&pose[0]);
            obj_free(&pose[1]);
            if (!drawn)
                continue;
            const char *slash = strrchr(argv[3 + 2 * g], '/');
            printf("%s, %zu vertices, %s: ", slash != NULL ? slash + 1 : argv[3 + 2 * g],
                   n_vertices, NAME[kind]);
            (void)fflush(stdout);
            n_mesh += bench_map(d[0], d[1]);
            icc_domain_free(d[0]);
            icc_domain_free(d[1]);
        }
    }
    printf("%zu of %zu of kind mesh, certified\n", n_mesh, n);
    return n_mesh == n ? EXIT_SUCCESS : EXIT_FAILURE;
}
