/* Reads, sorts and pairs the features of cages, and puts their names into messages. */
#include "cage/cage_features.h"

#include "base/allocate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *kind_name(int32_t kind)
{
    return kind == ICC_FEATURE_HOLE     ? "hole"
           : kind == ICC_FEATURE_REGION ? "region"
           : kind == ICC_FEATURE_LINE   ? "line"
           : kind == ICC_FEATURE_POINT  ? "point"
                                        : "tie";
}

/* The first outer ring of a region has the region's name. */
const char *feature_name(feature_text out, const cage_feature *f)
{
    if (f->label != NULL) {
        snprintf(out, sizeof(feature_text), "%s", f->label);
        return out;
    }
    const char *whole = f->of_outline ? "polygon" : "region";
    bool of_whole = f->item > 0 && f->ring > 0 && !(f->kind == ICC_FEATURE_REGION && f->item == 1);
    if (of_whole)
        snprintf(out, sizeof(feature_text), "%s %zu of %s %lld",
                 f->kind == ICC_FEATURE_REGION ? "part" : "hole", f->item, whole,
                 (long long)f->number);
    else
        snprintf(out, sizeof(feature_text), "%s %lld",
                 f->kind == ICC_FEATURE_REGION ? whole
                 : f->filled                   ? "hole"
                                               : kind_name(f->kind),
                 (long long)f->number);
    return out;
}

bool feature_is_ring(const cage_feature *f)
{
    return f->kind == ICC_FEATURE_HOLE || f->kind == ICC_FEATURE_REGION;
}

/* True if a ring belongs to a region that has a number in the file. */
static bool has_region(const cage_feature *f)
{
    return f->item > 0 && !f->of_outline;
}

size_t cage_count(const cage *c, int32_t kind)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n_features; i++) {
        const cage_feature *f = &c->features[i];
        bool counts = kind == ICC_FEATURE_HOLE ? !has_region(f)
                      : kind == ICC_FEATURE_REGION
                          ? (has_region(f) || f->n_facets > 0) && f->ring == 0
                          : !f->filled;
        n += f->kind == kind && counts;
    }
    return n;
}

size_t cage_outlines(const cage *c)
{
    size_t n = c->n > 0;
    for (size_t i = 0; i < c->n_features; i++)
        n += c->features[i].of_outline && c->features[i].kind == ICC_FEATURE_REGION;
    return n;
}

const char *cage_rings_text(char out[80], const cage *c)
{
    size_t n = c->n, used = 0, n_outlines = cage_outlines(c),
           n_regions = cage_count(c, ICC_FEATURE_REGION);
    for (size_t i = 0; i < c->n_features && c->n == 0; i++)
        n += feature_is_ring(&c->features[i]) ? c->features[i].n : 0;
    if (c->n == 0 && n_outlines > 0)
        used = (size_t)snprintf(out, 80, "%zu polygons, ", n_outlines);
    else if (c->n == 0)
        used = (size_t)snprintf(out, 80, "%zu region%s, ", n_regions, n_regions == 1 ? "" : "s");
    snprintf(out + used, 80 - used, "%zu vertices", n);
    return out;
}

const char *cage_inside_text(char out[120], const cage *c)
{
    static const int32_t kinds[] = {ICC_FEATURE_HOLE, ICC_FEATURE_REGION, ICC_FEATURE_LINE,
                                    ICC_FEATURE_POINT};
    size_t used = 0, left = 0, counts[4];
    for (size_t k = 0; k < 4; k++) {
        bool inside = kinds[k] != ICC_FEATURE_REGION || cage_outlines(c) > 0;
        counts[k] = inside ? cage_count(c, kinds[k]) : 0;
        left += counts[k] > 0;
    }
    out[0] = '\0';
    for (size_t k = 0; k < 4; k++) {
        size_t n = counts[k];
        if (n == 0)
            continue;
        const char *before = used == 0 ? ", with " : left == 1 ? " and " : ", ";
        used +=
            (size_t)snprintf(out + used, 120 - used, "%s%zu %s%s", before, n,
                             c->dim == 3 && kinds[k] == ICC_FEATURE_HOLE     ? "void"
                             : c->dim == 3 && kinds[k] == ICC_FEATURE_REGION ? "surface"
                                                                             : kind_name(kinds[k]),
                             n == 1 ? "" : "s");
        left--;
    }
    if (used > 0)
        snprintf(out + used, 120 - used, " inside");
    return out;
}

