/* libicc: the inside of a shape follows its boundary.
 *
 * setlocale() is never called, so numbers are read and written the same way everywhere. */
#include "base/file.h"
#include "base/guess.h"
#include "base/say.h"
#include "base/system.h"
#include "cmd/commands.h"
#include "cmd/completion.h"

#include <errno.h>
#include <icc/icc.h>
#include <stdio.h>
#include <string.h>

static const command commands[] = {
    {.name = "map",
     .bit = FOR_MAP,
     .n_operands_geojson = 2,
     .needs_target = true,
     .run = run_map,
     .usage = "--source FILE --target FILE [OPTION]... < POINTS > IMAGES\n"
              "--source FILE --target FILE --geojson [OPTION]... IN OUT",
     .summary = "Carries points along with their cage",
     .details =
         "Reads one point per line, `x y` in the plane and `x y z` in space, and writes its image "
         "per\n"
         "line, in the same order. A point without an image gives `nan nan`; the exit code is then "
         "4.\n"
         "Blank lines and lines that begin with # are left out.\n\n"
         "In the plane holes, lines and points inside the source go to their partners in the "
         "target;\n"
         "see the manual page for how files hold them. Of several polygons each has its own map. A "
         "GeoJSON file\n"
         "may hold both cages: then --target is not needed. --triangulation writes the map "
         "itself,\n"
         "--ties which way round one another they go.\n\n"
         "With --geojson it carries the points, lines and polygons of a GeoJSON file, with more\n"
         "vertices where the map bends lines; all but coordinates stays byte for byte. Features "
         "that\n"
         "lie outside, be it in part, are named, and the exit code is then 4; see --outside.\n"},
    {.name = "encode",
     .bit = FOR_ENCODE,
     .run = run_encode,
     .usage = "--source FILE [OPTION]... < POINTS > COORDINATES",
     .summary = "Gives the integral curve coordinates of points",
     .details =
         "Writes `facet b0 b1 t` per point `x y`: its curve starts on the edge from vertex "
         "`facet`\n"
         "(counted from 0), at b0 of that vertex plus b1 of the next; t is the share of the "
         "curve's\n"
         "length from there to the point. In space the facet is a face, with three numbers b, "
         "and so on.\n"},
    {.name = "decode",
     .bit = FOR_DECODE,
     .run = run_decode,
     .usage = "--source FILE [OPTION]... < COORDINATES > POINTS",
     .summary = "Gives the points of integral curve coordinates",
     .details = "The inverse of `libicc encode`.\n"},
    {.name = "warp",
     .bit = FOR_WARP,
     .n_operands = 2,
     .needs_target = true,
     .run = run_warp,
     .usage = "--source FILE --target FILE [OPTION]... IN OUT",
     .summary = "Warps a picture inside a cage",
     .details =
         "Cages are in pixels: x to the right, y down, pixel (i, j) covers [i, i+1] x [j, "
         "j+1]. A pixel\n"
         "whose centre lies in the target cage gets the colour that the map brings there; "
         "all others\n"
         "stay as they are. PNG, JPEG, PNM (PBM, PGM, PPM, PAM) and .npy go in; OUT has the format "
         "that its\n"
         "name says, or else that of IN: grey or RGB, with or without alpha (PNG, PAM), 8 "
         "or 16 bits\n"
         "(JPEG: 8).\n"},
    {.name = "animate",
     .bit = FOR_ANIMATE,
     .n_operands = 3,
     .n_operands_more = 1000000,
     .needs_target = true,
     .run = run_animate,
     .usage = "--source FILE [OPTION]... IN OUT CAGE...",
     .summary = "Warps a picture along a path of cages, a picture a frame",
     .details =
         "The source is the cage in the picture IN; the cages are where it goes, one after the "
         "other. Between\n"
         "them corners go straight, in as many frames as --steps says. OUT gets the number of the "
         "frame:\n"
         "fish.png makes fish-0000.png, fish-0001.png and so on. Each map follows the one before, "
         "and is\n"
         "certified like those of warp.\n"},
    {.name = "mesh",
     .bit = FOR_MESH,
     .n_operands = 2,
     .needs_target = true,
     .run = run_mesh,
     .usage = "--source FILE --target FILE [OPTION]... IN OUT\n"
              "--fill [OPTION]... SURFACE OUT",
     .summary = "Carries the vertices of a mesh along, or fills a surface",
     .details =
         "OBJ, OFF and Medit (.mesh) as text, legacy VTK, PLY and STL also as binary; OUT has the "
         "format of IN.\n"
         "Nothing is written when a vertex lies outside the cage, unless --outside keep leaves it "
         "where it is.\n"
         "Says how many elements of each kind keep their orientation, how many invert or collapse, "
         "and whether the mesh and its image are one-to-one, with exact signs. A mesh that is "
         "sampled from a one-to-one map need not be: the exit code is 4 while elements are "
         "inverted, collapsed or undecided, and the first of them are named.\n"},
    {.name = "check",
     .bit = FOR_CHECK,
     .run = run_check,
     .usage = "--source FILE [--target FILE] [OPTION]...",
     .summary = "Checks cages and certifies the map between them",
     .details =
         "The first line is the answer: 'one-to-one: yes, certified', or\n"
         "'one-to-one: not proved: ' and why. In the plane every crossing, contact, spike\n"
         "and repeated vertex is listed, one per line; elsewhere the first defect is named.\n"
         "Exit code 0 means that the charts and the map are certified to be one-to-one; the\n"
         "method gradient cannot be, so it gives 1. A surface or a mask by itself is only\n"
         "checked to be valid, the mask as one solid piece without holes; a surface is filled\n"
         "and its chart certified with --method foliation, or field. --boundary writes the\n"
         "vertices of a mask's boundary, which, moved, are a target.\n"},
    {.name = "info",
     .bit = FOR_INFO,
     .run = run_info,
     .usage = "--source FILE [--target FILE] [OPTION]...",
     .summary = "Reports what a chart is made of and what it misses",
     .details =
         "With a target it also reports how the map was made, what share of the inside collapses "
         "or inverts,\n"
         "and how much the rest is distorted.\n"},
    {.name = "plot",
     .bit = FOR_PLOT,
     .n_operands = 1,
     .run = run_plot,
     .usage = "--source FILE [--target FILE] [OPTION]... OUT.svg|OUT.vtk\n"
              "--source FILE --target FILE [OPTION]... OUT.png (in space)",
     .summary = "Draws a shape with its integral curves, or a map",
     .details =
         "In the plane, with a target: both shapes side by side, a u v map and a checkerboard that "
         "the target inherits, and the triangles of the map. Integral curves are drawn for a map "
         "of kind curves, and without a target. --function takes several names here, with commas "
         "between, and each may end\n"
         "in :constrained or :unconstrained; then there is a column for each.\n\n"
         "In space, with a target: both bodies cut by a plane, with a grid on the cut that the "
         "target\n"
         "inherits, as SVG or PNG.\n\n"
         "OUT.vtk, for ParaView, has the source alone, in the plane or in space: grid, tree, "
         "boundary and\n"
         "curves (cell data `part`: 0 to 3), with the displacement to the target if there is "
         "one.\n"},
    {.name = "match",
     .bit = FOR_MATCH,
     .needs_target = true,
     .run = run_match,
     .usage = "--source FILE --target FILE [OPTION]...",
     .summary = "Gives two outlines or surfaces that do not correspond common vertices",
     .details =
         "In the plane. Other numbers of vertices, another first one, another sense do not matter: "
         "like parts\n"
         "go to like parts. Every vertex of both is kept; others are added on edges. Prints how "
         "well they\n"
         "match: 'sure' is how many times better than in any other way, and below 1.06 it is "
         "refused. It is\n"
         "a heuristic: look at the result ('libicc plot --match auto' numbers places that go "
         "together). Landmarks\n"
         "help. Outlines without features, as discs, are paired by arc length where --match arc "
         "says so.\n"
         "map, warp, check and the others take --match as well, and need no files between.\n"
         "Surfaces in space (-o A.obj --target-output B.obj) get common triangles, within 1/1000 "
         "of the "
         "diagonal; the\n"
         "less the 'energy' is over 4 the less they are stretched.\n"},
    {.name = "weights",
     .bit = FOR_WEIGHTS,
     .run = run_weights,
     .usage = "[--source FILE] --handles FILE [OPTION]... < POINTS > OUT",
     .summary = "Blends handles: kernel coordinates of points, or a figure of them",
     .details =
         "Reads one point per line and writes its weight for each handle. Weights sum to 1, "
         "reproduce the\n"
         "point from the handles, and are 1 and 0 at the handles. The handles' file is JSON:\n\n"
         "  {\"handles\": [[x, y], ..],         or [x, y, z]; all else may be left out\n"
         "   \"edges\": [[0, 1], ..],           weights start linear between these handles\n"
         "   \"lines\": [{\"from\": [x, y], \"to\": [x, y], \"parallel\": 0}, ..],\n"
         "                                    straight, and parallel to an earlier line\n"
         "   \"regions\": [[[x, y], ..], ..],   polygons that belong to the shape, too\n"
         "   \"curves\": {\"vertices\": [[x, y], ..], \"segments\": [[0, 1], ..]},\n"
         "   \"rigid\": [{\"region\": [[x, y], ..], \"rigidity\": 1}, ..]}\n"
         "                                    or \"centre\" and \"radius\" for a region\n\n"
         "The shape is the source, the regions and the curves. With --picture or --binding "
         "the weights\n"
         "are written only where -o asks for them.\n"},
    {.name = "pose",
     .bit = FOR_POSE,
     .n_operands = 2,
     .run = run_pose,
     .usage = "[--source FILE] --handles FILE --pose FILE [OPTION]... IN OUT\n"
              "--binding FILE --pose FILE [OPTION]... OUT",
     .summary = "Moves points, meshes and pictures with their handles",
     .details =
         "IN is a list of points, a mesh (OBJ, OFF, PLY, Medit, VTK) or a picture (as warp), "
         "recognised "
         "by its content;\n"
         "see 'libicc weights --help' for the handles' file. With --binding FILE there is only "
         "OUT: "
         "the points\n"
         "are in the binding, and no source and no handles are needed. The pose is JSON, one of\n\n"
         "  {\"moves\": [{\"handle\": 0, \"move\": [dx, dy], \"turn\": degrees, \"axis\": "
         "[x, y, z],\n"
         "              \"matrix\": [[a, b], [c, d]]}, ..]}       the others stay\n"
         "  {\"transforms\": [[[a, b, tx], [c, d, ty]], ..]}      one per handle\n\n"
         "A matrix and a turn are about the handle, and come before its move. A turn goes from x "
         "to y. Poses\n"
         "can fold; in a picture what is the right way round then hides what is not. With "
         "--certified they\n"
         "cannot: handles and outline go where they should, the rest is a certified map near the "
         "pose.\n"},
    {.name = "demo",
     .bit = FOR_DEMO,
     .n_operands_more = 1,
     .run = run_demo,
     .usage = "[FOLDER]",
     .summary = "Writes two cages and a picture to try the others on",
     .details =
         "FOLDER (default: libicc-demo) must not be there yet. What to try next is printed.\n"},
};
enum { N_COMMANDS = sizeof commands / sizeof *commands };

