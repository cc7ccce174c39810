/* Lists the files of a call from its options, and compares them. */
#include "job/call_files.h"

#include "base/allocate.h"
#include "base/file.h"
#include "base/say.h"
#include "base/system.h"
#include "job/output_name.h"
#include "mesh/numbered_mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool has_bound(const args *a, const command *c)
{
    return c->bit & FOR_POSE && a->binding != NULL;
}

/* The input at place `i`. False if there are not so many. */
static bool call_input(call_file *out, const args *a, const command *c, size_t i)
{
    bool is_fit = (c->bit & FOR_FIT) != 0;
    bool has_operand = (c->n_operands >= 2 || a->geojson || a->warps || a->rectifies) &&
                       !has_bound(a, c) && a->n_operands > is_fit;
    const call_file inputs[] = {
        {is_fit && a->n_operands > 0 ? a->operands[0] : NULL, "POINTS", 0},
        {has_operand ? a->operands[is_fit] : NULL, a->fill ? "SURFACE" : "IN", 0},
        {a->outline, "--outline", 0},
        {a->moves, "--fit", 0},
        {a->nearest, "--nearest", 0},
        {a->source, "--source", 0},
        {a->target, "--target", 0},
        {a->mesh, "--mesh", 0},
        {a->target_mesh, "--target-mesh", 0},
        {a->points, "--points", 0},
        {a->coords, "--coords", 0},
        {a->handles, "--handles", 0},
        {a->pose, "--pose", 0},
        {a->pins, "--pins", 0},
        {has_bound(a, c) ? a->binding : NULL, "--binding", 0},
        {a->landmarks, "--landmarks", 0},
        {a->feature_points, "--feature-points", 0},
        {a->target_feature_points, "--target-feature-points", 0},
        {a->feature_lines, "--feature-lines", 0},
        {a->target_feature_lines, "--target-feature-lines", 0}};
    const struct {
        const file_list *list;
        const char *option;
    } lists[] = {{&a->voids, "--void"},
                 {&a->surfaces, "--surface"},
                 {&a->target_voids, "--target-void"},
                 {&a->target_surfaces, "--target-surface"}};
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++) {
        if (i < lists[k].list->n) {
            *out = (call_file){lists[k].list->names[i], lists[k].option, 0};
            return true;
        }
        i -= lists[k].list->n;
    }
    const size_t n = sizeof inputs / sizeof *inputs;
    if (i < n)
        *out = inputs[i];
    else if (c->bit & FOR_ANIMATE && i - n + 2 < a->n_operands)
        *out = (call_file){a->operands[i - n + 2], "CAGE", NULL};
    else
        return false;
    return true;
}

/* The formats that the last operand may have, before its input has been read. */
static const char *formats_of_operand(const args *a, const command *c)
{
    return a->geojson                                      ? "GeoJSON, GeoJSONSeq, JSON"
           : c->bit & FOR_ANIMATE                          ? PICTURES ", animated PNG"
           : c->bit & FOR_WARP || a->warps || a->rectifies ? PICTURES
           : a->fill                                       ? NUMBERED_MESHES
           : c->bit & FOR_MESH               ? "OBJ, OFF, PLY, STL, glTF, Medit, VTK, VTU, Gmsh"
           : c->bit & FOR_PLOT               ? "SVG, PNG, VTK, HTML"
           : a->frames > 0                   ? PICTURES ", animated PNG"
           : a->pins != NULL                 ? PICTURES
           : c->bit & FOR_POSE && a->binding ? "text"
           : c->bit & FOR_POSE ? "text, OBJ, OFF, PLY, STL, glTF, Medit, VTK, VTU, Gmsh, " PICTURES
                               : NULL;
}

bool call_output(call_file *out, const args *a, const command *c, size_t i)
{
    const char *of_operand = formats_of_operand(a, c);
    const call_file outputs[] = {
        {a->output, "--output", c->bit & FOR_MATCH ? "text, GeoJSON, JSON, " SURFACES : "text"},
        {a->target_output, "--target-output", "text, GeoJSON, JSON, " SURFACES},
        {a->triangulation, "--triangulation", "JSON"},
        {a->mesh_out, "--mesh-out", NUMBERED_MESHES},
        {a->target_mesh_out, "--target-mesh-out", NUMBERED_MESHES},
        {a->ties, "--ties", "GeoJSON, JSON"},
        {a->repair, "--repair", "text, GeoJSON, JSON, " SURFACES ", NumPy"},
        {a->boundary, "--boundary", "text, GeoJSON, JSON, " SURFACES},
        {a->picture, "--picture", "SVG"},
        {a->drawing, "--plot", "SVG"},
        {a->spine, "--spine", "JSON"},
        {c->bit & FOR_WEIGHTS ? a->binding : NULL, "--binding", "libicc's own"},
        {a->json ? a->json_file : NULL, "--json", "JSON"},
        {of_operand != NULL ? args_result(a, c) : NULL, "OUT", of_operand}};
    if (i >= sizeof outputs / sizeof *outputs)
        return false;
    *out = outputs[i];
    return true;
}