/* ----------------------------------------------------------------- reading */

void cage_add_feature(cage *c, int32_t kind, int64_t number, size_t first)
{
    c->features = grow(c->features, &c->room_features, c->n_features + 1, sizeof *c->features);
    cage_feature *f = &c->features[c->n_features++];
    *f = (cage_feature){.kind = kind, .number = number, .n = c->n - first};
    f->points = need(f->n, 2 * sizeof *f->points);
    if (f->n > 0) {
        memcpy(f->points, c->points + 2 * first, f->n * 2 * sizeof *f->points);
        f->line = c->lines[first];
    }
    c->n = first;
}

/* Drops a last vertex that repeats the first. */
static void drop_last(cage *c, size_t first)
{
    if (c->n >= first + 2) {
        const double *begin = c->points + 2 * first, *last = c->points + 2 * (c->n - 1);
        c->n -= last[0] == begin[0] && last[1] == begin[1];
    }
}

bool cage_end_region_ring(cage *c, const cage_feature *like, size_t first, problem *wrong)
{
    feature_text name;
    drop_last(c, first);
    size_t n = c->n - first;
    if (n < 3)
        return spoilt(wrong, n > 0 ? c->lines[first] : 0, "%s has %zu %s; a ring has at least 3",
                      feature_name(name, like), n, n == 1 ? "vertex" : "vertices");
    cage_add_feature(c, like->kind, like->number, first);
    cage_feature *f = &c->features[c->n_features - 1];
    f->of_outline = like->of_outline;
    f->ring = like->ring;
    f->item = like->item;
    return true;
}

bool cage_end_ring(cage *c, size_t first, problem *wrong)
{
    drop_last(c, first);
    if (first == 0)
        return true;
    size_t n = c->n - first, number = c->n_features + 1;
    if (n < 3)
        return spoilt(wrong, n > 0 ? c->lines[first] : 0,
                      "hole %zu has %zu %s; a hole has at least 3", number, n,
                      n == 1 ? "vertex" : "vertices");
    cage_add_feature(c, ICC_FEATURE_HOLE, (int64_t)number, first);
    return true;
}

/* Adds a ring of outline `number` to the features of a cage. */
static void add_outline_ring(cage *c, size_t number, size_t ring, size_t n, double *points,
                             size_t line)
{
    c->features = grow(c->features, &c->room_features, c->n_features + 1, sizeof *c->features);
    c->features[c->n_features++] =
        (cage_feature){.kind = ring == 0 ? ICC_FEATURE_REGION : ICC_FEATURE_HOLE,
                       .number = (int64_t)number,
                       .of_outline = true,
                       .ring = ring,
                       .item = ring == 0 ? 1 : ring,
                       .n = n,
                       .points = points,
                       .line = line};
}

/* Takes the rings of a polygon, and adds them to a cage. */
static void take_outline(cage *c, size_t number, cage *polygon)
{
    size_t line = polygon->lines != NULL && polygon->n > 0 ? polygon->lines[0] : 0;
    add_outline_ring(c, number, 0, polygon->n, polygon->points, line);
    polygon->points = NULL;
    for (size_t i = 0; i < polygon->n_features; i++) {
        cage_feature *f = &polygon->features[i];
        add_outline_ring(c, number, i + 1, f->n, f->points, f->line);
        f->points = NULL;
    }
}

cage *cage_add_polygon(cage *c)
{
    c->more = grow(c->more, &c->room_more, c->n_more + 1, sizeof *c->more);
    cage *added = &c->more[c->n_more++];
    *added = (cage){.dim = 2};
    return added;
}

void cage_join_outlines(cage *c)
{
    cage whole = *c;
    *c = (cage){.dim = whole.dim,
                .cut = whole.cut,
                .n_heights = whole.n_heights,
                .n_curves = whole.n_curves,
                .curve_edges = whole.curve_edges,
                .room_curves = whole.room_curves};
    whole.curve_edges = NULL;
    take_outline(c, 1, &whole);
    for (size_t i = 0; i < whole.n_more; i++)
        take_outline(c, i + 2, &whole.more[i]);
    cage_free(&whole);
}

