/* A skeleton of Spine 4.2 (http://esotericsoftware.com/spine-json-format). Each part is a slot with
 * a mesh. The vertices of its outer boundary come first, which is Spine's hull. A timeline of the mesh
 * moves every vertex to its place at each key, so it plays the same pose. Each pin is a bone that goes
 * along, for what you attach there. Spine's y points up. The origin is the middle of the picture's
 * lower edge. */
#include "fit/pin_pose.h"

#include "base/allocate.h"
#include "base/system.h"
#include "fit/pin_path.h"
#include "job/call_files.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct spine {
    const pin_pose *p;
    json json;
    char *picture; /* its name without the ending: so Spine calls pictures */
} spine;

/* ------------------------------------------------------------------ hull */

/* An edge of a triangle, along it. */
typedef struct side {
    uint32_t from, to;
} side;

static int compare_sides(const void *a, const void *b)
{
    const side *p = a, *q = b;
    return p->from != q->from ? (p->from > q->from) - (p->from < q->from)
                              : (p->to > q->to) - (p->to < q->to);
}

/* The vertex after each along the boundary, or NULL inside: then it is its own. */
static uint32_t *find_next(const pinned_part *part)
{
    size_t n = 3 * part->n_triangles;
    side *sides = need(n, sizeof *sides);
    uint32_t *next = need(part->n_vertices, sizeof *next);
    for (uint32_t v = 0; v < part->n_vertices; v++)
        next[v] = v;
    for (size_t i = 0; i < n; i++)
        sides[i] = (side){part->triangles[i], part->triangles[i % 3 == 2 ? i - 2 : i + 1]};
    qsort(sides, n, sizeof *sides, compare_sides);
    for (size_t i = 0; i < n; i++) {
        const side back = {sides[i].to, sides[i].from};
        if (bsearch(&back, sides, n, sizeof *sides, compare_sides) == NULL)
            next[sides[i].from] = sides[i].to;
    }
    free(sides);
    return next;
}

/* Twice the area in a loop of the boundary. Its vertices are marked. */
static double loop_area(const pinned_part *part, const uint32_t *next, uint32_t first, bool *seen)
{
    double area = 0;
    uint32_t v = first;
    do {
        const double *a = part->keys[0] + 2 * v, *b = part->keys[0] + 2 * next[v];
        area += a[0] * b[1] - a[1] * b[0];
        seen[v] = true;
        v = next[v];
    } while (v != first);
    return area;
}

/* Lists all vertices, those of the outer boundary first and in its order. Triangles run
 * counter-clockwise, and so does this loop; those of holes run the other way. Returns their number. */
static size_t order_vertices(const pinned_part *part, uint32_t *order)
{
    uint32_t *next = find_next(part), first = 0;
    bool *seen = need(part->n_vertices, sizeof *seen),
         *placed = need(part->n_vertices, sizeof *placed);
    size_t n = 0, n_hull;
    for (uint32_t v = 0; v < part->n_vertices; v++)
        if (next[v] != v && !seen[v] && loop_area(part, next, v, seen) > 0)
            first = v;
    uint32_t v = first;
    do {
        order[n++] = v;
        placed[v] = true;
        v = next[v];
    } while (v != first);
    n_hull = n;
    for (v = 0; v < part->n_vertices; v++)
        if (!placed[v])
            order[n++] = v;
    free(next);
    free(seen);
    free(placed);
    return n_hull;
}

/* ------------------------------------------------------------------ values */

static double to_x(const spine *s, double x)
{
    return x - (double)s->p->figure.picture.width / 2;
}

static double to_y(const spine *s, double y)
{
    return (double)s->p->figure.picture.height - y;
}

static double time_of(const spine *s, size_t key)
{
    const args *a = s->p->job.args;
    return a->frames == 0 ? (double)key : (double)key / frames_rate(a);
}

/* Writes a list in one line: begin, numbers, end. */
static void list_begin(spine *s, const char *name)
{
    json_raw(&s->json, name, "[", 1);
}

static void list_add(spine *s, size_t i, double value)
{
    fprintf(s->json.stream, "%s%.10g", i > 0 ? "," : "", value);
}

static void list_end(spine *s)
{
    fputc(']', s->json.stream);
}

