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
    {.name = "demo",
     .bit = FOR_DEMO,
     .n_operands_more = 1,
     .run = run_demo,
     .usage = "[FOLDER]",
     .summary = "Writes a picture and two cages to try the other commands on",
     .example = "my-demo",
     .details = "FOLDER (default: libicc-demo) must not exist yet. The commands to try are then "
                "printed, and they work from the folder that you are in.\n"},
    {.name = "map",
     .bit = FOR_MAP,
     .n_operands_geojson = 2,
     .needs_target = true,
     .run = run_map,
     .usage = "--source FILE --target FILE [OPTION]... < POINTS > IMAGES\n"
              "--source FILE --target FILE --geojson [OPTION]... IN OUT",
     .summary = "Moves points, or a GeoJSON layer, along with their cage",
     .example = "-s before.txt -t after.txt -p points.txt -o images.txt",
     .details =
         "Reads one point per line, `x y` in the plane and `x y z` in space. Writes its image per "
         "line, in the same order. A point without an image gives `nan nan`, and the exit code is "
         "then 4. Blank lines and lines that begin with # are skipped.\n"
         "\n"
         "With --geojson it moves a GeoJSON file instead. Lines and polygons get more vertices "
         "where the map bends them. Polygons that share sides stay without gaps. Everything but "
         "coordinates stays byte for byte. Features outside the cage are named, and the exit code "
         "is then 4 (see --outside).\n"
         "\n"
         "A cage may hold holes, lines and points whose places in the target are known. One "
         "GeoJSON or SVG file may hold both cages; then --target is not needed. See "
         "libicc-files(5).\n"},
    {.name = "fit",
     .bit = FOR_FIT,
     .n_operands = 1,
     .n_operands_geojson = 3,
     .run = run_fit,
     .usage = "[OPTION]... POINTS\n"
              "[OPTION]... POINTS --points FILE > IMAGES\n"
              "[OPTION]... --geojson POINTS IN OUT\n"
              "[OPTION]... --rectify POINTS IN OUT\n"
              "[OPTION]... --outline FILE --warp POINTS IN OUT",
     .summary = "Makes a map from control points alone, or poses a figure by pins",
     .example = "sheet.points --geojson roads.geojson moved.geojson",
     .details =
         "POINTS are places whose places in the target are known: points of the QGIS "
         "georeferencer (.points), lines `x y to_x to_y`, CSV, links in GeoJSON, ground control "
         "points of GDAL, or an annotation of Allmaps. The map goes through all of them, is as "
         "smooth as possible between them, and is proved one-to-one. It covers the box of the "
         "points and a margin. If y points down in the source only, it is turned over.\n"
         "\n"
         "Alone, the command prints how far each point is off: from the best affine map; left "
         "out, which is from where all other points would take it; and in the map. The root mean "
         "square of the second is the accuracy that you can expect between the points. A mistake "
         "stands out in the first two.\n"
         "\n"
         "With --outline the points are pins of a figure, whose outline goes where it may.\n"},
    {.name = "warp",
     .bit = FOR_WARP,
     .n_operands = 2,
     .needs_target = true,
     .run = run_warp,
     .usage = "--source FILE --target FILE [OPTION]... IN OUT",
     .summary = "Warps a picture inside its cage",
     .example = "-s before.txt -t after.txt --background 78b9d7 fish.png bent.png",
     .details = "Cages are in pixels: x to the right, y down, and pixel (i, j) covers [i, i+1] x "
                "[j, j+1]. A pixel whose centre lies in the target cage gets the colour that the "
                "map brings there. All other pixels stay as they are.\n"
                "\n"
                "IN may be PNG, JPEG, PNM (PBM, PGM, PPM, PAM) or a NumPy array (.npy). OUT has "
                "the format that its name says, or else that of IN. Pictures are grey or RGB, with "
                "or without alpha, with 8 or 16 bits a channel.\n"},
    {.name = "animate",
     .bit = FOR_ANIMATE,
     .n_operands = 3,
     .n_operands_more = 1000000,
     .needs_target = true,
     .run = run_animate,
     .usage = "--source FILE [OPTION]... IN OUT CAGE...",
     .summary = "Warps a picture along a path of cages, frame by frame",
     .example = "-s before.txt --steps 24 --background 78b9d7 \\\n"
                "      fish.png film.png before.txt after.txt",
     .details =
         "The source is the cage in the picture IN. The cages are the places that it goes to, one "
         "after the other. Between two cages corners move straight, in as many frames as --steps "
         "says. A limb that turns far gets short on the way, so give a cage every 15 to 20 "
         "degrees. "
         "The first cage is a frame as well. A GeoJSON cage is read in the role target. "
         "OUT gets the number of the frame: film.png becomes film-0000.png, film-0001.png "
         "and so on. Each map follows the one before and is certified like those of warp.\n"},
    {.name = "mesh",
     .bit = FOR_MESH,
     .n_operands = 2,
     .needs_target = true,
     .run = run_mesh,
     .usage = "--source FILE --target FILE [OPTION]... IN OUT\n"
              "--fit MOVES [OPTION]... IN OUT\n"
              "--nearest WARPED [OPTION]... IN OUT\n"
              "--fill [OPTION]... SURFACE OUT",
     .summary = "Moves the vertices of a mesh with their cage, or fills a surface",
     .example = "-s before.off -t after.off part.vtk moved.vtk",
     .details =
         "IN may be OBJ, OFF, Medit (.mesh), legacy VTK, VTU, Gmsh (.msh), PLY, STL or glTF. OUT "
         "has the same format, and a glTF scene is written as JSON if OUT ends in .gltf. If a "
         "vertex lies outside the cage, nothing is written unless you give --outside keep.\n"
         "\n"
         "The command then says how many elements of each kind keep their orientation, and "
         "whether the mesh and its image are one-to-one. The signs are exact. The exit code "
         "is 4 if an element is inverted, collapsed or undecided; OUT is written all the "
         "same. A coarse mesh can invert although its map is one-to-one; --untangle repairs "
         "it where that is possible.\n"
         "\n"
         "With --fit the mesh needs no cage: some of its vertices are told where to go, and "
         "all others follow as rigidly as possible. With --nearest another program has "
         "moved all vertices, and only what it has folded changes.\n"},
    {.name = "check",
     .bit = FOR_CHECK,
     .run = run_check,
     .usage = "--source FILE [--target FILE] [OPTION]...",
     .summary = "Checks cages and proves the map between them one-to-one",
     .example = "-s before.txt -t after.txt",
     .details = "The first line is the answer: 'one-to-one: yes, certified', or 'one-to-one: not "
                "proved: ' and the reason. The exit code is 0 only if the map is certified. In the "
                "plane the command lists every crossing, contact, spike and repeated vertex. In "
                "space it names the first defect.\n"
                "\n"
                "A surface or a mask without a target is only checked to be valid. With --method "
                "foliation or field its chart is made and certified as well.\n"},
    {.name = "match",
     .bit = FOR_MATCH,
     .needs_target = true,
     .run = run_match,
     .usage = "--source FILE --target FILE [OPTION]...",
     .summary = "Pairs two outlines or surfaces whose vertices do not correspond",
     .example = "-s old.txt -t new.txt -o a.txt --target-output b.txt",
     .details =
         "The outlines may differ in number of vertices, in starting point and in direction. Like "
         "parts are paired with like parts. Each side keeps its vertices and gets those that it "
         "lacks. The command prints how well the outlines match: 'sure' compares the pairing with "
         "the next best one, and below 1.06 it is refused.\n"
         "\n"
         "The pairing is a guess by shape, so look at it: 'libicc plot --match auto' numbers "
         "places that go together. Landmarks help. A circle looks the same from everywhere; "
         "--match arc pairs it by arc length. map, warp, check and others also take --match.\n"
         "\n"
         "Surfaces in space get common triangles (-o A.obj --target-output B.obj), at most 1/1000 "
         "of the diagonal away. An 'energy' of 4 means no distortion.\n"},
    {.name = "info",
     .bit = FOR_INFO,
     .run = run_info,
     .usage = "--source FILE [--target FILE] [OPTION]...",
     .summary = "Reports how a map was made and how much it distorts",
     .example = "-s before.txt -t after.txt",
     .details = "With a target the command reports how the map was made, what share of the inside "
                "collapses or inverts, and how much the rest is distorted. Without a target it "
                "reports how the coordinates of the shape were made.\n"},
    {.name = "plot",
     .bit = FOR_PLOT,
     .n_operands = 1,
     .run = run_plot,
     .usage = "--source FILE [--target FILE] [OPTION]... OUT.svg|OUT.vtk\n"
              "--source FILE --target FILE [OPTION]... OUT.html\n"
              "--source FILE --target FILE [OPTION]... OUT.png (in space)",
     .summary = "Draws a shape, or the map between two",
     .example = "-s before.txt -t after.txt --y-down map.svg",
     .details = "In the plane, with a target, the drawing shows both shapes side by side, a u v "
                "map and a checkerboard that the target inherits. A mesh map is drawn with its "
                "triangles, other maps with integral curves.\n"
                "\n"
                "In space, with a target, it shows both bodies cut by a plane, with a grid on the "
                "cut that the target inherits (SVG or PNG).\n"
                "\n"
                "OUT.html, with a target, is a page for a browser, complete in itself. A slider "
                "goes from before to after, colours show the stretch, and in space you turn both "
                "bodies and move the cut. It shows the cells of a mesh map.\n"
                "\n"
                "OUT.vtk, for ParaView, holds the source alone: grid, tree, boundary and curves, "
                "with the displacement to the target if there is one.\n"},
    {.name = "pose",
     .bit = FOR_POSE,
     .n_operands = 2,
     .run = run_pose,
     .usage = "--pins FILE [OPTION]... IN OUT\n"
              "[--source FILE] --handles FILE --pose FILE [OPTION]... IN OUT\n"
              "--binding FILE --pose FILE [OPTION]... OUT",
     .summary = "Poses a picture by pins, or points, meshes and pictures by handles",
     .example = "--pins pins.json hero.png posed.png",
     .details = "With --pins IN is a picture with a transparent ground. The outline of what is "
                "opaque bends as little as it can, ends where it may, and never folds or overlaps. "
                "The pins are JSON, where all but \"at\" may be missing:\n"
                "\n"
                "  {\"pins\": [{\"name\": \"hand\", \"at\": [x, y], \"to\": [x, y], \"turn\": "
                "degrees}, ..],\n"
                "   \"bones\": [[0, 1], ..]}       lines between two pins that stay straight\n"
                "\n"
                "With --handles IN is a list of points, a mesh (as for 'libicc mesh') or a picture "
                "(as for "
                "'libicc warp'). Its content tells which. 'libicc weights --help' describes the "
                "handles' file. With --binding FILE you give only OUT, because the file holds the "
                "points and their weights. The pose is JSON, either of\n"
                "\n"
                "  {\"moves\": [{\"handle\": 0, \"move\": [dx, dy], \"turn\": degrees, \"axis\": "
                "[x, y, z],\n"
                "              \"matrix\": [[a, b], [c, d]]}, ..]}       the others stay\n"
                "  {\"transforms\": [[[a, b, tx], [c, d, ty]], ..]}      one per handle\n"
                "\n"
                "A matrix and a turn act about the handle, before its move. A turn goes from x to "
                "y. Poses can fold. With --certified they cannot: handles and outline go where "
                "they should, and a certified map near the pose moves the rest.\n"},
    {.name = "weights",
     .bit = FOR_WEIGHTS,
     .run = run_weights,
     .usage = "[--source FILE] --handles FILE [OPTION]... < POINTS > OUT",
     .summary = "Computes how strongly each handle moves a point",
     .example = "-s cat.txt -a handles.json -p points.txt -o weights.txt",
     .details =
         "Reads one point per line and writes its weight for each handle (kernel coordinates). The "
         "weights sum to 1 and reproduce the point from the handles. At a handle its own weight is "
         "1. The handles' file is JSON:\n"
         "\n"
         "  {\"handles\": [[x, y], ..],         or [x, y, z]; all other members are optional\n"
         "   \"edges\": [[0, 1], ..],           weights start linear between these handles\n"
         "   \"lines\": [{\"from\": [x, y], \"to\": [x, y], \"parallel\": 0}, ..],\n"
         "                                    stay straight, parallel to an earlier line\n"
         "   \"regions\": [[[x, y], ..], ..],   polygons that also belong to the shape\n"
         "   \"curves\": {\"vertices\": [[x, y], ..], \"segments\": [[0, 1], ..]},\n"
         "   \"rigid\": [{\"region\": [[x, y], ..], \"rigidity\": 1}, ..]}\n"
         "                                    or \"centre\" and \"radius\" for a region\n"
         "\n"
         "The shape consists of the source, the regions and the curves. With --picture or "
         "--binding the weights are written only if you give -o. libicc-files(5) lists all "
         "members.\n"},
    {.name = "encode",
     .bit = FOR_ENCODE,
     .run = run_encode,
     .usage = "--source FILE [OPTION]... < POINTS > COORDINATES",
     .summary = "Converts points to integral curve coordinates",
     .example = "-s before.txt -p points.txt -o coordinates.txt",
     .details = "Writes `facet b0 b1 t` for each point `x y`. Its curve starts on the edge from "
                "vertex `facet` (counted from 0), at b0 of that vertex plus b1 of the next one. "
                "The point lies at the share t of the curve's length. In space the facet is a "
                "face, with three numbers b.\n"},
    {.name = "decode",
     .bit = FOR_DECODE,
     .run = run_decode,
     .usage = "--source FILE [OPTION]... < COORDINATES > POINTS",
     .summary = "Converts integral curve coordinates to points",
     .example = "-s before.txt -p coordinates.txt -o points.txt",
     .details = "Reads the lines that 'libicc encode' writes and writes their points.\n"},
};
enum { N_COMMANDS = sizeof commands / sizeof *commands };

