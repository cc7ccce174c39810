/* Leaves out repeated faces and crumbs, and turns faces. */
#include "cage/mend.h"

#include "base/allocate.h"
#include "cage/sides.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FOUR_PI 12.566370614359172

enum { NAMED = 8 /* numbers in a message */ };

/* A surface and what is known of its faces. */
typedef struct scan {
    cage *c;
    const char *file;
    uint32_t *number; /* of each face in the file */
    uint32_t *other;  /* the face at side k of face f, or UINT32_MAX: at 3 f + k */
    uint32_t *piece;  /* of each face */
    bool *turned;     /* turned over against the first face of its piece */
    size_t n_pieces;
    double *area; /* of each piece */
    size_t *size; /* its faces */
} scan;

double mend_area2(const double *a, const double *b, const double *c)
{
    double u[3], v[3];
    for (size_t k = 0; k < 3; k++) {
        u[k] = b[k] - a[k];
        v[k] = c[k] - a[k];
    }
    double n[3] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    return sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
}

static const double *corner(const cage *c, size_t face, size_t k)
{
    return c->points + 3 * (size_t)c->facets[3 * face + k];
}

/* Prints `FILE: TEXT: faces 3, 4, 5 ..` with the marked faces. */
static void tell(const scan *s, const bool *marked, const char *text, size_t n)
{
    char list[NAMED * 12 + 4] = "";
    size_t used = 0, named = 0;
    for (size_t f = 0; f < s->c->n_facets && named < NAMED; f++)
        if (marked[f])
            used += (size_t)snprintf(list + used, sizeof list - used, "%s%u",
                                     named++ > 0 ? ", " : "", s->number[f]);
    note("%s: %zu %s %s: %s%s", s->file, n, n == 1 ? "face" : "faces", text, list,
         n > NAMED ? ", .." : "");
}

/* Drops the marked faces. */
static void drop(scan *s, const bool *marked)
{
    cage *c = s->c;
    size_t kept = 0;
    for (size_t f = 0; f < c->n_facets; f++) {
        if (marked[f])
            continue;
        memmove(c->facets + 3 * kept, c->facets + 3 * f, 3 * sizeof *c->facets);
        c->facet_lines[kept] = c->facet_lines[f];
        s->number[kept++] = s->number[f];
    }
    c->n_facets = kept;
}

/* ---- repeated faces ---- */

/* A face by its corners in rising order. */
typedef struct corners {
    uint32_t at[3], face;
} corners;

