/* Carries the normals of OBJ and PLY. glb_vectors.c does so for glTF. */
#include "mesh/mesh_carry.h"

#include "base/allocate.h"
#include "mesh/affine_map.h"
#include "mesh/vtu.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool carry_derivative(double out[12], size_t dim, const double *derivative)
{
    affine_identity(out);
    for (size_t i = 0; i < dim * dim; i++) {
        if (!isfinite(derivative[i]))
            return false;
        out[i / dim * 4 + i % dim] = derivative[i];
    }
    return true;
}

/* ------------------------------------------------------ normals of OBJ, PLY */

/* The normal and the vertex of use k. False: the file has no such normal, or it is zero. */
static bool take_use(const mesh_normals *of, size_t k, size_t *normal, size_t *vertex)
{
    *normal = of->uses[2 * k];
    *vertex = of->uses[2 * k + 1];
    if (*normal >= of->n)
        return false;
    const double *v = of->values + 3 * *normal;
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]) && affine_length(v) > 0;
}

/* The derivatives at all vertices that have normals, NaN at others. */
static double *derive(const mesh_file *m, const mesh_mover *mover)
{
    const mesh_normals *of = &m->vertex_normals;
    size_t n = 0, square = m->dim * m->dim, *at = need(m->n_vertices, sizeof *at);
    double *points = need(m->n_vertices, m->dim * sizeof *points);
    double *directions = need(m->n_vertices, 3 * sizeof *directions);
    double *found = need(m->n_vertices, square * sizeof *found);
    double *out = need(m->n_vertices, square * sizeof *out);
    for (size_t k = 0; k < of->n_uses; k++) {
        size_t normal, vertex;
        if (!take_use(of, k, &normal, &vertex) || at[vertex] > 0)
            continue;
        memcpy(points + m->dim * n, m->points + m->dim * vertex, m->dim * sizeof *points);
        memcpy(directions + 3 * n, of->values + 3 * normal, 3 * sizeof *directions);
        at[vertex] = ++n;
    }
    bool good = n == 0 || mover->derive(mover->data, n, points, directions, found);
    for (size_t i = 0; i < m->n_vertices && good; i++)
        for (size_t k = 0; k < square; k++)
            out[square * i + k] = at[i] > 0 ? found[square * (at[i] - 1) + k] : (double)NAN;
    free(at);
    free(points);
    free(directions);
    free(found);
    if (!good)
        free(out);
    return good ? out : NULL;
}

/* The image of a normal at one of its vertices, of length 1. */
static bool turn(double out[3], const mesh_file *m, const double *derivatives, size_t k,
                 size_t *normal)
{
    size_t vertex;
    double derivative[12];
    const mesh_normals *of = &m->vertex_normals;
    return take_use(of, k, normal, &vertex) &&
           carry_derivative(derivative, m->dim, derivatives + m->dim * m->dim * vertex) &&
           affine_turn_normal(out, derivative, of->values + 3 * *normal) &&
           affine_set_length(out, 1);
}

/* A normal of several vertices becomes the mean of its images. `images` has 3 numbers for each normal,
 * all 0 for a normal without an image. */
static void turn_all(const mesh_file *m, const double *derivatives, double *images,
                     mesh_carried *out)
{
    const mesh_normals *of = &m->vertex_normals;
    size_t normal;
    double image[3];
    for (size_t k = 0; k < of->n_uses; k++)
        if (turn(image, m, derivatives, k, &normal))
            for (size_t x = 0; x < 3; x++)
                images[3 * normal + x] += image[x];
    for (size_t i = 0; i < of->n; i++)
        affine_set_length(images + 3 * i, 1);
    for (size_t k = 0; k < of->n_uses; k++)
        if (turn(image, m, derivatives, k, &normal)) {
            const double *mean = images + 3 * normal;
            double apart[3] = {image[0] - mean[0], image[1] - mean[1], image[2] - mean[2]};
            double degrees = 2 * asin(fmin(affine_length(apart) / 2, 1)) * 57.29577951308232;
            out->shared = fmax(out->shared, degrees);
        }
}

void mesh_edit(mesh_file *m, edits *e)
{
    char *before = m->own;
    m->own = edits_apply(e, m->text, &m->n_text, m->spans, 2 * m->n_vertices * m->n_spans);
    m->text = m->own;
    m->carried = true;
    free(before);
}

