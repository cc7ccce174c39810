/* Hashes of what maps of given shapes give: their meshes, 200,000 points, a warped picture, frames of a
 * drag; and of weights and poses inside small outlines, by two kernels. The lines are the same on every
 * machine, with every compiler; bindings/js/parity.sh compares.
 *
 * cages hash SOURCE TARGET ...   prints the hashes
 * cages time SOURCE TARGET ...   prints the least CPU time of each part, in milliseconds, of all runs in two seconds;
 *                                nothing is hashed then
 *
 * Files with one vertex `x y` a line, or surfaces as OBJ. */
#include "../flat_mesh.h"
#include "digest.h"
#include "fixtures.h"

#include <icc/kernel.h>
#include <stdbool.h>
#include <time.h>
#ifdef __wasm__
#include <wasi/api.h>
#endif

enum {
    MOST = 100000, /* vertices of a shape */
    ACROSS = 400,  /* points of a lattice, in the plane */
    DOWN = 500,
    LAYERS = 24, /* in space, along each axis */
    SIDE = 512,  /* of the pictures */
    N_FRAMES = 30,
    N_FRAMES_SPACE = 4,
    FRAME_STEPS = 2,
    SMALL = 20, /* vertices of outlines that get weights */
    ENOUGH_MS = 2000,
    N_REPEATS = 3 /* at least: a virtual machine is slow at first */
};

typedef struct shape {
    int32_t dim;
    size_t n_vertices, n_facets;
    double vertices[3 * MOST];
    uint32_t facets[6 * MOST];
} shape;

static shape source, target;
static double moved[3 * MOST], points[3 * ACROSS * DOWN], images[3 * ACROSS * DOWN];
static uint8_t before[SIDE * SIDE], after[SIDE * SIDE];

static double cpu_ms(void)
{
#ifdef __wasm__
    __wasi_timestamp_t ns = 0;
    (void)__wasi_clock_time_get(__WASI_CLOCKID_PROCESS_CPUTIME_ID, 1, &ns);
    return (double)ns * 1e-6;
#else
    return (double)clock() * (1e3 / CLOCKS_PER_SEC);
#endif
}

static bool is_surface(const char *path)
{
    const size_t n = strlen(path);
    return n > 4 && strcmp(path + n - 4, ".obj") == 0;
}

/* An outline is brought to the picture, so that it shows something. */
static void fit(shape *s)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, size = 0;
    for (size_t i = 0; i < 2 * s->n_vertices; ++i)
        lower[i % 2] = s->vertices[i] < lower[i % 2] ? s->vertices[i] : lower[i % 2];
    for (size_t i = 0; i < 2 * s->n_vertices; ++i)
        size = s->vertices[i] - lower[i % 2] > size ? s->vertices[i] - lower[i % 2] : size;
    for (size_t i = 0; i < 2 * s->n_vertices; ++i)
        s->vertices[i] = (s->vertices[i] - lower[i % 2]) * (SIDE / size);
}

static void read_shape(const char *path, shape *s)
{
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    char line[256];
    s->dim = is_surface(path) ? 3 : 2;
    s->n_vertices = s->n_facets = 0;
    while (fgets(line, sizeof line, file) != NULL && s->n_vertices < MOST &&
           s->n_facets < 2 * MOST) {
        double *v = s->vertices + (size_t)s->dim * s->n_vertices;
        uint32_t *f = s->facets + 3 * s->n_facets;
        if (s->dim == 2 ? sscanf(line, "%lf %lf", v, v + 1) == 2
                        : sscanf(line, "v %lf %lf %lf", v, v + 1, v + 2) == 3)
            ++s->n_vertices;
        else if (s->dim == 3 && sscanf(line, "f %u%*[^ ] %u%*[^ ] %u", f, f + 1, f + 2) == 3) {
            for (int k = 0; k < 3; ++k)
                --f[k];
            ++s->n_facets;
        } else if (s->dim == 3 && sscanf(line, "f %u %u %u", f, f + 1, f + 2) == 3) {
            for (int k = 0; k < 3; ++k)
                --f[k];
            ++s->n_facets;
        }
    }
    (void)fclose(file);
    if (s->dim == 2)
        fit(s);
}

static icc_domain *domain_of_shape(const shape *s)
{
    return domain_of(s->dim, s->n_vertices, s->vertices, s->n_facets,
                     s->dim == 2 ? NULL : s->facets);
}

/* ---- parts; without a digest, to be timed, they make the same and hash nothing ---- */

