/* Keeps parts of outlines apart by a barrier on the distances between vertices and edges. */
#ifndef ICCP_CONTACT_H
#define ICCP_CONTACT_H

#include "base/env.h"
#include "domain/outlines.h"
#include "map/energy/jacobian.h"

/* A vertex p and an edge from a to b of the outlines that may come near each other. */
typedef struct iccp_touch {
    uint32_t a, b, p;
    double range; /* they push each other away below this distance */
} iccp_touch;

/* Borrows everything. */
typedef struct iccp_contact_shape {
    const iccp_outlines *outlines;
    const double *points; /* before the map, where nothing may push */
    const uint8_t *fixed; /* of each vertex: not 0 if its place is told */
    double range;         /* the largest range of a pair; 0: nothing pushes */
    double strength;      /* factor of the barriers */
} iccp_contact_shape;

/* Sets range and strength. Edges whose two ends are told do not count. `weight` is the mean weight
 * of a triangle. */
icc_status iccp_contact_measure(iccp_contact_shape *shape, double weight, const iccp_env *env);

/* Pairs that are near each other in some images, and the grid that finds them. */
typedef struct iccp_contact {
    iccp_memory memory;
    const iccp_contact_shape *shape;
    size_t n, room;
    iccp_touch *touch; /* n: edge by edge */
    uint32_t side;     /* cells along an axis, at most */
    uint32_t *first;   /* of each cell: where its vertices begin; one more at the end */
    uint32_t *cell;    /* of each vertex of the outlines */
    uint32_t *listed;  /* vertices, cell by cell */
} iccp_contact;

icc_status iccp_contact_create(iccp_contact *contact, const iccp_contact_shape *shape,
                               const iccp_env *env);
void iccp_contact_free(iccp_contact *contact);

/* Lists the pairs that are closer than `reach` times their range. */
icc_status iccp_contact_find(iccp_contact *contact, const double *images, double reach);

/* The energy of the barriers of all listed pairs. */
double iccp_contact_energy(const iccp_contact *contact, const double *images);

/* The derivatives of one barrier by the places of a, b and p. The Hessian is Gauss-Newton's.
 * Returns false if the pair is farther apart than its range. */
bool iccp_contact_local(const iccp_touch *touch, double strength, const double *images,
                        iccp_local *local);

#endif
