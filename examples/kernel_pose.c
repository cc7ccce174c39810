/* Kernel coordinates: handles move, and what is around them follows, without a mesh.
 *
 *     kernel_pose OUT.svg
 *
 * Four scenes, at rest on the left and posed on the right: a star with a handle at every corner; a
 * stick figure, which is a region (the head) and curves; a bar with a part in the middle that is to
 * stay rigid (in grey); a square with two parallel lines that stay straight and parallel while
 * handles are moved (not turned). */
#include <icc/kernel.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 16, LINES = 24, PIECES = 100 };

/* What becomes of a handle: it is turned by so many degrees, and moved. */
typedef struct move {
    size_t handle;
    double turn, by[2];
} move;

/* Counts of 0 end the lists. */
typedef struct scene {
    const char *name;
    size_t n_ring, n_vertices, n_segments, n_handles, n_edges, n_lines, n_moves;
    double ring[MOST][2];     /* the boundary of the region */
    double vertices[MOST][2]; /* of curves */
    uint32_t segments[MOST][2];
    double handles[MOST][2];
    uint32_t edges[MOST][2];
    icc_line lines[2];
    double rigid[3]; /* centre and radius */
    int32_t method;  /* `ICC_WEIGHTS_*` */
    move moves[MOST];
} scene;

static const double pi = 3.14159265358979323846;

static void check(icc_status status, const char *name, const icc_error *err)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "kernel_pose: %s: %s\n", name,
            err != NULL && err->message[0] != '\0' ? err->message : icc_status_name(status));
    exit(EXIT_FAILURE);
}

static void *allocate(size_t n, size_t size)
{
    void *memory = calloc(n > 0 ? n : 1, size);
    check(memory != NULL ? ICC_OK : ICC_ERR_MEMORY, "memory", NULL);
    return memory;
}

/* ------------------------------------------------------------------ weights */

static icc_sampling *spread(const scene *s, icc_domain **region)
{
    icc_error err = {.size = sizeof err};
    icc_shape *shape;
    icc_sampling *sampling;
    *region = NULL;
    check(icc_domain_create(region, 2, s->n_ring, s->ring[0], 0, NULL, NULL, &err), s->name, &err);
    check(icc_shape_create(&shape, 2, 1, (const icc_domain *const *)region, s->n_vertices,
                           s->vertices[0], s->n_segments, s->segments[0], NULL, &err),
          s->name, &err);
    check(icc_sampling_create(&sampling, shape, NULL, NULL, &err), s->name, &err);
    icc_shape_free(shape);
    return sampling;
}

/* Makes the part around a centre as rigid as can be. */
static icc_weights *stiffen(icc_weights *weights, const scene *s)
{
    icc_error err = {.size = sizeof err};
    icc_weights_info info = {.size = sizeof info};
    check(icc_weights_get_info(weights, &info), s->name, NULL);
    double *nodes = allocate(info.n_nodes, 2 * sizeof *nodes), energy[2];
    uint32_t *stiff = allocate(info.n_nodes, sizeof *stiff);
    size_t n = 0;
    check(icc_weights_get_nodes(weights, nodes, NULL, NULL, NULL), s->name, NULL);
    for (size_t i = 0; i < info.n_nodes; ++i)
        if (hypot(nodes[2 * i] - s->rigid[0], nodes[2 * i + 1] - s->rigid[1]) < s->rigid[2])
            stiff[n++] = (uint32_t)i;
    icc_weights *stiffened;
    check(icc_weights_stiffen(&stiffened, weights, n, stiff, NULL, energy, NULL, &err), s->name,
          &err);
    printf("%s: the energy of the rigid part falls from %.3g to %.3g\n", s->name, energy[0],
           energy[1]);
    icc_weights_free(weights);
    free(nodes);
    free(stiff);
    return stiffened;
}

