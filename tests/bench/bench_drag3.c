/* Surfaces dragged about in space, frame by frame: usage: bench_drag3 NAME.src.obj ..., with
 * NAME.tgt.obj beside each. The map of the pair is made, then its target is moved there and back:
 * by 1, 5 and 10 % of its size a frame and 20 % at most; in one place with a smooth falloff, bent,
 * and twisted. Milliseconds of the processor a frame, one thread, beside those of making the map;
 * frames that were refused, and those made anew; the energy after the last frame and of a map made
 * to there at once. Run by hand. */
#include "bench.h"

#include "../meshes.h"

enum { FRAMES = 20 };
static const double FARTHEST = 0.2;

static const icc_env ONE_THREAD = {.size = sizeof(icc_env), .threads = 1};

/* ---- motions ---- */

typedef struct body {
    const obj *surface;
    double centre[3], size; /* the longest side of the bounding box */
    int axis;               /* along it */
    double half, radius;    /* half of that side, and the most distance from the axis */
    const double *grip;     /* a vertex */
} body;

static body body_of(const obj *o)
{
    body b = {.surface = o, .grip = o->vertices};
    double low[3], high[3];
    for (int k = 0; k < 3; ++k)
        low[k] = high[k] = o->vertices[k];
    for (size_t i = 0; i < 3 * o->n_vertices; ++i) {
        low[i % 3] = fmin(low[i % 3], o->vertices[i]);
        high[i % 3] = fmax(high[i % 3], o->vertices[i]);
    }
    for (int k = 0; k < 3; ++k) {
        b.centre[k] = (low[k] + high[k]) / 2;
        if (high[k] - low[k] > b.size) {
            b.size = high[k] - low[k];
            b.axis = k;
        }
    }
    b.half = b.size / 2;
    for (size_t v = 0; v < o->n_vertices; ++v) {
        const double *x = o->vertices + 3 * v;
        const int p = (b.axis + 1) % 3, q = (b.axis + 2) % 3;
        b.radius = fmax(b.radius, hypot(x[p] - b.centre[p], x[q] - b.centre[q]));
        if (x[p] > b.grip[p])
            b.grip = x;
    }
    return b;
}

/* The grip goes that far, what is near goes with it. A one-to-one map of space. */
static void pull(const body *b, double far, const double *x, double *y)
{
    const double reach = 0.4 * b->size;
    double r2 = 0;
    for (int k = 0; k < 3; ++k)
        r2 += (x[k] - b->grip[k]) * (x[k] - b->grip[k]);
    const double share = r2 < reach * reach ? pow(1 - r2 / (reach * reach), 2) : 0;
    memcpy(y, x, 3 * sizeof *y);
    y[(b->axis + 1) % 3] += 0.8 * far * share;
    y[b->axis] += 0.6 * far * share;
}

/* Along an arc, whose ends are about that far away. */
static void bend(const body *b, double far, const double *x, double *y)
{
    const int p = (b->axis + 1) % 3;
    const double curvature = 2 * far / (b->half * b->half);
    const double t = x[b->axis] - b->centre[b->axis], h = x[p] - b->centre[p];
    memcpy(y, x, 3 * sizeof *y);
    if (fabs(curvature) < 1e-12)
        return;
    y[b->axis] = b->centre[b->axis] + (1 / curvature - h) * sin(curvature * t);
    y[p] = b->centre[p] + 1 / curvature - (1 / curvature - h) * cos(curvature * t);
}

static void twist(const body *b, double far, const double *x, double *y)
{
    const int p = (b->axis + 1) % 3, q = (b->axis + 2) % 3;
    const double angle = far / b->radius * (x[b->axis] - b->centre[b->axis]) / b->half;
    const double u = x[p] - b->centre[p], v = x[q] - b->centre[q];
    y[b->axis] = x[b->axis];
    y[p] = b->centre[p] + u * cos(angle) - v * sin(angle);
    y[q] = b->centre[q] + u * sin(angle) + v * cos(angle);
}

typedef void motion(const body *b, double far, const double *x, double *y);

static icc_status move(icc_domain **out, const body *b, motion *moves, double far, icc_error *err)
{
    const obj *o = b->surface;
    double *moved = bench_alloc(o->n_vertices, 3 * sizeof *moved);
    for (size_t v = 0; v < o->n_vertices; ++v)
        moves(b, far, o->vertices + 3 * v, moved + 3 * v);
    const icc_status status =
        icc_domain_create(out, 3, o->n_vertices, moved, o->n_faces, o->faces, &ONE_THREAD, err);
    free(moved);
    return status;
}

/* ---- frames ---- */

static void notice(void *user, const char *message)
{
    size_t *n = user;
    if (strstr(message, "making a new map") != NULL)
        ++*n;
}

