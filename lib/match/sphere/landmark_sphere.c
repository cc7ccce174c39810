/* Draws two surfaces on the sphere with their landmarks at the same directions. Based on: V.
 * Kraevoy, A. Sheffer, Cross-Parameterization and Compatible Remeshing of 3D Models, 2004, for two
 * surfaces that grow from a base (match/sphere/landmark_base.h). Here both drawings grow together
 * and each is moved on the other, so every face is positive at all times. */
#include "match/sphere/landmark_sphere.h"

#include "base/error.h"
#include "base/minmax.h"
#include "match/sphere/landmark_base.h"
#include "match/sphere/landmark_paths.h"
#include "match/sphere/relax.h"
#include "match/sphere/sphere.h"

#include <string.h>

/* Each drawing is first moved on the other when FEW vertices, or FEW_EACH for each landmark, are
 * present. Then it is moved whenever the number has grown by `finer`, and by `finer_of_few` up to
 * MANY vertices. With few vertices this costs little and decides where limbs come to lie. */
enum { FEW = 120, FEW_EACH = 12, MANY = 6000 };
static const double finer = 1.6, finer_of_few = 1.3;

/* With few vertices, two step lengths are tried: the later one and a shorter one. Either may leave
 * a limb beside its partner, from where it never returns. With 4 landmarks the longer steps are
 * better for t05, and the shorter ones for most starts of t06. */
static const double lengths[2] = {ICCP_LONGER, 1.25};

/* If some landmarks are guesses, there are several starts. Each of them uses FEWER guesses less
 * than the one before. The start with the least energy at CHOICE vertices goes on. On t04 with 4
 * landmarks three starts end at 5.38, 5.25 (chosen) and 13.1, where 4 is an isometry. With 4
 * landmarks the second start goes on for t01 and t07, and the third one for t02 and t05. */
enum { FEWER = 4, MOST_FEWER = 2, CHOICE = 300 };

/* If a path is longer on one surface by this factor, it may pass something on one surface only.
 * Then another start is made with paths whose lengths differ little. With 2 landmarks it goes on
 * for t01 and t08. */
static const double uneven = 2;

typedef struct beginning {
    iccp_landmark_base base;
    uint8_t *is_fixed[2];
    iccp_relaxation r;
    double level, energy; /* `level`: vertices present; 0 if only landmarks are */
} beginning;

typedef struct problem {
    const iccp_half_edges *const *given;
    const double *const *x;
    const uint32_t *const *vertices;
    double scale[2];
    size_t n, n_fixed;
} problem;

/* Moves drawings with few vertices in several ways from the same start. Keeps the best result,
 * whose energy is *least. */
static icc_status relax_few(iccp_relaxation *r, bool is_severe, double *least, const iccp_env *env)
{
    enum { N = sizeof lengths / sizeof *lengths };
    const iccp_memory *const memory = &env->memory;
    double *kept[2];
    size_t n[2];
    *least = HUGE_VAL;
    icc_status status = ICC_OK;
    for (int side = 0; side < 2; ++side) {
        n[side] = 3 * r->side[side].m->n_vertices;
        kept[side] = iccp_alloc(memory, 2 * n[side], sizeof *kept[side]);
        if (kept[side] == NULL)
            status = ICC_ERR_MEMORY;
        else
            memcpy(kept[side], r->side[side].directions, n[side] * sizeof *kept[side]);
    }
    /* The first half holds the directions at the start, the second half the best ones found. */
    for (size_t k = 0; k < N && status == ICC_OK; ++k) {
        const iccp_env part =
            iccp_part(env, NULL, (double)k / (double)N, (double)(k + 1) / (double)N);
        double energy = HUGE_VAL;
        for (int side = 0; side < 2; ++side)
            memcpy(r->side[side].directions, kept[side], n[side] * sizeof *kept[side]);
        status = iccp_relax(r, lengths[k], is_severe, &energy, &part);
        for (int side = 0; side < 2 && energy < *least; ++side)
            memcpy(kept[side] + n[side], r->side[side].directions, n[side] * sizeof *kept[side]);
        *least = iccp_min(*least, energy);
    }
    for (int side = 0; side < 2; ++side) {
        if (*least < HUGE_VAL)
            memcpy(r->side[side].directions, kept[side] + n[side], n[side] * sizeof *kept[side]);
        iccp_free(memory, kept[side]);
    }
    return status;
}

