/* What became of the elements of a mesh, by proved signs, for each kind of element. */
#ifndef TALLY_H
#define TALLY_H

#include "base/json.h"
#include "mesh/element_kinds.h"
#include "mesh/mesh_file.h"

/* Elements of one kind, which has as many dimensions as the mesh. Triangles and tetrahedra have
 * exact signs, which stay, turn or vanish. Other elements are positive if their determinant has,
 * everywhere, the sign that it had everywhere before, inverted if somewhere it has not, or
 * undecided. Those that had no sign before count by themselves. */
typedef struct tally_kind {
    const element_kind *kind;
    size_t all, kept, inverted, collapsed, undecided, flat_before, without_image;
} tally_kind;

typedef struct tally {
    tally_kind *kinds; /* n_element_kinds */
    unsigned char *fates;
    bool *on_boundary; /* of each vertex, whether it is on that of the triangles or tetrahedra */
} tally;

void tally_make(tally *out, const mesh_file *m, const double *images);
void tally_free(tally *t);

/* How many elements are inverted, collapsed or undecided. */
size_t tally_spoilt(const tally *t);

/* Whether a certificate of the triangles, those of larger faces among them, or of the tetrahedra
 * speaks of all elements. */
bool tally_is_simplicial(const mesh_file *m);

/* Line i of a text, without its end; false behind the last. The first is about triangles or
 * tetrahedra, if there are any. */
bool tally_line(const tally *t, const mesh_file *m, size_t i, char *text, size_t room);

/* Members of a report, one for each kind; they list the elements that are not as they should be. */
void tally_report(const tally *t, const mesh_file *m, json *out);

/* Says on stderr which elements are not as they should be, by their numbers, and why. `name` is that
 * of the file, `inner` says why those with an inner corner are. Nothing if there are none. */
void tally_tell(const tally *t, const mesh_file *m, const char *name, const char *inner);

#endif
