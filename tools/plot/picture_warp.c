/* Converts pictures to the library's form and back. */
#include "plot/picture_warp.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>

/* The samples in the library's form; free() the pixels. Floats that are NaN are missing. */
static icc_picture pack(const picture *p)
{
    size_t n = p->width * p->height * p->channels;
    icc_picture packed = {.size = sizeof packed,
                          .width = (int32_t)p->width,
                          .height = (int32_t)p->height,
                          .channels = (int32_t)p->channels,
                          .bytes = (int32_t)p->depth / 8,
                          .alpha = picture_has_alpha(p),
                          .has_nodata = p->values != NULL,
                          .nodata = NAN};
    packed.stride = p->width * p->channels * p->depth / 8;
    packed.pixels = need(n, p->depth / 8);
    for (size_t i = 0; i < n; i++)
        if (p->depth == 8)
            ((uint8_t *)packed.pixels)[i] = (uint8_t)p->samples[i];
        else if (p->depth == 16)
            ((uint16_t *)packed.pixels)[i] = p->samples[i];
        else if (p->depth == 32)
            ((float *)packed.pixels)[i] = (float)p->values[i];
        else
            ((double *)packed.pixels)[i] = p->values[i];
    return packed;
}

static void unpack(picture *p, const icc_picture *packed)
{
    for (size_t i = 0; i < p->width * p->height * p->channels; i++)
        if (p->depth == 8)
            p->samples[i] = ((const uint8_t *)packed->pixels)[i];
        else if (p->depth == 16)
            p->samples[i] = ((const uint16_t *)packed->pixels)[i];
        else if (p->depth == 32)
            p->values[i] = (double)((const float *)packed->pixels)[i];
        else
            p->values[i] = ((const double *)packed->pixels)[i];
}

icc_status picture_warp(const icc_map *map, const picture *from, picture *to, size_t *n_failed,
                        const icc_env *env, icc_error *err)
{
    icc_picture before = pack(from), after = pack(to);
    icc_status status = icc_map_warp(map, &before, &after, n_failed, env, err);
    unpack(to, &after);
    free(before.pixels);
    free(after.pixels);
    return status;
}