static void digest_mesh(digest *d, const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    (void)icc_map_get_info(map, &info);
    const size_t dim = (size_t)info.dim, n = dim * info.n_vertices,
                 m = (dim + 1) * info.n_simplices;
    double *vertices = malloc((n + 1) * sizeof *vertices);
    double *mapped = malloc((n + 1) * sizeof *mapped);
    uint32_t *simplices = malloc((m + 1) * sizeof *simplices);
    if (vertices == NULL || mapped == NULL || simplices == NULL)
        exit(EXIT_FAILURE);
    icc_error err = {.size = sizeof err};
    must(flat_get_mesh(map, vertices, mapped, simplices), "icc_map_get_mesh", &err);
    if (d != NULL) {
        digest_i32(d, 1, &info.certified);
        digest_f64(d, n, vertices);
        digest_f64(d, n, mapped);
        digest_u32(d, m, simplices);
    }
    free(vertices);
    free(mapped);
    free(simplices);
}

/* A lattice that fills the source's box. */
static size_t make_points(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    (void)icc_domain_get_info(domain, &info);
    const size_t dim = (size_t)info.dim;
    const size_t sides[3] = {dim == 2 ? ACROSS : LAYERS, dim == 2 ? DOWN : LAYERS, LAYERS};
    const size_t n = dim == 2 ? ACROSS * DOWN : LAYERS * LAYERS * LAYERS;
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0, rest = i; k < dim; rest /= sides[k++]) {
            const double share = ((double)(rest % sides[k]) + 0.5) / (double)sides[k];
            points[dim * i + k] = info.lower[k] + share * (info.upper[k] - info.lower[k]);
        }
    return n;
}

static void digest_points(digest *d, const icc_map *map, size_t n)
{
    icc_error err = {.size = sizeof err};
    must(icc_map_apply(map, n, points, images, NULL, NULL, NULL), "icc_map_apply", &err);
    if (d != NULL)
        digest_f64(d, (size_t)source.dim * n, images);
}

static void digest_picture(digest *d, const icc_map *map)
{
    icc_error err = {.size = sizeof err};
    icc_picture from = {.size = sizeof from, .width = SIDE, .height = SIDE, .channels = 1};
    from.bytes = 1;
    from.stride = SIDE;
    icc_picture to = from;
    from.pixels = before;
    to.pixels = after;
    memset(after, 0, sizeof after);
    must(icc_map_warp(map, &from, &to, NULL, NULL, &err), "icc_map_warp", &err);
    if (d != NULL)
        digest_bytes(d, sizeof after, after);
}

/* The target in a frame: a corner on its way to the middle of its neighbours, a surface that grows. */
static void move_target(int frame)
{
    memcpy(moved, target.vertices, (size_t)target.dim * target.n_vertices * sizeof *moved);
    if (target.dim == 3) {
        for (size_t i = 0; i < target.n_vertices; ++i)
            moved[3 * i] *= 1 + 0.01 * frame;
        return;
    }
    const size_t n = target.n_vertices, at = n / 3;
    const double *a = target.vertices + 2 * (at - 1), *b = target.vertices + 2 * ((at + 1) % n);
    for (size_t k = 0; k < 2; ++k)
        moved[2 * at + k] += 0.02 * frame * (0.5 * (a[k] + b[k]) - moved[2 * at + k]);
}

/* A map that follows; a target that is refused leaves its status, and the map as it was. How many are. */
static int digest_frames(digest *d, const icc_map *start)
{
    icc_map *now = NULL;
    int refused = 0;
    for (int frame = 1; frame <= (target.dim == 2 ? N_FRAMES : N_FRAMES_SPACE); ++frame) {
        icc_domain *domain = NULL;
        icc_map *next = NULL;
        move_target(frame);
        int32_t status =
            icc_domain_create(&domain, target.dim, target.n_vertices, moved, target.n_facets,
                              target.dim == 2 ? NULL : target.facets, NULL, NULL);
        if (status == ICC_OK)
            status = icc_map_retarget(&next, now != NULL ? now : start, domain,
                                      &(icc_retarget_options){.size = sizeof(icc_retarget_options),
                                                              .iterations = FRAME_STEPS},
                                      NULL, NULL);
        icc_domain_free(domain);
        if (d != NULL)
            digest_i32(d, 1, &status);
        if (status != ICC_OK) {
            ++refused;
            continue;
        }
        digest_mesh(d, next);
        icc_map_free(now);
        now = next;
    }
    icc_map_free(now);
    return refused;
}

