/* Proves the sign of the Jacobian determinant of the map from the reference element, instead of
 * sampling it. So it proves whether an element is inverted anywhere. */
#ifndef ELEMENT_SIGN_H
#define ELEMENT_SIGN_H

#include "mesh/element_kinds.h"

typedef enum element_sign {
    ELEMENT_UNDECIDED,
    ELEMENT_POSITIVE, /* the determinant has the requested sign everywhere */
    ELEMENT_INVERTED  /* somewhere it is 0 or has the other sign */
} element_sign;

/* A plan for the elements of one kind, with work space. NULL if there is no memory. */
typedef struct element_plan element_plan;
element_plan *element_plan_make(const element_kind *kind);
void element_plan_free(element_plan *p);

/* The sign of an element whose dimension is that of the points. If `sign` is -1, the determinant
 * must be negative everywhere. All points are finite. Signs at the corners of linear elements are
 * exact unless some coordinates differ by more than a factor 2^180. Everything else rests on bounds
 * that include every rounding. */
element_sign element_sign_of(element_plan *p, const double *points, const uint32_t *nodes,
                             int sign);

/* The sign that an element is proved to have everywhere: 1, -1, or 0 if neither is proved. */
int element_orientation(element_plan *p, const double *points, const uint32_t *nodes);

#endif
