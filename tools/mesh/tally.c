/* Counts elements by the sign of their images. */
#include "mesh/tally.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "mesh/element_sign.h"
#include "mesh/mesh_boundary.h"

#include <icc/icc.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How many numbers are listed on stderr. A report lists all. */
enum { MOST_NAMED = 10 };

typedef enum fate {
    NOT_COUNTED, /* it has fewer dimensions than the mesh */
    KEPT,
    INVERTED,
    COLLAPSED,
    UNDECIDED,
    FLAT_BEFORE,
    WITHOUT_IMAGE
} fate;

static bool is_simplex(const element_kind *k)
{
    return k->type == ELEMENT_TRIANGLE || k->type == ELEMENT_TETRAHEDRON;
}

static bool is_of(const mesh_file *m, size_t i, const element_kind *k)
{
    return element_kind_find(m->kinds[i]) == k;
}

/* ------------------------------------------------------------------------- signs */

static bool has_image(const mesh_file *m, const double *points, size_t i)
{
    for (size_t k = m->node_starts[i]; k < m->node_starts[i + 1]; k++)
        for (size_t c = 0; c < m->dim; c++)
            if (!isfinite(points[m->dim * m->nodes[k] + c]))
                return false;
    return true;
}

static int simplex_sign(const mesh_file *m, const double *points, const uint32_t *corners)
{
    const double *at[4] = {NULL, NULL, NULL, NULL};
    for (size_t k = 0; k <= m->dim; k++)
        at[k] = points + m->dim * corners[k];
    return m->dim == 2 ? orientation(at[0], at[1], at[2])
                       : orientation_3d(at[0], at[1], at[2], at[3]);
}

/* The orientation of a polygon, exactly. 0 if it meets itself. */
static int polygon_sign(const double *points, const uint32_t *corners, size_t n)
{
    double *ring = need(n, 2 * sizeof *ring);
    icc_domain *domain = NULL;
    icc_domain_info info = {.size = sizeof info};
    for (size_t k = 0; k < n; k++)
        memcpy(ring + 2 * k, points + 2 * (size_t)corners[k], 2 * sizeof *ring);
    bool good = icc_domain_create(&domain, 2, n, ring, 0, NULL, NULL, NULL) == ICC_OK &&
                icc_domain_get_info(domain, &info) == ICC_OK;
    icc_domain_free(domain);
    free(ring);
    return good ? info.orientation : 0;
}

static fate simplex_fate(const mesh_file *m, const double *images, const uint32_t *corners)
{
    int before = simplex_sign(m, m->points, corners), after = simplex_sign(m, images, corners);
    return before == 0 ? FLAT_BEFORE : after == 0 ? COLLAPSED : after == before ? KEPT : INVERTED;
}

static fate polygon_fate(const mesh_file *m, const double *images, const uint32_t *corners,
                         size_t n)
{
    int before = polygon_sign(m->points, corners, n);
    return before == 0 ? FLAT_BEFORE : polygon_sign(images, corners, n) == before ? KEPT : INVERTED;
}

static fate other_fate(const mesh_file *m, const double *images, const uint32_t *nodes,
                       element_plan *plan)
{
    int before = element_orientation(plan, m->points, nodes);
    if (before == 0)
        return FLAT_BEFORE;
    element_sign after = element_sign_of(plan, images, nodes, before);
    return after == ELEMENT_POSITIVE ? KEPT : after == ELEMENT_INVERTED ? INVERTED : UNDECIDED;
}

