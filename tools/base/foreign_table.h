/* The table of foreign formats, and of what makes a file of them that is read. */
#ifndef FOREIGN_TABLE_H
#define FOREIGN_TABLE_H

#include <stddef.h>

/* What makes a file that is read. Commands stand in single quotes, with FILE for the foreign file and
 * OUT for the new one: tests/tool/test_remedies.sh runs each where the program is installed. */
typedef enum foreign_remedy {
    MAKE_GEOJSON,
    MAKE_GEOJSON_OF_TRACKS,
    MAKE_GEOJSON_OF_AREAS,
    MAKE_GEOJSON_OF_TEXT,
    MAKE_VTK,
    MAKE_OBJ,
    MAKE_GLB,
    MAKE_STL,
    MAKE_STL_OF_PRINTS,
    MAKE_PNG,
    MAKE_PNG_OR_KEEP,
    MAKE_SVG,
    MAKE_MASK,
    MAKE_ARRAY,
    MAKE_ARRAY_OR_VTK,
    MAKE_WKT,
    MAKE_WKT_OF_DIGITS,
    MAKE_UTF8,
    MAKE_POINTS,
    MAKE_POINTS_OF_JSON,
    USE_BLENDER,
    USE_PARAVIEW,
    WRITE_VERTICES,
    UNPACK,
    NO_REMEDY
} foreign_remedy;

/* By what a format is recognised. */
typedef enum foreign_mark {
    BYTES,  /* bytes at a place */
    WORD,   /* what a text begins with, behind white space and a mark of UTF-8 */
    ROOT,   /* the root element of XML, without its prefix */
    MEMBER, /* a member of a JSON object, or of GeoJSON's "type" */
    TYPE
} foreign_mark;

typedef struct foreign_format {
    foreign_mark mark;
    size_t at, n; /* where the bytes stand, and how many they are */
    const char *bytes;
    const char *what; /* the format, with its article */
    foreign_remedy remedy;
} foreign_format;

/* Longer marks come before those that they begin with. */
extern const foreign_format foreign_formats[];
extern const size_t n_foreign_formats;

/* By number; NULL: none. */
extern const char *const foreign_remedies[];

#endif
