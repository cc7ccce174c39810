/* Neighbours along a row mostly have the same region, and the distance from the walls tells so
 * without looking. */
#include "kernel/sieve.h"

#include "base/threads.h"

typedef struct sifting {
    const iccp_sieve *sieve;
    uint8_t *stays; /* of each point of the lattice */
} sifting;

static bool passes(const iccp_sieve *sieve, const iccp_spot *spot)
{
    return spot->region != ICCP_NOWHERE ? spot->clearance >= sieve->clearance
                                        : spot->clearance <= sieve->margin;
}

static void row_start(const iccp_sieve *sieve, size_t row, size_t *at)
{
    at[0] = 0;
    at[1] = row % sieve->count[1];
    at[2] = row / sieve->count[1];
}

static icc_status sift_rows(void *argument, size_t begin, size_t end)
{
    const sifting *s = argument;
    const iccp_sieve *sieve = s->sieve;
    const double reach = sieve->clearance > sieve->margin ? sieve->clearance : sieve->margin;
    for (size_t row = begin; row < end; ++row) {
        size_t at[3];
        iccp_spot spot = {.clearance = -1};
        uint8_t *stays = s->stays + row * sieve->count[0];
        for (row_start(sieve, row, at); at[0] < sieve->count[0]; ++at[0]) {
            double point[3];
            sieve->point(sieve->lattice, at, point);
            const iccp_spot here = iccp_shape_spot_beside(sieve->shape, &spot, point, reach);
            stays[at[0]] = passes(sieve, &here);
            if (!here.beside)
                spot = here;
        }
    }
    return ICC_OK;
}

icc_status iccp_sieve_add(iccp_places *places, const iccp_sieve *sieve, const iccp_env *env)
{
    const size_t n_rows = sieve->count[1] * sieve->count[2];
    sifting s = {sieve, iccp_alloc(&env->memory, n_rows, sieve->count[0])};
    if (s.stays == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_for_chunks(env, "sample", n_rows, 16, sift_rows, &s);
    for (size_t row = 0; status == ICC_OK && row < n_rows; ++row) {
        size_t at[3];
        for (row_start(sieve, row, at); at[0] < sieve->count[0]; ++at[0]) {
            double point[3];
            if (!s.stays[row * sieve->count[0] + at[0]])
                continue;
            sieve->point(sieve->lattice, at, point);
            iccp_places_add(places, point);
        }
    }
    iccp_free(&env->memory, s.stays);
    return status == ICC_OK && places->failed ? ICC_ERR_MEMORY : status;
}
