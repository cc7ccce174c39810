/* Elastic matching at the scale of single edges. It considers the pairings close to a given one
 * that take vertices to vertices and are linear between them. It finds the one with the least
 * elastic energy (A. Srivastava et al., Shape analysis of elastic curves in Euclidean spaces,
 * 2011).
 *
 * Chords between the vertices stand for the outlines. So a vertex on a straight edge may stay
 * alone, but a corner that stays alone costs its turn. Directions are compared after the local
 * rotation of the given pairing. */
#include "match/outline/vertices.h"

#include "match/outline/pins.h"
#include "match/outline/places.h"

#include <math.h>
#include <string.h>

/* Limits of how far a pairing may lie from the given one, in places. For all vertices of one side
 * together the limit is PAIRS. */
enum { LEAST_BAND = 64, MOST_BAND = 192, PAIRS = 1000000 };
enum { MOST_WIDTH = 2 * MOST_BAND + 1, BASE = ICCP_CHORD + 1 };

/* Outlines with fewer vertices have edges of many samples, so the given pairing is fine enough. */
enum { LEAST_VERTICES = ICCP_MATCH_SAMPLES / 8 };

/* If vertices are closer than samples, a first pass improves the local directions. The second pass
 * may reach pairs that were outside the band. */
enum { PASSES = 2 };

/* stiffness: the cost of stretch relative to turns. Limits: roots of the factor by which an edge
 * may be stretched more or less than its surroundings. The last limit is used if the first finds no
 * path, as for d17 with three landmarks. */
static const float stiffness = 1, first_limit = 2, last_limit = 4;

/* A first pair is searched within this share of the perimeter on each side of a place. */
static const double around = 1.0 / 16;

typedef struct search {
    const iccp_outline *outline[2];
    const iccp_pairing_knots *knots; /* the given ones */
    iccp_pairing_knots inverse, out;
    iccp_bend bends[ICCP_BENDS];
    iccp_places places[2];
    size_t *low; /* the first column of each row, */
    size_t *end; /* and the one after the last */
    size_t band, width;
    float best[BASE][MOST_WIDTH];
    int32_t step[MOST_WIDTH];
    unsigned char *from; /* of all rows */
} search;

static void release(search *s, const iccp_memory *memory)
{
    if (s == NULL)
        return;
    iccp_places_free(&s->places[0], memory);
    iccp_places_free(&s->places[1], memory);
    iccp_free(memory, s->inverse.knot);
    iccp_free(memory, s->out.knot);
    iccp_free(memory, s->low);
    iccp_free(memory, s->end);
    iccp_free(memory, s->from);
    iccp_free(memory, s);
}

static size_t band_for(size_t n)
{
    const size_t band = PAIRS / n;
    return band < LEAST_BAND ? LEAST_BAND : band < MOST_BAND ? band : MOST_BAND;
}

static search *prepare(const iccp_pairing_knots *knots, const iccp_outline *source,
                       const iccp_outline *target, size_t n_landmarks, const iccp_memory *memory)
{
    const size_t rows = source->n + target->n + 4;
    search *const s = iccp_alloc_zero(memory, 1, sizeof *s);
    if (s == NULL)
        return NULL;
    s->outline[0] = source;
    s->outline[1] = target;
    s->knots = knots;
    s->band = band_for(source->n > target->n ? source->n : target->n);
    s->width = 2 * s->band + 1;
    s->inverse.knot = iccp_alloc(memory, 2 * knots->n, sizeof *s->inverse.knot);
    s->out.knot = iccp_alloc(memory, 2 * (rows + 2 * n_landmarks), sizeof *s->out.knot);
    s->low = iccp_alloc(memory, rows, sizeof *s->low);
    s->end = iccp_alloc(memory, rows, sizeof *s->end);
    s->from = iccp_alloc(memory, rows, s->width);
    if (iccp_places_create(&s->places[0], source, target, memory) != ICC_OK ||
        iccp_places_create(&s->places[1], target, source, memory) != ICC_OK ||
        s->inverse.knot == NULL || s->out.knot == NULL || s->low == NULL || s->end == NULL ||
        s->from == NULL) {
        release(s, memory);
        return NULL;
    }
    s->inverse.n = knots->n;
    for (size_t k = 0; k < 2 * knots->n; ++k)
        s->inverse.knot[k] = knots->knot[k ^ 1];
    return s;
}