/* The name of a slot, or of a part of the picture. */
static void slot_name(char out[64], const spine *s, size_t k)
{
    if (s->p->figure.n == 1)
        snprintf(out, 64, "figure");
    else
        snprintf(out, 64, "part %zu", k + 1);
}

/* The name of a pin's bone. Names of bones are unique. */
static void bone_name(char out[96], const control_points *pins, size_t i)
{
    const char *name = pins->names[i];
    bool taken = name == NULL || strcmp(name, "root") == 0;
    for (size_t k = 0; k < i && !taken; k++)
        taken = pins->names[k] != NULL && strcmp(name, pins->names[k]) == 0;
    if (name == NULL)
        snprintf(out, 96, "pin %zu", i + 1);
    else
        snprintf(out, 96, taken ? "%.64s (pin %zu)" : "%.64s", name, i + 1);
}

/* ------------------------------------------------------------------ sections */

static void write_bones(spine *s)
{
    json *j = &s->json;
    const control_points *pins = &s->p->pins;
    char name[96];
    json_open(j, "bones", '[');
    json_open(j, NULL, '{');
    json_text(j, "name", "root");
    json_close(j, '}');
    for (size_t i = 0; i < pins->n; i++) {
        bone_name(name, pins, i);
        json_open(j, NULL, '{');
        json_text(j, "name", name);
        json_text(j, "parent", "root");
        json_number(j, "x", to_x(s, pins->from[2 * i]));
        json_number(j, "y", to_y(s, pins->from[2 * i + 1]));
        json_close(j, '}');
    }
    json_close(j, ']');
}

/* Slots are drawn in their order: parts without pins first. */
static void write_slots(spine *s)
{
    json *j = &s->json;
    char name[64];
    json_open(j, "slots", '[');
    for (int moves = 0; moves < 2; moves++)
        for (size_t k = 0; k < s->p->figure.n; k++) {
            if ((s->p->figure.parts[k].n_pins > 0) != moves)
                continue;
            slot_name(name, s, k);
            json_open(j, NULL, '{');
            json_text(j, "name", name);
            json_text(j, "bone", "root");
            json_text(j, "attachment", s->picture);
            json_close(j, '}');
        }
    json_close(j, ']');
}

static void write_mesh(spine *s, const pinned_part *part, const uint32_t *order, size_t n_hull)
{
    json *j = &s->json;
    const picture *from = &s->p->figure.picture;
    const double size[2] = {(double)from->width, (double)from->height};
    uint32_t *number = need(part->n_vertices, sizeof *number);
    for (uint32_t i = 0; i < part->n_vertices; i++)
        number[order[i]] = i;
    json_open(j, s->picture, '{');
    json_text(j, "type", "mesh");
    list_begin(s, "uvs");
    for (size_t i = 0; i < 2 * part->n_vertices; i++)
        list_add(s, i, part->keys[0][2 * order[i / 2] + i % 2] / size[i % 2]);
    list_end(s);
    list_begin(s, "triangles");
    for (size_t i = 0; i < 3 * part->n_triangles; i++)
        list_add(s, i, number[part->triangles[i]]);
    list_end(s);
    list_begin(s, "vertices");
    for (size_t i = 0; i < part->n_vertices; i++) {
        list_add(s, 2 * i, to_x(s, part->keys[0][2 * order[i]]));
        list_add(s, 1, to_y(s, part->keys[0][2 * order[i] + 1]));
    }
    list_end(s);
    json_count(j, "hull", n_hull);
    json_number(j, "width", size[0]);
    json_number(j, "height", size[1]);
    json_close(j, '}');
    free(number);
}

/* Each key but the first has what is added to the vertices at rest. */
static void write_deform(spine *s, const pinned_part *part, const uint32_t *order)
{
    json *j = &s->json;
    json_open(j, s->picture, '{');
    json_open(j, "deform", '[');
    for (size_t key = 0; key < s->p->n_keys; key++) {
        json_open(j, NULL, '{');
        json_number(j, "time", time_of(s, key));
        if (key > 0) {
            list_begin(s, "vertices");
            for (size_t i = 0; i < part->n_vertices; i++) {
                const double *a = part->keys[0] + 2 * order[i], *b = part->keys[key] + 2 * order[i];
                list_add(s, 2 * i, b[0] - a[0]);
                list_add(s, 1, a[1] - b[1]);
            }
            list_end(s);
        }
        json_close(j, '}');
    }
    json_close(j, ']');
    json_close(j, '}');
}

