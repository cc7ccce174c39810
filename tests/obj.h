/* Triangles of a Wavefront OBJ file: "v x y z" and "f a b c", without textures and normals. */
#ifndef TESTS_OBJ_H
#define TESTS_OBJ_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct obj {
    size_t n_vertices, n_faces;
    double *vertices;
    uint32_t *faces;
} obj;

static inline void obj_free(obj *o)
{
    free(o->vertices);
    free(o->faces);
    *o = (obj){0};
}

/* False when the file is not there. Indices that are out of range stay so. */
static inline bool obj_read(obj *o, const char *path)
{
    FILE *file = fopen(path, "r");
    char line[1024];
    *o = (obj){0};
    if (file == NULL)
        return false;
    for (size_t room = 0; fgets(line, sizeof line, file) != NULL;) {
        if (o->n_vertices + o->n_faces + 2 > room) {
            room = 2 * room + 1024;
            o->vertices = realloc(o->vertices, room * 3 * sizeof *o->vertices);
            o->faces = realloc(o->faces, room * 3 * sizeof *o->faces);
        }
        double *v = o->vertices + 3 * o->n_vertices;
        long f[3];
        if (sscanf(line, "v %lf %lf %lf", &v[0], &v[1], &v[2]) == 3) {
            ++o->n_vertices;
        } else if (sscanf(line, "f %ld%*[0-9/] %ld%*[0-9/] %ld", &f[0], &f[1], &f[2]) == 3 ||
                   sscanf(line, "f %ld %ld %ld", &f[0], &f[1], &f[2]) == 3) {
            for (int i = 0; i < 3; ++i)
                o->faces[3 * o->n_faces + (size_t)i] =
                    (uint32_t)(f[i] < 0 ? (long)o->n_vertices + f[i] : f[i] - 1);
            ++o->n_faces;
        }
    }
    (void)fclose(file);
    return true;
}

#endif
