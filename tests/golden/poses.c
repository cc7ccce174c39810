/* What the C library gives for a session of the studio's mode handles: reads what the page asked of
 * its engine, makes the same weights and poses, and prints the poses. The studio's test
 * (examples/studio/test/handles.test.js) writes the session and compares the numbers to the bit.
 *
 * poses < SESSION; what that holds: session.h. */
#include "fixtures.h"
#include "session.h"

#include <icc/kernel.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { MOST_KEPT = 256 };

/* The state of the session. */
static icc_sampling *sampling;
static icc_weights *kept[MOST_KEPT], *weights;
static icc_binding *binding;
static size_t n_handles;
static list handles, bound;

/* ---- nodes, and where they are ---- */

typedef struct nodes {
    size_t n;
    double *points, *values;
} nodes;

static nodes nodes_of(const icc_weights *w)
{
    icc_weights_info info = {.size = sizeof info};
    (void)icc_weights_get_info(w, &info);
    nodes all = {.n = info.n_nodes};
    all.points = room(2 * all.n, sizeof *all.points);
    all.values = room(n_handles * all.n, sizeof *all.values);
    must(icc_weights_get_nodes(w, all.points, NULL, all.values, NULL), "icc_weights_get_nodes",
         NULL);
    return all;
}

static void free_nodes(nodes *all)
{
    free(all->points);
    free(all->values);
}

/* ---- operations ---- */

static void become(icc_weights *w, size_t which)
{
    if (which >= MOST_KEPT) {
        (void)fprintf(stderr, "there are more than %d weights\n", MOST_KEPT);
        exit(EXIT_FAILURE);
    }
    if (kept[which] != w)
        icc_weights_free(kept[which]);
    weights = kept[which] = w;
    icc_binding_free(binding);
    binding = NULL;
}

/* Samples over the outline; with blue noise those on lines stand where the lines have their nodes. */
static void sample(const list *outline, double spacing, bool grid, const list *lines)
{
    icc_error err = {.size = sizeof err};
    icc_domain *domain = domain_of(2, outline->n / 2, outline->x, 0, NULL);
    icc_shape *shape;
    must(icc_shape_create(&shape, 2, 1, (const icc_domain *const *)&domain, 0, NULL, 0, NULL, NULL,
                          &err),
         "icc_shape_create", &err);
    size_t n_fixed = 0;
    double *fixed = NULL;
    for (size_t l = 0; l < lines->n / 5; ++l) {
        const double *from = lines->x + 5 * l, *to = from + 2;
        const double length =
            sqrt((to[0] - from[0]) * (to[0] - from[0]) + (to[1] - from[1]) * (to[1] - from[1]));
        const size_t n = (size_t)ceil(length / spacing);
        fixed = realloc(fixed, 2 * (n_fixed + n + 1) * sizeof *fixed);
        if (fixed == NULL)
            exit(EXIT_FAILURE);
        for (size_t k = 0; k <= n; ++k, ++n_fixed)
            for (size_t a = 0; a < 2; ++a)
                fixed[2 * n_fixed + a] = from[a] + (to[a] - from[a]) * (double)k / (double)n;
    }
    icc_sampling_options options = {.size = sizeof options,
                                    .kind = ICC_SAMPLING_BLUE,
                                    .spacing = spacing,
                                    .n_fixed = n_fixed,
                                    .fixed = fixed};
    if (grid)
        options = (icc_sampling_options){
            .size = sizeof options, .kind = ICC_SAMPLING_GRID, .spacing = spacing, .margin = 1};
    icc_sampling_free(sampling);
    must(icc_sampling_create(&sampling, shape, &options, NULL, &err), "icc_sampling_create", &err);
    icc_shape_free(shape);
    icc_domain_free(domain);
    free(fixed);
}

/* Weights that let the nodes within a ring move as if they were rigid. */
static icc_weights *stiffened(icc_weights *w, size_t n_ring, const double *ring)
{
    icc_error err = {.size = sizeof err};
    icc_domain *domain = domain_of(2, n_ring, ring, 0, NULL);
    nodes all = nodes_of(w);
    int32_t *where = room(all.n, sizeof *where);
    uint32_t *within = room(all.n, sizeof *within);
    must(icc_domain_locate(domain, all.n, all.points, where, NULL, NULL, NULL), "icc_domain_locate",
         NULL);
    size_t n = 0;
    for (size_t i = 0; i < all.n; ++i)
        if (where[i] == ICC_INSIDE)
            within[n++] = (uint32_t)i;
    icc_weights *stiff = w;
    if (n > 0) {
        must(icc_weights_stiffen(&stiff, w, n, within, NULL, NULL, NULL, &err),
             "icc_weights_stiffen", &err);
        icc_weights_free(w);
    }
    free(where);
    free(within);
    free_nodes(&all);
    icc_domain_free(domain);
    return stiff;
}

/* The same for all regions of a list. */
static icc_weights *stiffened_by(icc_weights *w, const list *regions)
{
    for (size_t at = 0; at < regions->n; at += 1 + (size_t)regions->x[at])
        w = stiffened(w, (size_t)regions->x[at] / 2, regions->x + at + 1);
    return w;
}