/* Finds the fate of one element. The plan of its kind is made when it is first needed. */
static fate fate_of(const mesh_file *m, const double *images, size_t i, element_plan **plan)
{
    const element_kind *k = element_kind_find(m->kinds[i]);
    const uint32_t *nodes = m->nodes + m->node_starts[i];
    if (k->dim != m->dim)
        return NOT_COUNTED;
    if (!has_image(m, images, i))
        return WITHOUT_IMAGE;
    if (is_simplex(k))
        return simplex_fate(m, images, nodes);
    if (k->shape == SHAPE_POLYGON)
        return polygon_fate(m, images, nodes, m->node_starts[i + 1] - m->node_starts[i]);
    if (k->shape == SHAPE_OTHER)
        return UNDECIDED;
    if (*plan == NULL)
        *plan = element_plan_make(k);
    return *plan == NULL ? UNDECIDED : other_fate(m, images, nodes, *plan);
}

/* ---------------------------------------------------------------------- counting */

static bool *boundary_vertices(const mesh_file *m)
{
    mesh_boundary b;
    mesh_boundary_find(&b, m->dim, m->dim == 2 ? m->n_triangles : m->n_tetrahedra,
                       m->dim == 2 ? m->triangles : m->tetrahedra);
    bool *on = mesh_boundary_vertices(&b, m->n_vertices);
    mesh_boundary_free(&b);
    return on;
}

static void count(tally_kind *k, fate f)
{
    k->all++;
    k->kept += f == KEPT;
    k->inverted += f == INVERTED;
    k->collapsed += f == COLLAPSED;
    k->undecided += f == UNDECIDED;
    k->flat_before += f == FLAT_BEFORE;
    k->without_image += f == WITHOUT_IMAGE;
}

void tally_make(tally *out, const mesh_file *m, const double *images)
{
    element_plan **plans = need(n_element_kinds, sizeof *plans);
    *out = (tally){.kinds = need(n_element_kinds, sizeof *out->kinds),
                   .fates = need(m->n_elements, sizeof *out->fates)};
    for (size_t k = 0; k < n_element_kinds; k++)
        out->kinds[k].kind = &element_kinds[k];
    for (size_t i = 0; i < m->n_elements; i++) {
        size_t k = (size_t)(element_kind_find(m->kinds[i]) - element_kinds);
        fate f = fate_of(m, images, i, &plans[k]);
        out->fates[i] = (unsigned char)f;
        count(&out->kinds[k], f);
    }
    for (size_t k = 0; k < n_element_kinds; k++)
        element_plan_free(plans[k]);
    free(plans);
    if (tally_spoilt(out) > 0)
        out->on_boundary = boundary_vertices(m);
}

void tally_compare(tally *t, const tally *before, const mesh_file *m)
{
    t->untangled = true;
    for (size_t i = 0; i < m->n_elements; i++)
        if (before->fates[i] == INVERTED || before->fates[i] == COLLAPSED) {
            t->n_tangled++;
            t->n_repaired += t->fates[i] == KEPT;
        }
}

void tally_free(tally *t)
{
    free(t->kinds);
    free(t->fates);
    free(t->on_boundary);
    *t = (tally){0};
}

static size_t kind_spoilt(const tally_kind *k)
{
    return k->inverted + k->collapsed + k->undecided;
}

size_t tally_spoilt(const tally *t)
{
    size_t n = 0;
    for (size_t k = 0; k < n_element_kinds; k++)
        n += kind_spoilt(&t->kinds[k]);
    return n;
}

/* In the plane, larger faces with straight sides are also stored as triangles. */
static bool is_made_of_simplices(const element_kind *k)
{
    return is_simplex(k) || k->shape == SHAPE_POLYGON ||
           (k->shape == SHAPE_SQUARE && k->degree == 1);
}

bool tally_is_simplicial(const mesh_file *m)
{
    for (size_t i = 0; i < m->n_elements; i++) {
        const element_kind *k = element_kind_find(m->kinds[i]);
        if (k->dim == m->dim && !is_made_of_simplices(k))
            return false;
    }
    return true;
}

/* True if the boundary alone decides the fate of an element. */
static bool is_on_boundary(const tally *t, const mesh_file *m, size_t i)
{
    if (t->on_boundary == NULL || !is_made_of_simplices(element_kind_find(m->kinds[i])))
        return false;
    for (size_t k = m->node_starts[i]; k < m->node_starts[i + 1]; k++)
        if (!t->on_boundary[m->nodes[k]])
            return false;
    return true;
}

