/* Checks options that need or exclude each other, and fills in what they imply. */
#include "base/say.h"
#include "job/args.h"
#include "job/call_files.h"
#include "job/option_table.h"
#include "job/output_name.h"

#include <icc/kernel.h>
#include <math.h>
#include <string.h>

/* True if two operands are a file to read and a file to write. */
static bool has_layer(const args *a)
{
    return a->geojson || a->warps || a->rectifies;
}

static const char *layer_option(const args *a)
{
    return a->geojson ? "geojson" : a->warps ? "warp" : "rectify";
}

/* Checks options of the file of --triangulation. */
static int check_triangulation(const args *a, const command *c)
{
    if (a->triangulation == NULL && (a->source_crs != NULL || a->target_crs != NULL))
        return misused(c->name, "--%s-crs needs --triangulation, whose file notes it",
                       a->source_crs != NULL ? "source" : "target");
    if (a->triangulation == NULL && a->fallback != 0)
        return misused(c->name, "--fallback needs --triangulation, whose file notes it");
    return DONE;
}

/* Checks options of features in space. */
static int check_solid(const args *a, const command *c)
{
    const bool one_sided = a->target == NULL && (a->source != NULL || a->fill);
    if (a->target_feature_points != NULL && a->feature_points == NULL)
        return misused(c->name, "--target-feature-points needs --feature-points");
    if (a->target_feature_lines != NULL && a->feature_lines == NULL)
        return misused(c->name, "--target-feature-lines needs --feature-lines");
    if (one_sided && a->target_voids.n + a->target_surfaces.n > 0)
        return misused(c->name, "--target-%s needs --target",
                       a->target_voids.n > 0 ? "void" : "surface");
    if ((a->mesh_out != NULL || a->target_mesh_out != NULL) &&
        (a->map == ICC_MAP_CURVES || a->method == ICC_METHOD_GRADIENT))
        return misused(c->name, "--mesh-out needs a mesh map, which is the default");
    return DONE;
}

/* Checks options that only some methods have. */
static int check_method(const args *a, const command *c)
{
    const char *gradient_only = a->n_functions > 0 ? "function"
                                : a->constrained   ? "constrained"
                                : a->unconstrained ? "unconstrained"
                                : a->min_fall > 0  ? "min-fall"
                                : a->solver != 0   ? "solver"
                                : a->tree != 0     ? "tree"
                                : a->elevation     ? "elevation"
                                : a->compression   ? "compression"
                                                   : NULL;
    if (gradient_only != NULL && a->method != ICC_METHOD_GRADIENT)
        return misused(c->name, "--%s needs --method gradient", gradient_only);
    if (a->map == ICC_MAP_MESH && a->method == ICC_METHOD_GRADIENT)
        return misused(c->name, "--map mesh needs a method that can be certified, not gradient");
    if (a->triangles && (a->map == ICC_MAP_CURVES || a->method == ICC_METHOD_GRADIENT))
        return misused(c->name, "--triangles needs a mesh map: --target FILE --map mesh");
    if (a->exact_lines && (a->map == ICC_MAP_CURVES || a->method == ICC_METHOD_GRADIENT))
        return misused(c->name, "--exact needs the triangles of a mesh map, but a %s map has none",
                       a->map == ICC_MAP_CURVES ? "curve" : "gradient");
    if (a->triangulation != NULL && (a->map == ICC_MAP_CURVES || a->method == ICC_METHOD_GRADIENT))
        return misused(c->name, "--triangulation needs a mesh map, which is the default");
    if (a->slides && (a->reach > 0 || a->ties != NULL || a->improve == 0))
        return misused(c->name, "--slide does not go with --%s",
                       a->reach > 0      ? "reach"
                       : a->ties != NULL ? "ties"
                                         : "improve 0");
    if (a->reach > 0 && (a->method != 0 || a->map == ICC_MAP_CURVES || a->mesh != NULL))
        return misused(c->name, "--%s does not go with --reach",
                       a->method != 0    ? "method"
                       : a->mesh != NULL ? "mesh"
                                         : "map");
    if (a->method == ICC_METHOD_DISC && (a->n_maximum > 0 || a->n_target_maximum > 0))
        return misused(c->name, "--method disc has no --maximum: it finds its own");
    return DONE;
}

