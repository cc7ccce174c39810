/* The command line: the command and its options. */
#ifndef ARGS_H
#define ARGS_H

#include "job/function_choice.h"

#include <icc/base.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Files of an option that may be repeated. */
enum { MAX_FILES = 256 };

typedef struct file_list {
    size_t n;
    const char *names[MAX_FILES];
} file_list;

typedef struct args {
    const char *program; /* as the user called it */
    const char *command;
    /* files */
    const char *source, *target, *mesh, *target_mesh, *points, *coords, *output, *repair, *boundary;
    const char *triangulation, *source_crs, *target_crs, *ties;
    const char *match, *landmarks, *target_output;
    const char *by; /* the property with the names of regions; NULL: cages are no layers */
    const char *json_file, *handles, *pose, *binding, *picture;
    const char *pins, *spine;
    const char *outline, *moves, *nearest, *drawing;
    const char *feature_points, *target_feature_points, *feature_lines, *target_feature_lines;
    const char *mesh_out, *target_mesh_out;
    file_list voids, surfaces, target_voids, target_surfaces;
    char **operands; /* moved to the front of argv */
    size_t n_operands;
    /* how charts and maps are made; 0 is the library's choice */
    int32_t method, map, tree, solver, cells, threads;
    function_choice functions[MAX_FUNCTIONS];
    size_t n_functions;
    int32_t improve; /* limit of steps; -1: the library's choice */
    int32_t slide;   /* which chains slide: ICC_SLIDE_ALL; 0: those inside if `slides` */
    double min_fall;
    double tolerance;    /* 0: the command's choice */
    int32_t outside;     /* one of the policies below; 0: the command's choice */
    int32_t require;     /* required of the result, or nothing is written; 0: nothing */
    int32_t fallback;    /* of triangulations; 0: none */
    int32_t quality;     /* of JPEG; 0: not given */
    int32_t rate;        /* frames of a film in a second; 0: not given */
    int32_t frames;      /* steps to a pose that are drawn; 0: the pose alone */
    int32_t turning;     /* of outlines to match; 0: the library's choice */
    int32_t y_down_side; /* the cages in which y points down; 0: not given */
    double snap;         /* below 0: the command's choice */
    double flatten;      /* the largest distance of an edge from its curve; 0: a fixed number of
                            edges */
    double weld;         /* the largest distance of vertices that `welds` joins */
    double maximum[ICC_MAX_DIM], target_maximum[ICC_MAX_DIM];
    size_t n_maximum, n_target_maximum; /* number of their coordinates; 0: not given */
    /* The command's use of two cages. */
    bool needs_target, may_pair, flips_cages;
    bool constrained, unconstrained;
    /* how fits are made; 0 is the library's choice */
    double box[ICC_MAX_DIM], resolution, margin, frame, smoothing, reach, stiffness;
    size_t n_box; /* numbers of the box; 0: not given */
    bool exact, smooths, slides, frees, rotates_vectors;
    bool exact_lines; /* of a layer */
    bool leaves_out;  /* regions at borders that one layer lacks */
    /* how weights are made */
    int32_t sampling, seed, weights, kernel, initial, steps;
    double spacing, sigma;
    bool thesis, certified;
    /* their figures */
    int32_t handle;
    double along[ICC_MAX_DIM];
    size_t n_along;
    bool logarithmic;
    double slice[ICC_MAX_DIM], view[ICC_MAX_DIM];
    size_t n_slice, n_view;
    /* what to do */
    bool fill, fill_holes, keep_source, inverse, repair_mesh, geojson, quiet, json, elevation,
        triangles, y_down, compression, has_background, welds, warps, rectifies, residuals;
    unsigned char background[4];
    int32_t lines;
} args;

/* The cage, or cages, that an option concerns. */
enum { SIDE_SOURCE = 1, SIDE_TARGET, SIDE_BOTH };

/* The program that fills surfaces in space. */

/* Policies for parts outside the cage. */
enum { OUTSIDE_KEEP = 1, OUTSIDE_NULL, OUTSIDE_CLIP, OUTSIDE_FAIL };

/* What other programs do with points outside of a triangulation. */
enum { FALLBACK_NONE = 1, FALLBACK_SIDE, FALLBACK_CENTROID };

/* What --require demands of a result. */
enum { REQUIRE_CERTIFIED = 1 };

/* Bits that stand for commands. */
enum {
    FOR_MAP = 1,
    FOR_ENCODE = 2,
    FOR_DECODE = 4,
    FOR_WARP = 8,
    FOR_MESH = 16,
    FOR_CHECK = 32,
    FOR_INFO = 64,
    FOR_PLOT = 128,
    FOR_CHARTS = 255, /* all of the above */
    MAY_PAIR = FOR_MAP | FOR_WARP | FOR_MESH | FOR_CHECK | FOR_INFO | FOR_PLOT,
    /* Commands that read what lies inside a solid from files of its own. */
    FOR_SOLIDS = FOR_MAP | FOR_MESH | FOR_CHECK | FOR_INFO | FOR_PLOT,
    FILLS_HOLES = FOR_MAP | FOR_WARP | FOR_CHECK,
    FLIPS_CAGES = FOR_MAP | FOR_MESH | FOR_CHECK | FOR_PLOT | 1024, /* FOR_MATCH */
    FOR_WEIGHTS = 256,
    FOR_POSE = 512,
    FOR_KERNEL = FOR_WEIGHTS | FOR_POSE,
    FOR_MATCH = 1024,
    FOR_ANIMATE = 2048,
    FOR_DEMO = 4096,
    FOR_FIT = 8192,
    HAS_CAGES = FOR_CHARTS | FOR_MATCH,
    TAKES_TARGET = MAY_PAIR | FOR_MATCH,
    FOR_ALL = HAS_CAGES | FOR_KERNEL | FOR_ANIMATE | FOR_FIT
};

typedef struct command {
    const char *name;
    unsigned bit;
    size_t n_operands;
    size_t n_operands_geojson; /* with --geojson, and for a fit with --warp */
    size_t n_operands_more;    /* this many more are accepted */
    bool needs_target;
    int (*run)(const args *a);
    const char *usage;   /* the text after the name: one line for each way to call the command */
    const char *summary; /* one line */
    const char *example; /* the text after the name */
    const char *details; /* paragraphs for --help, which wraps lines that do not begin with a
                            blank */
} command;

/* The help that the user asked for. A command that prints help does nothing else. */
enum { HELP_NONE, HELP_USUAL, HELP_ALL };

/* Reads argv[2..argc) for a command. Returns DONE, or MISUSED with a message on stderr. If --help
 * or --help-all is given, *help is set and nothing else counts. */
int args_parse(args *out, const command *c, int argc, char **argv, int *help);

/* The last step of parsing: checks of several options together. */
int args_check(args *a, const command *c);

/* The operand that names the result, or NULL if none does. */
const char *args_result(const args *a, const command *c);

/* Prints the help of a command on stdout, in lines of at most 80 columns. HELP_ALL lists the
 * options of the papers too. */
void args_help(const command *c, int help);

/* Prints paragraphs in such lines. Lines that begin with a blank and empty lines stay as they
 * are. */
void help_paragraphs(const char *text);

#endif
