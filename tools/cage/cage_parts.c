/* Takes OBJ files with several objects apart, and pairs features by name. */
#include "cage/cage_parts.h"

#include "base/allocate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NO_PART UINT32_MAX

/* A part with faces, or with lines only. */
typedef struct part {
    const mesh_part *of; /* NULL: what comes before the first one */
    size_t first_triangle, end_triangle, first_line, end_line;
} part;

typedef struct parts {
    const mesh_file *mesh;
    size_t n;
    part *items;
    uint32_t *owner; /* of each vertex: the part whose faces have it, or NO_PART */
    uint32_t *local; /* of each vertex: its number in its part */
    bool share;      /* two parts share vertex `shared` */
    uint32_t shared, sharing[2];
    bool named; /* a part has one of the known names */
    uint32_t outer;
} parts;

/* True if the name begins with a word, in any case, and a letter does not follow. */
static bool is_called(const part *p, const char *word)
{
    size_t n = strlen(word);
    if (p->of == NULL || p->of->n_name < n)
        return false;
    for (size_t i = 0; i < n; i++) {
        char c = p->of->name[i];
        if ((c >= 'A' && c <= 'Z' ? c + 32 : c) != word[i])
            return false;
    }
    char next = p->of->n_name > n ? p->of->name[n] : '\0';
    return !((next >= 'a' && next <= 'z') || (next >= 'A' && next <= 'Z'));
}

/* Lists the parts that have faces or lines. Groups within objects are no parts. */
static void list_parts(parts *p)
{
    const mesh_file *m = p->mesh;
    bool has_objects = false;
    for (size_t i = 0; i < m->n_parts; i++)
        has_objects = has_objects || !m->parts[i].is_group;
    p->items = need(m->n_parts + 1, sizeof *p->items);
    p->items[p->n++] = (part){0};
    for (size_t i = 0; i <= m->n_parts; i++) {
        const mesh_part *next = i < m->n_parts ? &m->parts[i] : NULL;
        part *last = &p->items[p->n - 1];
        if (next != NULL && next->is_group && has_objects)
            continue;
        last->end_triangle = next != NULL ? next->first_triangle : m->n_triangles;
        last->end_line = next != NULL ? next->first_line : m->n_lines;
        if (last->end_triangle == last->first_triangle && last->end_line == last->first_line)
            p->n--;
        if (next != NULL)
            p->items[p->n++] = (part){
                .of = next, .first_triangle = next->first_triangle, .first_line = next->first_line};
    }
}

static bool has_faces(const part *p)
{
    return p->end_triangle > p->first_triangle;
}

/* Finds the part of each vertex, and numbers the vertices of each part in their order. */
static void find_owners(parts *p)
{
    const mesh_file *m = p->mesh;
    size_t *count = need(p->n, sizeof *count);
    p->owner = need(m->n_vertices, sizeof *p->owner);
    p->local = need(m->n_vertices, sizeof *p->local);
    for (size_t v = 0; v < m->n_vertices; v++)
        p->owner[v] = NO_PART;
    for (uint32_t i = 0; i < p->n; i++)
        for (size_t k = 3 * p->items[i].first_triangle; k < 3 * p->items[i].end_triangle; k++) {
            uint32_t v = m->triangles[k];
            if (p->owner[v] != NO_PART && p->owner[v] != i && !p->share) {
                p->share = true;
                p->shared = v;
                p->sharing[0] = p->owner[v];
                p->sharing[1] = i;
            }
            p->owner[v] = i;
        }
    for (size_t v = 0; v < m->n_vertices; v++)
        if (p->owner[v] != NO_PART)
            p->local[v] = (uint32_t)count[p->owner[v]]++;
    free(count);
}

/* The diagonal of a part's box. */
static double part_size(const parts *p, uint32_t i)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t v = 0; v < p->mesh->n_vertices; v++)
        for (size_t k = 0; p->owner[v] == i && k < 3; k++) {
            low[k] = fmin(low[k], p->mesh->points[3 * v + k]);
            high[k] = fmax(high[k], p->mesh->points[3 * v + k]);
        }
    return hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]);
}

