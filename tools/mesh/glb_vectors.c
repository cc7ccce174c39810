/* Carries the normals, tangents and morph targets of a glTF scene along with its positions. Joints
 * are moved by glb_joints.c.
 *
 * Khronos Group, glTF 2.0 Specification, 2021: section 3.7.2 (meshes). A morph target displaces a vertex
 * by d, so its image displaces the vertex's image by map(p + d) - map(p). Normals turn by the inverse
 * transpose of the derivative, tangents by the derivative. The map acts in the scene, where nodes have
 * placed the meshes. */
#include "mesh/mesh_carry.h"

#include "base/allocate.h"
#include "base/bytes.h"
#include "base/gltf_pack.h"
#include "base/json_in.h"
#include "mesh/affine_map.h"
#include "mesh/glb.h"
#include "mesh/glb_joints.h"
#include "mesh/mesh_lines.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* -------------------------------------------------------------------- find */

typedef struct finder {
    const glb *g;
    glb_vectors *list;
    size_t n, room;
    size_t *of; /* of each accessor: its number in the list, from 1 */
    bool *other;
    problem *wrong;
} finder;

/* Adds vectors to the list. Directions that cannot be read stay as they are. Displacements would
 * then be wrong, so they are refused. */
static bool find(finder *f, const json_item *index, glb_vectors v)
{
    static const char *const names[] = {"NORMAL", "TANGENT", "a morph target's POSITION",
                                        "a morph target's NORMAL", "a morph target's TANGENT"};
    if (index == NULL)
        return true;
    const size_t n = f->g->sets[v.set].items.n;
    problem why;
    bool good =
        glb_find_items(f->g, index, names[v.use], v.use == GLB_TANGENT ? GLB_FOUR : GLB_THREE,
                       &v.accessor, &v.items, &why);
    if (good && v.items.n != n)
        good = spoilt(&why, 0, "accessors[%zu], for %s, has %zu items for %zu vertices", v.accessor,
                      names[v.use], v.items.n, n);
    if (!good && v.use == GLB_MORPH) {
        *f->wrong = why;
        return false;
    }
    if (!good) {
        *f->other = true;
        return true;
    }
    if (f->of[v.accessor] == 0) {
        f->list = grow(f->list, &f->room, f->n + 1, sizeof *f->list);
        f->list[f->n++] = v;
        f->of[v.accessor] = f->n;
        return true;
    }
    glb_vectors *first = &f->list[f->of[v.accessor] - 1];
    first->shared = first->shared || first->use != v.use || first->set != v.set ||
                    first->base != v.base || first->morph != v.morph;
    return true;
}

static size_t number_of(const json_item *index)
{
    bool good = json_is(index, JSON_NUMBER) && index->number >= 0 && index->number < UINT32_MAX;
    return good ? (size_t)index->number : SIZE_MAX;
}

/* NULL for an accessor of zeros, which has no bytes. */
static const json_item *with_bytes(const glb *g, const json_item *index)
{
    size_t i = number_of(index);
    bool zeros = i < g->n_accessors && json_get(g->accessors[i], "bufferView") == NULL &&
                 json_get(g->accessors[i], "sparse") == NULL;
    return zeros ? NULL : index;
}

static bool find_all(finder *f, const json_item *primitive)
{
    const json_item *attributes = json_get(primitive, "attributes");
    const json_item *normal = json_get(attributes, "NORMAL"),
                    *tangent = json_get(attributes, "TANGENT");
    size_t set = f->g->set_of[number_of(json_get(attributes, "POSITION"))];
    glb_vectors v = {.set = set, .base = SIZE_MAX, .morph = SIZE_MAX};
    v.use = GLB_NORMAL;
    bool good = find(f, normal, v);
    v.use = GLB_TANGENT;
    good = good && find(f, tangent, v);
    const json_item *target = json_first(json_get(primitive, "targets"));
    for (; target != NULL; target = json_next(target)) {
        const json_item *places = with_bytes(f->g, json_get(target, "POSITION"));
        v.use = GLB_MORPH;
        v.base = v.morph = SIZE_MAX;
        good = good && find(f, places, v);
        v.morph = places != NULL ? number_of(places) : SIZE_MAX;
        v.use = GLB_MORPH_NORMAL;
        v.base = number_of(normal);
        good = good && find(f, with_bytes(f->g, json_get(target, "NORMAL")), v);
        v.use = GLB_MORPH_TANGENT;
        v.base = number_of(tangent);
        good = good && find(f, with_bytes(f->g, json_get(target, "TANGENT")), v);
    }
    return good;
}

