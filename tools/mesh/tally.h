/* Counts the elements of a mesh by their proved signs before and after a map, for each kind of
 * element. */
#ifndef TALLY_H
#define TALLY_H

#include "base/json.h"
#include "mesh/element_kinds.h"
#include "mesh/mesh_file.h"

/* Counts for one kind of elements, which has as many dimensions as the mesh. Triangles and
 * tetrahedra have exact signs, which stay, turn or vanish. Other elements are positive if their
 * determinant keeps its sign everywhere. They are inverted if it somewhere lacks that sign, and
 * otherwise undecided. Elements without a sign before the map count as flat_before. */
typedef struct tally_kind {
    const element_kind *kind;
    size_t all, kept, inverted, collapsed, undecided, flat_before, without_image;
} tally_kind;

typedef struct tally {
    tally_kind *kinds; /* n_element_kinds */
    unsigned char *fates;
    bool *on_boundary; /* of each vertex: true if it is on the boundary of the triangles or
                          tetrahedra */
    bool untangled;    /* true after tally_compare() */
    size_t n_tangled, n_repaired; /* inverted or collapsed before untangling; those that keep their
                                     orientation after it */
} tally;

void tally_make(tally *out, const mesh_file *m, const double *images);
void tally_free(tally *t);

/* Counts what untangling has repaired. `before` is about the same mesh. */
void tally_compare(tally *t, const tally *before, const mesh_file *m);

/* How many elements are inverted, collapsed or undecided. */
size_t tally_spoilt(const tally *t);

/* True if a certificate of the tetrahedra, or of the triangles and fans of larger faces, covers all
 * elements. */
bool tally_is_simplicial(const mesh_file *m);

/* Line i of the report as text, without its end. False if there is no such line. The first line is
 * about triangles or tetrahedra, if there are any. */
bool tally_line(const tally *t, const mesh_file *m, size_t i, char *text, size_t room);

/* Adds a member for each kind to a report, with the numbers of spoilt elements. */
void tally_report(const tally *t, const mesh_file *m, json *out);

/* Prints on stderr which elements are spoilt, by their numbers, and why. `name` is that of the
 * file, and `inner` is the reason for elements with an inner corner. Prints nothing if no element
 * is spoilt. */
void tally_tell(const tally *t, const mesh_file *m, const char *name, const char *inner);

#endif
