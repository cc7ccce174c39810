/* What a binary glTF file says of its positions in JSON, which must follow them: their bounds. */
#include "mesh/mesh_lines.h"

#include "base/bytes.h"
#include "mesh/glb.h"

#include <stdlib.h>
#include <string.h>

/* The least and the greatest of each coordinate; those that the mesh leaves alone as in the file. */
static void find_bounds(const mesh_file *m, const glb_positions *set, const double *points,
                        double bounds[2][3])
{
    for (size_t k = 0; k < 3; k++)
        for (size_t i = 0; i < set->items.n; i++) {
            const char *at = m->text + set->items.at + i * set->items.stride + 4 * k;
            double x = k < m->dim ? points[m->dim * (set->first + i) + k]
                                  : (double)little_endian_float(at);
            bounds[0][k] = i == 0 || x < bounds[0][k] ? x : bounds[0][k];
            bounds[1][k] = i == 0 || x > bounds[1][k] ? x : bounds[1][k];
        }
}

static void set_bounds(cJSON *accessor, const char *name, const double bounds[3])
{
    cJSON_DeleteItemFromObjectCaseSensitive(accessor, name);
    cJSON_AddItemToObject(accessor, name, cJSON_CreateDoubleArray(bounds, 3));
}

static void write_chunk_head(size_t n, const char *type, FILE *stream)
{
    unsigned char bytes[4];
    put_little_endian(bytes, (uint32_t)n);
    fwrite(bytes, 1, 4, stream);
    fwrite(type, 1, 4, stream);
}

/* The JSON is padded with blanks to a multiple of four bytes. */
static void write_json(const mesh_file *m, const glb *g, const char *json, FILE *stream)
{
    size_t n = strlen(json), padded = (n + 3) / 4 * 4, behind = m->n_text - g->json_end;
    unsigned char total[4];
    put_little_endian(total, (uint32_t)(20 + padded + behind));
    fwrite(m->text, 1, 8, stream);
    fwrite(total, 1, 4, stream);
    write_chunk_head(padded, "JSON", stream);
    fwrite(json, 1, n, stream);
    fwrite("   ", 1, padded - n, stream);
}

size_t glb_write_head(const mesh_file *m, const double *points, FILE *stream)
{
    problem none;
    glb g;
    glb_open(&g, m->text, m->n_text, &none); /* as it has been before */
    for (size_t s = 0; s < g.n_sets; s++) {
        const glb_positions *set = &g.sets[s];
        cJSON *accessor = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(g.json, "accessors"),
                                             (int)set->accessor);
        double bounds[2][3];
        find_bounds(m, set, points, bounds);
        set_bounds(accessor, "min", bounds[0]);
        set_bounds(accessor, "max", bounds[1]);
    }
    char *json = cJSON_PrintUnformatted(g.json);
    if (json == NULL)
        exit(failed(NULL, 0, "not enough memory to write glTF"));
    size_t end = g.json_end;
    write_json(m, &g, json, stream);
    cJSON_free(json);
    glb_close(&g);
    return end;
}
