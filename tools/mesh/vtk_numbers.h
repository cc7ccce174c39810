/* The numbers of legacy VTK, as text or as bytes, the most significant first. */
#ifndef VTK_NUMBERS_H
#define VTK_NUMBERS_H

#include "mesh/mesh_lines.h"

/* Bytes of a number of a type, by its name; 0 for one of another name, and for bits and strings. */
size_t vtk_size(const char *word, size_t n);

/* Begins bytes behind the line that announces them. Text may begin in that line. */
void vtk_begin(lines *r);

/* A whole number from 0 to below `limit`: the next word, or the next `size` bytes. */
bool vtk_count(lines *r, size_t size, double limit, uint32_t *count);

/* The next vertex of three numbers, of which as many as the mesh has dimensions count; `size` is that
 * of a number in bytes. */
bool vtk_vertex(lines *r, size_t size);

/* Passes over the arrays of a field, which was announced in this line, where they are bytes. */
bool vtk_skip_field(lines *r);

#endif