/* Adds vertices to both drawings until `until` or all are present. Each drawing is moved on the
 * other whenever the number of vertices has grown enough. Where limbs come to lie is decided while
 * vertices are few. Guessed landmarks stay fixed only while there are very few vertices. With
 * guesses, strong stretch counts more only at the end, because limbs without a landmark find better
 * places by the plain energy. */
static icc_status grow(beginning *b, const problem *p, double until, const iccp_env *env,
                       icc_error *err)
{
    iccp_half_edges *const m = b->base.m;
    const size_t all[2] = {m[0].n_left + m[0].n_collapsed, m[1].n_left + m[1].n_collapsed};
    const double most = iccp_max((double)all[0], (double)all[1]), end = iccp_min(until, most);
    const bool is_sure = p->n == p->n_fixed;
    icc_status status = ICC_OK;
    while (b->level < end && status == ICC_OK) {
        const bool is_first = !(b->level > 0);
        const double before = b->level;
        b->level = is_first ? iccp_max(FEW, FEW_EACH * (double)p->n)
                            : before * (before < MANY ? finer_of_few : finer);
        const iccp_env part = iccp_part(env, NULL, before / end, iccp_min(1, b->level / end));
        for (int side = 0; side < 2 && status == ICC_OK; ++side) {
            const size_t n = b->level < (double)all[side] ? (size_t)b->level : all[side];
            status = iccp_sphere_grow(b->base.directions[side], &m[side], b->base.s[side].x,
                                      p->scale[side], b->is_fixed[side], !is_first, n, &part, err);
        }
        if (status == ICC_OK && is_first)
            status = iccp_explain(err, relax_few(&b->r, is_sure, &b->energy, &part));
        for (int side = 0; side < 2; ++side)
            for (size_t k = p->n_fixed; k < p->n; ++k)
                b->is_fixed[side][p->vertices[side][k]] = 0;
        if (status == ICC_OK && (!is_first || p->n > p->n_fixed))
            status = iccp_explain(err, iccp_relax(&b->r, ICCP_LONGER, is_sure || b->level >= most,
                                                  &b->energy, &part));
    }
    return status;
}

/* Starts with the first n landmarks. */
static icc_status begin(beginning *b, const problem *p, size_t n, bool is_even, const iccp_env *env,
                        icc_error *err)
{
    iccp_drawn_surface drawn[2];
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 1}, env);
    icc_status status =
        iccp_landmark_base_create(&b->base, p->given, p->x, p->scale, n, p->vertices,
                                  is_even ? uneven : HUGE_VAL, &parts[0], err);
    if (status == ICC_ERR_RESOLUTION && n > p->n_fixed)
        return iccp_fail(err, status,
                         "the paths between landmarks, and others that were found beside them, "
                         "take too many vertices");
    if (status != ICC_OK)
        return status;
    for (int side = 0; side < 2; ++side) {
        const iccp_split_surface *const s = &b->base.s[side];
        b->is_fixed[side] = iccp_alloc_zero(&env->memory, s->n_vertices, sizeof *b->is_fixed[side]);
        if (b->is_fixed[side] == NULL)
            return iccp_fail_memory(err);
        for (size_t k = 0; k < n; ++k)
            b->is_fixed[side][p->vertices[side][k]] = 1;
        drawn[side] =
            (iccp_drawn_surface){&b->base.m[side], s->x, b->base.directions[side], p->scale[side]};
    }
    status = iccp_explain(
        err, iccp_relaxation_create(&b->r, drawn,
                                    (const uint8_t *const[]){b->is_fixed[0], b->is_fixed[1]},
                                    &env->memory));
    return status == ICC_OK ? grow(b, p, CHOICE, &parts[1], err) : status;
}

