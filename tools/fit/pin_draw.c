/* Each part is drawn by itself, on a small picture around it, and then laid on the whole. Parts
 * without pins come first, so that those that move lie over them. */
#include "fit/pin_pose.h"

#include "base/allocate.h"
#include "job/call_files.h"
#include "picture/picture_file.h"
#include "plot/film.h"
#include "plot/picture_begin.h"
#include "plot/picture_warp.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest width and height of a picture. */
static const double MOST_PIXELS = 30000;

typedef struct box {
    double low[2], high[2];
} box;

static void box_add(box *b, size_t n, const double *points)
{
    for (size_t i = 0; i < 2 * n; i++) {
        b->low[i % 2] = fmin(b->low[i % 2], floor(points[i]));
        b->high[i % 2] = fmax(b->high[i % 2], ceil(points[i]));
    }
}

int pins_measure(pin_pose *p)
{
    const picture *from = &p->figure.picture;
    box all = {{0, 0}, {(double)from->width, (double)from->height}};
    for (size_t k = 0; k < p->figure.n; k++)
        for (size_t key = 0; key < p->n_keys; key++)
            box_add(&all, p->parts[k].n_vertices, p->parts[k].keys[key]);
    double width = all.high[0] - all.low[0], height = all.high[1] - all.low[1];
    if (!(width <= MOST_PIXELS && height <= MOST_PIXELS))
        return failed(
            p->job.args->pins, 0,
            "the posed picture would have %.6g x %.6g pixels; pins are in pixels, so move "
            "them less far",
            width, height);
    p->width = (size_t)width;
    p->height = (size_t)height;
    for (int c = 0; c < 2; c++)
        p->corner[c] = (long)all.low[c];
    return DONE;
}

/* ------------------------------------------------------------------ layers */

/* A part of the picture, and where its upper left corner lies in the whole. */
typedef struct layer {
    picture picture;
    size_t x, y;
} layer;

/* Draws a part at a key. */
static int draw_part(layer *out, pin_pose *p, size_t k, size_t key)
{
    const pinned_part *part = &p->parts[k];
    const picture *from = &p->figure.picture;
    box b = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    box_add(&b, part->n_vertices, part->keys[key]);
    out->x = (size_t)(b.low[0] - (double)p->corner[0]);
    out->y = (size_t)(b.low[1] - (double)p->corner[1]);
    out->picture = picture_make((size_t)(b.high[0] - b.low[0]), (size_t)(b.high[1] - b.low[1]),
                                from->channels, from->depth);
    double *images = need(part->n_vertices, 2 * sizeof *images);
    for (size_t i = 0; i < 2 * part->n_vertices; i++)
        images[i] = part->keys[key][i] - b.low[i % 2];
    icc_mesh mesh = {.size = sizeof mesh,
                     .dim = 2,
                     .n_vertices = part->n_vertices,
                     .vertices = part->keys[0],
                     .n_cells = part->n_triangles,
                     .cells = part->triangles};
    icc_map *map = NULL;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_map_info info = {.size = sizeof info};
    icc_status status = icc_map_create_nearest(&map, &mesh, images, NULL, NULL, &p->job.env, &err);
    if (status == ICC_OK)
        status = icc_map_get_info(map, &info);
    p->certified = p->certified && info.certified;
    if (status == ICC_OK)
        status = picture_warp(map, from, &out->picture, NULL, &p->job.env, &err);
    icc_map_free(map);
    free(images);
    return status == ICC_OK
               ? DONE
               : failed(p->job.args->operands[0], 0, "the pose: %s", job_message(&err));
}

/* Lays a pixel over another one. Returns true if both have colour. */
static bool lay_pixel(const picture *p, const uint16_t *over, uint16_t *under)
{
    unsigned n = p->channels - 1;
    double most = (double)((UINT32_C(1) << p->depth) - 1);
    double a = over[n] / most, b = under[n] / most * (1 - a), sum = a + b;
    if (over[n] == 0)
        return false;
    bool covers = under[n] > 0;
    for (unsigned c = 0; c < n && b > 0; c++)
        under[c] = (uint16_t)((a * over[c] + b * under[c]) / sum + 0.5);
    if (b > 0)
        under[n] = (uint16_t)(most * sum + 0.5);
    else
        memcpy(under, over, (n + 1) * sizeof *under);
    return covers;
}

