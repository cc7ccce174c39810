/* Reads the numbers of legacy VTK, as text or as bytes with the most significant first. */
#ifndef VTK_NUMBERS_H
#define VTK_NUMBERS_H

#include "mesh/mesh_lines.h"

/* The bytes of a number of a type, by its name. 0 for bits, strings and unknown types. */
size_t vtk_size(const char *word, size_t n);

/* Goes to the bytes after the line that announces them. Text may begin in that line, so there it
 * does not move. */
void vtk_begin(lines *r);

/* Reads an integer from 0 to below `limit`: the next word, or the next `size` bytes. */
bool vtk_count(lines *r, size_t size, double limit, uint32_t *count);

/* Takes the next n bytes. NULL: the file ends before. */
const char *vtk_bytes(lines *r, size_t n);

/* Reads the next vertex, which has three numbers of `size` bytes. In the plane the third is ignored. */
bool vtk_vertex(lines *r, size_t size);

/* Skips the arrays of a field, which this line announces, if they are bytes. */
bool vtk_skip_field(lines *r);

#endif