static void print_help(void)
{
    puts("Usage: libicc COMMAND [OPTION]...\n\n"
         "Carries everything inside a shape along when its boundary moves.\n\nCommands:");
    for (size_t i = 0; i < N_COMMANDS; i++)
        printf("  %-8s %s\n", commands[i].name, commands[i].summary);
    help_paragraphs(
        "\n'libicc help COMMAND' describes a command; 'libicc --version' prints the version; "
        "'libicc completion SHELL' prints what bash, zsh or fish needs to complete them. "
        "Exit codes: 0 done; 1 the input or the computation failed; 2 wrong usage; 4 done, but "
        "some points have no image, or some elements of a mesh are inverted.\n\n(Not related to "
        "ICC colour profiles.)\n");
}

static int run_command(const command *c, int argc, char **argv)
{
    args a;
    bool help;
    int result = args_parse(&a, c, argc, argv, &help);
    if (result == DONE && help)
        args_help(c);
    else if (result == DONE)
        result = c->run(&a);
    return result == PARTIAL && a.require != 0 ? FAILED : result;
}

/* Reports a failure if the output did not arrive. */
static int flushed(int result)
{
    errno = 0;
    bool good = fflush(stdout) == 0 && !ferror(stdout);
    if (good || (result != DONE && result != PARTIAL))
        return result;
    return failed(STANDARD_OUTPUT, 0, "cannot be written: %s", file_write_error(errno));
}