static icc_weights *weigh(const scene *s, const icc_sampling *sampling)
{
    icc_error err = {.size = sizeof err};
    const icc_weights_options options = {.size = sizeof options,
                                         .method = s->method,
                                         .steps = 40,
                                         .n_edges = s->n_edges,
                                         .edges = s->edges[0],
                                         .n_lines = s->n_lines,
                                         .lines = s->lines};
    icc_weights *weights;
    check(icc_weights_create(&weights, sampling, s->n_handles, s->handles[0], &options, NULL, &err),
          s->name, &err);
    return s->rigid[2] > 0 ? stiffen(weights, s) : weights;
}

static void make_pose(const scene *s, double (*transforms)[6])
{
    check(icc_pose_reset(2, s->n_handles, transforms[0]), s->name, NULL);
    for (size_t i = 0; i < s->n_moves; ++i) {
        const move *m = &s->moves[i];
        check(icc_pose_turn(2, transforms[m->handle], s->handles[m->handle], NULL,
                            m->turn * pi / 180),
              s->name, NULL);
        check(icc_pose_move(2, transforms[m->handle], m->by), s->name, NULL);
    }
}

/* ------------------------------------------------------------------ drawing */

/* Short pieces of lines: pairs of points. */
typedef struct strokes {
    size_t n;
    double *ends; /* n * 4 */
} strokes;

/* Adds a segment in pieces; those with an end outside the region are left out unless it is NULL. */
static void add(strokes *to, const double from[2], const double end[2], const icc_domain *region)
{
    double *points = allocate(PIECES + 1, 2 * sizeof *points);
    int32_t where[PIECES + 1] = {0};
    for (size_t i = 0; i <= PIECES; ++i)
        for (size_t k = 0; k < 2; ++k)
            points[2 * i + k] = from[k] + (end[k] - from[k]) * (double)i / PIECES;
    if (region != NULL)
        check(icc_domain_locate(region, PIECES + 1, points, where, NULL, NULL, NULL), "grid", NULL);
    to->ends = realloc(to->ends, (to->n + PIECES) * 4 * sizeof *to->ends);
    check(to->ends != NULL ? ICC_OK : ICC_ERR_MEMORY, "memory", NULL);
    for (size_t i = 0; i < PIECES; ++i)
        if (region == NULL || (where[i] != ICC_OUTSIDE && where[i + 1] != ICC_OUTSIDE))
            memcpy(to->ends + 4 * to->n++, points + 2 * i, 4 * sizeof *points);
    free(points);
}

static strokes make_grid(const icc_domain *region)
{
    icc_domain_info box = {.size = sizeof box};
    check(icc_domain_get_info(region, &box), "grid", NULL);
    strokes grid = {0, NULL};
    for (int k = 0; k < 2; ++k) {
        double step = fmax(box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]) / LINES;
        for (double at = box.lower[k] + step / 2; at < box.upper[k]; at += step) {
            double from[2] = {box.lower[0], box.lower[1]}, end[2] = {box.upper[0], box.upper[1]};
            from[k] = end[k] = at;
            add(&grid, from, end, region);
        }
    }
    return grid;
}

/* A view: where the scene's origin is on the page, and the size of its unit. */
typedef struct view {
    FILE *svg;
    double x, y, scale;
} view;

static void draw(const view *v, const strokes *s, const double *ends, const char *style)
{
    fprintf(v->svg, "<path fill=\"none\" stroke-linecap=\"round\" %s d=\"", style);
    for (size_t i = 0; i < 2 * s->n; ++i) {
        const bool goes_on =
            i > 0 && memcmp(ends + 2 * i, ends + 2 * (i - 1), 2 * sizeof *ends) == 0;
        if (i % 2 == 1 || !goes_on)
            fprintf(v->svg, "%c%.1f %.1f", i % 2 == 0 ? 'M' : 'L', v->x + v->scale * ends[2 * i],
                    v->y - v->scale * ends[2 * i + 1]);
    }
    fputs("\"/>\n", v->svg);
}

/* Draws strokes at rest and posed. */
static void draw_both(const view v[2], const icc_weights *weights, double (*transforms)[6],
                      strokes s, const char *style)
{
    icc_error err = {.size = sizeof err};
    if (s.n > 0) {
        icc_binding *binding;
        double *posed = allocate(s.n, 4 * sizeof *posed);
        check(icc_binding_create(&binding, weights, 2 * s.n, s.ends, 0, NULL, &err), "binding",
              &err);
        check(icc_binding_pose(binding, transforms[0], posed, NULL, NULL), "pose", NULL);
        draw(&v[0], &s, s.ends, style);
        draw(&v[1], &s, posed, style);
        icc_binding_free(binding);
        free(posed);
    }
    free(s.ends);
}

