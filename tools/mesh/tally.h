/* What became of the elements of a mesh, by exact signs. */
#ifndef TALLY_H
#define TALLY_H

#include "base/json.h"
#include "mesh/mesh_file.h"

/* Elements by what became of their orientation; those that had none before count by themselves. In
 * the plane they are triangles, in space tetrahedra. */
typedef struct tally {
    size_t all, kept, inverted, collapsed, flat_before, without_image;
} tally;

tally tally_count(const mesh_file *m, const double *images);

/* How many elements are inverted or collapsed. */
size_t tally_spoilt(const tally *t);

/* In one line, without its end; as an object of a report, which lists those that are inverted or
 * collapsed. */
void tally_print(const tally *t, const mesh_file *m, char *text, size_t room);
void tally_report(const tally *t, const mesh_file *m, const double *images, json *out);

/* Says on stderr which elements are inverted or collapsed, by their numbers, and why. `name` is that
 * of the file, `inner` says why those with an inner corner are. Nothing if there are none. */
void tally_tell(const tally *t, const mesh_file *m, const double *images, const char *name,
                const char *inner);

#endif
