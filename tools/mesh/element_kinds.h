/* The kinds of elements, by VTK's numbers: their names, nodes and shapes. */
#ifndef ELEMENT_KINDS_H
#define ELEMENT_KINDS_H

#include <stddef.h>
#include <stdint.h>

/* The kinds that the code names. */
enum {
    ELEMENT_POLYGON = 7,
    ELEMENT_TRIANGLE = 5,
    ELEMENT_PIXEL = 8,
    ELEMENT_QUADRILATERAL = 9,
    ELEMENT_TETRAHEDRON = 10,
    ELEMENT_HEXAHEDRON = 12,
    ELEMENT_WEDGE = 13,
    ELEMENT_PYRAMID = 14,
    ELEMENT_TRIANGLE_2 = 22,
    ELEMENT_QUADRILATERAL_9 = 28,
    ELEMENT_TETRAHEDRON_2 = 24,
    ELEMENT_LAGRANGE_HEXAHEDRON = 72,
    ELEMENT_LAGRANGE_WEDGE = 73,
    ELEMENT_LAGRANGE_PYRAMID = 74
};

/* The shape of the reference element, a product of simplices. A pyramid is not such a product, but
 * the signs at the corners of its base decide. For other shapes only the dimension is known. */
typedef enum element_shape {
    SHAPE_OTHER,
    SHAPE_POLYGON,
    SHAPE_TRIANGLE,
    SHAPE_SQUARE,
    SHAPE_TETRAHEDRON,
    SHAPE_CUBE,
    SHAPE_PRISM,
    SHAPE_PYRAMID
} element_shape;

enum { ELEMENT_MOST_NODES = 27 };

typedef struct element_kind {
    int type;
    const char *one, *many; /* names */
    unsigned dim;
    unsigned n_nodes; /* 0: any number */
    element_shape shape;
    unsigned degree;            /* 1 or 2, along each side */
    const unsigned char *order; /* the place of each node in a file, or NULL if they are in this
                                   order */
} element_kind;

/* The kind of a number from 0 to 255. An unknown one is a "cell of unknown kind" of dimension 3. */
const element_kind *element_kind_find(int type);

/* All kinds in the order of reports; the last stands for unknown ones. */
extern const element_kind element_kinds[];
extern const size_t n_element_kinds;

/* ---- shapes: the places of their corners and further nodes ---- */

/* Factors of the product, and the dimension of each. */
typedef struct element_product {
    unsigned n_factors, dims[3], n_corners;
    const unsigned char (*corners)[3]; /* for each corner: its vertex of each factor */
    const unsigned char (*middles)[2]; /* for each further node: the corners that it lies between */
    const unsigned char (*around)[4];  /* for each corner: itself and the neighbours that decide the
                                          sign there, in positive order */
    unsigned n_around;
} element_product;

const element_product *element_product_of(element_shape shape);

#endif