/* Finds the outer surface: by its name, or the largest that is no void or surface by name. */
static void find_outer(parts *p)
{
    double most = -1;
    p->outer = NO_PART;
    for (uint32_t i = 0; i < p->n; i++) {
        const part *own = &p->items[i];
        bool is_outer = is_called(own, "outer");
        bool is_inner = is_called(own, "void") || is_called(own, "surface");
        p->named = p->named || (has_faces(own) && (is_outer || is_inner));
        if (!has_faces(own) || is_inner)
            continue;
        double size = is_outer ? HUGE_VAL : part_size(p, i);
        if (size > most) {
            most = size;
            p->outer = i;
        }
    }
}

static void free_parts(parts *p)
{
    free(p->items);
    free(p->owner);
    free(p->local);
}

cage_feature *cage_add_solid_feature(cage *c, int32_t kind, size_t n, const double *points,
                                     size_t n_facets, const uint32_t *facets, const char *label,
                                     size_t n_label)
{
    c->features = grow(c->features, &c->room_features, c->n_features + 1, sizeof *c->features);
    cage_feature *f = &c->features[c->n_features++];
    *f = (cage_feature){.kind = kind, .number = (int64_t)c->n_features, .n = n};
    f->points = need(n, 3 * sizeof *f->points);
    memcpy(f->points, points, 3 * n * sizeof *points);
    f->n_facets = n_facets;
    f->facets = need(n_facets, 3 * sizeof *f->facets);
    if (n_facets > 0)
        memcpy(f->facets, facets, 3 * n_facets * sizeof *facets);
    if (n_label > 0) {
        f->label = need(n_label + 1, 1);
        memcpy(f->label, label, n_label);
    }
    return f;
}

/* ---- taking apart ---- */

static void take_outer(cage *out, const parts *p, const size_t *vertex_lines)
{
    const mesh_file *m = p->mesh;
    const part *own = &p->items[p->outer];
    out->dim = 3;
    for (size_t v = 0; v < m->n_vertices; v++)
        if (p->owner[v] == p->outer)
            cage_add_point(out, m->points + 3 * v, vertex_lines[v]);
    for (size_t t = own->first_triangle; t < own->end_triangle; t++)
        for (size_t k = 0; k < 3; k++)
            cage_add_corner(out, k, p->local[m->triangles[3 * t + k]], m->triangle_lines[t]);
}

static void take_inner(cage *out, const parts *p, uint32_t i, const size_t *vertex_lines)
{
    const mesh_file *m = p->mesh;
    const part *own = &p->items[i];
    const size_t n_facets = own->end_triangle - own->first_triangle;
    double *points = need(m->n_vertices, 3 * sizeof *points);
    uint32_t *facets = need(n_facets, 3 * sizeof *facets);
    size_t n = 0, line = 0;
    for (size_t v = 0; v < m->n_vertices; v++)
        if (p->owner[v] == i) {
            line = n == 0 ? vertex_lines[v] : line;
            memcpy(points + 3 * n++, m->points + 3 * v, 3 * sizeof *points);
        }
    for (size_t k = 0; k < 3 * n_facets; k++)
        facets[k] = p->local[m->triangles[3 * own->first_triangle + k]];
    cage_add_solid_feature(out, is_called(own, "void") ? ICC_FEATURE_HOLE : ICC_FEATURE_REGION, n,
                           points, n_facets, facets, own->of != NULL ? own->of->name : "",
                           own->of != NULL ? own->of->n_name : 0)
        ->line = line;
    free(points);
    free(facets);
}

/* True if no vertex of a line belongs to a face. */
static bool is_free(const parts *p, size_t line)
{
    const mesh_file *m = p->mesh;
    for (size_t k = m->line_starts[line]; k < m->line_starts[line + 1]; k++)
        if (p->owner[m->line_nodes[k]] != NO_PART)
            return false;
    return true;
}

static void take_lines(cage *out, const parts *p, uint32_t i, const size_t *vertex_lines)
{
    const mesh_file *m = p->mesh;
    const part *own = &p->items[i];
    for (size_t l = own->first_line; l < own->end_line; l++) {
        const uint32_t *nodes = m->line_nodes + m->line_starts[l];
        const size_t n = m->line_starts[l + 1] - m->line_starts[l];
        if (!is_free(p, l))
            continue;
        double *points = need(n, 3 * sizeof *points);
        for (size_t k = 0; k < n; k++)
            memcpy(points + 3 * k, m->points + 3 * (size_t)nodes[k], 3 * sizeof *points);
        /* Several lines of one part have no names of their own. */
        const bool alone = own->end_line - own->first_line == 1 && own->of != NULL;
        cage_add_solid_feature(out, ICC_FEATURE_LINE, n, points, 0, NULL,
                               alone ? own->of->name : "", alone ? own->of->n_name : 0)
            ->line = vertex_lines[nodes[0]];
        free(points);
    }
}