static void give_up(beginning *b, const iccp_memory *memory)
{
    iccp_landmark_base_free(&b->base, memory);
    iccp_relaxation_free(&b->r, memory);
    for (int side = 0; side < 2; ++side)
        iccp_free(memory, b->is_fixed[side]);
    *b = (beginning){.level = 0};
}

/* Starts with all landmarks, then with fewer and fewer guesses. If the paths between all were
 * uneven, the last start uses even ones. Keeps only the best start. A start for which there is no
 * room is skipped, unless it is the last one left. */
static icc_status begin_somehow(beginning *tries, size_t n_tries, size_t *best, const problem *p,
                                const iccp_env *env, icc_error *err)
{
    icc_status status = ICC_OK;
    double worst = HUGE_VAL;
    *best = n_tries;
    for (size_t k = 0; k < n_tries && status == ICC_OK; ++k) {
        const iccp_env part =
            iccp_part(env, NULL, (double)k / (double)n_tries, (double)(k + 1) / (double)n_tries);
        const bool is_even = k + 1 == n_tries, is_needed = k + 2 == n_tries && *best == n_tries;
        if (is_even && worst <= uneven)
            break;
        status = begin(&tries[k], p, is_even ? p->n : p->n - FEWER * k, is_even, &part,
                       is_needed ? err : NULL);
        if (k == 0 && status == ICC_OK)
            worst = tries[k].base.worst;
        if (status == ICC_OK && (*best == n_tries || tries[k].energy < tries[*best].energy)) {
            if (*best < n_tries)
                give_up(&tries[*best], &env->memory);
            *best = k;
        } else {
            give_up(&tries[k], &env->memory);
            if ((status == ICC_ERR_RESOLUTION || status == ICC_ERR_CERTIFICATE) && !is_needed)
                status = ICC_OK;
        }
    }
    return iccp_explain(err, status);
}

icc_status iccp_landmark_sphere_draw(double *directions[2], iccp_half_edges m[2],
                                     iccp_split_surface s[2], const iccp_half_edges *const given[2],
                                     const double *const x[2], size_t n, size_t n_fixed,
                                     const uint32_t *const vertices[2], const iccp_env *env,
                                     icc_error *err)
{
    const problem p = {
        .given = given,
        .x = x,
        .vertices = vertices,
        .scale = {iccp_sphere_scale(given[0], x[0]), iccp_sphere_scale(given[1], x[1])},
        .n = n,
        .n_fixed = n_fixed};
    const size_t least =
        n_fixed < ICCP_LEAST_SURFACE_LANDMARKS ? ICCP_LEAST_SURFACE_LANDMARKS : n_fixed;
    const size_t n_more = (n - least) / FEWER;
    const size_t n_tries = 2 + (n_more < MOST_FEWER ? n_more : MOST_FEWER);
    beginning tries[2 + MOST_FEWER] = {{.level = 0}};
    size_t best;
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){(double)n_tries, 20}, env);
    icc_status status = begin_somehow(tries, n_tries, &best, &p, &parts[0], err);
    if (status == ICC_OK)
        status = grow(&tries[best], &p, HUGE_VAL, &parts[1], err);
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        iccp_landmark_base *const b = &tries[best].base;
        status = iccp_sphere_check(&b->m[side], b->directions[side], err);
    }
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        iccp_landmark_base *const b = &tries[best].base;
        directions[side] = b->directions[side];
        m[side] = b->m[side];
        s[side] = b->s[side];
        b->directions[side] = NULL;
        b->m[side] = (iccp_half_edges){.memory = env->memory};
        b->s[side] = (iccp_split_surface){.memory = env->memory};
    }
    if (best < n_tries)
        give_up(&tries[best], &env->memory);
    return status;
}
