/* The arrays of a VTU file (VTK's XML format for unstructured grids), and their numbers.
 * https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
 *
 * An array stands in its element as text, or in base64, or its element names a place in a block of
 * raw bytes or base64 at the end of the file. Bytes begin with their number. If they are
 * compressed, they begin with the number of blocks, their sizes before, and their sizes after. */
#ifndef VTU_H
#define VTU_H

#include "base/edits.h"
#include "base/say.h"

#include <stdbool.h>
#include <stdint.h>

typedef enum vtu_section {
    VTU_OTHER,
    VTU_POINTS,
    VTU_CELLS,
    VTU_POINT_DATA,
    VTU_CELL_DATA
} vtu_section;

typedef struct vtu_array {
    vtu_section section;
    size_t piece;
    size_t tag, tag_end; /* its tag in the text: after '<', and after '>' */
    size_t end;          /* of its content: where its closing tag begins */
    char kind;           /* of its numbers: 'f' floats, 'i', 'u' integers, or '?' */
    size_t width;        /* bytes of a number */
    uint32_t n_components;
    bool is_text, is_appended;
    bool is_normal; /* the tag of its section names it as the normals */
    size_t offset;  /* if it is appended */
    /* After vtu_read(). */
    size_t n;          /* numbers */
    double *values;    /* n of them */
    double *changed;   /* n of them, to be written, or NULL */
    size_t at, at_end; /* its content in the text, without the blanks around it */
    uint64_t block;    /* if it is compressed: bytes of a block before */
} vtu_array;

typedef struct vtu_piece {
    uint32_t n_points, n_cells;
} vtu_piece;

typedef struct vtu {
    const char *text; /* borrowed */
    size_t n_text;
    bool is_little, is_zipped;
    size_t n_word; /* bytes of a size before an array */
    bool is_coded; /* the appended block is base64 */
    size_t data;   /* where it begins, or 0 */
    size_t n_arrays, n_pieces, room_arrays, room_pieces;
    vtu_array *arrays;
    vtu_piece *pieces;
} vtu;

/* True if the text begins like a VTU file. */
bool vtu_told(const char *text);

/* Finds the pieces and arrays of a file. False: see `wrong`. Free it in either case. */
bool vtu_scan(vtu *out, const char *text, size_t n, problem *wrong);
void vtu_free(vtu *v);

/* The name of an array for messages. */
const char *vtu_name(const vtu *v, const vtu_array *a, char out[32]);

/* The array of a piece in this section, also by its name. NULL: there is none. */
vtu_array *vtu_find(vtu *v, size_t piece, vtu_section section, const char *name);

/* Reads the n numbers of an array. False: see `wrong`. */
bool vtu_read(const vtu *v, vtu_array *a, uint64_t n, problem *wrong);

/* Fails if a part of the appended block belongs to this array and to another one. */
bool vtu_is_apart(const vtu *v, const vtu_array *a, problem *wrong);

/* Replaces the numbers that have been read, as doubles or in the type of the file. The form of the
 * array stays. In a text, equal numbers stay as they are written. */
void vtu_put(edits *e, const vtu *v, const vtu_array *a, const double *values, bool as_doubles);

/* After all arrays have been put: appended ones begin at other places. */
void vtu_put_offsets(edits *e, const vtu *v);

#endif