glb_vectors *glb_find_vectors(const glb *g, size_t *n, bool *other, problem *wrong)
{
    finder f = {.g = g, .other = other, .wrong = wrong};
    bool good = true;
    *other = false;
    f.of = need(g->n_accessors, sizeof *f.of);
    for (size_t i = 0; i < g->n_primitives && good; i++)
        good = find_all(&f, g->primitives[i]);
    free(f.of);
    if (!good)
        free(f.list);
    *n = good ? f.n : 1;
    return good ? f.list : NULL;
}

/* ------------------------------------------------------------------- apart */

/* Marks bytes that will be written. No byte may belong to two accessors, because they would need
 * different numbers there. */
static bool claim(bool *taken, size_t accessor, const glb_items *items, problem *wrong)
{
    for (size_t i = 0; i < items->n; i++)
        for (size_t k = 0; k < items->size; k++) {
            bool *byte = &taken[items->at + i * items->stride + k];
            if (*byte)
                return spoilt(wrong, 0,
                              "accessors[%zu] shares bytes with another one, but their values will "
                              "differ; save each with its own",
                              accessor);
            *byte = true;
        }
    return true;
}

/* Checks that no byte of indices will be written. before[i] counts the bytes before byte i that will be
 * written. */
static bool leaves_indices(const glb *g, const uint32_t *before, problem *wrong)
{
    for (size_t i = 0; i < g->n_primitives; i++) {
        const json_item *indices = json_get(g->primitives[i], "indices");
        problem none;
        size_t accessor;
        glb_items x;
        if (indices == NULL ||
            !glb_find_items(g, indices, "indices", GLB_INDICES, &accessor, &x, &none))
            continue;
        if (before[x.at] != before[x.at + (x.n - 1) * x.stride + x.size])
            return spoilt(wrong, 0,
                          "accessors[%zu], for indices, shares bytes with vertices, which change",
                          accessor);
    }
    return true;
}

bool glb_is_apart(const glb *g, size_t n_text, size_t n, const glb_vectors *vectors, problem *wrong)
{
    bool *taken = need(n_text, sizeof *taken), good = true;
    uint32_t *before = need(n_text + 1, sizeof *before);
    for (size_t s = 0; good && s < g->n_sets; s++)
        good = claim(taken, g->sets[s].accessor, &g->sets[s].items, wrong);
    for (size_t i = 0; good && i < n; i++)
        good = claim(taken, vectors[i].accessor, &vectors[i].items, wrong);
    for (size_t i = 0; i < n_text; i++)
        before[i + 1] = before[i] + taken[i];
    good = good && leaves_indices(g, before, wrong);
    free(taken);
    free(before);
    return good;
}

/* ------------------------------------------------------------------- carry */

typedef struct carrier {
    mesh_file *m;
    const glb *g;
    const double *images;
    const mesh_mover *mover;
    size_t n_vectors;
    const glb_vectors *vectors;
    size_t *of; /* of each accessor: the number of its vectors, from 1 */
    char *text; /* the text that is written */
    mesh_carried *out;
    problem *wrong;
} carrier;

static void take(double out[3], const char *text, const glb_items *items, size_t i)
{
    for (size_t k = 0; k < 3; k++)
        out[k] = (double)little_endian_float(text + items->at + i * items->stride + 4 * k);
}

static bool put(carrier *c, const glb_vectors *v, size_t i, const double value[3])
{
    char *at = c->text + v->items.at + i * v->items.stride;
    for (size_t k = 0; k < 3; k++) {
        if (!(fabs(value[k]) <= (double)FLT_MAX))
            return spoilt(c->wrong, 0, "item %zu of accessors[%zu] becomes too large for glTF", i,
                          v->accessor);
        put_little_endian_float(at + 4 * k, (float)value[k]);
    }
    return true;
}