static int by_corners(const void *a, const void *b)
{
    const corners *x = a, *y = b;
    for (size_t k = 0; k < 3; k++)
        if (x->at[k] != y->at[k])
            return x->at[k] < y->at[k] ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

static corners corners_of(const cage *c, size_t face)
{
    const uint32_t *f = c->facets + 3 * face;
    uint32_t low = f[0] < f[1] ? f[0] : f[1], high = f[0] < f[1] ? f[1] : f[0];
    return (corners){{f[2] < low ? f[2] : low,
                      f[2] < low    ? low
                      : f[2] < high ? f[2]
                                    : high,
                      f[2] > high ? f[2] : high},
                     (uint32_t)face};
}

/* Marks the faces whose corners an earlier face has, too. */
static size_t mark_repeated(const scan *s, bool *marked)
{
    size_t n = 0;
    corners *all = need(s->c->n_facets, sizeof *all);
    for (size_t f = 0; f < s->c->n_facets; f++)
        all[f] = corners_of(s->c, f);
    qsort(all, s->c->n_facets, sizeof *all, by_corners);
    for (size_t i = 1; i < s->c->n_facets; i++) {
        bool repeats = memcmp(all[i].at, all[i - 1].at, sizeof all[i].at) == 0;
        marked[all[i].face] = repeats;
        n += repeats;
    }
    free(all);
    return n;
}

static void drop_repeated(scan *s, mended *did)
{
    bool *marked = need(s->c->n_facets, sizeof *marked);
    did->n_repeated = mark_repeated(s, marked);
    if (did->n_repeated > 0) {
        tell(s, marked, "left out, because earlier ones have the same corners", did->n_repeated);
        drop(s, marked);
    }
    free(marked);
}

/* ---- pieces ---- */

static void find_others(scan *s)
{
    sides all = sides_make(s->c);
    for (size_t i = 0; i < all.n; i++)
        s->other[i] = UINT32_MAX;
    for (size_t i = 0, alike; i < all.n; i += alike) {
        alike = sides_alike(&all, i);
        const side *a = &all.all[i], *b = a + 1;
        if (alike != 2)
            continue;
        s->other[3 * a->face + a->k] = b->face;
        s->other[3 * b->face + b->k] = a->face;
    }
    sides_free(&all);
}

/* True if two faces run along the ends of side k of the first in the same direction. */
static bool runs_alike(const cage *c, uint32_t face, uint32_t k, uint32_t other)
{
    const uint32_t *f = c->facets + 3 * (size_t)face, *g = c->facets + 3 * (size_t)other;
    for (size_t j = 0; j < 3; j++)
        if (g[j] == f[k] && g[(j + 1) % 3] == f[(k + 1) % 3])
            return true;
    return false;
}

/* Numbers the faces that are connected with `first`, and finds which of them are turned over.
 * Returns false if the piece is one-sided. */
static bool number_piece(scan *s, uint32_t first, uint32_t *stack)
{
    size_t n = 0;
    bool two_sided = true;
    s->piece[first] = (uint32_t)s->n_pieces;
    stack[n++] = first;
    while (n > 0) {
        uint32_t f = stack[--n];
        s->area[s->n_pieces] +=
            mend_area2(corner(s->c, f, 0), corner(s->c, f, 1), corner(s->c, f, 2)) / 2;
        s->size[s->n_pieces]++;
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t g = s->other[3 * f + k];
            if (g == UINT32_MAX)
                continue;
            bool turned = s->turned[f] != runs_alike(s->c, f, k, g);
            if (s->piece[g] == UINT32_MAX) {
                s->piece[g] = s->piece[f];
                s->turned[g] = turned;
                stack[n++] = g;
            } else
                two_sided = two_sided && s->turned[g] == turned;
        }
    }
    s->n_pieces++;
    return two_sided;
}

static int find_pieces(scan *s)
{
    uint32_t *stack = need(s->c->n_facets, sizeof *stack);
    int result = DONE;
    find_others(s);
    for (size_t f = 0; f < s->c->n_facets; f++)
        s->piece[f] = UINT32_MAX;
    for (size_t f = 0; f < s->c->n_facets && result == DONE; f++)
        if (s->piece[f] == UINT32_MAX && !number_piece(s, (uint32_t)f, stack))
            result =
                failed(s->file, s->c->facet_lines[f],
                       "the surface with face %u has one side only, as a Moebius strip has; no "
                       "turning of faces mends that",
                       s->number[f]);
    free(stack);
    return result;
}

/* Turns the faces of each piece like most of them. */
static void turn_faces(scan *s, mended *did)
{
    cage *c = s->c;
    size_t *n = need(s->n_pieces, sizeof *n);
    for (size_t f = 0; f < c->n_facets; f++)
        n[s->piece[f]] += s->turned[f];
    for (size_t f = 0; f < c->n_facets; f++) {
        if (2 * n[s->piece[f]] > s->size[s->piece[f]])
            s->turned[f] = !s->turned[f];
        if (!s->turned[f])
            continue;
        uint32_t kept = c->facets[3 * f + 1];
        c->facets[3 * f + 1] = c->facets[3 * f + 2];
        c->facets[3 * f + 2] = kept;
        did->n_turned++;
    }
    if (did->n_turned > 0)
        tell(s, s->turned, "turned over, like the others around", did->n_turned);
    free(n);
}

/* ---- crumbs ---- */