/* Checks options of functions that solve an equation. */
static int check_functions(const args *a, const command *c)
{
    const char *solved_only = a->constrained     ? "constrained"
                              : a->unconstrained ? "unconstrained"
                              : a->min_fall > 0  ? "min-fall"
                              : a->solver != 0   ? "solver"
                                                 : NULL;
    bool solves = false;
    for (size_t i = 0; i < a->n_functions; i++)
        solves = solves || function_solves(a->functions[i].function);
    if (solved_only != NULL && !solves)
        return misused(c->name, "--%s needs --function laplace, bilaplace, clamped or harmonic",
                       solved_only);
    if (a->constrained && a->unconstrained)
        return misused(c->name, "--constrained and --unconstrained exclude each other");
    if (a->n_functions > 1 && !(c->bit & FOR_PLOT))
        return misused(c->name, "--function takes one name here; only plot takes several");
    return DONE;
}

/* Applies the flags to functions without their own constraints. */
static void settle_functions(args *a)
{
    for (size_t i = 0; i < a->n_functions; i++)
        if (a->functions[i].constraints == 0 && function_solves(a->functions[i].function))
            a->functions[i].constraints = a->constrained     ? ICC_CONSTRAINTS_ALL
                                          : a->unconstrained ? ICC_CONSTRAINTS_NONE
                                                             : 0;
}

/* Checks files and options that exclude each other, before any file is read. The number of files
 * depends on --geojson, and on --binding, which replaces one. */
static int check_operands(const args *a, const command *c)
{
    size_t n_operands = has_layer(a) ? c->n_operands_geojson : c->n_operands - has_bound(a, c);
    if (a->n_operands < n_operands && has_layer(a))
        return misused(c->name, "--%s needs two files, IN and OUT%s", layer_option(a),
                       c->bit & FOR_FIT ? ", after POINTS" : "");
    if (a->n_operands < n_operands)
        return misused(c->name, "usage: libicc %s %.*s", c->name, (int)strcspn(c->usage, "\n"),
                       c->usage);
    if (a->n_operands > n_operands && has_bound(a, c))
        return misused(c->name, "the --binding file holds the points; give one file, OUT");
    if (a->n_operands > n_operands + c->n_operands_more)
        return misused(c->name, "'%.60s' is one argument too many without --geojson",
                       a->operands[n_operands]);
    if (has_layer(a) && (a->points != NULL || a->output != NULL))
        return misused(c->name, "--points and --output do not go with --%s IN OUT",
                       layer_option(a));
    if (a->repair_mesh && a->inverse)
        return misused(c->name, "--untangle does not go with --inverse");
    if (a->tolerance > 0 && !a->geojson && !(c->bit & FOR_POSE))
        return misused(c->name, "--tolerance goes with --geojson only");
    if (a->exact_lines && !a->geojson)
        return misused(c->name, "--exact goes with --geojson only");
    if (a->outside == OUTSIDE_CLIP && !a->geojson)
        return misused(c->name, "--outside clip goes with --geojson only");
    if (a->outside == OUTSIDE_NULL && c->bit & FOR_MESH)
        return misused(c->name,
                       "--outside null would leave vertices without a place; use keep or fail");
    if (a->outside != 0 && a->outside != OUTSIDE_NULL && a->has_background && c->bit & FOR_WARP)
        return misused(c->name, "--background clears pixels, but --outside %s does not",
                       choice_name(outsides, a->outside));
    return DONE;
}

