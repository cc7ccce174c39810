/* Rotates vectors at vertices and in elements. */
#include "mesh/mesh_vectors.h"

#include "base/allocate.h"
#include "mesh/affine_map.h"
#include "mesh/mesh_lines.h"
#include "mesh/vtu.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* -------------------------------------------------------------------------- arrays */

mesh_vectors *vectors_begin(mesh_vector_list *l, bool in_elements)
{
    l->arrays = grow(l->arrays, &l->room, l->n + 1, sizeof *l->arrays);
    l->arrays[l->n] = (mesh_vectors){.in_elements = in_elements};
    return &l->arrays[l->n++];
}

void vectors_add(mesh_vectors *v, uint32_t item, const double value[3], size_t begin, size_t end)
{
    size_t i = v->n++;
    v->items = grow(v->items, &v->room_items, i + 1, sizeof *v->items);
    v->values = grow(v->values, &v->room_values, 3 * i + 3, sizeof *v->values);
    v->spans = grow(v->spans, &v->room_spans, 2 * i + 2, sizeof *v->spans);
    v->items[i] = item;
    memcpy(v->values + 3 * i, value, 3 * sizeof *value);
    v->spans[2 * i] = begin;
    v->spans[2 * i + 1] = end;
}

static void free_list(mesh_vector_list *l)
{
    for (size_t i = 0; i < l->n; i++) {
        free(l->arrays[i].items);
        free(l->arrays[i].values);
        free(l->arrays[i].spans);
    }
    free(l->arrays);
}

/* ----------------------------------------------------------------------- rotations */

/* Places where derivatives are wanted: of all vertices, or of all elements. */
typedef struct places {
    size_t n;
    double *points, *directions, *derivatives;
} places;

static void make_places(places *p, size_t n, size_t dim)
{
    *p = (places){.n = n,
                  .points = need(n, dim * sizeof(double)),
                  .directions = need(n, 3 * sizeof(double)),
                  .derivatives = need(n, dim * dim * sizeof(double))};
}

static void free_places(places *p)
{
    free(p->points);
    free(p->directions);
    free(p->derivatives);
}

/* The mean of the nodes of each element. */
static void find_centres(const mesh_file *m, places *p)
{
    for (size_t i = 0; i < m->n_elements; i++) {
        size_t begin = m->node_starts[i], end = m->node_starts[i + 1];
        for (size_t k = begin; k < end; k++)
            for (size_t x = 0; x < m->dim; x++)
                p->points[m->dim * i + x] +=
                    m->points[m->dim * m->nodes[k] + x] / (double)(end - begin);
    }
}

/* At a vertex of the boundary, the derivative is taken beside it: against the direction, which leads
 * away from the centres of its elements. */
static void find_directions(const mesh_file *m, const places *elements, places *p)
{
    memcpy(p->points, m->points, m->n_vertices * m->dim * sizeof *m->points);
    for (size_t i = 0; i < m->n_elements; i++)
        for (size_t k = m->node_starts[i]; k < m->node_starts[i + 1]; k++)
            for (size_t x = 0; x < m->dim; x++) {
                size_t v = m->nodes[k];
                p->directions[3 * v + x] +=
                    p->points[m->dim * v + x] - elements->points[m->dim * i + x];
            }
}

/* The image of a vector under the orthogonal part of a derivative, or of a normal. False if there is
 * none. */
static bool turn(double out[3], const mesh_file *m, const mesh_vectors *v, const places *p,
                 size_t i)
{
    double whole[12], part[12];
    const double *value = v->values + 3 * i;
    if (!carry_derivative(whole, m->dim, p->derivatives + m->dim * m->dim * v->items[i]))
        return false;
    if (v->are_normals)
        return affine_turn_normal(out, whole, value);
    if (!affine_rotation(part, whole))
        return false;
    affine_turn(out, part, value);
    return true;
}

/* --------------------------------------------------------------------------- writing */

static bool is_finite(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

static void put_vector(edits *e, const mesh_file *m, const mesh_vectors *v, size_t i,
                       const double image[3])
{
    edits_replace(e, v->spans[2 * i], v->spans[2 * i + 1]);
    for (size_t k = 0; k < 3; k++) {
        char bytes[8];
        if (m->form == MESH_TEXT) {
            edits_put_text(e, k > 0 ? " " : "");
            edits_put_number(e, image[k]);
            continue;
        }
        float single = (float)image[k];
        uint64_t bits;
        uint32_t half;
        memcpy(&half, &single, 4);
        memcpy(&bits, &image[k], 8);
        bits = v->width == 4 ? half : bits;
        for (size_t b = 0; b < v->width; b++)
            bytes[m->form == MESH_LITTLE ? b : v->width - 1 - b] = (char)(bits >> 8 * b & 255);
        edits_put(e, v->width, bytes);
    }
}

/* Rotates an array. A vector that is zero or not finite is as it was. */
static void rotate_array(edits *e, mesh_file *m, const mesh_vectors *v, const places *p,
                         mesh_rotated *out)
{
    double image[3];
    out->n_arrays++;
    out->n_vectors += v->n;
    for (size_t i = 0; i < v->n; i++) {
        const double *value = v->values + 3 * i;
        if (!is_finite(value) || !(affine_length(value) > 0))
            continue;
        if (!turn(image, m, v, p, i) || !is_finite(image)) {
            out->n_stay++;
            continue;
        }
        if (v->array != NULL)
            memcpy(v->array->changed + 3 * i, image, sizeof image);
        else
            put_vector(e, m, v, i, image);
    }
}

static bool derive(const mesh_mover *mover, places *p)
{
    return p->n == 0 || mover->derive(mover->data, p->n, p->points, p->directions, p->derivatives);
}

static bool rotate_all(mesh_file *m, const mesh_vector_list *l, const mesh_mover *mover,
                       mesh_rotated *out)
{
    bool at_vertices = false, in_elements = false;
    for (size_t i = 0; i < l->n; i++) {
        at_vertices = at_vertices || !l->arrays[i].in_elements;
        in_elements = in_elements || l->arrays[i].in_elements;
    }
    places vertices, elements;
    make_places(&vertices, m->n_vertices, m->dim);
    make_places(&elements, m->n_elements, m->dim);
    find_centres(m, &elements);
    find_directions(m, &elements, &vertices);
    bool good =
        (!at_vertices || derive(mover, &vertices)) && (!in_elements || derive(mover, &elements));
    edits e = {0};
    for (size_t i = 0; i < l->n && good; i++)
        rotate_array(&e, m, &l->arrays[i], l->arrays[i].in_elements ? &elements : &vertices, out);
    if (good && m->vtu == NULL)
        mesh_edit(m, &e);
    edits_free(&e);
    free_places(&vertices);
    free_places(&elements);
    return good;
}

bool mesh_rotate_vectors(mesh_file *m, const mesh_mover *mover, mesh_rotated *out, problem *wrong)
{
    static const struct {
        const char *format;
        bool (*find)(const mesh_file *, mesh_vector_list *, problem *);
    } finders[] = {
        {"VTK", vtk_find_vectors}, {"VTU", vtu_find_vectors}, {"Gmsh", gmsh_find_vectors}};
    mesh_vector_list l = {0};
    bool good = true;
    *out = (mesh_rotated){0};
    *wrong = (problem){0};
    for (size_t i = 0; i < sizeof finders / sizeof *finders; i++)
        if (strcmp(m->format, finders[i].format) == 0)
            good = finders[i].find(m, &l, wrong);
    if (good && l.n > 0)
        good = rotate_all(m, &l, mover, out);
    free_list(&l);
    return good;
}