static void print_help(void)
{
    help_paragraphs(
        "Usage: libicc COMMAND [OPTION]...\n\n"
        "Moves everything inside a shape when its boundary moves. The boundary is called a cage: a "
        "polygon, in space a closed surface. libicc proves that a map is one-to-one, or says that "
        "it cannot.\n\nCommands:\n");
    for (size_t i = 0; i < N_COMMANDS; i++)
        printf("  %-8s %s\n", commands[i].name, commands[i].summary);
    help_paragraphs(
        "\nTo begin, run 'libicc demo'.\n\n"
        "  libicc COMMAND --help      describes a command, as does 'libicc help COMMAND'\n"
        "  libicc COMMAND --help-all  also lists its rarely used options\n"
        "  libicc completion SHELL    prints the completions for bash, zsh or fish\n"
        "  libicc --version           prints the version\n\n"
        "Exit codes: 0 done; 1 the input or the computation failed; 2 wrong usage; 4 done, but "
        "some points have no image, or some elements of a mesh are inverted.\n\n(libicc has "
        "nothing to do with ICC colour profiles.)\n");
}

static int run_command(const command *c, int argc, char **argv)
{
    args a;
    int help;
    int result = args_parse(&a, c, argc, argv, &help);
    if (result == DONE && help != HELP_NONE)
        args_help(c, help);
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

/* Words that people try, and the command that does it. */
static const char *const other_names[][2] = {{"transform", "map"},    {"apply", "map"},
                                             {"deform", "warp"},      {"morph", "warp"},
                                             {"video", "animate"},    {"film", "animate"},
                                             {"fill", "mesh"},        {"tetrahedralize", "mesh"},
                                             {"verify", "check"},     {"validate", "check"},
                                             {"repair", "check"},     {"register", "match"},
                                             {"report", "info"},      {"georef", "fit"},
                                             {"georeference", "fit"}, {"rubbersheet", "fit"},
                                             {"gcps", "fit"},         {"nearest", "mesh"},
                                             {"draw", "plot"},        {"show", "plot"},
                                             {"bind", "weights"},     {"skin", "weights"},
                                             {"bones", "pose"},       {"rig", "pose"},
                                             {"example", "demo"}};

static int no_command(const char *name)
{
    guess near = {0};
    guess_text text;
    for (size_t i = 0; i < N_COMMANDS; i++)
        guess_try(&near, name, strlen(name), commands[i].name);
    for (size_t i = 0; i < sizeof other_names / sizeof *other_names; i++)
        if (strcmp(name, other_names[i][0]) == 0)
            near.name = other_names[i][1];
    return misused(NULL, "there is no command '%.40s'%s", name, guess_say(text, &near, ""));
}

/* Handles `libicc help` and `libicc help COMMAND`. */
static int help_with(const char *name)
{
    const command *c = name != NULL ? find_command(name) : NULL;
    if (name != NULL && c == NULL)
        return no_command(name);
    if (c != NULL)
        args_help(c, HELP_USUAL);
    else
        print_help();
    return DONE;
}

int main(int argc, char **argv)
{
    system_begin();
    if (argc < 2)
        return misused(
            NULL, "which command? one of demo, map, fit, warp, animate, mesh, check, match, info, "
                  "plot, pose, weights, encode, decode");
    const char *name = argv[1];
    const command *c = find_command(name);
    if (c != NULL)
        return flushed(run_command(c, argc, argv));
    if (strcmp(name, "--version") == 0 || strcmp(name, "version") == 0 || strcmp(name, "-v") == 0 ||
        strcmp(name, "-V") == 0)
        printf("libicc %s\n", icc_version());
    else if (strcmp(name, "--help") == 0 || strcmp(name, "--help-all") == 0 ||
             strcmp(name, "-h") == 0)
        print_help();
    else if (strcmp(name, "help") == 0)
        return flushed(help_with(argc > 2 ? argv[2] : NULL));
    else if (strcmp(name, "completion") == 0)
        return flushed(completion_print(argc > 2 ? argv[2] : NULL, N_COMMANDS, commands));
    else
        return no_command(name);
    return flushed(DONE);
}
