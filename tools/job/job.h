/* The first steps of every command: reading the cages, making domains, a chart or a map.
 *
 * Words of this folder
 * - job: one call of a command with its cages, domains, chart and map.
 * - operand: an argument that is no option.
 * - matched: cages that did not correspond and were given common vertices.
 *
 * Steps, each of which does those before it
 * - job_read_cages(), job_make_domains(), job_make_chart() or job_make_map(), job_end().
 *
 * Ways
 * - Options: option_table.c lists them, args.c parses, args_check.c says what excludes what,
 *   args_help.c prints.
 * - Cages: job_cages.c reads and makes domains, correspond.h compares, match_cages.h matches,
 *   landmark_file.h. Vertices on sides: t_junctions.h. Meshes inside: fill.h.
 * - Maps of what is known only in part: fit_cages.h.
 * - Files: output_name.h, call_files.h (nothing overwritten), point_file.h, cage_file.h,
 *   ties_file.h, triangulation.h (axes: axis_order.h). Requirements: require.h. Normals:
 *   attached.h.
 * - Functions of method gradient: function_choice.h.
 *
 * Begin with job.c; args.h has the options. */
#ifndef JOB_H
#define JOB_H

#include "base/file.h"
#include "base/json.h"
#include "base/progress.h"
#include "base/say.h"
#include "cage/cage.h"
#include "geo/carrier.h"
#include "job/args.h"

#include <icc/icc.h>

/* The result of file_read_chosen(). */
typedef struct source_file {
    char *text;
    size_t n;
    const char *named;
} source_file;

typedef struct job {
    const args *args; /* own */
    args own;
    progress bar;
    icc_env env;
    const source_file *source; /* borrowed if several jobs have one source; NULL: it is read */
    cage cages[2];             /* source, target */
    bool both;                 /* both cages are in one file */
    size_t n_added;            /* vertices added to sides on which others lie: see t_junctions.h */
    problem one_sided[2];      /* for each cage: a vertex that does so in this cage only, or "" */
    const icc_domain *domains[2];
    icc_domain *made[2]; /* the domains that are not owned by `match` */
    bool has_domains;
    bool filled; /* domains are made: see job/fill.h */
    icc_match *match;
    icc_match_info matched; /* size 0: the cages correspond as they are */
    size_t function;        /* the number in args->functions; the first one unless there are
                               several */
    icc_chart *chart;       /* of the source */
    icc_map *map;
    icc_fit *fit; /* NULL, or the fit that owns the map */
    double started, seconds_read, seconds_made;
    void (*describe)(json *out, const struct job *j); /* adds members to reports; may be NULL */
} job;

/* The functions below return DONE, or FAILED with a message on stderr. Each does the steps that it
 * needs unless they have been done. End the job in any case. */
void job_start(job *j, const args *a);
void job_end(job *j);

/* Reads the source and the target, if there is one, and matches them on request. Then they
 * correspond, unless the source is a mask. The source's file may have both cages. That applies if
 * no target was named. A source without features that was chosen by name stays alone if the command
 * needs no target. */
int job_read_cages(job *j);

/* The number of coordinates of a point. The cages must have been read. */
size_t job_dim(const job *j);

/* Reads the cages and makes their domains. A mask then has the
 * vertices and facets of its boundary. */
int job_make_domains(job *j);

/* Makes the domain of one side from its cage. */
int job_make_domain(job *j, size_t side);

/* Makes the domain of a polygon with the features inside. */
icc_status job_make_polygon(icc_domain **out, const cage *c, const icc_env *env, icc_error *err);

/* Reads the cages, which must be in the plane for `what`. */
int job_read_plane(job *j, const char *what);

/* Does all that, and makes the chart of the source. */
int job_make_chart(job *j);

/* Does all that, and makes the map from source to target. */
int job_make_map(job *j);

/* Makes a carrier from the side of the points that are read to the other side. Needs a map. Free it
 * in any case. */
int job_start_carrier(job *j, carrier *c);

typedef char side_text[64];

/* Tells which cage of a file with several is meant: "source: ", "target: polygon 2: ", or "".
 * Returns `out`. */
const char *job_side(side_text out, const job *j, int side);

/* The library's message without the side at its beginning, because job_side() names the side. */
const char *job_message(const icc_error *err);

/* Prints the library's message with the file and the line at fault. Returns FAILED. */
int job_failed(job *j, const icc_error *err);

/* Prints the same with a hint after it. */
int job_failed_with(job *j, const icc_error *err, const char *hint);

/* Prints the message of a call that has no icc_error. */
int job_failed_status(job *j, icc_status status);

/* The name of the source's or the target's file. */
const char *job_file(const job *j, int side);

/* What bounds the map, for messages: "the cage", or "the frame" or "the outline" of a fit. */
const char *job_bound(const job *j);

/* The options that make a frame larger, as the end of a message; else "". */
const char *job_bound_hint(const job *j);

/* If points have no image, prints how many and returns PARTIAL; else returns DONE. */
int job_partial(job *j, size_t n, const icc_status *status, const char *what);

/* ---- the report of --json ---- */

typedef struct report {
    outfile file;
    json json;
} report;

/* Vertices and facets of all that lies inside a cage. Those of its own boundary are not among them,
 * nor in the counts `vertices` and `facets` of a report. */
typedef struct inside_counts {
    size_t n_vertices, n_facets;
} inside_counts;

/* `info` is that of the cage's domain. */
inside_counts inside_count(const cage *c, const icc_domain_info *info);

/* Begins a report with the members that every job has. False: a message is on stderr. */
bool report_open(report *r, const job *j);
bool report_close(report *r);

/* Reports how long it took to read, to make a map, and to map. */
void report_times(report *r, const job *j, double apply);

/* Reports how many points were mapped, how many failed, and how long it took, as most commands do.
 * Does nothing without --json. */
int report_points(const job *j, size_t n, size_t n_failed, double seconds);

#endif
