/* The commands. Each returns the exit code of the program.
 *
 * Words of this folder
 * - command: a file cmd_NAME.c with one function run_NAME(), and one row in main.c. Its options are
 *   in job/option_table.c.
 * - job: the steps that all commands begin with (job/job.h).
 * - apply: what a command does with the map of a job, once it has one.
 * - completion: what a shell offers after the Tab key (completion.h).
 *
 * Begin with cmd_map.c. */
#ifndef COMMANDS_H
#define COMMANDS_H

#include "job/job.h"

int run_map(const args *a);
int run_fit(const args *a);
int run_match(const args *a);
int run_encode(const args *a);
int run_decode(const args *a);
int run_warp(const args *a);
int run_mesh(const args *a);
int run_fill(const args *a); /* mesh --fill */
int run_check(const args *a);
int run_info(const args *a);
int run_plot(const args *a);
int run_weights(const args *a);
int run_pose(const args *a);
int run_pins(const args *a); /* pose --pins */
int run_animate(const args *a);
int run_demo(const args *a);

/* What map, map --geojson, warp and plot do with a job. They make its map unless it has one. */
int map_apply(job *j);
int geojson_apply(job *j);
int warp_apply(job *j);

/* Draws the shapes and the map of a job in the plane. */
int plot_apply(job *j, const char *name);

#endif
