/* Surfaces from any bytes, most of them closed. */
#ifndef TESTS_FUZZ_BODIES_H
#define TESTS_FUZZ_BODIES_H

#include "../surfaces.h"

static inline int in_bar(int x, int y, int z)
{
    return x >= 0 && x < 3 && y == 1 && z == 1;
}

static inline void choose(surface *s, int which)
{
    if (which == 3) {
        surface_cells(s, 3, in_bar);
        return;
    }
    surface_octahedron(s);
    for (int i = 0; i < which; ++i)
        surface_split(s);
    for (size_t i = 0; i < 3 * s->n_vertices; ++i)
        s->vertices[i] *= 1 << which;
}

static inline double moved(double x, uint8_t byte)
{
    x += (double)(byte & 7) - (byte & 1 ? 4 : (double)(byte & 7));
    return byte & 64 ? nextafter(x, byte & 128 ? 10 : -10) : x;
}

static inline void read_surface(surface *s, const uint8_t *data, size_t size)
{
    static const double scales[4] = {1, 1e300, 1e-310, 0x1p-40};
    static const double offsets[4] = {0, 1e9, -0x1p50, 12345.678};
    const size_t n = 3 * s->n_vertices < size - 1 ? 3 * s->n_vertices : size - 1;
    for (size_t i = 0; i < n; ++i)
        s->vertices[i] = moved(s->vertices[i], data[1 + i]);
    for (size_t i = 0; i < 3 * s->n_vertices; ++i)
        s->vertices[i] = s->vertices[i] * scales[data[0] >> 2 & 3] + offsets[data[0] >> 4 & 3];
    for (size_t i = 1 + n; i + 1 < size; i += 2)
        s->faces[data[i] % (3 * s->n_faces)] = data[i + 1] % (uint32_t)(s->n_vertices + 1);
}

#endif
