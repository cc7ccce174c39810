/* Writes one surface in each format. */
#include "cage/surface_write.h"

#include "base/bytes.h"

#include <string.h>

static const double *corner(const cage *c, size_t facet, size_t k)
{
    return c->points + 3 * c->facets[3 * facet + k];
}

static void write_vertices(FILE *stream, const cage *c, const char *before)
{
    for (const double *p = c->points; p < c->points + 3 * c->n; p += 3)
        fprintf(stream, "%s%.17g %.17g %.17g\n", before, p[0], p[1], p[2]);
}

static void write_faces(FILE *stream, const cage *c, const char *before, unsigned first)
{
    for (const uint32_t *f = c->facets; f < c->facets + 3 * c->n_facets; f += 3)
        fprintf(stream, "%s%u %u %u\n", before, (unsigned)f[0] + first, (unsigned)f[1] + first,
                (unsigned)f[2] + first);
}

static void write_obj(FILE *stream, const cage *c)
{
    write_vertices(stream, c, "v ");
    write_faces(stream, c, "f ", 1);
}

static void write_off(FILE *stream, const cage *c)
{
    fprintf(stream, "OFF\n%zu %zu 0\n", c->n, c->n_facets);
    write_vertices(stream, c, "");
    write_faces(stream, c, "3 ", 0);
}

/* Normals of 0 tell the reader to compute them. */
static void write_stl(FILE *stream, const cage *c)
{
    fputs("solid libicc\n", stream);
    for (size_t i = 0; i < c->n_facets; i++) {
        fputs("facet normal 0 0 0\n outer loop\n", stream);
        for (size_t k = 0; k < 3; k++) {
            const double *p = corner(c, i, k);
            fprintf(stream, "  vertex %.17g %.17g %.17g\n", p[0], p[1], p[2]);
        }
        fputs(" endloop\nendfacet\n", stream);
    }
    fputs("endsolid libicc\n", stream);
}

static void write_double(FILE *stream, double value)
{
    uint64_t bits;
    unsigned char bytes[8];
    memcpy(&bits, &value, 8);
    put_little_endian(bytes, (uint32_t)bits);
    put_little_endian(bytes + 4, (uint32_t)(bits >> 32));
    fwrite(bytes, 1, 8, stream);
}

static void write_ply(FILE *stream, const cage *c)
{
    fprintf(stream,
            "ply\nformat binary_little_endian 1.0\nelement vertex %zu\nproperty double x\n"
            "property double y\nproperty double z\nelement face %zu\n"
            "property list uchar int vertex_indices\nend_header\n",
            c->n, c->n_facets);
    for (size_t i = 0; i < 3 * c->n; i++)
        write_double(stream, c->points[i]);
    for (size_t i = 0; i < 3 * c->n_facets; i++) {
        unsigned char bytes[4];
        put_little_endian(bytes, c->facets[i]);
        if (i % 3 == 0)
            fputc(3, stream);
        fwrite(bytes, 1, 4, stream);
    }
}

void surface_write(FILE *stream, const cage *c, const char *format)
{
    static const struct {
        const char *name;
        void (*write)(FILE *stream, const cage *c);
    } writers[] = {{"OFF", write_off}, {"PLY", write_ply}, {"STL", write_stl}};
    for (size_t i = 0; i < sizeof writers / sizeof *writers; i++)
        if (strcmp(writers[i].name, format) == 0) {
            writers[i].write(stream, c);
            return;
        }
    write_obj(stream, c);
}
