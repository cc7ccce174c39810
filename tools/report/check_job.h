/* The parts of `libicc check`: check_find.c finds what is wrong, check_report.c prints it and
 * writes the report of --json, and check_write.c writes repaired shapes. The words of this folder
 * are in info.h. */
#ifndef CHECK_JOB_H
#define CHECK_JOB_H

#include "cage/cage_defects.h"
#include "cage/mend.h"
#include "job/job.h"
#include "report/chart_facts.h"

typedef struct check {
    job job;
    defect_list defects[2]; /* in the plane; in other dimensions there is only the first defect */
    size_t n_defects;
    size_t n_dropped; /* by --repair: vertices */
    size_t n_filled;  /* by --repair: cells of a mask */
    size_t n_joined;  /* by --repair: vertices of a surface */
    mended mended;    /* by --repair: faces and holes of a surface */
    chart_facts charts[2];
    icc_map_info map; /* of kind 0 if there is no target */
    icc_map_report made;
    bool certified; /* everything is certified */
} check;

/* Lists the defects of the outer rings of cages in the plane. */
int check_find_defects(check *c);

/* True if there is only a mask, a surface or a picture, without a target. */
bool check_is_alone(const check *c);

/* True if only that is checked, and no chart of it. For a surface an option may ask for a chart. */
bool check_domain_only(const check *c);

/* ---- printing ---- */

/* Prints the answer in the first line: the map is one-to-one, or why that is not proved. Prints
 * nothing if only a domain is checked. */
void check_print_verdict(const check *c);
void check_print_defects(const check *c);
void check_print_domains(const check *c);
void check_print_certificates(const check *c);

/* The reason why not everything is certified, in one line. */
const char *check_reason(char text[240], const check *c);

/* Writes the report of --json. */
int check_report(const check *c);

/* ---- writing ---- */

/* --repair in the plane: drops the same vertices from both cages until none is superfluous, and
 * writes the rest. */
int check_repair(check *c);

/* --repair of a surface: joins vertices at one place, mends it (mend.h), and writes it if it is then
 * valid. */
int check_repair_surface(check *c);

/* --repair of a mask: fills cells where others touch only along edges or corners, and writes it. */
int check_repair_mask(check *c);

/* --boundary: writes the vertices of a mask's boundary, which the user then moves. */
int check_write_boundary(check *c);

#endif
