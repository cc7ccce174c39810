/* Any polygon with any points: a triangulation that is what it must be, or a reason that holds. */
#include "../triangulation.h"
#include "fuzz.h"

enum { MOST_POINTS = 48 };

typedef struct input {
    size_t n_boundary, n_points;
    double points[2 * MOST_POINTS];
} input;

/* A signed number of few bits, so that points coincide and line up; or, as the first byte says,
 * that times a number that is no power of two, or a few last places off, or very large or small. */
static double decode(uint8_t style, uint8_t byte)
{
    const double coarse = (double)(byte >> 3) - 16.0;
    const double last_places = (double)(byte & 7) * 0x1p-48;
    switch (style >> 4 & 3) {
    case 0:
        return coarse;
    case 1:
        return 0.1 * coarse;
    case 2:
        return coarse + last_places;
    default:
        return byte == 128 ? 0.0 : ((double)byte - 128.0) * (style & 64 ? 0x1p180 : 0x1p-180);
    }
}

/* The first byte: its lower half and its highest bit say how many vertices there are, the rest how
 * to decode. Then x and y of each point. */
static void read_input(input *in, const uint8_t *data, size_t size)
{
    in->n_points = (size - 1) / 2 < MOST_POINTS ? (size - 1) / 2 : MOST_POINTS;
    in->n_boundary = 3u + (data[0] & 15u) + (data[0] & 128u) / 8;
    if (in->n_boundary > in->n_points)
        in->n_boundary = in->n_points;
    for (size_t i = 0; i < 2 * in->n_points; ++i)
        in->points[i] = decode(data[0], data[1 + i]);
}

static bool repeats(const input *in, size_t i)
{
    for (size_t j = 0; j < in->n_points; ++j) {
        const double *p = point_at(in->points, i), *q = point_at(in->points, j);
        if (i != j && is_on(p, p, q))
            return true;
    }
    return false;
}

static bool is_good(const input *in)
{
    for (size_t i = 0; i < in->n_points; ++i)
        if (repeats(in, i) ||
            (i >= in->n_boundary &&
             place_in_polygon(in->n_boundary, in->points, point_at(in->points, i)) <= 0))
            return false;
    return is_simple(in->n_boundary, in->points);
}

/* Whether the point that the error names deserves it. */
static bool is_culprit(const input *in, const icc_error *err)
{
    if (err->index < 0 || (size_t)err->index >= in->n_points)
        return false;
    const size_t i = (size_t)err->index;
    if (err->status == ICC_ERR_ARGUMENT)
        return repeats(in, i);
    return place_in_polygon(in->n_boundary, in->points, point_at(in->points, i)) <= 0 ||
           !is_simple(in->n_boundary, in->points);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const iccp_env env = {.memory = iccp_memory_default, .threads = 1};
    uint32_t triangles[6 * MOST_POINTS], neighbours[6 * MOST_POINTS];
    input in;
    if (size < 7)
        return 0;
    read_input(&in, data, size);
    icc_error err = {.size = sizeof err};
    const icc_status status = iccp_triangulate_mesh(in.n_boundary, in.n_points, in.points,
                                                    triangles, neighbours, &env, &err);
    require((status == ICC_OK) == is_good(&in));
    if (status == ICC_OK)
        require(find_triangulation_defect(in.n_boundary, in.n_points, in.points, triangles,
                                          neighbours) == NULL);
    else if (status != ICC_ERR_BOUNDARY)
        require(is_culprit(&in, &err));
    return 0;
}