/* Pins need no handles, and nothing of their weights. */
static int check_pins(const args *a, const command *c)
{
    const char *of_handles = a->handles != NULL   ? "handles"
                             : a->pose != NULL    ? "pose"
                             : a->binding != NULL ? "binding"
                             : a->certified       ? "certified"
                             : a->tolerance > 0   ? "tolerance"
                             : a->welds           ? "weld"
                             : a->sampling != 0   ? "sampling"
                             : a->weights != 0    ? "weights"
                             : a->kernel != 0     ? "kernel"
                             : a->initial != 0    ? "initial"
                             : a->steps > 0       ? "steps"
                             : a->spacing > 0     ? "spacing"
                             : a->sigma > 0       ? "sigma"
                             : a->seed > 0        ? "seed"
                             : a->thesis          ? "thesis"
                                                  : NULL;
    const char *output = args_result(a, c);
    if (of_handles != NULL)
        return misused(c->name, "--%s does not go with --pins", of_handles);
    if (a->frames > 0 && output != NULL && strcmp(output, "-") == 0)
        return misused(c->name, "--frames writes several files or a film; OUT must be a name");
    if (a->rate > 0 && a->frames == 0)
        return misused(c->name, "--rate goes with --frames");
    return DONE;
}

/* Checks the same for the commands with handles. */
static int check_kernel(const args *a, const command *c)
{
    bool bound = has_bound(a, c);
    if (a->pins != NULL)
        return check_pins(a, c);
    if (a->spine != NULL || a->frames > 0 || a->reach > 0 || a->rate > 0)
        return misused(c->name, "--%s goes with --pins",
                       a->spine != NULL ? "spine"
                       : a->frames > 0  ? "frames"
                       : a->reach > 0   ? "reach"
                                        : "rate");
    if (c->bit & FOR_POSE && a->pose == NULL)
        return misused(c->name, "--pose FILE is missing%s",
                       a->handles == NULL ? ", or --pins FILE" : "");
    if (a->handles == NULL && !bound)
        return misused(c->name, "--handles FILE is missing");
    if (bound && (a->handles != NULL || a->source != NULL))
        return misused(c->name, "--source and --handles do not go with --binding");
    if (bound && a->certified)
        return misused(c->name, "--certified needs the shape and the handles, not --binding");
    if (a->tolerance > 0 && !a->certified)
        return misused(c->name, "--tolerance goes with --certified");
    if (a->n_along > 0 && a->points != NULL)
        return misused(c->name, "--points and --along exclude each other");
    if (a->n_along > 0 && a->n_along != 4 && a->n_along != 6)
        return misused(c->name, "--along must be X0,Y0,X1,Y1 or X0,Y0,Z0,X1,Y1,Z1");
    if (a->picture == NULL && (a->logarithmic || a->handle > 0 || a->y_down))
        return misused(c->name, "--log, --handle and --y-down go with --picture");
    if (a->steps > 0 && a->initial == ICC_INITIAL_INVERSE)
        return misused(c->name, "--steps does not go with --initial inverse");
    if (a->seed > 0 && a->sampling == ICC_SAMPLING_GRID)
        return misused(c->name, "--seed does not go with --sampling grid");
    return DONE;
}

/* Filling takes a surface and no map. */
static int check_fill(const args *a, const command *c)
{
    const char *of_maps = a->source != NULL    ? "source"
                          : a->target != NULL  ? "target"
                          : a->mesh != NULL    ? "mesh"
                          : a->target_mesh     ? "target-mesh"
                          : a->inverse         ? "inverse"
                          : a->repair_mesh     ? "untangle"
                          : a->method != 0     ? "method"
                          : a->map != 0        ? "map"
                          : a->outside != 0    ? "outside"
                          : a->match != NULL   ? "match"
                          : a->json            ? "json"
                          : a->rotates_vectors ? "rotate-vectors"
                          : a->triangulation   ? "triangulation"
                                               : NULL;
    if (of_maps != NULL)
        return misused(c->name, "--%s does not go with --fill", of_maps);
    if (check_solid(a, c) != DONE)
        return MISUSED;
    return a->n_operands < 2 ? misused(c->name, "usage: libicc mesh --fill SURFACE OUT") : DONE;
}

