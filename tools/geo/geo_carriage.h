/* Data that the files that carry geometries share. */
#ifndef GEO_CARRIAGE_H
#define GEO_CARRIAGE_H

#include "geo/geo_carry.h"
#include "geo/geo_layer.h"
#include "geo/geo_write.h"
#include "geo/lakes.h"

/* A vertex of a path that is carried: a position of the text, or a node of the layer on the way to
 * the next one. */
typedef struct origin {
    bool position;
    size_t from;
    double along;
    uint32_t node;
} origin;

/* A geometry that lies in the cage and waits until its lines are mapped along with others. */
typedef struct waiting {
    uint32_t object;
    size_t n_without;
    bool whole;
    geo_shape read;
    polyline *lines;
    size_t n_lines, room_lines;
} waiting;

typedef struct carriage {
    const carrier *cage;
    noding noding;
    lakes lakes; /* if geometries are clipped */
    const geo_options *options;
    geo_layer layer;
    map_edges *edges; /* lines are cut at them; NULL: they are sampled */
    const char *text;
    geo_index index;
    geo_box *boxes; /* one for each object: the box of its contents */
    geo_result *out;
    problem *wrong;
    size_t line, line_at; /* the line of a place in the text, from which later lines are counted */
    uint32_t fault_of;    /* the object of the last fault */
    /* The current geometry. */
    uint32_t object;
    geo_shape read;  /* as the text has it */
    geo_shape shape; /* the same with vertices that neighbours have on its sides; it has no spans */
    origin *origins; /* of each position of `shape`, which has the next four arrays, too */
    double *images;
    icc_status *status;
    bool *snapped;
    size_t room_origins, room_images, room_status, room_snapped;
    polyline *lines;
    size_t n_lines, room_lines;
    waiting *waits; /* room_waiting, of which n_waiting wait; with n_vertices in their lines */
    size_t n_waiting, room_waiting, n_vertices;
} carriage;

/* The object of the current geometry. */
geo_object *geo_current(const carriage *c);

/* Says in c->wrong that the library stopped. Returns false. */
bool geo_stop(carriage *c, icc_status status);

/* Records that the current geometry is not carried unchanged. A feature has one entry. If its
 * geometries have two fates, the worse one is reported. */
void geo_note_fault(carriage *c, size_t n_without, const char *fate);

/* Records a fault and drops the geometry. Returns true. */
bool geo_leave_out(carriage *c, size_t n_without);
geo_writer geo_writer_of(carriage *c);

/* Ends a geometry whose lines are refined, if it still `writes`, or else cuts it or leaves it out.
 * False: see c->wrong. */
bool geo_end(carriage *c, size_t n_without, bool whole, bool writes);

/* geo_take.c */

/* Makes the shape that is carried of the one that has been read. False: see c->wrong. */
bool geo_take_shape(carriage *c);

/* geo_lines.c */

/* Adds an empty line to c->lines. */
polyline *geo_add_line(carriage *c);

/* A node with its image. On the cage it is the image of the place on the edge; elsewhere that of
 * its position, if there is one. */
vertex geo_vertex_of(const carriage *c, const geo_node *node);
bool geo_has_gap(const polyline *line);

/* Make lines of all points, which are lines without pieces, or of all paths. True: all of the
 * geometry lies in the cage. */
bool geo_take_points(carriage *c);
bool geo_take_paths(carriage *c);

/* Closes pieces along an edge of the cage, where the map is linear. */
void geo_close_on_cage(carriage *c, polyline *line);

/* Adds vertices to a line until its image is exact or accurate. False: see c->wrong. */
bool geo_refine_line(carriage *c, polyline *line);

/* geo_wait.c */

/* Lets the current geometry wait. False: see c->wrong. */
bool geo_wait(carriage *c, size_t n_without, bool whole);

/* Refines the lines of all geometries that wait, and writes these; geo_flush_before() keeps the
 * current geometry. False: see c->wrong. */
bool geo_flush(carriage *c);
bool geo_flush_before(carriage *c);
void geo_waits_free(carriage *c);

/* geo_cut.c */

/* Cuts the current geometry along the cage. False: see c->wrong. */
bool geo_cut(carriage *c, size_t n_without);

/* geo_bounds.c */

/* Sets each bbox to the box of its object's contents. Goes from the last object to the first, so
 * that contents are known before their object. False: see c->wrong. */
bool geo_set_boxes(carriage *c);

#endif
