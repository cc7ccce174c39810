/* Following a leaf of a foliation of simplices: a straight piece in each simplex, in barycentric
 * coordinates, towards smaller rank or back. */
#ifndef ICCP_FIBRE_H
#define ICCP_FIBRE_H

#include "domain/simplices.h"
#include "trace/path.h"

#endif
