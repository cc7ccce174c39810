/* Every way to sample that this processor supports gives the bits of plain C. */
#include "map/picture/sampler.h"

#include "../../../random.h"
#include "../../../suite.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SAMPLES = 40, MOST_BYTES = 8 };

/* Opacities: all different, all the same, or in runs. */
typedef enum filling { NOISE, OPAQUE, RUNS, CLEAR, N_FILLINGS } filling;

static unsigned opacity(random_source *r, filling how, unsigned before)
{
    const unsigned any = (unsigned)random_below(r, 65536);
    if (how == RUNS)
        return random_below(r, 5) > 0 ? before : any % 3 == 0 ? any : any % 2 * 65535;
    return how == NOISE ? any : how == OPAQUE ? 65535 : 0;
}

static icc_picture make(random_source *r, int32_t width, int32_t height, int32_t channels,
                        int32_t bytes, int32_t alpha, filling how)
{
    icc_picture p = {.size = sizeof p,
                     .width = width,
                     .height = height,
                     .channels = channels,
                     .bytes = bytes,
                     .alpha = alpha,
                     .stride =
                         (size_t)width * (size_t)(channels * bytes) + (size_t)random_below(r, 4)};
    /* The last row has no gap after it, so that what reads beyond is found. */
    const size_t n = p.stride * (size_t)(height - 1) + (size_t)(width * channels * bytes);
    uint8_t *at = malloc(n);
    ck_assert_ptr_nonnull(at);
    p.pixels = at;
    for (size_t k = 0; k < n; ++k)
        at[k] = (uint8_t)random_below(r, 256);
    unsigned before = 0;
    for (int32_t j = 0; j < height; ++j)
        for (int32_t i = 0; i < width && alpha; ++i) {
            const uint16_t two = (uint16_t)(before = opacity(r, how, before));
            uint8_t *last =
                at + (size_t)j * p.stride + (size_t)((i + 1) * channels * bytes - bytes);
            if (bytes == 2)
                memcpy(last, &two, 2);
            else
                *last = (uint8_t)(two >> 8);
        }
    return p;
}

/* Between two places, some of them at the corners and some beyond the picture. */
static iccp_line random_line(random_source *r, const icc_picture *p)
{
    double end[2][2];
    const double last[2] = {p->width - 1, p->height - 1};
    for (int k = 0; k < 4; ++k)
        end[k / 2][k % 2] = random_below(r, 4) == 0   ? last[k % 2] * (double)random_below(r, 2)
                            : random_below(r, 8) == 0 ? random_between(r, -2, last[k % 2] + 2)
                                                      : random_unit(r) * last[k % 2];
    const size_t n = 1 + (size_t)random_below(r, MOST_SAMPLES);
    const double steps = n > 1 ? (double)(n - 1) : 1;
    return (iccp_line){end[0][0], end[0][1], (end[1][0] - end[0][0]) / steps,
                       (end[1][1] - end[0][1]) / steps, n};
}

/* What a line gives: painted, and gathered and stored. A byte after the last pixel would show that
 * too much is written. */
typedef struct result {
    uint8_t painted[MOST_SAMPLES * MOST_BYTES + 1];
    uint8_t stored[(MOST_SAMPLES + 1) * MOST_BYTES + 1];
    float sums[MOST_SAMPLES + 1][5];
} result;

static void sample(const iccp_sampler *sampler, const iccp_line *line, size_t phase,
                   size_t per_pixel, result *out)
{
    const float weight = 1 / (float)per_pixel;
    iccp_gathered gathered[MOST_SAMPLES + 1] = {{{0}, 0}};
    memset(out, 0, sizeof *out);
    iccp_sampler_paint(sampler, line, out->painted);
    iccp_sampler_gather(sampler, line, weight, phase, per_pixel, gathered);
    size_t n = 0;
    for (size_t k = 0; k <= MOST_SAMPLES; ++k) {
        for (int32_t c = 0; c < sampler->source->channels; ++c)
            out->sums[k][c] = gathered[k].sums[c];
        out->sums[k][4] = gathered[k].weight;
        n += gathered[k].weight > 0;
    }
    iccp_sampler_store(sampler, gathered, n, out->stored);
}

static void expect_same(const result *a, const result *b)
{
    ck_assert_mem_eq(a->painted, b->painted, sizeof a->painted);
    ck_assert_mem_eq(a->sums, b->sums, sizeof a->sums);
    ck_assert_mem_eq(a->stored, b->stored, sizeof a->stored);
}

/* Each level, and what the library chooses by itself. */
static void compare(random_source *r, const icc_picture *p)
{
    for (int round = 0; round < 40; ++round) {
        const iccp_line line = random_line(r, p);
        const size_t per_pixel = 1 + (size_t)random_below(r, 5),
                     phase = (size_t)random_below(r, (int)per_pixel);
        result plain, other;
        iccp_sampler sampler;
        iccp_sampler_init_as(ICCP_SIMD_NONE, &sampler, p);
        sample(&sampler, &line, phase, per_pixel, &plain);
        for (iccp_simd_level level = ICCP_SIMD_SSE42; level <= iccp_simd(); ++level) {
            iccp_sampler_init_as(level, &sampler, p);
            sample(&sampler, &line, phase, per_pixel, &other);
            expect_same(&plain, &other);
        }
        iccp_sampler_init(&sampler, p);
        sample(&sampler, &line, phase, per_pixel, &other);
        expect_same(&plain, &other);
    }
}

START_TEST(all_kinds_give_the_same_bits)
{
    static const int32_t sizes[7][2] = {{1, 1}, {1, 6}, {2, 1}, {2, 2}, {3, 5}, {17, 4}, {40, 31}};
    random_source r = {3};
    for (int size = 0; size < 7; ++size)
        for (int32_t channels = 1; channels <= 4; ++channels)
            for (int32_t bytes = 1; bytes <= 2; ++bytes)
                for (int32_t alpha = 0; alpha <= (channels > 1); ++alpha)
                    for (filling how = NOISE; how < (alpha ? N_FILLINGS : OPAQUE); ++how) {
                        const icc_picture p =
                            make(&r, sizes[size][0], sizes[size][1], channels, bytes, alpha, how);
                        compare(&r, &p);
                        free(p.pixels);
                    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sampler");
    TCase *tests = tcase_create("sampler");
    tcase_add_test(tests, all_kinds_give_the_same_bits);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
