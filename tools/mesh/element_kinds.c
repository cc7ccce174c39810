/* Kinds have the numbers and orders of nodes of VTK's file formats and vtkCellType.h. Each order
 * begins with the corners, then come nodes in the middle of edges, of faces, and of the element. */
#include "mesh/element_kinds.h"

static const unsigned char pixel[] = {0, 1, 3, 2}, voxel[] = {0, 1, 3, 2, 4, 5, 7, 6};

const element_kind element_kinds[] = {
    {ELEMENT_TRIANGLE, "triangle", "triangles", 2, 3, SHAPE_TRIANGLE, 1, NULL},
    {ELEMENT_TETRAHEDRON, "tetrahedron", "tetrahedra", 3, 4, SHAPE_TETRAHEDRON, 1, NULL},
    {ELEMENT_QUADRILATERAL, "quadrilateral", "quadrilaterals", 2, 4, SHAPE_SQUARE, 1, NULL},
    {ELEMENT_PIXEL, "pixel", "pixels", 2, 4, SHAPE_SQUARE, 1, pixel},
    {ELEMENT_POLYGON, "polygon", "polygons", 2, 0, SHAPE_POLYGON, 1, NULL},
    {6, "triangle strip", "triangle strips", 2, 0, SHAPE_OTHER, 1, NULL},
    {ELEMENT_HEXAHEDRON, "hexahedron", "hexahedra", 3, 8, SHAPE_CUBE, 1, NULL},
    {11, "voxel", "voxels", 3, 8, SHAPE_CUBE, 1, voxel},
    {ELEMENT_WEDGE, "prism", "prisms (wedges)", 3, 6, SHAPE_PRISM, 1, NULL},
    {ELEMENT_PYRAMID, "pyramid", "pyramids", 3, 5, SHAPE_PYRAMID, 1, NULL},
    {15, "pentagonal prism", "pentagonal prisms", 3, 10, SHAPE_OTHER, 1, NULL},
    {16, "hexagonal prism", "hexagonal prisms", 3, 12, SHAPE_OTHER, 1, NULL},
    {41, "convex point set", "convex point sets", 3, 0, SHAPE_OTHER, 1, NULL},
    {42, "polyhedron", "polyhedra", 3, 0, SHAPE_OTHER, 1, NULL},
    {ELEMENT_TRIANGLE_2, "quadratic triangle", "quadratic triangles", 2, 6, SHAPE_TRIANGLE, 2,
     NULL},
    {34, "biquadratic triangle", "biquadratic triangles", 2, 7, SHAPE_OTHER, 2, NULL},
    {23, "quadratic quadrilateral", "quadratic quadrilaterals", 2, 8, SHAPE_SQUARE, 2, NULL},
    {ELEMENT_QUADRILATERAL_9, "biquadratic quadrilateral", "biquadratic quadrilaterals", 2, 9,
     SHAPE_SQUARE, 2, NULL},
    {30, "quadratic-linear quadrilateral", "quadratic-linear quadrilaterals", 2, 6, SHAPE_OTHER, 2,
     NULL},
    {36, "quadratic polygon", "quadratic polygons", 2, 0, SHAPE_OTHER, 2, NULL},
    {ELEMENT_TETRAHEDRON_2, "quadratic tetrahedron", "quadratic tetrahedra", 3, 10,
     SHAPE_TETRAHEDRON, 2, NULL},
    {25, "quadratic hexahedron", "quadratic hexahedra", 3, 20, SHAPE_CUBE, 2, NULL},
    {29, "triquadratic hexahedron", "triquadratic hexahedra", 3, 27, SHAPE_CUBE, 2, NULL},
    {33, "biquadratic hexahedron", "biquadratic hexahedra", 3, 24, SHAPE_OTHER, 2, NULL},
    {26, "quadratic prism", "quadratic prisms (wedges)", 3, 15, SHAPE_PRISM, 2, NULL},
    {32, "biquadratic prism", "biquadratic prisms (wedges)", 3, 18, SHAPE_PRISM, 2, NULL},
    {31, "quadratic-linear prism", "quadratic-linear prisms (wedges)", 3, 12, SHAPE_OTHER, 2, NULL},
    {27, "quadratic pyramid", "quadratic pyramids", 3, 13, SHAPE_OTHER, 2, NULL},
    {37, "triquadratic pyramid", "triquadratic pyramids", 3, 19, SHAPE_OTHER, 2, NULL},
    {69, "higher-order triangle", "higher-order triangles", 2, 0, SHAPE_OTHER, 2, NULL},
    {70, "higher-order quadrilateral", "higher-order quadrilaterals", 2, 0, SHAPE_OTHER, 2, NULL},
    {71, "higher-order tetrahedron", "higher-order tetrahedra", 3, 0, SHAPE_OTHER, 2, NULL},
    {ELEMENT_LAGRANGE_HEXAHEDRON, "higher-order hexahedron", "higher-order hexahedra", 3, 0,
     SHAPE_OTHER, 2, NULL},
    {ELEMENT_LAGRANGE_WEDGE, "higher-order prism", "higher-order prisms (wedges)", 3, 0,
     SHAPE_OTHER, 2, NULL},
    {ELEMENT_LAGRANGE_PYRAMID, "higher-order pyramid", "higher-order pyramids", 3, 0, SHAPE_OTHER,
     2, NULL},
    {76, "Bezier triangle", "Bezier triangles", 2, 0, SHAPE_OTHER, 2, NULL},
    {77, "Bezier quadrilateral", "Bezier quadrilaterals", 2, 0, SHAPE_OTHER, 2, NULL},
    {78, "Bezier tetrahedron", "Bezier tetrahedra", 3, 0, SHAPE_OTHER, 2, NULL},
    {79, "Bezier hexahedron", "Bezier hexahedra", 3, 0, SHAPE_OTHER, 2, NULL},
    {80, "Bezier prism", "Bezier prisms (wedges)", 3, 0, SHAPE_OTHER, 2, NULL},
    {81, "Bezier pyramid", "Bezier pyramids", 3, 0, SHAPE_OTHER, 2, NULL},
    {3, "line", "lines", 1, 2, SHAPE_OTHER, 1, NULL},
    {4, "polyline", "polylines", 1, 0, SHAPE_OTHER, 1, NULL},
    {21, "quadratic line", "quadratic lines", 1, 3, SHAPE_OTHER, 2, NULL},
    {35, "cubic line", "cubic lines", 1, 4, SHAPE_OTHER, 3, NULL},
    {68, "higher-order line", "higher-order lines", 1, 0, SHAPE_OTHER, 2, NULL},
    {75, "Bezier line", "Bezier lines", 1, 0, SHAPE_OTHER, 2, NULL},
    {1, "vertex", "vertices", 0, 1, SHAPE_OTHER, 1, NULL},
    {2, "set of vertices", "sets of vertices", 0, 0, SHAPE_OTHER, 1, NULL},
    {0, "empty cell", "empty cells", 0, 0, SHAPE_OTHER, 1, NULL},
    {-1, "cell of unknown kind", "cells of unknown kind", 3, 0, SHAPE_OTHER, 1, NULL},
};
const size_t n_element_kinds = sizeof element_kinds / sizeof *element_kinds;

