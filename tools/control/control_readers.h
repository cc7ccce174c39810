/* The readers of control points, one for each format. Each reads text[0..n), with text[n] == '\0'.
 * False: see `wrong`. control_read.c chooses among them. */
#ifndef CONTROL_READERS_H
#define CONTROL_READERS_H

#include "base/json_tree.h"
#include "control/control_points.h"

/* The georeferencer of QGIS (.points). The first is true if a text is one. */
bool control_is_qgis(const char *text);
bool control_read_qgis(control_points *out, const char *text, problem *wrong);

/* Tables: x y to_x to_y in columns, separated by white space, commas or semicolons. */
bool control_read_table(control_points *out, const char *text, size_t n, problem *wrong);

/* GDAL: the ground control points of a VRT, and the options -gcp of gdal_translate. */
bool control_is_vrt(const char *text);
bool control_read_vrt(control_points *out, const char *text, problem *wrong);
bool control_has_gcp_options(const char *text);
bool control_read_gcp_options(control_points *out, const char *text, problem *wrong);

/* JSON. Annotations of IIIF maps, as Allmaps has them, and GeoJSON with links or with pairs of
 * Points. */
bool control_is_annotation(const json_tree *tree);
bool control_read_annotation(control_points *out, const json_tree *tree, const char *text,
                             problem *wrong);
bool control_read_links(control_points *out, const json_tree *tree, const char *text,
                        problem *wrong);

/* Pins of a figure, which may turn, and bones between them. */
bool control_has_pins(const json_tree *tree);
bool control_read_pins(control_points *out, const json_tree *tree, const char *text,
                       problem *wrong);

#endif
