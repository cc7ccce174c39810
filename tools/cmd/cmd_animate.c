/* libicc animate: a picture follows its cage along a path of cages, one picture for each frame.
 *
 * The first map is made. Each further map follows the one before to the next cage, so that the
 * inside does not jump from frame to frame. Between two cages of the path, vertices move
 * straight. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/system.h"
#include "cage/cage_between.h"
#include "job/call_files.h"
#include "job/job.h"
#include "picture/picture_file.h"
#include "plot/coverage.h"
#include "plot/film.h"
#include "plot/picture_begin.h"
#include "plot/picture_warp.h"
#include "report/reason.h"

#include <stdlib.h>
#include <string.h>

/* The share of the time that the first map takes, compared with a frame. */
static const double FIRST = 0.3;

/* Facts about a frame for the report. */
typedef struct frame_facts {
    icc_map_info map;
    icc_map_report made;

    size_t n_failed; /* pixels without an image */
} frame_facts;

typedef struct animation {
    const args *args;
    source_file source;
    size_t n_keys;
    job *keys; /* from the source to each cage of the path; the first one has the map and the
                  progress */
    picture from, empty; /* the picture that is read, and the empty one that frames are drawn on */
    picture_style style;
    film film;    /* if is_film() */
    icc_map *map; /* to the cage of the present frame, if it is not the first */
    size_t frame, n_frames;
    frame_facts *frames; /* n_frames; those before `frame` are known */
    double began;
} animation;

static size_t n_steps(const args *a)
{
    return a->steps > 0 ? (size_t)a->steps : 1;
}

/* The source may be a pipe, so its file is read once. */
static int read_keys(animation *x)
{
    x->source.text = file_read_chosen(x->args->source, &x->source.n, &x->source.named);
    int result = x->source.text != NULL ? DONE : FAILED;
    for (size_t k = 0; k < x->n_keys && result == DONE; k++) {
        args own = *x->args;
        own.target = x->args->operands[2 + k];
        job_start(&x->keys[k], &own);
        x->keys[k].source = &x->source;
        result = job_read_plane(&x->keys[k], "animate");
        if (result == DONE)
            result = job_make_domains(&x->keys[k]);
    }
    return result;
}

static int read_picture(animation *x)
{
    const args *a = x->args;
    if (a->rate > 0 && !is_film(a->operands[1]))
        return misused(a->command, "--rate is for films, whose OUT is named .apng");
    int result = picture_read(&x->from, a->operands[0]);
    const char *name = is_film(a->operands[1]) ? "film.png" : a->operands[1];
    return result == DONE ? picture_begin(&x->empty, &x->style, &x->from, a, name) : result;
}

/* Adds a picture to the film. */
static int add_to_film(animation *x, const picture *p)
{
    const args *a = x->args;
    problem wrong;
    size_t n;
    unsigned char *png = picture_encode(p, &x->style, &n, &wrong);
    if (png == NULL)
        return failed(a->operands[1], 0, "%s", wrong.text);
    if (x->frame == 0 &&
        !film_open(&x->film, a->operands[1], (uint32_t)x->n_frames, frames_rate(a))) {
        free(png);
        return FAILED;
    }
    film_add(&x->film, png, n);
    free(png);
    return DONE;
}

/* Writes a picture to a file of its own, or adds it to the film. */
static int save(animation *x, const picture *p)
{
    if (is_film(x->args->operands[1]))
        return add_to_film(x, p);
    char *name = frame_name(x->args->operands[1], x->frame);
    int result = picture_save(p, &x->style, name);
    free(name);
    return result;
}

/* Announces one more library call for a frame. */
static void expect_frame(animation *x)
{
    progress_expect(&x->keys[0].bar, 1.0 / (double)(2 * (x->n_frames - x->frame)));
}

static int write_frame(animation *x, const icc_map *map)
{
    job *j = &x->keys[0];
    icc_error err = {.size = sizeof err, .index = -1};
    picture to = picture_copy(&x->empty);
    frame_facts *facts = &x->frames[x->frame];
    expect_frame(x);
    icc_status status = picture_warp(map, &x->from, &to, &facts->n_failed, &j->env, &err);
    int result = DONE;
    if (status == ICC_OK) {
        result = save(x, &to);
    } else {
        result = job_failed(j, &err);
    }
    picture_free(&to);
    facts->map = (icc_map_info){.size = sizeof facts->map};
    icc_map_get_info(map, &facts->map);
    facts->made = (icc_map_report){.size = sizeof facts->made};
    icc_map_get_report(map, &facts->made);
    x->frame++;
    return result;
}