/* Weights of three corners, and the points in a pose of these. */
static void digest_kernel(digest *d, int32_t kernel, const icc_domain *domain, size_t n)
{
    icc_error err = {.size = sizeof err};
    icc_shape *outline;
    icc_sampling *sampling;
    icc_weights *weights;
    icc_binding *binding;
    enum { N_HANDLES = 3 };
    double handles[2 * N_HANDLES], transforms[6 * N_HANDLES];
    for (size_t h = 0; h < N_HANDLES; ++h)
        memcpy(handles + 2 * h, source.vertices + 2 * (h * source.n_vertices / N_HANDLES),
               2 * sizeof *handles);
    must(icc_shape_create(&outline, 2, 1, &domain, 0, NULL, 0, NULL, NULL, &err), "shape", &err);
    must(icc_sampling_create(&sampling, outline, NULL, NULL, &err), "sampling", &err);
    const icc_weights_options options = {.size = sizeof options, .kernel = kernel};
    must(icc_weights_create(&weights, sampling, N_HANDLES, handles, &options, NULL, &err),
         "weights", &err);
    must(icc_binding_create(&binding, weights, n / 40, points, 0, NULL, &err), "binding", &err);
    must(icc_pose_reset(2, N_HANDLES, transforms), "pose", &err);
    for (int frame = 0; frame < N_FRAMES; ++frame) {
        const double by[2] = {0.5, -0.25};
        must(icc_pose_move(2, transforms, by), "move", &err);
        must(icc_pose_turn(2, transforms + 6, handles + 2, NULL, 0.02), "turn", &err);
        must(icc_binding_pose(binding, transforms, images, NULL, NULL), "posed", &err);
        if (d != NULL)
            digest_f64(d, n / 20, images);
    }
    icc_binding_free(binding);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
    icc_shape_free(outline);
}

/* ---- lines ---- */

enum { MAP, MESH, POINTS, PICTURE, FRAMES, WENDLAND, GAUSS, N_PARTS };
static const char *const PARTS[N_PARTS] = {"map",    "mesh",     "points", "picture",
                                           "frames", "wendland", "gauss"};

/* All parts of one pair; a part that a shape does not have keeps an empty hash. Times are taken without
 * digests. How many frames were refused. */
static int run(digest digests[N_PARTS], double ms[N_PARTS])
{
    icc_error err = {.size = sizeof err};
    icc_domain *from = domain_of_shape(&source), *to = domain_of_shape(&target);
    icc_map *map;
    const size_t n = make_points(from);
    int refused = 0;
    double last = cpu_ms();
    must(icc_map_create(&map, from, to, NULL, NULL, &err), "icc_map_create", &err);
    for (int part = 0; part < N_PARTS; ++part) {
        digest *d = digests != NULL ? &digests[part] : NULL;
        if (d != NULL)
            *d = digest_of_nothing();
        const bool plane = source.dim == 2, small = plane && source.n_vertices <= SMALL;
        if (part == MESH)
            digest_mesh(d, map);
        if (part == POINTS)
            digest_points(d, map, n);
        if (part == PICTURE && plane)
            digest_picture(d, map);
        if (part == FRAMES)
            refused = digest_frames(d, map);
        if (part >= WENDLAND && small)
            digest_kernel(d, part == GAUSS ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND, from, n);
        const double now = cpu_ms();
        if (now - last < ms[part])
            ms[part] = now - last;
        last = now;
    }
    icc_map_free(map);
    icc_domain_free(from);
    icc_domain_free(to);
    return refused;
}

int main(int argc, char **argv)
{
    if (argc < 4 || argc % 2 != 0 ||
        (strcmp(argv[1], "hash") != 0 && strcmp(argv[1], "time") != 0)) {
        (void)fputs("usage: cages hash|time SOURCE TARGET ...\n", stderr);
        return EXIT_FAILURE;
    }
    const bool timed = strcmp(argv[1], "time") == 0;
    for (size_t i = 0; i < sizeof before; ++i)
        before[i] = (uint8_t)(7 * (i % SIDE) + 13 * (i / SIDE));
    for (int i = 2; i + 1 < argc; i += 2) {
        digest digests[N_PARTS];
        double ms[N_PARTS];
        for (int part = 0; part < N_PARTS; ++part)
            ms[part] = HUGE_VAL;
        read_shape(argv[i], &source);
        read_shape(argv[i + 1], &target);
        int refused = 0;
        const double until = cpu_ms() + ENOUGH_MS;
        for (int repeat = 0; repeat < 1 || (timed && (repeat < N_REPEATS || cpu_ms() < until));
             ++repeat)
            refused = run(timed ? NULL : digests, ms);
        const char *slash = strrchr(argv[i], '/');
        const char *name = slash != NULL ? slash + 1 : argv[i];
        (void)printf("%.*s", (int)strcspn(name, "."), name);
        for (int part = timed ? MAP : MESH; part < N_PARTS; ++part)
            if (timed)
                (void)printf(" %s %.2f", PARTS[part], ms[part]);
            else
                (void)printf(" %s %016llx", PARTS[part], (unsigned long long)digests[part].state);
        (void)printf(" refused %d\n", refused);
        (void)fflush(stdout);
    }
    return EXIT_SUCCESS;
}