static const command *find_command(const char *name)
{
    for (size_t i = 0; i < N_COMMANDS; i++)
        if (strcmp(name, commands[i].name) == 0)
            return &commands[i];
    return NULL;
}

static int no_command(const char *name)
{
    guess near = {0};
    guess_text text;
    for (size_t i = 0; i < N_COMMANDS; i++)
        guess_try(&near, name, strlen(name), commands[i].name);
    return misused(NULL, "there is no command '%.40s'%s", name, guess_say(text, &near, ""));
}

/* Handles `libicc help` and `libicc help COMMAND`. */
static int help_with(const char *name)
{
    const command *c = name != NULL ? find_command(name) : NULL;
    if (name != NULL && c == NULL)
        return no_command(name);
    if (c != NULL)
        args_help(c);
    else
        print_help();
    return DONE;
}

int main(int argc, char **argv)
{
    system_begin();
    if (argc < 2)
        return misused(
            NULL, "which command? one of map, encode, decode, warp, animate, mesh, check, info, "
                  "plot, match, weights, pose, demo");
    const char *name = argv[1];
    const command *c = find_command(name);
    if (c != NULL)
        return flushed(run_command(c, argc, argv));
    if (strcmp(name, "--version") == 0 || strcmp(name, "version") == 0 || strcmp(name, "-v") == 0 ||
        strcmp(name, "-V") == 0)
        printf("libicc %s\n", icc_version());
    else if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0)
        print_help();
    else if (strcmp(name, "help") == 0)
        return flushed(help_with(argc > 2 ? argv[2] : NULL));
    else if (strcmp(name, "completion") == 0)
        return flushed(completion_print(argc > 2 ? argv[2] : NULL, N_COMMANDS, commands));
    else
        return no_command(name);
    return flushed(DONE);
}