int call_inputs_check(const args *a, const command *c)
{
    call_file in;
    size_t n_standard = 0;
    for (size_t i = 0; call_input(&in, a, c, i); i++)
        n_standard +=
            in.name != NULL && (strcmp(in.name, "-") == 0 || strncmp(in.name, "-#", 2) == 0);
    if (n_standard > 1)
        return misused(c->name, "only one input can be standard input");
    return DONE;
}

/* True if `map` writes a result over its own points or layer. cmd_map.c and cmd_geojson.c do that only
 * if all of it has an image. */
static bool is_image_of(const call_file *in, const call_file *out, const args *a, const command *c)
{
    return c->bit & (FOR_MAP | FOR_FIT) &&
           (a->geojson ? strcmp(in->role, "IN") == 0 && strcmp(out->role, "OUT") == 0
                       : strcmp(in->role, "--points") == 0 && strcmp(out->role, "--output") == 0);
}

static bool overwrites(const call_file *in, const char *output)
{
    char *file = file_chosen_name(in->name);
    bool same = file_is_same(file, output);
    free(file);
    return same;
}

/* `name` is the output's, or that of one of its frames. */
static int check_overwriting(const args *a, const command *c, const call_file *out,
                             const char *name)
{
    call_file in;
    for (size_t i = 0; call_input(&in, a, c, i); i++)
        if (in.name != NULL && !is_image_of(&in, out, a, c) && overwrites(&in, name))
            return misused(c->name,
                           "%s would be written over an input, '%.200s' of %s; write to another "
                           "file",
                           out->role, in.name, in.role);
    return DONE;
}

/* Checks the frames that exist already. */
static int check_frames(const args *a, const command *c, const call_file *out)
{
    int result = DONE;
    size_t n = frames_count(a);
    for (size_t i = 0; i < n && result == DONE; i++) {
        char *name = frame_name(out->name, i);
        if (system_exists(name))
            result = check_overwriting(a, c, out, name);
        free(name);
    }
    return result;
}

/* True if both name one file, or one new file by the same name. */
static bool is_one_file(const char *a, const char *b)
{
    return strcmp(a, "-") != 0 && strcmp(b, "-") != 0 &&
           (system_is_same(a, b) || (strcmp(a, b) == 0 && !system_exists(a)));
}

static int check_outputs_apart(const args *a, const command *c)
{
    call_file one, other;
    for (size_t i = 0; call_output(&one, a, c, i); i++)
        for (size_t k = 0; k < i && call_output(&other, a, c, k); k++)
            if (one.name != NULL && other.name != NULL && is_one_file(one.name, other.name))
                return misused(c->name, "%s and %s are one file, '%.200s'; write to two",
                               other.role, one.role, one.name);
    return DONE;
}

int call_outputs_check(const args *a, const command *c)
{
    call_file out;
    int result = DONE;
    for (size_t i = 0; result == DONE && call_output(&out, a, c, i); i++)
        if (out.name != NULL)
            result = (c->bit & FOR_ANIMATE || a->frames > 0) && strcmp(out.role, "OUT") == 0
                         ? check_frames(a, c, &out)
                         : check_overwriting(a, c, &out, out.name);
    return result == DONE ? check_outputs_apart(a, c) : result;
}

bool is_film(const char *out)
{
    const char *format = output_format(out);
    return format != NULL && strcmp(format, "animated PNG") == 0;
}

char *frame_name(const char *out, size_t frame)
{
    const char *dot = strrchr(system_last_part(out), '.');
    size_t n_stem = dot != NULL ? (size_t)(dot - out) : strlen(out), n = strlen(out) + 32;
    char *result = need(n, 1);
    if (is_film(out))
        return strcpy(result, out);
    snprintf(result, n, "%.*s-%04zu%s", (int)n_stem, out, frame, out + n_stem);
    return result;
}

size_t frames_count(const args *a)
{
    if (a->frames > 0)
        return (size_t)a->frames + 1;
    size_t steps = a->steps > 0 ? (size_t)a->steps : 1;
    return (a->n_operands - 3) * steps + 1;
}

uint32_t frames_rate(const args *a)
{
    enum { RATE = 25 };
    return a->rate > 0 ? (uint32_t)a->rate : RATE;
}