static bool is_zero(const double v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

static bool is_finite(const double v[3])
{
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* The points of a list of vertices, each displaced if there is a target, and their images. In the plane
 * only the first two coordinates of the file are mapped. */
typedef struct spots {
    size_t n;
    size_t *vertices;    /* of the set */
    double *points;      /* n * dim, in the scene */
    double *images;      /* the same; NULL if not needed */
    double *directions;  /* 3 n, in the scene */
    double *derivatives; /* n * dim * dim; NULL if not needed */
} spots;

static void spots_free(spots *s)
{
    free(s->vertices);
    free(s->points);
    free(s->images);
    free(s->directions);
    free(s->derivatives);
}

static spots spots_make(const carrier *c, size_t n)
{
    size_t dim = c->m->dim;
    return (spots){.vertices = need(n, sizeof(size_t)),
                   .points = need(n, dim * sizeof(double)),
                   .images = need(n, dim * sizeof(double)),
                   .directions = need(n, 3 * sizeof(double)),
                   .derivatives = need(n, dim * dim * sizeof(double))};
}

/* The point of vertex i of a set in the scene, displaced in the file by d unless d is NULL. */
static void find_point(const carrier *c, size_t set, size_t i, const double *d, double *out)
{
    const glb_positions *positions = &c->g->sets[set];
    const mesh_place *place = glb_place(c->m, positions->first);
    const size_t dim = c->m->dim;
    double own[3];
    if (d == NULL || is_zero(d)) {
        memcpy(out, c->m->points + dim * (positions->first + i), dim * sizeof *out);
        return;
    }
    take(own, c->m->text, &positions->items, i);
    for (size_t k = 0; k < 3; k++)
        own[k] += d[k];
    if (place != NULL)
        affine_apply(out, place->out, own);
    else
        memcpy(out, own, dim * sizeof *out);
}

/* Carries displacements. Those that are zero stay zero. */
static bool carry_morph(carrier *c, const glb_vectors *v)
{
    const glb_positions *positions = &c->g->sets[v->set];
    const mesh_place *place = glb_place(c->m, positions->first);
    const size_t dim = c->m->dim, n = v->items.n;
    spots s = spots_make(c, n);
    bool good = true;
    for (size_t i = 0; good && i < n; i++) {
        double d[3];
        take(d, c->m->text, &v->items, i);
        if (is_zero(d))
            continue;
        s.vertices[s.n] = i;
        find_point(c, v->set, i, d, s.points + dim * s.n);
        s.n++;
        good = is_finite(d) ||
               spoilt(c->wrong, 0, "item %zu of accessors[%zu] is not finite", i, v->accessor);
    }
    if (good && s.n > 0 && v->shared)
        good =
            spoilt(c->wrong, 0,
                   "accessors[%zu] displaces several meshes, whose images differ; save each with "
                   "its own",
                   v->accessor);
    size_t n_failed = 0;
    good = good && (s.n == 0 || c->mover->map(c->mover->data, s.n, s.points, s.images, &n_failed));
    c->out->n_morphed += s.n;
    c->out->n_beyond += n_failed;
    for (size_t k = 0; good && k < s.n; k++) {
        double there[3], here[3], d[3];
        size_t vertex = positions->first + s.vertices[k];
        take(d, c->m->text, &v->items, s.vertices[k]);
        memcpy(there, s.images + dim * k, dim * sizeof *there);
        memcpy(here, c->images + dim * vertex, dim * sizeof *here);
        if (place != NULL) {
            affine_apply(there, place->in, s.images + dim * k);
            affine_apply(here, place->in, c->images + dim * vertex);
        }
        for (size_t x = 0; x < dim; x++)
            d[x] = there[x] - (double)(float)here[x];
        good = put(c, v, s.vertices[k], d);
    }
    spots_free(&s);
    return good;
}

/* Turns a direction of the file to the scene, without regard to length. */
static void find_direction(const mesh_place *place, bool normal, const double own[3], double out[3])
{
    memcpy(out, own, 3 * sizeof *out);
    if (place != NULL && normal)
        affine_turn_back(out, place->in, own);
    else if (place != NULL)
        affine_turn(out, place->out, own);
}

/* The image of a direction of the file, which the scene's derivative turns in the scene. */
static bool turn(double out[3], const mesh_place *place, bool normal, const double derivative[12],
                 const double own[3])
{
    double scene[3], image[3];
    find_direction(place, normal, own, scene);
    if (!normal)
        affine_turn(image, derivative, scene);
    else if (!affine_turn_normal(image, derivative, scene))
        return false;
    memcpy(out, image, sizeof image);
    if (place != NULL && normal)
        affine_turn_back(out, place->out, image);
    else if (place != NULL)
        affine_turn(out, place->in, image);
    return affine_set_length(out, affine_length(own));
}

/* The direction of vertex i. A target's is added to its base. False if it is zero or not finite. */
static bool take_direction(const carrier *c, const glb_vectors *v, size_t i, double out[3])
{
    take(out, c->m->text, &v->items, i);
    if (v->use == GLB_MORPH_NORMAL || v->use == GLB_MORPH_TANGENT) {
        double base[3];
        take(base, c->m->text, &c->vectors[c->of[v->base] - 1].items, i);
        for (size_t k = 0; k < 3; k++)
            out[k] += base[k];
    }
    return is_finite(out) && !is_zero(out);
}

/* Carries directions at the vertices, or at those displaced by a target. A target's directions are
 * written as differences from the images of their base, which has been written before. */
static bool carry_directions(carrier *c, const glb_vectors *v)
{
    const mesh_place *place = glb_place(c->m, c->g->sets[v->set].first);
    const bool normal = v->use == GLB_NORMAL || v->use == GLB_MORPH_NORMAL;
    const glb_vectors *morph = v->morph != SIZE_MAX ? &c->vectors[c->of[v->morph] - 1] : NULL;
    const glb_vectors *base = v->base != SIZE_MAX ? &c->vectors[c->of[v->base] - 1] : NULL;
    const size_t dim = c->m->dim, n = v->items.n;
    spots s = spots_make(c, n);
    for (size_t i = 0; i < n; i++) {
        double own[3], d[3] = {0, 0, 0};
        if (morph != NULL)
            take(d, c->m->text, &morph->items, i);
        if (!take_direction(c, v, i, own))
            continue;
        s.vertices[s.n] = i;
        find_point(c, v->set, i, d, s.points + dim * s.n);
        find_direction(place, normal, own, s.directions + 3 * s.n);
        s.n++;
    }
    bool good =
        s.n == 0 || c->mover->derive(c->mover->data, s.n, s.points, s.directions, s.derivatives);
    c->out->n_vectors += s.n;
    for (size_t k = 0; good && k < s.n; k++) {
        double own[3], turned[3], derivative[12];
        take_direction(c, v, s.vertices[k], own);
        if (!carry_derivative(derivative, dim, s.derivatives + dim * dim * k) ||
            !turn(turned, place, normal, derivative, own)) {
            memcpy(turned, own, sizeof turned);
            c->out->n_stay++;
        }
        if (base != NULL) {
            double from[3];
            take(from, c->text, &base->items, s.vertices[k]);
            for (size_t x = 0; x < 3; x++)
                turned[x] -= from[x];
        }
        good = put(c, v, s.vertices[k], turned);
    }
    spots_free(&s);
    return good;
}

/* False for directions that stay: they are shared, or their base or displacements could not be
 * read. */
static bool is_read(const carrier *c, const glb_vectors *v)
{
    bool target = v->use == GLB_MORPH_NORMAL || v->use == GLB_MORPH_TANGENT;
    if (v->shared || (v->morph != SIZE_MAX && c->of[v->morph] == 0))
        return false;
    return !target || (v->base < c->g->n_accessors && c->of[v->base] > 0 &&
                       !c->vectors[c->of[v->base] - 1].shared);
}

static bool carry_all(carrier *c)
{
    static const glb_use order[] = {GLB_MORPH, GLB_NORMAL, GLB_TANGENT, GLB_MORPH_NORMAL,
                                    GLB_MORPH_TANGENT};
    bool good = true;
    for (size_t u = 0; u < 5; u++)
        for (size_t i = 0; good && i < c->n_vectors; i++) {
            const glb_vectors *v = &c->vectors[i];
            if (v->use != order[u])
                continue;
            if (v->use == GLB_MORPH)
                good = carry_morph(c, v);
            else if (is_read(c, v))
                good = carry_directions(c, v);
            else
                c->out->other = true;
        }
    return good;
}

static void count_all(const carrier *c)
{
    for (size_t i = 0; i < c->n_vectors; i++) {
        const glb_vectors *v = &c->vectors[i];
        *(v->use == GLB_MORPH ? &c->out->n_morphed : &c->out->n_vectors) += v->items.n;
    }
}

/* Puts the changed text together. */
static void take_text(mesh_file *m, const glb *g, edits *e, const char *text)
{
    char *before = m->own;
    m->own = gltf_join(e, text + g->json_at, g->json->end, text + g->json_end,
                       m->n_text - g->json_end, &m->n_text);
    m->text = m->own;
    m->carried = true;
    free(before);
}

bool glb_carry(mesh_file *m, const double *images, const mesh_mover *mover, mesh_carried *out,
               problem *wrong)
{
    glb g;
    size_t n;
    problem none;
    glb_open(&g, m->text, m->n_text, &none); /* it was opened before, so this cannot fail */
    glb_vectors *vectors = glb_find_vectors(&g, &n, &out->other, wrong);
    carrier c = {.m = m,
                 .g = &g,
                 .images = images,
                 .mover = mover,
                 .n_vectors = vectors != NULL ? n : 0,
                 .vectors = vectors,
                 .of = need(g.n_accessors, sizeof(size_t)),
                 .out = out,
                 .wrong = wrong};
    bool good = vectors != NULL || n == 0;
    out->n_copies = m->n_copies;
    for (size_t i = 0; i < c.n_vectors; i++)
        c.of[vectors[i].accessor] = i + 1;
    if (good && mover == NULL)
        count_all(&c);
    c.text = need(m->n_text + 1, 1);
    memcpy(c.text, m->text, m->n_text);
    if (good && mover != NULL)
        good = glb_is_apart(&g, m->n_text, c.n_vectors, vectors, wrong) && carry_all(&c);
    edits e = {0};
    good = good && glb_carry_joints(&g, m->dim, c.text, m->n_text, c.n_vectors, vectors, &e, mover,
                                    out, wrong);
    if (good && mover != NULL)
        take_text(m, &g, &e, c.text);
    free(c.text);
    edits_free(&e);
    free(c.of);
    free(vectors);
    glb_close(&g);
    return good;
}
