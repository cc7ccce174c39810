/* The order of a reference system's axes. */
#ifndef AXIS_ORDER_H
#define AXIS_ORDER_H

typedef enum axis_order {
    AXES_EAST_FIRST = 1, /* easting or longitude */
    AXES_NORTH_FIRST,    /* northing or latitude */
    AXES_UNKNOWN
} axis_order;

/* The order of a system's axes, from a code such as EPSG:4326 or a URN. For other names it is
 * unknown. */
axis_order axis_order_of(const char *crs);

#endif