/* Reports why a frame between two cages, or at the second one, cannot be made. */
static int failed_frame(animation *x, size_t key, double share, const icc_error *err)
{
    progress_end(&x->keys[0].bar);
    return failed(job_file(&x->keys[key], 2), 0,
                  "frame %zu, %g of the way from %s: %s; cages between the two may help", x->frame,
                  share, job_file(&x->keys[key - 1], 2), job_message(err));
}

/* Moves the map of the frame before to a share of the way from one cage of the path to the next. */
static int follow(animation *x, size_t key, double share)
{
    job *first = &x->keys[0];
    const icc_map *old = x->map != NULL ? x->map : first->map;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_domain *own = NULL;
    icc_map *map = NULL;
    icc_status status = ICC_OK;
    if (share < 1) {
        cage c = cage_between(&x->keys[key - 1].cages[1], &x->keys[key].cages[1], share);
        status = job_make_polygon(&own, &c, &first->env, &err);
        cage_free(&c);
    }
    expect_frame(x);
    if (status == ICC_OK)
        status = icc_map_retarget(&map, old, own != NULL ? own : x->keys[key].domains[1], NULL,
                                  &first->env, &err);
    icc_domain_free(own);
    if (status != ICC_OK)
        return failed_frame(x, key, share, &err);
    icc_map_free(x->map);
    x->map = map;
    return write_frame(x, map);
}

static int write_frames(animation *x)
{
    size_t steps = n_steps(x->args);
    int result = write_frame(x, x->keys[0].map);
    for (size_t key = 1; key < x->n_keys; key++)
        for (size_t i = 1; i <= steps && result == DONE; i++)
            result = follow(x, key, i < steps ? (double)i / (double)steps : 1);
    if (x->film.file.stream == NULL)
        return result;
    if (result == DONE)
        return film_close(&x->film) ? DONE : FAILED;
    film_abandon(&x->film);
    return result;
}

/* Writes one object for each frame: its file and what is proved of its map. */
static void report_frames(animation *x, json *j)
{
    json_open(j, "frames", '[');
    for (x->frame = 0; x->frame < x->n_frames; x->frame++) {
        const frame_facts *facts = &x->frames[x->frame];
        char reason[REASON_LENGTH], *name = frame_name(x->args->operands[1], x->frame);
        json_open(j, NULL, '{');
        json_text(j, "file", name);
        json_flag(j, "certified", facts->map.certified != 0);
        if (!facts->map.certified)
            json_text(j, "not_certified_because", reason_of_map(reason, &facts->map, &facts->made));
        json_count(j, "without_image", facts->n_failed);
        json_close(j, '}');
        free(name);
    }
    json_close(j, ']');
}

static int write_report(animation *x, size_t n, size_t n_failed)
{
    const job *j = &x->keys[0];
    double seconds = seconds_now() - x->began;
    report r;
    if (!j->args->json)
        return DONE;
    if (!report_open(&r, j))
        return FAILED;
    json_count(&r.json, "points", n);
    json_count(&r.json, "without_image", n_failed);
    report_frames(x, &r.json);
    report_times(&r, j, seconds);
    return report_close(&r) ? DONE : FAILED;
}

static int finish(animation *x)
{
    progress_end(&x->keys[0].bar);
    size_t n = x->n_frames * x->from.width * x->from.height, n_failed = 0;
    for (size_t i = 0; i < x->n_frames; i++)
        n_failed += x->frames[i].n_failed;
    int result = write_report(x, n, n_failed);
    if (result != DONE || n_failed == 0)
        return result;
    note("%zu of %zu pixels have no image in the source", n_failed, n);
    return PARTIAL;
}

int run_animate(const args *a)
{
    animation x = {.args = a, .n_keys = a->n_operands - 2};
    x.n_frames = frames_count(a);
    x.keys = need(x.n_keys, sizeof *x.keys);
    x.frames = need(x.n_frames, sizeof *x.frames);
    int result = read_keys(&x);
    if (result == DONE)
        result = read_picture(&x);
    progress_expect(&x.keys[0].bar, FIRST);
    if (result == DONE)
        result = job_make_map(&x.keys[0]);
    if (result == DONE)
        coverage_tell(&x.keys[0], x.from.width, x.from.height);
    x.began = seconds_now();
    if (result == DONE)
        result = write_frames(&x);
    if (result == DONE)
        result = finish(&x);
    icc_map_free(x.map);
    picture_free(&x.from);
    picture_free(&x.empty);
    for (size_t k = 0; k < x.n_keys; k++)
        job_end(&x.keys[k]);
    free(x.keys);
    free(x.frames);
    free(x.source.text);
    return result;
}
