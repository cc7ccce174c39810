/* Cuts simplices at chords and necks, and last in the middle.
 *
 * Chords are cut one after the other in the order of their numbers. J. M. Maubach, SIAM J. Sci.
 * Comput. 16, 1995, orders the edges of a simplex for the same reason. Two simplices cut their
 * common facet in the same way, because chords outside it do not affect it. A neck has no chords,
 * so it is a facet of one piece on either side. */
#include "map/solid/solid_chords.h"

#include "geometry/tuples.h"
#include "math/orient.h"

#include <string.h>

/* A cut leaves at most CORNERS pieces, and all but one of them wait. Every cut of a chord leaves
 * pieces with fewer chords, and every other cut pieces with fewer necks. */
enum { CORNERS = ICC_MAX_DIM + 1, WAITING = CORNERS * (CORNERS - 1) / 2 + CORNERS * CORNERS };

static const uint32_t NONE = UINT32_MAX;

/* A simplex or a piece of one. chord[i][j]: the number of the chord between two of its corners, or
 * NONE. neck[i]: the number of the neck opposite corner i, or NONE. */
typedef struct piece {
    uint32_t corner[CORNERS];
    uint32_t chord[CORNERS][CORNERS];
    uint32_t neck[CORNERS];
} piece;

/* Marked edges or facets, then those of each simplex whose ends or corners are all fixed. Sorting
 * brings equal ones together. Those that equal no marked one are numbered. */
typedef struct listing {
    iccp_tuples tuples;
    size_t n_marked;
    uint32_t *owner;  /* of each that is not marked: a bit for each corner of its simplex */
    uint32_t *number; /* of each tuple: its number, or NONE */
    size_t n;         /* numbers */
    uint32_t *first;  /* n_simplices + 1: the first tuple of each simplex */
} listing;

typedef struct cutter {
    const iccp_simplices *mesh;
    const iccp_solid_marks *marks;
    size_t n; /* corners of a simplex */
    listing chords, necks;
    size_t n_wholes; /* pieces whose corners are all fixed */
    iccp_simplices *out;
} cutter;

/* ---- listing ---- */

static void set_piece(const cutter *c, size_t s, piece *p)
{
    memset(p, 0xff, sizeof *p);
    memcpy(p->corner, c->mesh->corners + c->n * s, c->n * sizeof *p->corner);
    for (size_t e = c->chords.first[s]; e < c->chords.first[s + 1]; ++e) {
        const uint32_t bits = c->chords.owner[e - c->chords.n_marked];
        for (size_t i = 0; i < c->n; ++i)
            for (size_t j = 0; j < c->n; ++j)
                if (i != j && bits >> i & 1 && bits >> j & 1)
                    p->chord[i][j] = c->chords.number[e];
    }
    if (c->necks.first == NULL)
        return;
    for (size_t e = c->necks.first[s]; e < c->necks.first[s + 1]; ++e)
        for (size_t i = 0; i < c->n; ++i)
            if ((c->necks.owner[e - c->necks.n_marked] >> i & 1) == 0)
                p->neck[i] = c->necks.number[e];
}

/* Whether a subset of a simplex's corners is listed: `width` fixed points, without a chord. */
static bool is_listed(const cutter *c, const piece *p, size_t width, uint32_t bits)
{
    size_t n = 0;
    bool listed = true;
    for (size_t i = 0; i < c->n && listed; ++i) {
        if ((bits >> i & 1) == 0)
            continue;
        ++n;
        listed = p->corner[i] < c->marks->n_fixed;
        for (size_t j = 0; j < i && width > 2; ++j)
            listed = listed && ((bits >> j & 1) == 0 || p->chord[i][j] == NONE);
    }
    return listed && n == width;
}

static void put(const listing *l, size_t place, const uint32_t *corners)
{
    const size_t width = l->tuples.width;
    uint32_t *vertices = l->tuples.vertices + width * place;
    memcpy(vertices, corners, width * sizeof *vertices);
    (void)iccp_sort_vertices(width, vertices);
}

/* Lists the subsets of a simplex's corners from `place` on. Returns the place after them. Only
 * counts them if `l->owner` is NULL. */
static size_t list_simplex(const cutter *c, const listing *l, size_t s, size_t width, size_t place)
{
    piece p;
    if (width == 2) /* chords are not known yet */
        memcpy(p.corner, c->mesh->corners + c->n * s, c->n * sizeof *p.corner);
    else
        set_piece(c, s, &p);
    for (uint32_t bits = 0; bits < 1u << c->n; ++bits) {
        uint32_t corners[CORNERS];
        size_t n = 0;
        if (!is_listed(c, &p, width, bits))
            continue;
        for (size_t i = 0; i < c->n; ++i)
            if (bits >> i & 1)
                corners[n++] = p.corner[i];
        if (l->owner != NULL) {
            l->owner[place - l->n_marked] = bits;
            put(l, place, corners);
        }
        ++place;
    }
    return place;
}