/* The text of a normal in the file's form. */
static size_t print_span(const mesh_file *m, const double *image, size_t k, char out[96])
{
    const mesh_normals *of = &m->vertex_normals;
    if (m->form == MESH_TEXT && of->n_spans == 1)
        return (size_t)snprintf(out, 96, "%.17g %.17g %.17g", image[0], image[1], image[2]);
    double number = image[of->order[k]];
    if (m->form == MESH_TEXT)
        return (size_t)snprintf(out, 96, "%.17g", number);
    float single = (float)number;
    uint64_t bits = 0;
    uint32_t half;
    memcpy(&half, &single, 4);
    memcpy(&bits, &number, 8);
    bits = of->width == 4 ? half : bits;
    for (size_t i = 0; i < of->width; i++)
        out[m->form == MESH_LITTLE ? i : of->width - 1 - i] = (char)(bits >> 8 * i & 255);
    return of->width;
}

/* Writes new normals into the text. Those without an image stay. */
static void rewrite(mesh_file *m, const double *images)
{
    const mesh_normals *of = &m->vertex_normals;
    edits e = {0};
    for (size_t i = 0; i < of->n * of->n_spans; i++) {
        char out[96];
        const double *image = images + 3 * (i / of->n_spans),
                     *old = of->values + 3 * (i / of->n_spans);
        double scaled[3], length = affine_length(old);
        if (!(affine_length(image) > 0))
            continue;
        for (size_t x = 0; x < 3; x++)
            scaled[x] = image[x] * length;
        edits_replace(&e, of->spans[2 * i], of->spans[2 * i + 1]);
        edits_put(&e, print_span(m, scaled, i % of->n_spans, out), out);
    }
    mesh_edit(m, &e);
    edits_free(&e);
}

static bool carry_normals(mesh_file *m, const mesh_mover *mover, mesh_carried *out)
{
    const mesh_normals *of = &m->vertex_normals;
    double *derivatives = derive(m, mover);
    if (derivatives == NULL)
        return false;
    double *images = need(of->n, 3 * sizeof *images);
    turn_all(m, derivatives, images, out);
    bool *used = need(of->n, sizeof *used);
    for (size_t k = 0; k < of->n_uses; k++) {
        size_t normal, vertex;
        if (take_use(of, k, &normal, &vertex))
            used[normal] = true;
    }
    for (size_t i = 0; i < of->n; i++) {
        out->n_vectors += used[i];
        out->n_stay += used[i] && !(affine_length(images + 3 * i) > 0);
    }
    rewrite(m, images);
    free(used);
    free(images);
    free(derivatives);
    return true;
}

/* ---------------------------------------------------------------------- all */

/* True if a line begins with a word. */
static bool has_line(const mesh_file *m, const char *word)
{
    size_t n = strlen(word);
    const char *p = m->text, *end = p + m->n_text;
    while ((p = memchr(p, '\n', (size_t)(end - p))) != NULL && (size_t)(end - ++p) > n)
        if (memcmp(p, word, n) == 0)
            return true;
    return false;
}

/* True if the file has normals that no reader takes: those of VTK and Medit, whole numbers in PLY, and
 * normals of OBJ that no face uses. */
static bool has_others(const mesh_file *m)
{
    const mesh_normals *of = &m->vertex_normals;
    for (size_t i = 0; m->vtu != NULL && i < m->vtu->n_arrays; i++)
        if (m->vtu->arrays[i].is_normal)
            return true;
    return strcmp(m->format, "VTK") == 0 || strcmp(m->format, "Medit") == 0
               ? has_line(m, "NORMALS ") || has_line(m, "Normals")
           : strcmp(m->format, "PLY") == 0 ? of->n_spans == 0 && strstr(m->text, " nx") != NULL
                                           : of->n > 0 && of->n_uses == 0;
}

bool mesh_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
                problem *wrong)
{
    *out = (mesh_carried){0};
    *wrong = (problem){0};
    if (mesh_is_glb(m->text, m->n_text))
        return glb_carry(m, images, mover, out, wrong);
    out->other = has_others(m);
    if (m->vertex_normals.n_uses == 0)
        return true;
    if (mover != NULL)
        return carry_normals(m, mover, out);
    out->n_vectors = m->vertex_normals.n;
    return true;
}