/* The mesh of --fit or --nearest is moved itself, without a cage. */
static int check_moved_mesh(const args *a, const command *c)
{
    if (check_triangulation(a, c) != DONE)
        return MISUSED;
    const char *by = a->moves != NULL ? "fit" : "nearest";
    const char *of_maps = a->source != NULL   ? "source"
                          : a->target != NULL ? "target"
                          : a->mesh != NULL   ? "mesh"
                          : a->target_mesh    ? "target-mesh"
                          : a->inverse        ? "inverse"
                          : a->repair_mesh    ? "untangle"
                          : a->method != 0    ? "method"
                          : a->map != 0       ? "map"
                          : a->match != NULL  ? "match"
                          : a->fill           ? "fill"
                          : a->voids.n > 0    ? "void"
                          : a->surfaces.n > 0 ? "surface"
                          : a->feature_points ? "feature-points"
                          : a->feature_lines  ? "feature-lines"
                                              : NULL;
    const char *of_fit = a->slides          ? "slide"
                         : a->frees         ? "free"
                         : a->reach > 0     ? "reach"
                         : a->stiffness > 0 ? "stiffness"
                                            : NULL;
    if (a->moves != NULL && a->nearest != NULL)
        return misused(c->name, "--fit and --nearest exclude each other");
    if (of_maps != NULL)
        return misused(c->name, "--%s does not go with --%s", of_maps, by);
    if (a->nearest != NULL && of_fit != NULL)
        return misused(c->name, "--%s goes with --fit", of_fit);
    if (a->slides && a->frees)
        return misused(c->name, "--slide and --free exclude each other");
    return DONE;
}

/* Options of fits without a mesh or with cages. */
static int check_fit(const args *a, const command *c)
{
    const char *of_frame = a->n_box > 0    ? "box"
                           : a->margin > 0 ? "margin"
                           : a->smooths    ? "smooth"
                                           : NULL;
    const char *of_outline = a->reach > 0 ? "reach" : a->stiffness > 0 ? "stiffness" : NULL;
    if (a->n_box != 0 && (a->n_box != 4 || !(a->box[0] < a->box[2]) || !(a->box[1] < a->box[3])))
        return misused(c->name, "--box must be X0,Y0,X1,Y1: the lower and the upper corner");
    if (a->outline != NULL && of_frame != NULL)
        return misused(c->name, "--%s does not go with --outline", of_frame);
    if (a->outline == NULL && of_outline != NULL)
        return misused(c->name, "--%s goes with --outline", of_outline);
    if (a->exact && a->smooths)
        return misused(c->name, "--exact and --smooth exclude each other");
    if (a->geojson + a->warps + a->rectifies > 1)
        return misused(c->name, "--geojson, --warp and --rectify exclude each other");
    if (a->inverse && !a->geojson && has_layer(a))
        return misused(c->name, "--inverse does not go with --%s", layer_option(a));
    if ((a->geojson || !has_layer(a)) && (a->has_background || a->quality > 0))
        return misused(c->name, "--%s goes with --warp or --rectify",
                       a->quality > 0 ? "quality" : "background");
    if (a->rectifies && (a->outline != NULL || a->triangulation != NULL || a->drawing != NULL))
        return misused(c->name, "--%s does not go with --rectify",
                       a->outline != NULL         ? "outline"
                       : a->triangulation != NULL ? "triangulation"
                                                  : "plot");
    if (!a->rectifies && a->resolution > 0)
        return misused(c->name, "--resolution goes with --rectify");
    if (a->residuals && a->points != NULL && (a->output == NULL || strcmp(a->output, "-") == 0))
        return misused(c->name,
                       "images and residuals cannot both go to standard output; use -o FILE");
    if (a->residuals && a->json && strcmp(a->json_file, "-") == 0)
        return misused(c->name, "the report of --json has the residuals");
    return check_triangulation(a, c);
}