static void list_marked(const cutter *c, const listing *l)
{
    const size_t dim = c->mesh->dim;
    size_t place = 0;
    for (size_t f = 0; f < c->marks->n_facets; ++f) {
        const uint32_t *v = c->marks->facets + dim * f;
        if (l->tuples.width > 2)
            put(l, place++, v);
        for (size_t i = 0; i < dim && l->tuples.width == 2; ++i)
            for (size_t j = i + 1; j < dim; ++j)
                put(l, place++, (const uint32_t[2]){v[i], v[j]});
    }
    for (size_t e = 0; e < c->marks->n_edges && l->tuples.width == 2; ++e)
        put(l, place++, c->marks->edges + 2 * e);
}

static void number(listing *l)
{
    iccp_tuples_sort(&l->tuples);
    for (size_t begin = 0; begin < l->tuples.n;) {
        const size_t end = iccp_tuples_end(&l->tuples, begin);
        bool is_marked = false;
        for (size_t k = begin; k < end; ++k)
            is_marked |= l->tuples.order[k] < l->n_marked;
        for (; begin < end; ++begin)
            l->number[l->tuples.order[begin]] = is_marked ? NONE : (uint32_t)l->n;
        l->n += !is_marked;
    }
}

static icc_status list(const cutter *c, listing *out, size_t width, const iccp_env *env)
{
    const size_t dim = c->mesh->dim, n_simplices = c->mesh->n_simplices;
    listing l = {.n_marked = width == 2
                                 ? c->marks->n_facets * (dim * (dim - 1) / 2) + c->marks->n_edges
                                 : c->marks->n_facets};
    size_t place = l.n_marked;
    l.first = iccp_alloc(&env->memory, n_simplices + 1, sizeof *l.first);
    for (size_t s = 0; s < n_simplices && l.first != NULL; ++s) {
        l.first[s] = (uint32_t)place;
        place = list_simplex(c, &l, s, width, place);
    }
    l.owner = iccp_alloc(&env->memory, place, sizeof *l.owner);
    l.number = iccp_alloc(&env->memory, place, sizeof *l.number);
    icc_status status =
        l.first != NULL && l.owner != NULL && l.number != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_tuples_create(&l.tuples, place, width, c->mesh->n_points, &env->memory);
    if (status == ICC_OK) {
        l.first[n_simplices] = (uint32_t)place;
        list_marked(c, &l);
        for (size_t s = 0; s < n_simplices; ++s)
            (void)list_simplex(c, &l, s, width, l.first[s]);
        number(&l);
    }
    *out = l;
    return status;
}

static void free_listing(listing *l, const iccp_memory *memory)
{
    l->tuples.memory = *memory;
    iccp_tuples_free(&l->tuples);
    iccp_free(memory, l->owner);
    iccp_free(memory, l->number);
    iccp_free(memory, l->first);
}

/* ---- cutting ---- */

/* Finds the first chord of a piece. Returns false if there is none. */
static bool find_chord(const cutter *c, const piece *p, size_t *a, size_t *b)
{
    uint32_t least = NONE;
    for (size_t i = 0; i < c->n; ++i)
        for (size_t j = i + 1; j < c->n; ++j)
            if (p->chord[i][j] < least) {
                least = p->chord[i][j];
                *a = i;
                *b = j;
            }
    return least != NONE;
}

/* Replaces a corner by a new point. Only the facet opposite stays. */
static void replace(const cutter *c, piece *p, size_t corner, uint32_t point)
{
    p->corner[corner] = point;
    for (size_t i = 0; i < c->n; ++i) {
        p->chord[corner][i] = p->chord[i][corner] = NONE;
        if (i != corner)
            p->neck[i] = NONE;
    }
}

static bool is_whole(const cutter *c, const piece *p)
{
    bool all_fixed = true;
    for (size_t i = 0; i < c->n; ++i)
        all_fixed = all_fixed && p->corner[i] < c->marks->n_fixed;
    return all_fixed;
}

/* Finds the new point in a piece, and the corners which it replaces, one in each part. Returns
 * false if the piece stays. *n_wholes counts new points in the middle of pieces. */
static bool find_cut(const cutter *c, const piece *p, uint32_t *point, bool *takes,
                     size_t *n_wholes)
{
    size_t a, b, neck = 0;
    const uint32_t n = (uint32_t)c->mesh->n_points;
    if (find_chord(c, p, &a, &b)) {
        *point = n + p->chord[a][b];
        for (size_t i = 0; i < c->n; ++i)
            takes[i] = i == a || i == b;
        return true;
    }
    while (neck < c->n && p->neck[neck] == NONE)
        ++neck;
    if (neck == c->n && !is_whole(c, p))
        return false;
    for (size_t i = 0; i < c->n; ++i)
        takes[i] = i != neck;
    *point = n + (uint32_t)c->chords.n +
             (neck < c->n ? p->neck[neck] : (uint32_t)(c->necks.n + (*n_wholes)++));
    return true;
}