/* Sets the band: the columns close to a row's image. There may be none. */
static void place_band(search *s)
{
    const iccp_places *const a = &s->places[0], *const b = &s->places[1];
    size_t at = 0, low = 0, end = 0;
    for (size_t i = 0; i < a->n; ++i) {
        const double image = iccp_knots_at(s->knots, a->share[i]);
        while (at + 1 < b->n && b->share[at] < image)
            ++at;
        while (low < b->n && (low + s->band < at || b->share[low] < image - iccp_near))
            ++low;
        while (end < b->n && end < at + s->band + 1 && b->share[end] < image + iccp_near)
            ++end;
        s->low[i] = low;
        s->end[i] = end > low ? end : low;
    }
    s->low[0] = 0;
    s->end[0] = 1;
    s->low[a->n - 1] = b->n - 1;
    s->end[a->n - 1] = b->n;
}

/* Offers steps of p rows and q columns to row i. */
static void offer(search *s, size_t i, size_t p, size_t q, float limit)
{
    const size_t low = s->low[i], before = s->low[i - p] + q;
    const size_t from = low > before ? low : before;
    const size_t to = s->end[i] < s->end[i - p] + q ? s->end[i] : s->end[i - p] + q;
    const float *const old = s->best[(i - p) % BASE];
    float *const best = s->best[i % BASE];
    float *const *const a = s->places[0].chord[p - 1], *const *const b = s->places[1].chord[q - 1];
    const float *const x = b[ICCP_CHORD_X], *const y = b[ICCP_CHORD_Y];
    const float *const root = b[ICCP_CHORD_ROOT];
    const float here[] = {a[ICCP_CHORD_X][i], a[ICCP_CHORD_Y][i]};
    const float length = a[ICCP_CHORD_ROOT][i];
    const float least = length / limit, most = length * limit;
    const int32_t code = (int32_t)(p * BASE + q);
    for (size_t j = from; j < to; ++j) {
        float value =
            old[j - before] + (here[0] * x[j] + here[1] * y[j] + stiffness * length * root[j]);
        value = root[j] < least || root[j] > most ? -HUGE_VALF : value;
        s->step[j - low] = value > best[j - low] ? code : s->step[j - low];
        best[j - low] = value > best[j - low] ? value : best[j - low];
    }
}

/* Subtracts the greatest value of row i from all rows kept, so that single steps are not lost in
 * large sums. */
static void lower(search *s, size_t i)
{
    float most = -HUGE_VALF;
    for (size_t k = 0; k < s->width; ++k)
        most = s->best[i % BASE][k] > most ? s->best[i % BASE][k] : most;
    for (size_t row = 0; row < BASE && most > -HUGE_VALF; ++row)
        for (size_t k = 0; k < s->width; ++k)
            s->best[row][k] -= most;
}

/* Finds the best path from end to end with limited slopes. Returns false if there is none. */
static bool find_path(search *s, float limit)
{
    const size_t n = s->places[0].n, m = s->places[1].n;
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < s->width; ++k) {
            s->best[i % BASE][k] = -HUGE_VALF;
            s->step[k] = 0;
        }
        if (i == 0)
            s->best[0][0] = 0;
        for (size_t p = 1; p <= ICCP_CHORD && p <= i; ++p)
            for (size_t q = 1; q <= ICCP_CHORD; ++q)
                offer(s, i, p, q, limit);
        for (size_t k = 0; k < s->width; ++k)
            s->from[i * s->width + k] = (unsigned char)s->step[k];
        if (i % 64 == 63)
            lower(s, i);
    }
    return s->best[(n - 1) % BASE][m - 1 - s->low[n - 1]] > -HUGE_VALF;
}

