/* What the files that carry geometries share. */
#ifndef GEO_CARRIAGE_H
#define GEO_CARRIAGE_H

#include "geo/geo_carry.h"
#include "geo/geo_write.h"

typedef struct carriage {
    const carrier *cage;
    noding noding;
    geo_policy policy;
    double tolerance;
    const char *text;
    geo_index index;
    geo_box *boxes; /* one per object: of what is in it */
    geo_result *out;
    problem *wrong;
    size_t line, line_at; /* the line of a place in the text, for the next one behind it */
    uint32_t fault_of;    /* the object of the last fault */
    /* of the current geometry */
    uint32_t object;
    geo_shape shape;
    double *images;
    icc_status *status;
    bool *snapped;
    size_t room_images, room_status, room_snapped;
    polyline *lines;
    size_t n_lines, room_lines;
} carriage;

/* The object of the current geometry. */
geo_object *geo_current(const carriage *c);

/* Notes that the current geometry is not carried as it was. A feature has one entry; of two fates
 * of its geometries the worse is reported. */
void geo_note_fault(carriage *c, size_t n_without, const char *fate);

/* Notes that, and leaves nothing of it. Returns true. */
bool geo_leave_out(carriage *c, size_t n_without);

/* One more empty line in c->lines. */
polyline *geo_add_line(carriage *c);

/* A node with its image: on the cage that of its place there, elsewhere that of its position, if it
 * has one. */
vertex geo_vertex_of(const carriage *c, const geo_node *node);
bool geo_has_gap(const polyline *line);
geo_writer geo_writer_of(carriage *c);

/* Cuts the current geometry along the cage. False: see c->wrong. */
bool geo_cut(carriage *c, size_t n_without);

/* Sets each bbox to what is in its object, from the last object to the first, so that what an
 * object holds is known before it. False: see c->wrong. */
bool geo_set_boxes(carriage *c);

#endif
