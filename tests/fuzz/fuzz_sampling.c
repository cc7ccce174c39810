/* Any bytes as a shape, of up to two regions and a curve, and its samples: all are in the shape,
 * those on edges first, none too near another, and they survive being saved. */
#include "kernel/sampling/sampling.h"

#include "outlines.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { HEADER = 6, MOST_STICKS = 8 };

static icc_domain *read_region(const uint8_t *data, size_t size, int kind)
{
    double xy[2 * MAX_VERTICES];
    icc_domain *domain;
    const size_t n = read_outline(data, size, kind & 1, kind & 2, xy);
    place_outline(n, xy, kind >> 2 & 15);
    (void)icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, NULL);
    return domain;
}

/* A zigzag of as many segments as wanted. */
static icc_shape *make_shape(icc_domain *const *regions, size_t n_regions, size_t n_sticks,
                             uint8_t step)
{
    double vertices[2 * MOST_STICKS + 2];
    uint32_t segments[2 * MOST_STICKS];
    icc_shape *shape;
    for (uint32_t i = 0; i <= n_sticks; ++i) {
        vertices[2 * i] = 0.1 * step * i - 2;
        vertices[2 * i + 1] = i % 2 == 0 ? 0.5 : -0.5;
        if (i < n_sticks) {
            segments[2 * i] = i;
            segments[2 * i + 1] = i + 1;
        }
    }
    (void)icc_shape_create(&shape, 2, n_regions, (const icc_domain *const *)regions, n_sticks + 1,
                           vertices, n_sticks, segments, NULL, NULL);
    return shape;
}

static void check_samples(const icc_sampling *sampling)
{
    const icc_sampling_info *info = &sampling->info;
    require(info->n_samples > 0 && info->sigma > 0 && info->spacing > 0);
    for (size_t i = 0; i < info->n_samples; ++i) {
        const iccp_spot spot = iccp_shape_spot(sampling->shape, sampling->points + 2 * i);
        const int edge = spot.wall != ICCP_NOWHERE || spot.curve != ICCP_NOWHERE;
        require(edge || spot.region != ICCP_NOWHERE);
        require(info->kind == ICC_SAMPLING_GRID || edge == (i < info->n_edge));
    }
    require(info->n_samples == 1 || info->nearest >= 0.5499);
}

static void check_bytes(const icc_sampling *sampling)
{
    icc_sampling *loaded;
    size_t n;
    require(icc_sampling_save(sampling, 0, NULL, &n) == ICC_OK);
    void *data = malloc(n);
    require(data != NULL && icc_sampling_save(sampling, n, data, &n) == ICC_OK);
    require(icc_sampling_load(&loaded, n, data, NULL, NULL) == ICC_OK);
    require(memcmp(loaded->points, sampling->points,
                   2 * sampling->info.n_samples * sizeof(double)) == 0);
    icc_sampling_free(loaded);
    free(data);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    icc_domain *regions[2] = {NULL, NULL};
    icc_sampling *sampling;
    if (size < HEADER + 6)
        return 0;
    const size_t first = (size - HEADER) * data[0] / 256;
    regions[0] = read_region(data + HEADER, first, data[1]);
    regions[1] = read_region(data + HEADER + first, size - HEADER - first, data[2]);
    const size_t skip = regions[0] == NULL;
    const size_t n_regions = (size_t)(regions[0] != NULL) + (regions[1] != NULL);
    icc_shape *shape = make_shape(regions + skip, n_regions, data[3] % (MOST_STICKS + 1), data[4]);
    icc_domain_free(regions[0]);
    icc_domain_free(regions[1]);
    if (shape == NULL)
        return 0;
    double longest = fmax(shape->upper[0] - shape->lower[0], shape->upper[1] - shape->lower[1]);
    const icc_sampling_options options = {.size = sizeof options,
                                          .kind = data[5] & 1 ? 0 : ICC_SAMPLING_GRID,
                                          .steps = 1 + (data[5] >> 1 & 7),
                                          .spacing = longest / (3 + (data[5] >> 4)),
                                          .seed = data[5]};
    if (icc_sampling_create(&sampling, shape, &options, NULL, NULL) == ICC_OK) {
        check_samples(sampling);
        check_bytes(sampling);
        icc_sampling_free(sampling);
    }
    icc_shape_free(shape);
    return 0;
}