/* Holes and outlines first, ties last. */
static int rank(const cage_feature *f)
{
    return f->kind == CAGE_TIE ? 2 : feature_is_ring(f) && !has_region(f) ? 0 : 1;
}

static int by_number(const void *a, const void *b)
{
    const cage_feature *p = a, *q = b;
    if (rank(p) != rank(q))
        return rank(p) - rank(q);
    if (p->number != q->number)
        return p->number < q->number ? -1 : 1;
    return (p->ring > q->ring) - (p->ring < q->ring);
}

size_t cage_circles(const cage *c)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n_features; i++)
        n += c->features[i].radius > 0;
    return n;
}

const cage_feature *cage_find_feature(const cage *c, size_t number)
{
    if (number < c->n_features)
        return &c->features[number];
    number -= c->n_features;
    for (size_t i = 0; i < c->n_features; i++)
        if (c->features[i].radius > 0 && number-- == 0)
            return &c->features[i];
    return NULL;
}

bool cage_sort_features(cage *c, problem *wrong)
{
    if (c->n_features == 0)
        return true;
    qsort(c->features, c->n_features, sizeof *c->features, by_number);
    for (size_t i = 0; i + 1 < c->n_features; i++)
        if (by_number(&c->features[i], &c->features[i + 1]) == 0)
            return spoilt(wrong, 0, "two %s have the number %lld in \"feature\"",
                          c->features[i].kind == CAGE_TIE ? "ties" : "features",
                          (long long)c->features[i].number);
    while (c->n_ties < c->n_features && c->features[c->n_features - c->n_ties - 1].kind == CAGE_TIE)
        c->n_ties++;
    c->n_features -= c->n_ties;
    c->ties = need(c->n_ties, sizeof *c->ties);
    memcpy(c->ties, c->features + c->n_features, c->n_ties * sizeof *c->ties);
    return cage_circles(c) == 0 || c->n_ties == 0 ||
           spoilt(wrong, 0, "points with a radius cannot be combined with ties");
}

void cage_fill_holes(cage *c)
{
    for (size_t i = 0; i < c->n_features; i++) {
        cage_feature *f = &c->features[i];
        if (f->kind != ICC_FEATURE_HOLE || has_region(f))
            continue;
        double *points = need(f->n + 1, 2 * sizeof *points);
        memcpy(points, f->points, f->n * 2 * sizeof *points);
        memcpy(points + 2 * f->n, f->points, 2 * sizeof *points);
        free(f->points);
        f->points = points;
        f->n++;
        f->kind = ICC_FEATURE_LINE;
        f->filled = true;
    }
}

/* ----------------------------------------------------------------- pairing */

static bool pair(const cage_feature *source, const cage_feature *target, problem *wrong)
{
    feature_text name;
    feature_name(name, target);
    if (source->kind != target->kind)
        return spoilt(wrong, target->line, "feature %lld is a %s, but in the source a %s",
                      (long long)target->number, kind_name(target->kind), kind_name(source->kind));
    if (source->n != target->n && source->kind != CAGE_TIE)
        return spoilt(wrong, target->line,
                      "%s has %zu vertices, but in the source %zu; they correspond one by one",
                      name, target->n, source->n);
    if ((source->radius > 0) != (target->radius > 0))
        return spoilt(wrong, target->line, "%s has %s, but in the source %s", name,
                      target->radius > 0 ? "a radius" : "no radius",
                      source->radius > 0 ? "one" : "none");
    return true;
}

/* Compares two sorted lists. Reports the first feature without a partner, or with a wrong one. */
static bool pair_all(size_t n, const cage_feature *source, size_t m, const cage_feature *target,
                     problem *wrong)
{
    feature_text name;
    for (size_t i = 0; i < n || i < m; i++) {
        int order = i == m ? -1 : i == n ? 1 : by_number(&source[i], &target[i]);
        if (order < 0)
            return spoilt(wrong, 0, "%s of the source has no partner in the target",
                          feature_name(name, &source[i]));
        if (order > 0)
            return spoilt(wrong, target[i].line, "%s has no partner in the source",
                          feature_name(name, &target[i]));
        if (!pair(&source[i], &target[i], wrong))
            return false;
    }
    return true;
}

