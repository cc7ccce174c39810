/* What every command does first: read the cages, make domains, a chart or a map. */
#ifndef JOB_H
#define JOB_H

#include "base/file.h"
#include "base/json.h"
#include "base/progress.h"
#include "base/say.h"
#include "cage/cage.h"
#include "geo/carrier.h"
#include "job/args.h"
#include "job/nesting.h"

#include <icc/icc.h>

/* What file_read_chosen() gives. */
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
    const source_file *source; /* borrowed, where several jobs have one source; NULL: it is read */
    cage cages[2];             /* source, target */
    bool both;                 /* are in one file */
    const icc_domain *domains[2];
    icc_domain *made[2]; /* the same, but for those that are of `match` */
    bool has_domains;    /* of all parts */
    bool filled;         /* the domains: see job/fill.h */
    icc_match *match;
    icc_match_info matched; /* size 0: the cages correspond as they are */
    size_t function;        /* which of args->functions; the first unless there are several */
    icc_chart *chart;       /* of the source */
    icc_map *map;
    char name[48];     /* of one polygon of several, as in "polygon 2: "; else "" */
    cage_hole place;   /* the hole of another that it lies in */
    size_t n_parts;    /* others: polygons, then insides of holes */
    size_t n_polygons; /* all of them, with this one */
    struct job *parts;
    double started, seconds_read, seconds_made;
} job;

/* The functions below return DONE, or FAILED with a line on stderr. Each does what it needs unless
 * it has been done. A job is to be ended in any case. */
void job_start(job *j, const args *a);
void job_end(job *j);

/* Reads the source, and the target if there is one, and matches them if that is asked for; they
 * then correspond, unless the source is a mask. Where no target was named, and one is needed, or
 * the source has features, which only maps take, the source's file may hold both. */
int job_read_cages(job *j);

/* Coordinates of a point, once the cages have been read. */
size_t job_dim(const job *j);

/* Reads the cages and makes their domains, those of all parts. A mask then has the vertices and facets of its
 * boundary. */
int job_make_domains(job *j);

/* The domain of a polygon with what lies inside. */
icc_status job_make_polygon(icc_domain **out, const cage *c, const icc_env *env, icc_error *err);

/* Reads the cages, which must be in the plane for `what`. */
int job_read_plane(job *j, const char *what);

/* All that, and the chart of the source. */
int job_make_chart(job *j);

/* All that, and the map from source to target, of each part. */
int job_make_map(job *j);

/* A carrier from the side whose points are read to the other, once there is a map; to be freed in
 * any case. */
int job_start_carrier(job *j, carrier *c);

typedef char side_text[64];

/* The words that tell which cage of a file with several is meant: "source: ", "target: polygon 2: ",
 * or "". Returns `out`. */
const char *job_side(side_text out, const job *j, int side);

/* The library's message without the side in front, because job_side() names it. */
const char *job_message(const icc_error *err);

/* Says what the library said, with the file and the line at fault; returns FAILED. */
int job_failed(job *j, const icc_error *err);

/* The same with more behind it. */
int job_failed_with(job *j, const icc_error *err, const char *hint);

/* The same for a call that has no icc_error. */
int job_failed_status(job *j, icc_status status);

/* The name of the source's or the target's file. */
const char *job_file(const job *j, int side);

/* Says how many points have no image, and returns PARTIAL; returns DONE when all have. */
int job_partial(job *j, size_t n, const icc_status *status, const char *what);

/* ---- the report of --json ---- */

typedef struct report {
    outfile file;
    json json;
} report;

/* Begins a report with what is known of every job. False: said why. */
bool report_open(report *r, const job *j);
bool report_close(report *r);

/* How long it took to read, to make a map, and to map. */
void report_times(report *r, const job *j, double apply);

/* Most commands report how many points they mapped, how many of these failed, and how long it took.
 * Does nothing without --json. */
int report_points(const job *j, size_t n, size_t n_failed, double seconds);

#endif