static void draw_handles(const view v[2], const scene *s, double (*transforms)[6])
{
    for (size_t i = 0; i < s->n_handles; ++i)
        for (size_t side = 0; side < 2; ++side) {
            const double *t = transforms[i], *h = s->handles[i];
            double x = side == 0 ? h[0] : t[0] * h[0] + t[1] * h[1] + t[2],
                   y = side == 0 ? h[1] : t[3] * h[0] + t[4] * h[1] + t[5];
            fprintf(v->svg, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"#e8482c\"/>\n",
                    v[side].x + v[side].scale * x, v[side].y - v[side].scale * y);
        }
}

static void draw_scene(const scene *s, const view v[2])
{
    icc_domain *region;
    icc_sampling *sampling = spread(s, &region);
    icc_weights *weights = weigh(s, sampling);
    double transforms[MOST][6];
    strokes outline = {0, NULL}, lines = {0, NULL}, circle = {0, NULL};
    make_pose(s, transforms);
    for (size_t i = 0; i < s->n_ring; ++i)
        add(&outline, s->ring[i], s->ring[(i + 1) % s->n_ring], NULL);
    for (size_t i = 0; i < s->n_segments; ++i)
        add(&outline, s->vertices[s->segments[i][0]], s->vertices[s->segments[i][1]], NULL);
    for (size_t i = 0; i < s->n_lines; ++i)
        add(&lines, s->lines[i].from, s->lines[i].to, NULL);
    for (int i = 0; i < 32 && s->rigid[2] > 0; ++i) {
        double a = i * pi / 16, b = (i + 1) * pi / 16, r = s->rigid[2];
        double from[2] = {s->rigid[0] + r * cos(a), s->rigid[1] + r * sin(a)},
               end[2] = {s->rigid[0] + r * cos(b), s->rigid[1] + r * sin(b)};
        add(&circle, from, end, NULL);
    }
    draw_both(v, weights, transforms, circle, "stroke=\"#999\" stroke-width=\"5\"");
    draw_both(v, weights, transforms, make_grid(region), "stroke=\"#7aa6d8\"");
    draw_both(v, weights, transforms, outline, "stroke=\"#222\" stroke-width=\"2\"");
    draw_both(v, weights, transforms, lines, "stroke=\"#d08a00\" stroke-width=\"3\"");
    draw_handles(v, s, transforms);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
    icc_domain_free(region);
}

/* ------------------------------------------------------------------- scenes */

static scene make_star(void)
{
    scene s = {.name = "star",
               .n_ring = 10,
               .n_handles = 10,
               .n_edges = 10,
               .n_moves = 3,
               .moves = {{0, 40, {2.5, -1.5}}, {2, 0, {-1, -4}}, {8, -30, {1, 3}}}};
    for (uint32_t i = 0; i < 10; ++i) {
        double r = i % 2 == 0 ? 10 : 4.5, a = pi / 2 + i * pi / 5;
        s.ring[i][0] = s.handles[i][0] = r * cos(a);
        s.ring[i][1] = s.handles[i][1] = r * sin(a);
        s.edges[i][0] = i;
        s.edges[i][1] = (i + 1) % 10;
    }
    return s;
}

