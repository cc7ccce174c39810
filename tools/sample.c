/* The R2 sequence: multiples of (1/g, 1/g^2) modulo 1, where g^3 = g + 1. M. Roberts, The
 * unreasonable effectiveness of quasirandom sequences, 2018. */
#include "sample.h"

#include "memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH = 4096, MAX_BATCHES = 1000 };

size_t sample_inside(const icc_domain *domain, size_t n, double *points, const icc_env *env)
{
    const double g = 1.32471795724474602596, step[2] = {1 / g, 1 / (g * g)};
    icc_domain_info info = {.size = sizeof info};
    if (icc_domain_get_info(domain, &info) != ICC_OK)
        return 0;
    double *batch = need(BATCH, 2 * sizeof *batch);
    int32_t *where = need(BATCH, sizeof *where);
    size_t found = 0;
    for (size_t b = 0; b < MAX_BATCHES && found < n; b++) {
        for (size_t i = 0; i < BATCH; i++)
            for (size_t k = 0; k < 2; k++) {
                double u = fmod(0.5 + (double)(b * BATCH + i + 1) * step[k], 1.0);
                batch[2 * i + k] = info.lower[k] * (1 - u) + info.upper[k] * u;
            }
        if (icc_domain_locate(domain, BATCH, batch, where, NULL, NULL, env) != ICC_OK)
            break;
        for (size_t i = 0; i < BATCH && found < n; i++)
            if (where[i] == ICC_INSIDE)
                memcpy(points + 2 * found++, batch + 2 * i, 2 * sizeof *batch);
    }
    free(batch);
    free(where);
    return found;
}
