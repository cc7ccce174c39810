/* libicc warp: a picture inside a cage follows it. */
#include "commands.h"

#include "job.h"
#include "memory.h"
#include "picture.h"

#include <stdlib.h>

typedef struct warp {
    job job;
    picture from, to;
    size_t n_failed;
} warp;

static int read_picture(warp *w)
{
    const args *a = w->job.args;
    size_t n;
    char *bytes = file_read(a->operands[0], &n);
    if (bytes == NULL)
        return FAILED;
    problem wrong;
    bool good = picture_decode(&w->from, bytes, n, &wrong);
    free(bytes);
    if (!good)
        return failed(a->operands[0], 0, "%s", wrong.text);
    if (a->has_background)
        picture_widen(&w->from,
                      a->background[0] != a->background[1] || a->background[0] != a->background[2],
                      a->background[3] < 255);
    w->to = picture_copy(&w->from);
    for (size_t i = 0; a->has_background && i < w->to.width * w->to.height; i++)
        picture_set(&w->to, i, a->background);
    return DONE;
}

static int write_picture(const warp *w)
{
    const char *name = w->job.args->operands[1];
    problem wrong;
    size_t n;
    unsigned char *bytes = picture_encode(&w->to, w->from.keep, &n, &wrong);
    if (bytes == NULL)
        return failed(name, 0, "%s", wrong.text);
    outfile file;
    int result = outfile_open(&file, name) ? DONE : FAILED;
    if (result == DONE) {
        fwrite(bytes, 1, n, file.stream);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    free(bytes);
    return result;
}

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

static int warp_picture(warp *w)
{
    icc_error err = {.size = sizeof err, .index = -1};
    icc_picture from = pack(&w->from), to = pack(&w->to);
    double began = seconds_now();
    icc_status ran = icc_map_warp(w->job.map, &from, &to, &w->n_failed, &w->job.env, &err);
    double seconds = seconds_now() - began;
    progress_end(&w->job.bar);
    unpack(&w->to, &to);
    free(from.pixels);
    free(to.pixels);
    int result = ran == ICC_OK ? write_picture(w) : job_failed(&w->job, &err);
    if (result == DONE)
        result = report_points(&w->job, w->to.width * w->to.height, w->n_failed, seconds);
    if (result != DONE || w->n_failed == 0)
        return result;
    note("%zu of %zu pixels have no image in the source: the curves do not reach them", w->n_failed,
         w->to.width * w->to.height);
    return PARTIAL;
}

int run_warp(const args *a)
{
    warp w = {0};
    job_start(&w.job, a);
    int result = job_read_plane(&w.job, "warp");
    if (result == DONE)
        result = job_make_map(&w.job);
    if (result == DONE)
        result = read_picture(&w);
    if (result == DONE)
        result = warp_picture(&w);
    picture_free(&w.from);
    picture_free(&w.to);
    job_end(&w.job);
    return result;
}