/* ------------------------------------------------------------------------- text */

static void print_kind(const tally_kind *k, char *text, size_t room)
{
    if (is_simplex(k->kind))
        snprintf(text, room,
                 "%zu %s: %zu keep their orientation, %zu inverted, %zu collapsed, %zu flat "
                 "before, %zu without image",
                 k->all, k->kind->many, k->kept, k->inverted, k->collapsed, k->flat_before,
                 k->without_image);
    else
        snprintf(text, room,
                 "%zu %s: %zu positive, %zu inverted, %zu undecided, %zu not positive before, %zu "
                 "without image",
                 k->all, k->kind->many, k->kept, k->inverted, k->undecided, k->flat_before,
                 k->without_image);
}

/* Prints the elements of other dimensions in one line. */
static bool print_carried(const tally *t, const mesh_file *m, char *text, size_t room)
{
    size_t used = 0;
    for (const tally_kind *k = t->kinds; k < t->kinds + n_element_kinds; k++)
        if (k->kind->dim != m->dim && k->all > 0 && used < room)
            used += (size_t)snprintf(text + used, room - used, "%s%zu %s", used > 0 ? ", " : "",
                                     k->all, k->all == 1 ? k->kind->one : k->kind->many);
    if (used > 0 && used < room)
        snprintf(text + used, room - used, " carried");
    return used > 0;
}

bool tally_line(const tally *t, const mesh_file *m, size_t i, char *text, size_t room)
{
    size_t n = 0;
    for (const tally_kind *k = t->kinds; k < t->kinds + n_element_kinds; k++)
        if (k->kind->dim == m->dim && k->all > 0 && n++ == i) {
            print_kind(k, text, room);
            return true;
        }
    if (n == i && print_carried(t, m, text, room))
        return true;
    if (n + i > 0)
        return false;
    snprintf(text, room, "%zu vertices carried; there are no elements", m->n_vertices);
    return true;
}

/* -------------------------------------------------------------------- report */

/* The name of a kind as a member of a JSON object. */
static const char *member(char out[64], const element_kind *k)
{
    size_t n = strcspn(k->many, "(");
    n -= k->many[n] == '(';
    for (size_t i = 0; i < n; i++)
        out[i] = k->many[i] == ' ' ? '_' : k->many[i];
    out[n] = '\0';
    return out;
}

/* Lists the numbers of elements of a kind, counted from 0 within the kind. */
static void list_numbers(const tally *t, const mesh_file *m, const element_kind *kind,
                         const char *name, bool undecided, bool only_boundary, json *out)
{
    size_t n = 0;
    json_open(out, name, '[');
    for (size_t i = 0; i < m->n_elements; i++) {
        if (!is_of(m, i, kind))
            continue;
        fate f = t->fates[i];
        bool wanted = undecided ? f == UNDECIDED : f == INVERTED || f == COLLAPSED;
        if (wanted && (!only_boundary || is_on_boundary(t, m, i)))
            json_count(out, NULL, n);
        n++;
    }
    json_close(out, ']');
}

static void report_kind(const tally *t, const mesh_file *m, const tally_kind *k, json *out)
{
    char name[64];
    bool simplex = is_simplex(k->kind);
    json_open(out, member(name, k->kind), '{');
    json_count(out, "all", k->all);
    json_count(out, simplex ? "kept" : "positive", k->kept);
    json_count(out, "inverted", k->inverted);
    json_count(out, simplex ? "collapsed" : "undecided", simplex ? k->collapsed : k->undecided);
    json_count(out, simplex ? "flat_before" : "not_positive_before", k->flat_before);
    json_count(out, "without_image", k->without_image);
    list_numbers(t, m, k->kind, "turned", false, false, out);
    list_numbers(t, m, k->kind, "turned_on_boundary", false, true, out);
    if (!simplex)
        list_numbers(t, m, k->kind, "undecided_elements", true, false, out);
    json_close(out, '}');
}