/* Lays a layer on the whole. Returns the number of pixels in which both have colour. */
static size_t lay(const layer *l, picture *to)
{
    size_t n = 0;
    const picture *p = &l->picture;
    for (size_t y = 0; y < p->height; y++)
        for (size_t x = 0; x < p->width; x++)
            n += lay_pixel(p, p->samples + (y * p->width + x) * p->channels,
                           to->samples + ((l->y + y) * to->width + l->x + x) * p->channels);
    return n;
}

/* Draws all parts on a transparent picture, and then on the background. */
static int draw_key(picture *to, pin_pose *p, size_t key)
{
    const args *a = p->job.args;
    const picture *from = &p->figure.picture;
    int result = DONE;
    *to = picture_make(p->width, p->height, from->channels, from->depth);
    p->n_covered = 0;
    for (int moves = 0; moves < 2; moves++)
        for (size_t k = 0; k < p->figure.n && result == DONE; k++) {
            layer l = {.x = 0};
            if ((p->figure.parts[k].n_pins > 0) != moves)
                continue;
            result = draw_part(&l, p, k, key);
            if (result == DONE)
                p->n_covered += lay(&l, to);
            picture_free(&l.picture);
        }
    if (!a->has_background || result != DONE)
        return result;
    layer all = {.picture = *to};
    *to = picture_make(p->width, p->height, from->channels, from->depth);
    for (size_t i = 0; i < p->width * p->height; i++)
        picture_set(to, i, a->background);
    lay(&all, to);
    picture_free(&all.picture);
    return DONE;
}

/* ------------------------------------------------------------------ files */

/* Adds a picture to the film. */
static int add_to_film(film *out, const pin_pose *p, const picture *drawn,
                       const picture_style *style, size_t key)
{
    const args *a = p->job.args;
    problem wrong;
    size_t n;
    unsigned char *png = picture_encode(drawn, style, &n, &wrong);
    if (png == NULL)
        return failed(a->operands[1], 0, "%s", wrong.text);
    bool good = key > 0 || film_open(out, a->operands[1], (uint32_t)p->n_keys, frames_rate(a));
    if (good)
        film_add(out, png, n);
    free(png);
    return good ? DONE : FAILED;
}

/* Draws a key and writes it: the pose alone to OUT, keys to numbered files or to a film. */
static int write_key(film *out, pin_pose *p, const picture_style *style, size_t key)
{
    const char *name = p->job.args->operands[1];
    picture drawn = {.width = 0};
    int result = draw_key(&drawn, p, key);
    if (result == DONE && p->job.args->frames == 0) {
        result = picture_save(&drawn, style, name);
    } else if (result == DONE && is_film(name)) {
        result = add_to_film(out, p, &drawn, style, key);
    } else if (result == DONE) {
        char *numbered = frame_name(name, key);
        result = picture_save(&drawn, style, numbered);
        free(numbered);
    }
    picture_free(&drawn);
    return result;
}

int pins_draw(pin_pose *p)
{
    const args *a = p->job.args;
    film written = {.rate = 0};
    picture unused;
    picture_style style;
    int result = picture_begin(&unused, &style, &p->figure.picture, a,
                               is_film(a->operands[1]) ? "film.png" : a->operands[1]);
    picture_free(&unused);
    for (size_t key = a->frames > 0 ? 0 : p->n_keys - 1; key < p->n_keys && result == DONE; key++)
        result = write_key(&written, p, &style, key);
    progress_end(&p->job.bar);
    if (written.file.stream == NULL)
        return result;
    if (result == DONE)
        return film_close(&written) ? DONE : FAILED;
    film_abandon(&written);
    return result;
}
