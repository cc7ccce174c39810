/* Finds the arrays of a VTU file by the tags of its XML. */
#include "mesh/vtu.h"

#include "base/allocate.h"
#include "base/number.h"
#include "base/xml_tags.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A reader at a tag. */
typedef struct scan {
    vtu *v;
    problem *wrong;
    tag tag;
    vtu_section section;
    const char *normals; /* of the section: the name of the array of normals, or NULL */
    size_t n_normals;
    bool in_array;
} scan;

static bool first_tag(tag *out, const char *text)
{
    if (strncmp(text, "\xef\xbb\xbf", 3) == 0)
        text += 3;
    text += strspn(text, " \t\r\n");
    return *text == '<' && tag_next(out, text);
}

bool vtu_told(const char *text)
{
    tag root;
    return first_tag(&root, text) && tag_is(&root, "VTKFile") &&
           tag_has(&root, "type", 4, "UnstructuredGrid");
}

static size_t line_of_tag(const scan *s)
{
    return line_of(s->v->text, s->tag.name);
}

static const char *attribute(const scan *s, const char *name, const char **end)
{
    return tag_attribute(&s->tag, name, strlen(name), end);
}

/* Copies the value of an attribute for a message. */
static const char *shown_value(char out[32], const char *value, const char *end)
{
    char copy[32] = "";
    size_t n = (size_t)(end - value);
    memcpy(copy, value, n < sizeof copy ? n : sizeof copy - 1);
    return quoted(out, copy);
}

/* Reads an attribute that is a whole number below `limit`. */
static bool count(const scan *s, const char *name, double limit, double *out)
{
    const char *end, *at = attribute(s, name, &end);
    char shown[32];
    if (at == NULL)
        return spoilt(s->wrong, line_of_tag(s), "the tag '%s' has no %s",
                      shown_value(shown, s->tag.name, s->tag.name + s->tag.n_name), name);
    const char *p = at + strspn(at, " \t\r\n");
    if (p < end && number_read(&p, out) == NUMBER_OK && p + strspn(p, " \t\r\n") == end &&
        *out >= 0 && *out < limit && floor(*out) >= *out)
        return true;
    return spoilt(s->wrong, line_of_tag(s), "%s '%s' where a whole number below %.17g is expected",
                  name, shown_value(shown, at, end), limit);
}

static bool read_head(scan *s)
{
    const char *end, *compressor = attribute(s, "compressor", &end);
    bool is_named = compressor != NULL && end > compressor;
    s->v->is_little = !tag_has(&s->tag, "byte_order", 10, "BigEndian");
    s->v->n_word = tag_has(&s->tag, "header_type", 11, "UInt64") ? 8 : 4;
    s->v->is_zipped = tag_has(&s->tag, "compressor", 10, "vtkZLibDataCompressor");
    bool is_lzma = tag_has(&s->tag, "compressor", 10, "vtkLZMADataCompressor");
    char shown[32];
    return !is_named || s->v->is_zipped ||
           spoilt(
               s->wrong, line_of_tag(s),
               "it is compressed by '%s'; libicc reads vtkZLibDataCompressor, and ParaView saves "
               "it (Compressor Type: ZLib)%s",
               shown_value(shown, compressor, end),
               is_lzma ? "; 'python3 -m libicc' takes it as it is" : "");
}

static bool add_piece(scan *s)
{
    double n_points, n_cells;
    vtu *v = s->v;
    if (!count(s, "NumberOfPoints", 4e9, &n_points) || !count(s, "NumberOfCells", 4e9, &n_cells))
        return false;
    v->pieces = grow(v->pieces, &v->room_pieces, v->n_pieces + 1, sizeof *v->pieces);
    v->pieces[v->n_pieces++] = (vtu_piece){(uint32_t)n_points, (uint32_t)n_cells};
    return true;
}

static void read_type(const scan *s, vtu_array *a)
{
    static const struct {
        const char *name;
        char kind;
        size_t width;
    } types[] = {{"Float32", 'f', 4}, {"Float64", 'f', 8}, {"Int8", 'i', 1},  {"Int16", 'i', 2},
                 {"Int32", 'i', 4},   {"Int64", 'i', 8},   {"UInt8", 'u', 1}, {"UInt16", 'u', 2},
                 {"UInt32", 'u', 4},  {"UInt64", 'u', 8}};
    a->kind = '?';
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (tag_has(&s->tag, "type", 4, types[i].name)) {
            a->kind = types[i].kind;
            a->width = types[i].width;
        }
}

