/* Reads, sorts and pairs the features of cages, and puts their names into messages. */
#include "cage/cage_features.h"

#include "base/allocate.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *kind_name(int32_t kind)
{
    return kind == ICC_FEATURE_HOLE    ? "hole"
           : kind == ICC_FEATURE_LINE  ? "line"
           : kind == ICC_FEATURE_POINT ? "point"
                                       : "tie";
}

const char *feature_name(feature_text out, const cage_feature *f)
{
    snprintf(out, sizeof(feature_text), "%s %lld", kind_name(f->kind), (long long)f->number);
    return out;
}

size_t cage_count(const cage *c, int32_t kind)
{
    size_t n = 0;
    for (size_t i = 0; i < c->n_features; i++)
        n += c->features[i].kind == kind;
    return n;
}

const char *cage_inside_text(char out[120], const cage *c)
{
    size_t used = 0, left = 0;
    for (int32_t kind = ICC_FEATURE_HOLE; kind <= ICC_FEATURE_POINT; kind++)
        left += cage_count(c, kind) > 0;
    out[0] = '\0';
    for (int32_t kind = ICC_FEATURE_HOLE; kind <= ICC_FEATURE_POINT; kind++) {
        size_t n = cage_count(c, kind);
        if (n == 0)
            continue;
        const char *before = used == 0 ? ", with " : left == 1 ? " and " : ", ";
        used += (size_t)snprintf(out + used, 120 - used, "%s%zu %s%s", before, n, kind_name(kind),
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

bool cage_end_ring(cage *c, size_t first, problem *wrong)
{
    if (c->n >= first + 2) {
        const double *begin = c->points + 2 * first, *last = c->points + 2 * (c->n - 1);
        c->n -= last[0] == begin[0] && last[1] == begin[1];
    }
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

/* Holes first, ties last. */
static int rank(int32_t kind)
{
    return kind == ICC_FEATURE_HOLE ? 0 : kind == CAGE_TIE ? 2 : 1;
}

static int by_number(const void *a, const void *b)
{
    const cage_feature *p = a, *q = b;
    if (rank(p->kind) != rank(q->kind))
        return rank(p->kind) - rank(q->kind);
    return p->number < q->number ? -1 : p->number > q->number;
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
    if (n != m)
        return spoilt(wrong, 0, "%zu hole%s, but the source has %zu; they correspond one by one", m,
                      m == 1 ? "" : "s", n);
    return pair_all(source->n_features, source->features, target->n_features, target->features,
                    wrong) &&
           pair_all(source->n_ties, source->ties, target->n_ties, target->ties, wrong);
}

/* ---------------------------------------------------------------- messages */

/* The name repeats "(a line)" after the number, so that is skipped. */
static const char *skip_kind(const char *p)
{
    for (int32_t kind = ICC_FEATURE_HOLE; kind <= ICC_FEATURE_POINT; kind++) {
        char text[16];
        int n = snprintf(text, sizeof text, " (a %s)", kind_name(kind));
        if (strncmp(p, text, (size_t)n) == 0)
            return p + n;
    }
    return p;
}

/* Reads "feature 3" or "tie 3" at the beginning of a text, and names it. False if there is
 * something else. */
static bool take_name(feature_text name, const char **text, const cage *c)
{
    const char *const words[] = {"feature ", "tie "};
    for (size_t k = 0; k < 2; k++) {
        const char *digits = *text + strlen(words[k]);
        size_t i = 0, n = 0;
        if (strncmp(*text, words[k], strlen(words[k])) != 0)
            continue;
        for (; digits[n] >= '0' && digits[n] <= '9' && n < 18; n++)
            i = 10 * i + (size_t)(digits[n] - '0');
        const cage_feature *f = n == 0          ? NULL
                                : k == 0        ? cage_find_feature(c, i)
                                : i < c->n_ties ? &c->ties[i]
                                                : NULL;
        if (f == NULL)
            return false;
        *text = skip_kind(digits + n);
        feature_name(name, f);
        if (k == 0 && i >= c->n_features)
            snprintf(name, sizeof(feature_text), "circle of point %lld", (long long)f->number);
        return true;
    }
    return false;
}

void features_translate(char *out, size_t room, const cage *c, const char *message)
{
    size_t used = 0;
    out[0] = '\0';
    while (*message != '\0' && used + 1 < room) {
        feature_text name = {*message, '\0'};
        if (!take_name(name, &message, c))
            message++;
        int n = snprintf(out + used, room - used, "%s", name);
        used = used + (size_t)n < room ? used + (size_t)n : room - 1;
    }
}