static double energy_of(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    bench_check(icc_map_get_info(map, &info), NULL);
    return info.kind == ICC_MAP_MESH && info.certified ? info.energy : HUGE_VAL;
}

static size_t size_of(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    bench_check(icc_map_get_info(map, &info), NULL);
    return info.n_simplices;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double place_of(int frame, double step)
{
    const double way = fmod((frame + 1) * step, 4 * FARTHEST);
    return way < FARTHEST ? way : way < 3 * FARTHEST ? 2 * FARTHEST - way : way - 4 * FARTHEST;
}

static void follow(const char *name, const char *how, motion *moves, double step, const body *b,
                   const icc_domain *source, icc_map *first, double making)
{
    double ms[FRAMES], fresh = 0;
    size_t n = 0, n_refused = 0, n_anew = 0, n_not_embedded = 0;
    icc_map *map = first;
    icc_env env = ONE_THREAD;
    env.user = &n_anew;
    env.log = notice;
    for (int frame = 0; frame < FRAMES; ++frame) {
        icc_error err = {.size = sizeof err};
        icc_domain *target;
        icc_map *next;
        if (move(&target, b, moves, b->size * place_of(frame, step), &err) != ICC_OK) {
            ++n_not_embedded;
            continue;
        }
        const double begin = bench_processor_seconds();
        const icc_status status = icc_map_retarget(&next, map, target, NULL, &env, &err);
        ms[n++] = 1e3 * (bench_processor_seconds() - begin);
        if (status != ICC_OK) {
            ++n_refused;
            printf("    frame %d: %s\n", frame, err.message);
        } else {
            if (map != first)
                icc_map_free(map);
            map = next;
        }
        if (frame + 1 == FRAMES || n + n_not_embedded == FRAMES) {
            icc_map *other;
            if (icc_map_create(&other, source, target, NULL, &ONE_THREAD, &err) == ICC_OK) {
                fresh = energy_of(other);
                icc_map_free(other);
            }
        }
        icc_domain_free(target);
    }
    qsort(ms, n, sizeof *ms, by_size);
    printf("| %s | %s %2.0f %% | %.1f | %.1f | %.3f | %zu | %zu | %.4f | %.4f | %zu |", name, how,
           100 * step, ms[n / 2], ms[n - 1], ms[n / 2] / making, n_refused, n_anew, energy_of(map),
           fresh, size_of(map));
    printf(n_not_embedded > 0 ? " %zu frames meet themselves\n" : "\n", n_not_embedded);
    (void)fflush(stdout);
    if (map != first)
        icc_map_free(map);
}

static icc_domain *read_domain(obj *o, const char *path)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    if (!obj_read(o, path)) {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(EXIT_FAILURE);
    }
    bench_check(
        icc_domain_create(&domain, 3, o->n_vertices, o->vertices, o->n_faces, o->faces, NULL, &err),
        &err);
    return domain;
}

int main(int argc, char **argv)
{
    static const double STEPS[] = {0.01, 0.05, 0.1};
    printf("| pair | frames | ms, median | most | of making it | refused | anew | energy | fresh | "
           "tetrahedra |\n");
    for (int k = 1; k < argc; ++k) {
        char path[1024];
        obj before, after;
        icc_error err = {.size = sizeof err};
        icc_map *map;
        const size_t stem = strlen(argv[k]) - strlen(".src.obj");
        const char *slash = strrchr(argv[k], '/');
        (void)snprintf(path, sizeof path, "%.*s.tgt.obj", (int)stem, argv[k]);
        icc_domain *bare = read_domain(&before, argv[k]), *target = read_domain(&after, path);
        const double begin = bench_processor_seconds();
        bench_check(icc_map_create(&map, bare, target, NULL, &ONE_THREAD, &err), &err);
        const double making = 1e3 * (bench_processor_seconds() - begin);
        const body b = body_of(&after);
        char name[4] = {0};
        (void)snprintf(name, sizeof name, "%.3s", slash != NULL ? slash + 1 : argv[k]);
        printf("%s: %zu tetrahedra, made in %.1f ms, energy %.4f\n", name, size_of(map), making,
               energy_of(map));
        for (size_t s = 0; s < sizeof STEPS / sizeof *STEPS; ++s) {
            follow(name, "pulled", pull, STEPS[s], &b, bare, map, making);
            follow(name, "bent", bend, STEPS[s], &b, bare, map, making);
            follow(name, "twisted", twist, STEPS[s], &b, bare, map, making);
        }
        icc_map_free(map);
        icc_domain_free(bare);
        icc_domain_free(target);
        obj_free(&before);
        obj_free(&after);
    }
    return EXIT_SUCCESS;
}