static scene make_stick_figure(void)
{
    scene s = {.name = "stick figure",
               .n_ring = 5,
               .n_vertices = 13,
               .n_segments = 12,
               .n_handles = 14,
               .n_edges = 12,
               .n_moves = 8,
               .ring = {{0, 5.2}, {0.8, 5.9}, {0.7, 7.3}, {-0.7, 7.3}, {-0.8, 5.9}},
               .vertices = {{0, 5.2},
                            {0, 4.6},
                            {0, 1.6},
                            {-1.6, 3.4},
                            {-2.9, 2.4},
                            {1.6, 3.4},
                            {2.9, 2.4},
                            {-1.1, -0.6},
                            {-1.5, -3},
                            {1.1, -0.6},
                            {1.5, -3},
                            {-2.2, -3},
                            {2.2, -3}},
               .segments = {{0, 1},
                            {1, 2},
                            {1, 3},
                            {3, 4},
                            {1, 5},
                            {5, 6},
                            {2, 7},
                            {7, 8},
                            {2, 9},
                            {9, 10},
                            {8, 11},
                            {10, 12}},
               .handles = {{-0.7, 7.3}, {0.7, 7.3}},
               .edges = {{0, 1},
                         {2, 3},
                         {2, 4},
                         {4, 5},
                         {2, 6},
                         {6, 7},
                         {3, 8},
                         {8, 9},
                         {3, 10},
                         {10, 11},
                         {9, 12},
                         {11, 13}},
               .moves = {{5, 0, {0.2, 3.4}},
                         {4, 0, {-0.1, 1.6}},
                         {0, -15, {0.57, 0.11}},
                         {1, -15, {0.52, -0.25}},
                         {10, 0, {0.9, 0.9}},
                         {11, 0, {1.6, 0.9}},
                         {13, 0, {1.7, 1.2}},
                         {7, 0, {-1, -0.5}}}};
    memcpy(s.handles[2], s.vertices[1], 12 * sizeof s.handles[2]); /* all joints and ends */
    return s;
}

static scene make_bar(void)
{
    return (scene){.name = "rigid part",
                   .n_ring = 4,
                   .n_handles = 8,
                   .n_moves = 4,
                   .ring = {{0, 0}, {13, 0}, {13, 4}, {0, 4}},
                   .handles = {{0.5, 0.5},
                               {0.5, 3.5},
                               {3, 0.3},
                               {3, 3.7},
                               {10, 0.3},
                               {10, 3.7},
                               {12.5, 0.5},
                               {12.5, 3.5}},
                   .rigid = {6.5, 2, 1.9},
                   .method = ICC_WEIGHTS_L1,
                   .moves = {{4, 30, {-0.2, 0.8}},
                             {5, 30, {-1.9, 0.3}},
                             {6, 45, {-0.8, 2.4}},
                             {7, 45, {-2.9, 1.5}}}};
}

static scene make_square(void)
{
    return (scene){.name = "lines",
                   .n_ring = 4,
                   .n_handles = 6,
                   .n_lines = 2,
                   .n_moves = 3,
                   .ring = {{0, 0}, {10, 0}, {10, 10}, {0, 10}},
                   .handles = {{0.5, 0.5}, {9.5, 0.5}, {9.5, 9.5}, {0.5, 9.5}, {5, 1.5}, {5, 8.5}},
                   .lines = {{.from = {2, 3.5}, .to = {8, 3.5}},
                             {.from = {3.5, 6.5}, .to = {6.5, 6.5}, .parallel = 1}},
                   .moves = {{4, 0, {-1.5, 1.5}}, {5, 0, {2, -0.5}}, {2, 0, {-1, 2}}}};
}

int main(int argc, char **argv)
{
    FILE *svg = argc == 2 ? fopen(argv[1], "w") : NULL;
    if (svg == NULL) {
        fputs("usage: kernel_pose OUT.svg\n", stderr);
        return EXIT_FAILURE;
    }
    const scene scenes[] = {make_star(), make_stick_figure(), make_bar(), make_square()};
    const view places[] = {
        {svg, 160, 180, 13}, {svg, 820, 180, 22}, {svg, 30, 500, 20}, {svg, 690, 520, 20}};
    fputs("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"1320\" height=\"560\">\n"
          "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
          svg);
    for (size_t i = 0; i < 4; ++i) {
        view both[2] = {places[i], places[i]};
        both[1].x += 320;
        draw_scene(&scenes[i], both);
    }
    fputs("</svg>\n", svg);
    if (fclose(svg) != 0)
        return EXIT_FAILURE;
    printf("the result is %s\n", argv[1]);
    return EXIT_SUCCESS;
}