/* Writes the meshes, or their timelines. */
static void write_parts(spine *s, bool timelines)
{
    char name[64];
    for (size_t k = 0; k < s->p->figure.n; k++) {
        const pinned_part *part = &s->p->parts[k];
        if (timelines && s->p->figure.parts[k].n_pins == 0)
            continue;
        uint32_t *order = need(part->n_vertices, sizeof *order);
        size_t n_hull = order_vertices(part, order);
        slot_name(name, s, k);
        json_open(&s->json, name, '{');
        if (timelines)
            write_deform(s, part, order);
        else
            write_mesh(s, part, order, n_hull);
        json_close(&s->json, '}');
        free(order);
    }
}

static void write_skins(spine *s)
{
    json *j = &s->json;
    json_open(j, "skins", '[');
    json_open(j, NULL, '{');
    json_text(j, "name", "default");
    json_open(j, "attachments", '{');
    write_parts(s, false);
    json_close(j, '}');
    json_close(j, '}');
    json_close(j, ']');
}

/* Bones go along with their pins, and turn as these do. `ways`: the places of all pins at all keys. */
static void write_bone_timelines(spine *s, const double *ways, size_t i)
{
    json *j = &s->json;
    const control_points *pins = &s->p->pins;
    const double *from = pins->from + 2 * i;
    const bool turns = !isnan(pins->turns[i]);
    char name[96];
    bone_name(name, pins, i);
    json_open(j, name, '{');
    for (int turning = 0; turning <= turns; turning++) {
        json_open(j, turning ? "rotate" : "translate", '[');
        for (size_t key = 0; key < s->p->n_keys; key++) {
            double share = (double)key / (double)(s->p->n_keys - 1);
            const double *at = ways + 2 * (key * pins->n + i);
            json_open(j, NULL, '{');
            json_number(j, "time", time_of(s, key));
            if (turning) {
                json_number(j, "value", -share * pins->turns[i]);
            } else {
                json_number(j, "x", at[0] - from[0]);
                json_number(j, "y", from[1] - at[1]);
            }
            json_close(j, '}');
        }
        json_close(j, ']');
    }
    json_close(j, '}');
}

static void write_animation(spine *s)
{
    json *j = &s->json;
    json_open(j, "animations", '{');
    json_open(j, "pose", '{');
    json_open(j, "bones", '{');
    const control_points *pins = &s->p->pins;
    double *ways = need(s->p->n_keys * pins->n, 2 * sizeof *ways);
    for (size_t key = 0; key < s->p->n_keys; key++)
        pins_places(ways + 2 * key * pins->n, pins, (double)key / (double)(s->p->n_keys - 1));
    for (size_t i = 0; i < pins->n; i++)
        write_bone_timelines(s, ways, i);
    free(ways);
    json_close(j, '}');
    json_open(j, "attachments", '{');
    json_open(j, "default", '{');
    write_parts(s, true);
    json_close(j, '}');
    json_close(j, '}');
    json_close(j, '}');
    json_close(j, '}');
}

static void write_head(spine *s)
{
    json *j = &s->json;
    const picture *from = &s->p->figure.picture;
    json_open(j, "skeleton", '{');
    json_text(j, "spine", "4.2.0");
    json_number(j, "x", to_x(s, 0));
    json_number(j, "y", 0);
    json_count(j, "width", from->width);
    json_count(j, "height", from->height);
    json_close(j, '}');
}

int pins_write_spine(const pin_pose *p)
{
    outfile file;
    const args *a = p->job.args;
    const char *name = system_last_part(a->operands[0]), *dot = strrchr(name, '.');
    size_t n = dot != NULL ? (size_t)(dot - name) : strlen(name);
    if (!outfile_open(&file, a->spine))
        return FAILED;
    spine s = {.p = p, .json = {.stream = file.stream, .first = true}, .picture = need(n + 1, 1)};
    memcpy(s.picture, name, n);
    json_open(&s.json, NULL, '{');
    write_head(&s);
    write_bones(&s);
    write_slots(&s);
    write_skins(&s);
    write_animation(&s);
    json_close(&s.json, '}');
    free(s.picture);
    return outfile_close(&file) ? DONE : FAILED;
}
