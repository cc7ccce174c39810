/* Pictures of all kinds of samples, numbers of channels, opacity, missing samples and ways of
 * interpolation, through a map that shrinks, grows and turns, and through the identity: refused
 * with a reason, or twice the same bytes, nothing written outside the domain and between rows, and
 * whole numbers as they were from the identity. */
#include "fuzz.h"

#include <icc/icc.h>

enum { WIDE = 12, HIGH = 9, MARGIN = 2, GAP = 3, HEADER = 12, FILL = 0xa5 };

static icc_domain *box(double slant)
{
    const double corners[] = {0, 0, WIDE, slant, WIDE - slant, HIGH, slant, HIGH - slant};
    icc_domain *domain = NULL;
    require(icc_domain_create(&domain, 2, 4, corners, 0, NULL, NULL, NULL) == ICC_OK);
    return domain;
}

/* Made once and kept to the end of the program. */
static const icc_map *make_map(bool is_identity)
{
    static icc_domain *domains[2];
    static icc_map *maps[2];
    if (maps[is_identity] == NULL) {
        for (int k = 0; k < 2; ++k)
            domains[k] = domains[k] != NULL ? domains[k] : box(2.5 * k);
        require(icc_map_create(&maps[is_identity], domains[0], domains[!is_identity], NULL, NULL,
                               NULL) == ICC_OK);
    }
    return maps[is_identity];
}

static icc_picture reserve(const icc_picture *like, int32_t width, int32_t height)
{
    icc_picture p = *like;
    p.width = width;
    p.height = height;
    p.stride = (size_t)(width * p.channels * p.bytes) + GAP;
    p.pixels = malloc(p.stride * (size_t)height);
    if (p.pixels == NULL)
        exit(0);
    memset(p.pixels, FILL, p.stride * (size_t)height);
    return p;
}

/* Whether all that a target has beyond the domain's box is as it was. */
static void require_margin(const icc_picture *p, size_t pixel)
{
    const unsigned char *row = p->pixels;
    for (size_t j = 0; j < (size_t)p->height; ++j, row += p->stride)
        for (size_t k = j < HIGH ? WIDE * pixel : 0; k < p->stride; ++k)
            require(row[k] == FILL);
}

static void try_map(const icc_picture *source, bool is_identity)
{
    icc_picture target[2];
    size_t n_failed[2] = {0, 0};
    icc_status status[2];
    icc_error err = {.size = sizeof err};
    for (int k = 0; k < 2; ++k) {
        target[k] = reserve(source, WIDE + MARGIN, HIGH + MARGIN);
        status[k] =
            icc_map_warp(make_map(is_identity), source, &target[k], &n_failed[k], NULL, &err);
    }
    require(status[0] == status[1] && n_failed[0] == n_failed[1]);
    require(status[0] == ICC_OK || (status[0] == ICC_ERR_ARGUMENT && err.message[0] != '\0'));
    require(memcmp(target[0].pixels, target[1].pixels,
                   target[0].stride * (size_t)target[0].height) == 0);
    const size_t pixel = (size_t)(source->channels * source->bytes);
    require_margin(&target[0], status[0] == ICC_OK ? pixel : 0);
    const unsigned char *from = source->pixels, *to = target[0].pixels;
    for (size_t j = 0; j < HIGH && status[0] == ICC_OK && is_identity && source->bytes < 4; ++j)
        require(memcmp(from + j * source->stride, to + j * target[0].stride, WIDE * pixel) == 0);
    free(target[0].pixels);
    free(target[1].pixels);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size <= HEADER)
        return 0;
    icc_picture like = {.size = sizeof like,
                        .channels = 1 + data[0] % 64,
                        .bytes = 1 << data[1] % 4,
                        .alpha = data[2] % 4 == 1,
                        .interpolation = data[3] % 5,
                        .has_nodata = data[2] % 4 > 1};
    memcpy(&like.nodata, data + 4, sizeof like.nodata);
    if (data[2] % 4 == 2 && like.bytes < 4)
        like.nodata = data[HEADER];
    icc_picture source = reserve(&like, WIDE, HIGH);
    for (size_t k = 0; k < source.stride * HIGH; ++k)
        ((unsigned char *)source.pixels)[k] = data[HEADER + k % (size - HEADER)];
    try_map(&source, false);
    try_map(&source, true);
    free(source.pixels);
    return 0;
}