static void make(void)
{
    icc_error err = {.size = sizeof err};
    const size_t which = (size_t)number();
    icc_weights_options options = {.size = sizeof options, .method = (int32_t)number()};
    const double spacing = number();
    const bool grid = number() != 0;
    list outline = numbers();
    free(handles.x);
    handles = numbers();
    n_handles = handles.n / 2;
    list bones = numbers(), lines = numbers(), regions = numbers();
    sample(&outline, spacing, grid, &lines);
    uint32_t *edges = indices(&bones);
    icc_line *straight = room(lines.n / 5, sizeof *straight);
    for (size_t l = 0; l < lines.n / 5; ++l) {
        memcpy(straight[l].from, lines.x + 5 * l, 2 * sizeof *lines.x);
        memcpy(straight[l].to, lines.x + 5 * l + 2, 2 * sizeof *lines.x);
        straight[l].parallel = (int32_t)lines.x[5 * l + 4];
    }
    options.n_edges = bones.n / 2;
    options.edges = edges;
    options.n_lines = lines.n / 5;
    options.lines = straight;
    icc_weights *made;
    must(icc_weights_create(&made, sampling, n_handles, handles.x, &options, NULL, &err),
         "icc_weights_create", &err);
    become(stiffened_by(made, &regions), which);
    free(outline.x);
    free(bones.x);
    free(lines.x);
    free(regions.x);
    free(edges);
    free(straight);
}

/* How much of a stroke reaches a place: of several the most. */
static double brush(const list *strokes, double radius, const double *at)
{
    double most = 0;
    for (size_t s = 0; s + 1 < strokes->n; s += 2) {
        const double x = at[0] - strokes->x[s], y = at[1] - strokes->x[s + 1];
        const double d = (x * x + y * y) / (radius * radius),
                     height = d < 1 ? (1 - d) * (1 - d) : 0;
        most = height > most ? height : most;
    }
    return most;
}

static void paint(void)
{
    icc_error err = {.size = sizeof err};
    const size_t which = (size_t)number(), handle = (size_t)number();
    const double radius = number(), amount = number();
    const bool rigid = number() != 0;
    list strokes = numbers();
    nodes all = nodes_of(weights);
    uint32_t *near = room(all.n, sizeof *near);
    double *values = room(n_handles * all.n, sizeof *values),
           *rigidity = room(all.n, sizeof *rigidity);
    size_t n = 0;
    for (size_t i = 0; i < all.n; ++i) {
        const double height = brush(&strokes, radius, all.points + 2 * i);
        if (height == 0)
            continue;
        memcpy(values + n_handles * n, all.values + n_handles * i, n_handles * sizeof *values);
        values[n_handles * n + handle] += amount * height;
        rigidity[n] = fmax(1e-3, amount * height);
        near[n++] = (uint32_t)i;
    }
    icc_weights *made;
    if (rigid)
        must(icc_weights_stiffen(&made, weights, n, near, rigidity, NULL, NULL, &err),
             "icc_weights_stiffen", &err);
    else
        must(icc_weights_repaint(&made, weights, n, near, values, NULL, &err),
             "icc_weights_repaint", &err);
    become(made, which);
    free(strokes.x);
    free(near);
    free(values);
    free(rigidity);
    free_nodes(&all);
}

static void method(void)
{
    icc_error err = {.size = sizeof err};
    const size_t which = (size_t)number();
    const int32_t kind = (int32_t)number();
    list regions = numbers();
    icc_weights *made;
    must(icc_weights_with_method(&made, weights, kind, NULL, &err), "icc_weights_with_method",
         &err);
    become(stiffened_by(made, &regions), which);
    free(regions.x);
}

static void pose(void)
{
    icc_error err = {.size = sizeof err};
    list transforms = numbers(), changes = numbers();
    for (size_t c = 0; c + 4 <= changes.n; c += 4) {
        const size_t h = (size_t)changes.x[c];
        const double *offset = changes.x + c + 1, angle = changes.x[c + 3];
        if (angle != 0)
            must(icc_pose_turn(2, transforms.x + 6 * h, handles.x + 2 * h, NULL, angle),
                 "icc_pose_turn", NULL);
        must(icc_pose_move(2, transforms.x + 6 * h, offset), "icc_pose_move", NULL);
    }
    if (binding == NULL)
        must(icc_binding_create(&binding, weights, bound.n / 2, bound.x, 0, NULL, &err),
             "icc_binding_create", &err);
    double *images = room(bound.n, sizeof *images);
    must(icc_binding_pose(binding, transforms.x, images, NULL, NULL), "icc_binding_pose", NULL);
    print("transforms", transforms.n, transforms.x);
    print("images", bound.n, images);
    free(images);
    free(transforms.x);
    free(changes.x);
}

static void bind(void)
{
    free(bound.x);
    bound = numbers();
    icc_binding_free(binding);
    binding = NULL;
}

static void recall(void)
{
    const size_t which = (size_t)number();
    if (which >= MOST_KEPT || kept[which] == NULL) {
        (void)fprintf(stderr, "weights %zu were never made\n", which);
        exit(EXIT_FAILURE);
    }
    become(kept[which], which);
}

int main(void)
{
    static const struct {
        const char *name;
        void (*run)(void);
    } OPERATIONS[] = {{"make", make},     {"paint", paint}, {"method", method},
                      {"recall", recall}, {"bind", bind},   {"pose", pose}};
    enum { N = sizeof OPERATIONS / sizeof *OPERATIONS };
    char name[16];
    while (scanf("%15s", name) == 1) {
        size_t k = 0;
        while (k < N && strcmp(OPERATIONS[k].name, name) != 0)
            ++k;
        if (k == N) {
            (void)fprintf(stderr, "no operation is called %s\n", name);
            return EXIT_FAILURE;
        }
        OPERATIONS[k].run();
    }
    icc_binding_free(binding);
    for (size_t k = 0; k < MOST_KEPT; ++k)
        icc_weights_free(kept[k]);
    icc_sampling_free(sampling);
    free(handles.x);
    free(bound.x);
    return EXIT_SUCCESS;
}
