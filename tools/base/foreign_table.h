/* The table of foreign formats and of remedies that turn them into readable files. */
#ifndef FOREIGN_TABLE_H
#define FOREIGN_TABLE_H

#include <stddef.h>

/* How to make a readable file. Commands stand in single quotes, with FILE for the foreign file and
 * OUT for the new one. tests/tool/test_remedies.sh runs each whose program is installed. */
typedef enum foreign_remedy {
    MAKE_GEOJSON,
    MAKE_GEOJSON_OF_TRACKS,
    MAKE_GEOJSON_OF_AREAS,
    MAKE_GEOJSON_OF_TEXT,
    MAKE_VTK,
    MAKE_OBJ,
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

/* The part of a file by which a format is recognised. */
typedef enum foreign_mark {
    BYTES,  /* bytes at a place */
    WORD,   /* the beginning of a text, after a UTF-8 byte order mark and white space */
    ROOT,   /* the root element of XML, without its prefix */
    MEMBER, /* the name of a member of a JSON object */
    TYPE    /* the value of its member "type" */
} foreign_mark;

typedef struct foreign_format {
    foreign_mark mark;
    size_t at, n; /* the place and number of the bytes */
    const char *bytes;
    const char *what; /* the format, with its article */
    foreign_remedy remedy;
} foreign_format;

/* Longer marks come before shorter ones that begin in the same way. */
extern const foreign_format foreign_formats[];
extern const size_t n_foreign_formats;

/* The text of each remedy; NULL: there is none. */
extern const char *const foreign_remedies[];

#endif
