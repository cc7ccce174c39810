/* A solid that moves, as one solid of four dimensions: its cells are voxels at moments. The
 * boundary in space and time is deformed - the motion slows down, and the solid leans over - and
 * what happens inside goes along. */
#include <icc/icc.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NX = 3, NY = 2, NZ = 2, NT = 3, N_CELLS = NX * NY * NZ * NT, N_EVENTS = 12 };

static void check(icc_status status, const icc_error *err)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "solid_through_time: %s\n",
            err != NULL ? err->message : icc_status_name(status));
    exit(EXIT_FAILURE);
}

/* A block of 2 x 2 x 2 voxels that steps aside at the last moment. */
static void fill(uint8_t cells[N_CELLS])
{
    for (int i = 0; i < N_CELLS; ++i) {
        const int x = i % NX, t = i / (NX * NY * NZ), first = t == NT - 1;
        cells[i] = x >= first && x < first + 2;
    }
}

static void deform(const double from[4], double to[4])
{
    to[0] = from[0] + 0.15 * from[2] * from[2]; /* leans over */
    to[1] = from[1];
    to[2] = from[2];
    to[3] = from[3] + from[3] * from[3] / 6; /* slows down */
}

static icc_domain *make_target(const icc_domain *source)
{
    icc_domain_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    icc_domain *target;
    check(icc_domain_get_info(source, &info), NULL);
    double *vertices = calloc(info.n_vertices, 4 * sizeof *vertices);
    uint32_t *facets = calloc(info.n_facets, 4 * sizeof *facets);
    if (vertices == NULL || facets == NULL)
        exit(EXIT_FAILURE);
    check(icc_domain_get_boundary(source, vertices, facets), NULL);
    for (size_t i = 0; i < info.n_vertices; ++i) {
        double moved[4];
        deform(vertices + 4 * i, moved);
        for (size_t k = 0; k < 4; ++k)
            vertices[4 * i + k] = moved[k];
    }
    check(
        icc_domain_create(&target, 4, info.n_vertices, vertices, info.n_facets, facets, NULL, &err),
        &err);
    printf("boundary: %zu vertices, %zu tetrahedra\n", info.n_vertices, info.n_facets);
    free(vertices);
    free(facets);
    return target;
}

int main(void)
{
    const size_t shape[4] = {NX, NY, NZ, NT};
    uint8_t cells[N_CELLS];
    icc_domain *source;
    icc_map *map;
    icc_error err = {.size = sizeof err};
    const icc_env env = {.size = sizeof env, .threads = 4};
    fill(cells);
    check(icc_domain_create_mask(&source, 4, shape, cells, NULL, &err), &err);
    icc_domain *target = make_target(source);
    check(icc_map_create(&map, source, target, NULL, &env, &err), &err);

    double events[N_EVENTS][4], images[N_EVENTS][4], back[N_EVENTS][4];
    for (int i = 0; i < N_EVENTS; ++i) {
        events[i][0] = 1.1 + 0.7 * fmod(0.618 * i, 1);
        events[i][1] = 0.2 + 1.6 * fmod(0.755 * i + 0.1, 1);
        events[i][2] = 0.2 + 1.6 * fmod(0.570 * i + 0.3, 1);
        events[i][3] = 0.2 + 2.6 * i / (N_EVENTS - 1);
    }
    size_t n_lost = 0, n_lost_back = 0;
    check(icc_map_apply(map, N_EVENTS, events[0], images[0], NULL, &n_lost, &env), NULL);
    check(icc_map_apply_inverse(map, N_EVENTS, images[0], back[0], NULL, &n_lost_back, &env), NULL);
    printf("      x      y      z      t  ->     x      y      z      t   and back within\n");
    for (int i = 0; i < N_EVENTS; ++i) {
        double error = 0;
        for (int k = 0; k < 4; ++k)
            error = fmax(error, fabs(back[i][k] - events[i][k]));
        for (int k = 0; k < 4; ++k)
            printf(" %6.3f", events[i][k]);
        fputs("  ", stdout);
        for (int k = 0; k < 4; ++k)
            printf(" %6.3f", images[i][k]);
        printf("   %.1e\n", error);
    }
    printf("%zu of %d events have no image\n", n_lost, (int)N_EVENTS);
    icc_map_free(map);
    icc_domain_free(target);
    icc_domain_free(source);
    return EXIT_SUCCESS;
}
