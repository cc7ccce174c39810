/* Writes surfaces to files with their exact doubles: OBJ, OFF, STL as text, PLY as binary. */
#ifndef SURFACE_WRITE_H
#define SURFACE_WRITE_H

#include "cage/cage.h"

#include <stdio.h>

/* Writes a surface in space in one of these formats. */
void surface_write(FILE *stream, const cage *c, const char *format);

#endif
