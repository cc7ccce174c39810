#include "plot/picture_warp.h"

#include "base/allocate.h"

#include <stdlib.h>

/* The samples as the library takes them; free() the pixels. */
static icc_picture pack(const picture *p)
{
    size_t n = p->width * p->height * p->channels;
    icc_picture packed = {.size = sizeof packed,
                          .width = (int32_t)p->width,
                          .height = (int32_t)p->height,
                          .channels = (int32_t)p->channels,
                          .bytes = (int32_t)p->depth / 8,
                          .alpha = p->channels % 2 == 0};
    packed.stride = p->width * p->channels * p->depth / 8;
    packed.pixels = need(n, p->depth / 8);
    for (size_t i = 0; i < n; i++)
        if (p->depth == 8)
            ((uint8_t *)packed.pixels)[i] = (uint8_t)p->samples[i];
        else
            ((uint16_t *)packed.pixels)[i] = p->samples[i];
    return packed;
}

static void unpack(picture *p, const icc_picture *packed)
{
    for (size_t i = 0; i < p->width * p->height * p->channels; i++)
        p->samples[i] = p->depth == 8 ? ((const uint8_t *)packed->pixels)[i]
                                      : ((const uint16_t *)packed->pixels)[i];
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