bool features_correspond(const cage *source, const cage *target, problem *wrong)
{
    size_t n = cage_count(source, ICC_FEATURE_HOLE), m = cage_count(target, ICC_FEATURE_HOLE);
    if (n != m && source->n > 0)
        return spoilt(wrong, 0,
                      "%zu hole%s, but the source has %zu: hole %zu of the %s has no partner", m,
                      m == 1 ? "" : "s", n, 1 + (n < m ? n : m), n > m ? "source" : "target");
    return pair_all(source->n_features, source->features, target->n_features, target->features,
                    wrong) &&
           pair_all(source->n_ties, source->ties, target->n_ties, target->ties, wrong);
}

/* ---------------------------------------------------------------- messages */

/* The name repeats "(a line)" after the number, so that is skipped. */
static const char *skip_kind(const char *p)
{
    static const char *const kinds[] = {"hole", "region", "line", "point", "void", "surface"};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        char text[16];
        int n = snprintf(text, sizeof text, " (a %s)", kinds[k]);
        if (strncmp(p, text, (size_t)n) == 0)
            return p + n;
    }
    return p;
}

/* Reads the number of a feature or tie, and names it. False if there is something else. */
static bool take_number(feature_text name, const char **text, const cage *c, bool tie)
{
    size_t i = 0, n = 0;
    for (; (*text)[n] >= '0' && (*text)[n] <= '9' && n < 18; n++)
        i = 10 * i + (size_t)((*text)[n] - '0');
    const cage_feature *f = n == 0          ? NULL
                            : !tie          ? cage_find_feature(c, i)
                            : i < c->n_ties ? &c->ties[i]
                                            : NULL;
    if (f == NULL)
        return false;
    *text = skip_kind(*text + n);
    feature_name(name, f);
    if (!tie && i >= c->n_features)
        snprintf(name, sizeof(feature_text), "circle of point %lld", (long long)f->number);
    return true;
}

/* True if a text begins with a word, which is then skipped. */
static bool take_word(const char **text, const char *word)
{
    bool found = strncmp(*text, word, strlen(word)) == 0;
    *text += found ? strlen(word) : 0;
    return found;
}

/* Adds to a text that has room for `room` bytes. */
static void append(char *out, size_t room, const char *text, size_t n)
{
    size_t used = strlen(out), left = room - 1 - used;
    n = n < left ? n : left;
    memcpy(out + used, text, n);
    out[used + n] = '\0';
}

/* Names the features of a list such as "3, 4 and 7". */
static void take_list(char *out, size_t room, const char **text, const cage *c)
{
    static const char *const between[] = {", ", " and "};
    feature_text name;
    while (take_number(name, text, c, false)) {
        append(out, room, name, strlen(name));
        const char *next = *text;
        bool more = false;
        for (size_t k = 0; k < 2 && !more; k++)
            more = take_word(&next, between[k]) && *next >= '0' && *next <= '9';
        if (!more)
            return;
        append(out, room, *text, (size_t)(next - *text));
        *text = next;
    }
}

/* Names what a text begins with, if it is a feature, a list of features or a tie. */
static bool take_names(char *out, size_t room, const char **text, const cage *c)
{
    const char *at = *text;
    size_t used = strlen(out);
    feature_text name = "";
    if (take_word(&at, "features "))
        take_list(out, room, &at, c);
    else {
        bool tie = take_word(&at, "tie ");
        if (tie || take_word(&at, "feature "))
            take_number(name, &at, c, tie);
    }
    append(out, room, name, strlen(name));
    if (out[used] == '\0')
        return false;
    *text = at;
    return true;
}

void features_translate(char *out, size_t room, const cage *c, const char *message)
{
    out[0] = '\0';
    while (*message != '\0' && strlen(out) + 1 < room)
        if (!take_names(out, room, &message, c))
            append(out, room, message++, 1);
}
