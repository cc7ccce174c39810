/* The mesh of a core and its coat, with images, while vertices are raised and images are moved. The
 * image of every tetrahedron stays positive, exactly, except during a trial. */
#ifndef ICCP_COAT_MESH_H
#define ICCP_COAT_MESH_H

#include "fill/tets.h"
#include "geometry/simplices.h"
#include "map/solid/halfspaces.h"

typedef struct iccp_coat_mesh {
    iccp_tets tets;             /* before the map; its no_memory tells that any allocation failed */
    double *image;              /* 3 of each point */
    size_t room;                /* points that have room for an image */
    size_t n_fixed;             /* the points of the boundary, which are not smoothed */
    iccp_halfspaces halfspaces; /* of the point that is being moved */
} iccp_coat_mesh;

/* Copies a mesh that knows its neighbours, and its images. ICC_ERR_MEMORY. Free it even then. */
icc_status iccp_coat_mesh_create(iccp_coat_mesh *mesh, const iccp_simplices *from,
                                 const double *images, const iccp_memory *memory);
void iccp_coat_mesh_free(iccp_coat_mesh *mesh);

/* Returns the mesh without removed tetrahedra, which does not know its neighbours, and its images.
 * Free both even on failure. */
icc_status iccp_coat_mesh_give(const iccp_coat_mesh *mesh, iccp_simplices **out, double **images);

static inline double *iccp_coat_image(const iccp_coat_mesh *mesh, uint32_t point)
{
    return mesh->image + 3 * (size_t)point;
}

/* Sets the image of a point. */
void iccp_coat_put(iccp_coat_mesh *mesh, uint32_t point, const double image[3]);

/* Cuts an edge in the middle, before and after the map. If it returns false, nothing has
 * changed. */
bool iccp_coat_cut(iccp_coat_mesh *mesh, uint32_t a, uint32_t b, uint32_t *point);

/* Returns true if the images of all tetrahedra at a point are positive. */
bool iccp_coat_is_star_good(iccp_coat_mesh *mesh, uint32_t point);

/* Moves the images of all inner points to where their tetrahedra are large, as far as these stay
 * positive. O(n). */
void iccp_coat_smooth(iccp_coat_mesh *mesh);

#endif