/* The solid angle of face f seen from a point (Van Oosterom and Strackee, 1983). */
static double solid_angle(const cage *c, size_t f, const double *from)
{
    double v[3][3], length[3];
    for (size_t i = 0; i < 3; i++) {
        for (size_t k = 0; k < 3; k++)
            v[i][k] = corner(c, f, i)[k] - from[k];
        length[i] = sqrt(v[i][0] * v[i][0] + v[i][1] * v[i][1] + v[i][2] * v[i][2]);
    }
    double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                    v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                    v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    double dot[3];
    for (size_t i = 0; i < 3; i++) {
        const double *a = v[i], *b = v[(i + 1) % 3];
        dot[i] = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * length[(i + 2) % 3];
    }
    return 2 * atan2(volume, length[0] * length[1] * length[2] + dot[0] + dot[1] + dot[2]);
}

/* True if a point lies inside a piece, which may have small holes. */
static bool is_inside(const scan *s, uint32_t piece, const double *point)
{
    double sum = 0;
    for (size_t f = 0; f < s->c->n_facets; f++)
        if (s->piece[f] == piece)
            sum += solid_angle(s->c, f, point);
    return fabs(sum) > FOUR_PI / 2;
}

static uint32_t largest_piece(const scan *s)
{
    uint32_t largest = 0;
    for (size_t k = 1; k < s->n_pieces; k++)
        if (s->area[k] > s->area[largest])
            largest = (uint32_t)k;
    return largest;
}

/* Leaves out small pieces outside the largest one. */
static void drop_crumbs(scan *s, mended *did)
{
    bool *marked = need(s->c->n_facets, sizeof *marked),
         *is_crumb = need(s->n_pieces, sizeof *is_crumb);
    bool *known = need(s->n_pieces, sizeof *known);
    uint32_t body = largest_piece(s);
    size_t n = 0;
    for (size_t f = 0; f < s->c->n_facets; f++) {
        uint32_t k = s->piece[f];
        if (!known[k] && s->area[k] <= MEND_SMALL * s->area[body]) {
            is_crumb[k] = !is_inside(s, body, corner(s->c, f, 0));
            did->n_crumbs += is_crumb[k];
        }
        known[k] = true;
        marked[f] = is_crumb[k];
        n += marked[f];
    }
    if (n > 0) {
        char text[80];
        snprintf(text, sizeof text, "left out, in %zu small %s beside the body", did->n_crumbs,
                 did->n_crumbs == 1 ? "piece" : "pieces");
        tell(s, marked, text, n);
        drop(s, marked);
    }
    free(marked);
    free(is_crumb);
    free(known);
}

/* Drops the vertices that no face has. */
static void drop_unused(cage *c)
{
    uint32_t *number = need(c->n, sizeof *number);
    size_t kept = 0;
    for (size_t i = 0; i < 3 * c->n_facets; i++)
        number[c->facets[i]] = 1;
    for (size_t i = 0; i < c->n; i++) {
        if (number[i] == 0)
            continue;
        memmove(c->points + 3 * kept, c->points + 3 * i, 3 * sizeof *c->points);
        c->lines[kept] = c->lines[i];
        number[i] = (uint32_t)kept++;
    }
    for (size_t i = 0; i < 3 * c->n_facets; i++)
        c->facets[i] = number[c->facets[i]];
    c->n = kept;
    free(number);
}

int mend_surface(cage *c, const char *file, mended *did)
{
    size_t n = c->n_facets;
    scan s = {.c = c, .file = file};
    *did = (mended){0};
    s.number = need(n, sizeof *s.number);
    s.other = need(3 * n, sizeof *s.other);
    s.piece = need(n, sizeof *s.piece);
    s.turned = need(n, sizeof *s.turned);
    s.area = need(n, sizeof *s.area);
    s.size = need(n, sizeof *s.size);
    for (size_t f = 0; f < n; f++)
        s.number[f] = (uint32_t)f;
    drop_repeated(&s, did);
    int result = find_pieces(&s);
    if (result == DONE && n > 0) {
        double area = s.area[largest_piece(&s)];
        turn_faces(&s, did);
        drop_crumbs(&s, did);
        drop_unused(c);
        result = mend_holes(c, file, area, did);
    }
    free(s.number);
    free(s.other);
    free(s.piece);
    free(s.turned);
    free(s.area);
    free(s.size);
    return result;
}