void tally_report(const tally *t, const mesh_file *m, json *out)
{
    char name[64];
    for (const tally_kind *k = t->kinds; k < t->kinds + n_element_kinds; k++)
        if (k->kind->dim == m->dim && (k->all > 0 || is_simplex(k->kind)))
            report_kind(t, m, k, out);
    if (t->untangled) {
        json_open(out, "untangled", '{');
        json_count(out, "inverted_before", t->n_tangled);
        json_count(out, "repaired", t->n_repaired);
        json_close(out, '}');
    }
    json_open(out, "carried", '{');
    for (const tally_kind *k = t->kinds; k < t->kinds + n_element_kinds; k++)
        if (k->kind->dim != m->dim && k->all > 0)
            json_count(out, member(name, k->kind), k->all);
    json_close(out, '}');
}

/* ------------------------------------------------------------------ what is wrong */

/* Groups of spoilt elements by their cause. */
typedef enum group { ON_BOUNDARY, INNER, OPEN, N_GROUPS } group;

static group group_of(const tally *t, const mesh_file *m, size_t i)
{
    return t->fates[i] == UNDECIDED                              ? OPEN
           : t->fates[i] != INVERTED && t->fates[i] != COLLAPSED ? N_GROUPS
           : is_on_boundary(t, m, i)                             ? ON_BOUNDARY
                                                                 : INNER;
}

/* Writes the first numbers of a group's elements, and returns how many it has. */
static size_t name_group(char *text, size_t room, const tally *t, const mesh_file *m,
                         const element_kind *kind, group wanted)
{
    size_t n = 0, number = 0, used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < m->n_elements; i++) {
        if (!is_of(m, i, kind))
            continue;
        if (group_of(t, m, i) == wanted && ++n <= MOST_NAMED)
            used += (size_t)snprintf(text + used, room - used, "%s%zu", n > 1 ? ", " : "", number);
        number++;
    }
    if (n > MOST_NAMED)
        snprintf(text + used, room - used, ", ..");
    return n;
}

static const char *reason(const element_kind *k, group g, const char *inner)
{
    return g == OPEN    ? (k->shape == SHAPE_OTHER ? "nothing is proved of this kind"
                                                   : "the sign is too near to 0 somewhere")
           : g == INNER ? inner
           : k->n_nodes == 3
               ? "all three corners lie on the boundary of the mesh, whose images stay"
           : k->n_nodes == 4 ? "all four corners lie on the boundary of the mesh, whose images stay"
                             : "all corners lie on the boundary of the mesh, whose images stay";
}

static void tell_group(const tally *t, const mesh_file *m, const tally_kind *k, group g,
                       const char *name, const char *inner)
{
    char numbers[256];
    size_t n = name_group(numbers, sizeof numbers, t, m, k->kind, g);
    if (n > 0)
        note("%s: %zu of %zu %s %s %s (numbers from 0: %s): %s", name, n, k->all, k->kind->many,
             n == 1 ? "is" : "are",
             g == OPEN             ? "undecided"
             : is_simplex(k->kind) ? "inverted or collapsed"
                                   : "inverted",
             numbers, reason(k->kind, g, inner));
}

void tally_tell(const tally *t, const mesh_file *m, const char *name, const char *inner)
{
    for (const tally_kind *k = t->kinds; k < t->kinds + n_element_kinds; k++)
        for (int g = 0; g < N_GROUPS && kind_spoilt(k) > 0; g++)
            tell_group(t, m, k, (group)g, name,
                       is_made_of_simplices(k->kind)
                           ? inner
                           : "the mesh is too coarse for the map there; elements of this "
                             "kind are not untangled");
}