/* Puts a new point in the middle of a piece with fixed corners. */
static void place_whole(const cutter *c, const piece *p, uint32_t point)
{
    const size_t dim = c->mesh->dim;
    double *out = c->out->points + dim * point;
    memset(out, 0, dim * sizeof *out);
    for (size_t i = 0; i < c->n; ++i)
        for (size_t k = 0; k < dim; ++k)
            out[k] += c->mesh->points[dim * p->corner[i] + k] / (double)c->n;
}

/* Writes the pieces of one simplex to `corners`, unless that is NULL. Returns their number. */
static size_t cut(cutter *c, size_t s, uint32_t *corners)
{
    piece stack[WAITING];
    bool takes[CORNERS];
    uint32_t point;
    size_t n_stack = 1, n_pieces = 0;
    set_piece(c, s, &stack[0]);
    while (n_stack > 0) {
        const piece p = stack[--n_stack];
        const size_t n_wholes = c->n_wholes;
        if (find_cut(c, &p, &point, takes, &c->n_wholes)) {
            if (corners != NULL && c->n_wholes > n_wholes)
                place_whole(c, &p, point);
            for (size_t i = c->n; i-- > 0;)
                if (takes[i]) {
                    stack[n_stack] = p;
                    replace(c, &stack[n_stack++], i, point);
                }
            continue;
        }
        if (corners != NULL)
            memcpy(corners + c->n * n_pieces, p.corner, c->n * sizeof *corners);
        ++n_pieces;
    }
    return n_pieces;
}

/* Puts new points in the middle of what a listing numbers. */
static void place_middles(const cutter *c, const listing *l, size_t first)
{
    const size_t dim = c->mesh->dim, width = l->tuples.width;
    for (size_t e = l->n_marked; e < l->tuples.n; ++e) {
        if (l->number[e] == NONE)
            continue;
        double *out = c->out->points + dim * (first + l->number[e]);
        memset(out, 0, dim * sizeof *out);
        for (size_t i = 0; i < width; ++i)
            for (size_t k = 0; k < dim; ++k)
                out[k] +=
                    c->mesh->points[dim * l->tuples.vertices[width * e + i] + k] / (double)width;
    }
}

static bool all_positive(const iccp_simplices *mesh)
{
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const double *corner[CORNERS];
        for (size_t i = 0; i <= mesh->dim; ++i)
            corner[i] = iccp_corner_point(mesh, (mesh->dim + 1) * s + i);
        if (iccp_orient(mesh->dim, corner) != 1)
            return false;
    }
    return true;
}

/* Cuts every simplex twice: first to count the pieces, then to write them. */
static icc_status cut_simplices(cutter *c, const iccp_env *env)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t dim = mesh->dim, n_listed = c->chords.n + c->necks.n;
    iccp_simplices *out = c->out;
    *out = (iccp_simplices){.memory = env->memory, .dim = dim, .n_boundary = mesh->n_boundary};
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        out->n_simplices += cut(c, s, NULL);
    out->n_points = mesh->n_points + n_listed + c->n_wholes;
    out->points = iccp_alloc(&env->memory, out->n_points, dim * sizeof *out->points);
    out->corners = iccp_alloc(&env->memory, out->n_simplices, c->n * sizeof *out->corners);
    if (out->points == NULL || out->corners == NULL)
        return ICC_ERR_MEMORY;
    memcpy(out->points, mesh->points, mesh->n_points * dim * sizeof *out->points);
    place_middles(c, &c->chords, mesh->n_points);
    place_middles(c, &c->necks, mesh->n_points + c->chords.n);
    c->n_wholes = 0;
    size_t n = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        n += cut(c, s, out->corners + c->n * n);
    return ICC_OK;
}

icc_status iccp_solid_cut_chords(iccp_simplices **out, const iccp_simplices *mesh,
                                 const iccp_solid_marks *marks, const iccp_env *env)
{
    cutter c = {.mesh = mesh, .marks = marks, .n = mesh->dim + 1};
    *out = NULL;
    icc_status status = list(&c, &c.chords, 2, env);
    if (status == ICC_OK)
        status = list(&c, &c.necks, mesh->dim, env);
    if (status == ICC_OK)
        c.out = iccp_alloc_zero(&env->memory, 1, sizeof *c.out);
    if (status == ICC_OK)
        status = c.out != NULL ? cut_simplices(&c, env) : ICC_ERR_MEMORY;
    if (status == ICC_OK && c.out->n_points > mesh->n_points && all_positive(c.out)) {
        *out = c.out;
        c.out = NULL;
    }
    iccp_simplices_free(c.out);
    free_listing(&c.chords, &env->memory);
    free_listing(&c.necks, &env->memory);
    return status;
}