const element_kind *element_kind_find(int type)
{
    size_t i = 0;
    while (i + 1 < n_element_kinds && element_kinds[i].type != type)
        i++;
    return &element_kinds[i];
}

/* ---------------------------------------------------------------------- shapes */

static const unsigned char triangle_corners[][3] = {{0}, {1}, {2}};
static const unsigned char triangle_middles[][2] = {{0, 1}, {1, 2}, {2, 0}};
static const unsigned char triangle_around[][4] = {{0, 1, 2, 0}};

static const unsigned char square_corners[][3] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
static const unsigned char square_middles[][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}};
static const unsigned char square_around[][4] = {
    {0, 1, 3, 0}, {1, 2, 0, 0}, {2, 3, 1, 0}, {3, 0, 2, 0}};

static const unsigned char tetrahedron_corners[][3] = {{0}, {1}, {2}, {3}};
static const unsigned char tetrahedron_middles[][2] = {{0, 1}, {1, 2}, {2, 0},
                                                       {0, 3}, {1, 3}, {2, 3}};
static const unsigned char tetrahedron_around[][4] = {{0, 1, 2, 3}};

static const unsigned char cube_corners[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
/* The middle of a face lies between opposite corners of it. */
static const unsigned char cube_middles[][2] = {
    {0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5},
    {2, 6}, {3, 7}, {0, 7}, {1, 6}, {0, 5}, {3, 6}, {0, 2}, {4, 6}, {0, 6}};
static const unsigned char cube_around[][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6},
                                               {3, 0, 2, 7}, {4, 7, 5, 0}, {5, 4, 6, 1},
                                               {6, 5, 7, 2}, {7, 6, 4, 3}};

static const unsigned char prism_corners[][3] = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}};
static const unsigned char prism_middles[][2] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3},
                                                 {0, 3}, {1, 4}, {2, 5}, {0, 4}, {1, 5}, {2, 3}};
static const unsigned char prism_around[][4] = {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5},
                                                {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}};

static const unsigned char pyramid_around[][4] = {
    {0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}};

const element_product *element_product_of(element_shape shape)
{
    static const element_product products[] = {
        [SHAPE_TRIANGLE] = {1, {2}, 3, triangle_corners, triangle_middles, triangle_around, 1},
        [SHAPE_SQUARE] = {2, {1, 1}, 4, square_corners, square_middles, square_around, 4},
        [SHAPE_TETRAHEDRON] =
            {1, {3}, 4, tetrahedron_corners, tetrahedron_middles, tetrahedron_around, 1},
        [SHAPE_CUBE] = {3, {1, 1, 1}, 8, cube_corners, cube_middles, cube_around, 8},
        [SHAPE_PRISM] = {2, {2, 1}, 6, prism_corners, prism_middles, prism_around, 6},
        [SHAPE_PYRAMID] = {0, {0}, 0, NULL, NULL, pyramid_around, 4}};
    return shape >= SHAPE_TRIANGLE ? &products[shape] : NULL;
}
