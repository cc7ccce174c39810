/* The order of a reference system's axes. */
#ifndef AXIS_ORDER_H
#define AXIS_ORDER_H

typedef enum axis_order {
    AXES_EAST_FIRST = 1, /* easting or longitude */
    AXES_NORTH_FIRST,    /* northing or latitude */
    AXES_UNKNOWN
} axis_order;

/* Of a system by its name: a code as EPSG:4326 or an URN; what else it may be is unknown. */
axis_order axis_order_of(const char *crs);

#endif