static bool add_array(scan *s)
{
    vtu *v = s->v;
    const char *text = v->text, *end, *name = attribute(s, "Name", &end);
    double offset = 0, n_components = 1;
    vtu_array a = {.section = s->section,
                   .piece = v->n_pieces - (v->n_pieces > 0),
                   .tag = (size_t)(s->tag.name - text),
                   .tag_end = (size_t)(s->tag.end + 1 - text),
                   .is_appended = tag_has(&s->tag, "format", 6, "appended"),
                   .is_normal = name != NULL && s->normals != NULL && end > name &&
                                (size_t)(end - name) == s->n_normals &&
                                memcmp(name, s->normals, s->n_normals) == 0};
    a.end = a.tag_end;
    a.is_text = !a.is_appended && !tag_has(&s->tag, "format", 6, "binary");
    read_type(s, &a);
    if ((a.is_appended && !count(s, "offset", (double)v->n_text, &offset)) ||
        (attribute(s, "NumberOfComponents", &end) != NULL &&
         !count(s, "NumberOfComponents", 4e9, &n_components)))
        return false;
    a.offset = (size_t)offset;
    a.n_components = (uint32_t)n_components;
    v->arrays = grow(v->arrays, &v->room_arrays, v->n_arrays + 1, sizeof *v->arrays);
    v->arrays[v->n_arrays++] = a;
    s->in_array = !s->tag.stands_alone;
    return true;
}

/* A section of a piece begins or ends. */
static bool pass_section(scan *s)
{
    static const char *const names[] = {"FieldData", "Points", "Cells", "PointData", "CellData"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!tag_is(&s->tag, names[i]))
            continue;
        if (i > 0 && s->v->n_pieces == 0)
            return spoilt(s->wrong, line_of_tag(s), "the tag '%s' before the first Piece",
                          names[i]);
        const char *end = NULL;
        bool begins = !s->tag.closes && !s->tag.stands_alone;
        s->section = begins ? (vtu_section)i : VTU_OTHER;
        s->normals = begins ? attribute(s, "Normals", &end) : NULL;
        s->n_normals = s->normals != NULL ? (size_t)(end - s->normals) : 0;
    }
    return true;
}

/* The block of all appended arrays begins after an underscore. */
static bool find_data(scan *s)
{
    const char *p = s->tag.end + 1;
    p += strspn(p, " \t\r\n");
    s->v->is_coded = !tag_has(&s->tag, "encoding", 8, "raw");
    s->v->data = (size_t)(p + 1 - s->v->text);
    return *p == '_' ||
           spoilt(s->wrong, line_of_tag(s), "the appended data do not begin with an underscore");
}

static bool take_tag(scan *s)
{
    bool is_array = tag_is(&s->tag, "DataArray") || tag_is(&s->tag, "Array");
    if (s->in_array && s->tag.closes && is_array) {
        s->v->arrays[s->v->n_arrays - 1].end = (size_t)(s->tag.name - 2 - s->v->text);
        s->in_array = false;
        return true;
    }
    if (s->in_array) /* notes about the array */
        return true;
    if (is_array)
        return s->tag.closes || add_array(s);
    if (tag_is(&s->tag, "Piece"))
        return s->tag.closes || add_piece(s);
    return pass_section(s);
}

/* Reads all tags up to the appended data, which may be bytes. */
static bool read_tags(scan *s)
{
    const char *p = s->tag.end + 1;
    for (; tag_next(&s->tag, p); p = s->tag.end + 1) {
        if (!s->in_array && !s->tag.closes && tag_is(&s->tag, "AppendedData"))
            return find_data(s);
        if (s->tag.closes && tag_is(&s->tag, "VTKFile"))
            return true;
        if (!take_tag(s))
            return false;
    }
    return spoilt(s->wrong, 0, "the file ends early");
}

bool vtu_scan(vtu *out, const char *text, size_t n, problem *wrong)
{
    *out = (vtu){.text = text, .n_text = n};
    scan s = {.v = out, .wrong = wrong};
    if (!first_tag(&s.tag, text))
        return spoilt(wrong, 0, "the file ends early");
    if (!read_head(&s) || !read_tags(&s))
        return false;
    return out->n_pieces > 0 || spoilt(wrong, 0, "there is no Piece");
}

void vtu_free(vtu *v)
{
    for (size_t i = 0; i < v->n_arrays; i++)
        free(v->arrays[i].values);
    for (size_t i = 0; i < v->n_arrays; i++)
        free(v->arrays[i].changed);
    free(v->arrays);
    free(v->pieces);
    *v = (vtu){0};
}

const char *vtu_name(const vtu *v, const vtu_array *a, char out[32])
{
    tag t = {.name = v->text + a->tag, .end = v->text + a->tag_end - 1};
    t.n_name = strcspn(t.name, " \t\r\n/>");
    const char *end, *name = tag_attribute(&t, "Name", 4, &end);
    if (name == NULL)
        return a->section == VTU_POINTS ? "Points" : "";
    return shown_value(out, name, end);
}

vtu_array *vtu_find(vtu *v, size_t piece, vtu_section section, const char *name)
{
    for (size_t i = 0; i < v->n_arrays; i++) {
        vtu_array *a = &v->arrays[i];
        tag t = {.name = v->text + a->tag, .end = v->text + a->tag_end - 1};
        t.n_name = strcspn(t.name, " \t\r\n/>");
        if (a->piece == piece && a->section == section &&
            (name == NULL || tag_has(&t, "Name", 4, name)))
            return a;
    }
    return NULL;
}