static bool is_zero(const double v[3])
{
    return !(fabs(v[0]) + fabs(v[1]) + fabs(v[2]) > 0);
}

/* Checks the options that cut solids and set the view. */
static int check_views(const args *a, const command *c)
{
    if (a->n_slice != 0 && a->n_slice != 3 && a->n_slice != 6)
        return misused(c->name, "--slice must be NX,NY,NZ or X,Y,Z,NX,NY,NZ");
    if (a->n_slice > 0 && is_zero(a->slice + a->n_slice - 3))
        return misused(c->name, "--slice has a normal of length 0");
    if (a->n_view != 0 && (a->n_view != 3 || is_zero(a->view)))
        return misused(c->name, "--view must be X,Y,Z, and not 0,0,0");
    return DONE;
}

/* Checks options that need --match, or exclude it. */
static int check_match(const args *a, const command *c)
{
    const char *matched_only = a->landmarks != NULL ? "landmarks"
                               : a->turning != 0    ? "turning"
                               : a->keep_source     ? "keep-source"
                                                    : NULL;
    if (a->match == NULL && matched_only != NULL)
        return misused(c->name, "--%s goes with --match", matched_only);
    if (a->by == NULL && a->leaves_out)
        return misused(c->name, "--leave-out goes with --by");
    if (a->by != NULL && (a->match != NULL || a->mesh != NULL || a->repair != NULL))
        return misused(c->name, "--%s does not go with --by",
                       a->match != NULL  ? "match"
                       : a->mesh != NULL ? "mesh"
                                         : "repair");
    bool turns = a->y_down_side == SIDE_SOURCE || a->y_down_side == SIDE_TARGET;
    if (turns && (a->mesh != NULL || a->target_mesh != NULL))
        return misused(c->name, "--y-down=%s does not go with --mesh",
                       choice_name(sides, a->y_down_side));
    if (a->match != NULL && (a->mesh != NULL || a->target_mesh != NULL))
        return misused(c->name, "--match is for outlines, not for --mesh");
    if (a->match != NULL && a->repair != NULL)
        return misused(c->name, "--repair does not go with --match; repair each cage by itself");
    return DONE;
}

static int check_charts(const args *a, const command *c)
{
    if (a->moves != NULL || a->nearest != NULL)
        return check_moved_mesh(a, c);
    const bool slides = a->slides && (c->bit & FOR_MESH) != 0;
    if (slides || a->frees || a->stiffness > 0)
        return misused(c->name, "--%s goes with --fit",
                       slides     ? "slide"
                       : a->frees ? "free"
                                  : "stiffness");
    if (a->fill)
        return check_fill(a, c);
    if (a->source == NULL)
        return misused(c->name, "--source FILE is missing");
    if (check_match(a, c) != DONE || check_triangulation(a, c) != DONE || check_solid(a, c) != DONE)
        return MISUSED;
    int result = check_method(a, c);
    if (result == DONE)
        result = check_views(a, c);
    return result == DONE ? check_functions(a, c) : result;
}

/* Checks animations: frames are several files, and so are the cages of a path. */
static int check_animate(const args *a, const command *c)
{
    bool standard = false;
    for (size_t i = 1; i < a->n_operands; i++)
        standard = standard || strcmp(a->operands[i], "-") == 0;
    return standard
               ? misused(c->name, "OUT and the cages of the path are files; only the source or IN "
                                  "may be standard input")
               : DONE;
}

/* Checks options together. */
static int check_together(const args *a, const command *c)
{
    int result = c->bit & FOR_DEMO     ? DONE
                 : c->bit & FOR_KERNEL ? check_kernel(a, c)
                 : c->bit & FOR_FIT    ? check_fit(a, c)
                                       : check_charts(a, c);
    if (result == DONE)
        result = check_operands(a, c);
    if (result == DONE && c->bit & FOR_ANIMATE)
        result = check_animate(a, c);
    if (result == DONE)
        result = call_inputs_check(a, c);
    if (result == DONE)
        result = output_names_check(a, c);
    return result == DONE ? call_outputs_check(a, c) : result;
}