static bool has_free_line(const parts *p)
{
    for (size_t l = 0; l < p->mesh->n_lines; l++)
        if (is_free(p, l))
            return true;
    return false;
}

static const char *part_name(char out[32], const parts *p, uint32_t i)
{
    const mesh_part *of = p->items[i].of;
    snprintf(out, 32, "%.*s", of != NULL ? (int)(of->n_name < 24 ? of->n_name : 24) : 0,
             of != NULL ? of->name : "");
    return out;
}

/* Says what is wrong with the parts, if they are to be taken apart. */
static bool check_parts(const parts *p, const size_t *vertex_lines, problem *wrong)
{
    char names[2][32];
    if (p->share)
        return spoilt(wrong, vertex_lines[p->shared],
                      "the objects '%s' and '%s' share a vertex; surfaces must be apart",
                      part_name(names[0], p, p->sharing[0]), part_name(names[1], p, p->sharing[1]));
    return p->outer != NO_PART ||
           spoilt(wrong, 0,
                  "all objects are voids or surfaces inside; one must be the outer "
                  "surface, such as 'o outer'");
}

bool cage_take_parts(cage *out, const mesh_file *m, const size_t *vertex_lines, bool *is_divided,
                     problem *wrong)
{
    parts p = {.mesh = m};
    size_t n_surfaces = 0;
    list_parts(&p);
    find_owners(&p);
    find_outer(&p);
    for (size_t i = 0; i < p.n; i++)
        n_surfaces += has_faces(&p.items[i]);
    *is_divided =
        n_surfaces > 0 && (has_free_line(&p) || (n_surfaces > 1 && (!p.share || p.named)));
    bool good = !*is_divided || check_parts(&p, vertex_lines, wrong);
    if (good && *is_divided) {
        take_outer(out, &p, vertex_lines);
        for (uint32_t i = 0; i < p.n; i++)
            if (i != p.outer && has_faces(&p.items[i]))
                take_inner(out, &p, i, vertex_lines);
        for (uint32_t i = 0; i < p.n; i++)
            take_lines(out, &p, i, vertex_lines);
    }
    free_parts(&p);
    return good;
}

/* ---- pairing ---- */

static bool have_same_label(const cage_feature *a, const cage_feature *b)
{
    return a->label != NULL && b->label != NULL && strcmp(a->label, b->label) == 0;
}

/* The feature of the target that belongs at place i: the one with the same name, or else the one
 * that is there if neither has a name. n_features: none. */
static size_t find_partner(const cage *source, const cage *target, size_t i)
{
    const cage_feature *own = &source->features[i];
    for (size_t k = i; own->label != NULL && k < target->n_features; k++)
        if (have_same_label(own, &target->features[k]))
            return k;
    return i < target->n_features && (own->label == NULL || target->features[i].label == NULL)
               ? i
               : target->n_features;
}

bool cage_pair_parts(const cage *source, cage *target, problem *wrong)
{
    for (size_t i = 0; i < source->n_features; i++) {
        const cage_feature *own = &source->features[i];
        const size_t k = find_partner(source, target, i);
        if (k == target->n_features)
            return spoilt(wrong, 0, "'%s' of the source has no partner in the target",
                          own->label != NULL ? own->label : "a line");
        cage_feature moved = target->features[k];
        memmove(target->features + i + 1, target->features + i, (k - i) * sizeof moved);
        target->features[i] = moved;
        target->features[i].number = own->number;
        if (own->kind == moved.kind &&
            (own->n_facets != moved.n_facets ||
             memcmp(own->facets, moved.facets, 3 * own->n_facets * sizeof *own->facets) != 0))
            return spoilt(wrong, moved.line,
                          "'%s' has other faces than in the source; they must be the same, in the "
                          "same order",
                          moved.label != NULL ? moved.label : "a surface");
    }
    if (source->n_features == target->n_features)
        return true;
    const cage_feature *lone = &target->features[source->n_features];
    return spoilt(wrong, lone->line, "'%s' has no partner in the source",
                  lone->label != NULL ? lone->label : "a line");
}