/* Appends the path's pairs, except the last. */
static void read_path(search *s)
{
    double *const out = s->out.knot + 2 * s->out.n;
    size_t n = 0;
    for (size_t i = s->places[0].n - 1, j = s->places[1].n - 1; i > 0; ++n) {
        const unsigned char step = s->from[i * s->width + (j - s->low[i])];
        i -= step / BASE;
        j -= step % BASE;
        out[2 * n] = s->places[0].share[i];
        out[2 * n + 1] = s->places[1].share[j];
    }
    for (size_t k = 0; k < n / 2; ++k)
        for (size_t e = 0; e < 2; ++e) {
            const double swap = out[2 * k + e];
            out[2 * k + e] = out[2 * (n - 1 - k) + e];
            out[2 * (n - 1 - k) + e] = swap;
        }
    s->out.n += n;
}

/* Finds the pairs between two given pairs of shares. Returns false if there is no path. */
static bool pair_between(search *s, const double *from, const double *to)
{
    for (size_t e = 0; e < 2; ++e) {
        iccp_places_find(&s->places[e], s->outline[e], s->outline[1 - e],
                         e == 0 ? s->knots : &s->inverse, from[e], to[e]);
        iccp_places_chords(&s->places[e], s->outline[e], e == 0 ? s->bends : NULL);
    }
    place_band(s);
    float limit = first_limit;
    while (limit <= last_limit && !find_path(s, limit))
        limit *= 2;
    if (limit > last_limit)
        return false;
    read_path(s);
    return true;
}

/* Finds a first pair if there is no landmark: the closest one around the first knot. */
static bool find_first(search *s, double *first)
{
    const double share = s->knots->knot[0], from = share - around, to = share + around;
    if (!pair_between(s, (const double[]){from, iccp_knots_at(s->knots, from)},
                      (const double[]){to, iccp_knots_at(s->knots, to)}))
        return false;
    double least = HUGE_VAL;
    for (size_t k = 0; k < s->out.n; ++k) {
        const double away = fabs(s->out.knot[2 * k] - share);
        if (away < least) {
            least = away;
            memcpy(first, s->out.knot + 2 * k, 2 * sizeof *first);
        }
    }
    s->out.n = 0;
    return true;
}

/* Pairs the vertices. If there is no path, the knots stay as they are. */
static icc_status pair_once(iccp_pairing_knots *knots, const iccp_outline *source,
                            const iccp_outline *target, size_t n_landmarks, const double *landmarks,
                            const iccp_env *env)
{
    search *const s = prepare(knots, source, target, n_landmarks, &env->memory);
    if (s == NULL)
        return ICC_ERR_MEMORY;
    iccp_bends_find(s->bends, knots, source, target);
    double first[2];
    bool is_found = n_landmarks > 0 || find_first(s, first);
    const size_t n = n_landmarks > 0 ? n_landmarks : 1;
    const double *const pairs = n_landmarks > 0 ? landmarks : first;
    icc_status status = ICC_OK;
    for (size_t k = 0; k < n && is_found && status == ICC_OK; ++k) {
        double next[2] = {pairs[2 * ((k + 1) % n)], pairs[2 * ((k + 1) % n) + 1]};
        if (k + 1 == n) {
            next[0] += 1;
            next[1] += 1;
        }
        is_found = pair_between(s, pairs + 2 * k, next);
        status = iccp_progress(env, NULL, (double)(k + 1) / (double)n);
    }
    if (status == ICC_OK && is_found) {
        double *const old = knots->knot;
        *knots = s->out;
        s->out.knot = old;
    }
    release(s, &env->memory);
    return status;
}

icc_status iccp_pair_vertices(iccp_pairing_knots *knots, const iccp_outline *source,
                              const iccp_outline *target, size_t n_landmarks,
                              const double *landmarks, const iccp_env *env)
{
    const size_t fewest = source->n < target->n ? source->n : target->n;
    const int passes = fewest < LEAST_VERTICES ? 0 : fewest < ICCP_MATCH_SAMPLES ? 1 : PASSES;
    icc_status status = ICC_OK;
    for (int k = 0; k < passes && status == ICC_OK; ++k) {
        const iccp_env part = iccp_part(env, NULL, (double)k / passes, (double)(k + 1) / passes);
        status = pair_once(knots, source, target, n_landmarks, landmarks, &part);
    }
    return status;
}
