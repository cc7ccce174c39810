/* The parts of `libicc check`. */
#ifndef CHECK_JOB_H
#define CHECK_JOB_H

#include "cage/cage_defects.h"
#include "job/job.h"
#include "report/chart_facts.h"

typedef struct check {
    job job;
    defect_list defects[2]; /* in the plane; elsewhere the first defect is all that there is */
    size_t n_defects;
    size_t n_dropped; /* by --repair: vertices */
    size_t n_filled;  /* by --repair: cells of a mask */
    size_t n_joined;  /* by --repair: vertices of a surface */
    chart_facts charts[2];
    icc_map_info map;    /* of kind 0 without a target */
    bool certified;      /* all there is */
    struct check *parts; /* the other polygons, as many as the job has; their jobs are copies */
} check;

/* Lists the defects of cages in the plane, and those of the other polygons. */
int check_find_defects(check *c);

/* Whether there is only a mask or a surface, without a target. */
bool check_is_alone(const check *c);

/* Whether only that is checked, and no chart of it: an option may ask for that of a surface. */
bool check_domain_only(const check *c);

/* ---- telling ---- */

/* The answer, in the first line: is it one-to-one, or why is that not proved. Nothing where only a
 * domain is checked. */
void check_print_verdict(const check *c);
void check_print_defects(const check *c);
void check_print_domains(const check *c);
void check_print_certificates(const check *c);

/* Why not all is certified, in one line. */
const char *check_reason(char text[240], const check *c);

/* The report of --json. */
int check_report(const check *c);

/* ---- writing ---- */

/* --repair in the plane: drops vertices of both cages alike until none is superfluous, and writes
 * what is left. */
int check_repair(check *c);

/* --repair of a surface: joins vertices at one place, and writes it if it is closed then. */
int check_repair_surface(check *c);

/* --repair of a mask: fills cells where others touch only along edges or corners, and writes it. */
int check_repair_mask(check *c);

/* --boundary: the vertices of a mask's boundary, to be moved. */
int check_write_boundary(check *c);

#endif