/* Sets how to match: by shape by default, and by landmarks for `--match FILE`. */
static int settle_match(args *a, const command *c)
{
    if (a->match == NULL && c->bit & FOR_MATCH)
        a->match = "auto";
    if (a->match == NULL || strcmp(a->match, "auto") == 0 || strcmp(a->match, "arc") == 0)
        return DONE;
    if (a->landmarks != NULL)
        return misused(c->name, "landmarks come from --match FILE or from --landmarks, not both");
    a->landmarks = a->match;
    a->match = "auto";
    return DONE;
}

const char *args_result(const args *a, const command *c)
{
    size_t at = c->bit & FOR_ANIMATE ? 1 : c->bit & FOR_FIT ? 2 : a->n_operands - 1;
    return a->n_operands > 0 && at < a->n_operands ? a->operands[at] : NULL;
}

/* By default input comes from stdin, and results go to stdout. */
static int settle_streams(args *a, const command *c)
{
    bool draws = c->bit & FOR_WEIGHTS && (a->picture != NULL || a->n_along > 0);
    if (c->bit & (FOR_MAP | FOR_ENCODE | FOR_WEIGHTS) && a->points == NULL && !a->geojson &&
        !draws && a->mesh_out == NULL && a->target_mesh_out == NULL)
        a->points = "-";
    if (c->bit & FOR_DECODE && a->coords == NULL)
        a->coords = "-";
    if (c->bit & FOR_WEIGHTS && a->output == NULL && a->picture == NULL && a->binding == NULL)
        a->output = "-";
    bool may_lack = (c->bit & (FOR_WEIGHTS | FOR_MATCH)) != 0;
    if (c->bit & FOR_FIT && !has_layer(a) && a->points == NULL && (a->output != NULL || a->inverse))
        a->points = "-";
    const char *result = a->output != NULL || may_lack ? a->output : "-";
    if (c->bit & FOR_FIT && a->points == NULL)
        result = NULL;
    if ((c->n_operands > 1 && !(c->bit & FOR_FIT)) || c->bit & FOR_PLOT || has_layer(a))
        result = args_result(a, c);
    if (a->json && !(c->bit & (FOR_CHECK | FOR_INFO)) && strcmp(a->json_file, "-") == 0 &&
        result != NULL && strcmp(result, "-") == 0)
        return misused(c->name,
                       "result and report cannot both go to standard output; use --json=FILE");
    if (a->drawing != NULL && strcmp(a->drawing, "-") == 0)
        return misused(c->name, "--plot goes to a file, beside the result");
    if (a->triangulation != NULL && strcmp(a->triangulation, "-") == 0)
        return misused(c->name, "--triangulation goes to a file, beside the result");
    if (a->ties != NULL && strcmp(a->ties, "-") == 0)
        return misused(c->name, "--ties goes to a file, beside the result");
    return DONE;
}

/* A mesh without a cage is its own cage. It is read twice, so it cannot be standard input. */
static void settle_meshes(args *a)
{
    if (a->source != NULL || a->mesh == NULL || strcmp(a->mesh, "-") == 0)
        return;
    a->source = a->mesh;
    if (a->target == NULL && a->target_mesh != NULL && strcmp(a->target_mesh, "-") != 0)
        a->target = a->target_mesh;
}

int args_check(args *a, const command *c)
{
    bool has_cage = !a->fill && a->moves == NULL && a->nearest == NULL;
    if (has_cage)
        settle_meshes(a);
    a->needs_target = (c->needs_target || a->match != NULL || a->by != NULL) && has_cage;
    a->may_pair = (c->bit & MAY_PAIR) != 0;
    a->flips_cages = (c->bit & FLIPS_CAGES) != 0;
    settle_functions(a);
    int result = settle_match(a, c);
    if (result == DONE)
        result = settle_streams(a, c);
    return result != DONE ? result : check_together(a, c);
}
