/* PLY surfaces, as text or binary: G. Turk, The PLY Polygon File Format, 1994. Of the vertices x, y
 * and z are taken, of the faces the list vertex_indices; all else is skipped. */
#include "cage/cage_readers.h"
#include "base/allocate.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef enum ply_form { PLY_TEXT, PLY_LITTLE, PLY_BIG } ply_form;

typedef struct ply_type {
    const char *names[2];
    size_t size;
    char kind; /* i: signed, u: unsigned, f: floating point */
} ply_type;

static const ply_type types[] = {{{"char", "int8"}, 1, 'i'},     {{"uchar", "uint8"}, 1, 'u'},
                                 {{"short", "int16"}, 2, 'i'},   {{"ushort", "uint16"}, 2, 'u'},
                                 {{"int", "int32"}, 4, 'i'},     {{"uint", "uint32"}, 4, 'u'},
                                 {{"float", "float32"}, 4, 'f'}, {{"double", "float64"}, 8, 'f'}};

/* What a property is to us. */
typedef enum ply_use { PLY_SKIP = -1, PLY_X, PLY_Y, PLY_Z, PLY_CORNERS } ply_use;

typedef struct property {
    const ply_type *type, *count; /* count: of a list, else NULL */
    ply_use use;
} property;

enum { MAX_PROPERTIES = 64, MAX_ELEMENTS = 16 };

typedef struct element {
    char name[32];
    size_t n; /* items */
    size_t n_properties;
    property properties[MAX_PROPERTIES];
} element;

typedef struct ply {
    cage *out;
    const char *at, *end;
    size_t line; /* 0 in binary data */
    problem *wrong;
    ply_form form;
    size_t n_vertices; /* that the header announces */
    size_t n_elements;
    element elements[MAX_ELEMENTS];
} ply;

/* ------------------------------------------------------------------ header */

/* The next word of this line, at most 31 characters of it; empty at the line's end. */
static const char *next_word(ply *p, char out[32])
{
    size_t n = 0;
    while (p->at < p->end && (*p->at == ' ' || *p->at == '\t' || *p->at == '\r'))
        p->at++;
    while (p->at < p->end && strchr(" \t\r\n", *p->at) == NULL) {
        if (n < 31)
            out[n++] = *p->at > 32 && *p->at < 127 ? *p->at : '?';
        p->at++;
    }
    out[n] = '\0';
    return out;
}

static bool next_line(ply *p)
{
    const char *stop = memchr(p->at, '\n', (size_t)(p->end - p->at));
    if (stop == NULL)
        return spoilt(p->wrong, p->line, "the file ends early");
    p->at = stop + 1;
    p->line++;
    return true;
}

static bool read_form(ply *p)
{
    static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char word[32];
    next_word(p, word);
    for (int i = 0; i < 3; i++)
        if (strcmp(word, forms[i]) == 0) {
            p->form = (ply_form)i;
            return true;
        }
    return spoilt(p->wrong, p->line, "'%s' is not a form of PLY", word);
}

static const ply_type *find_type(ply *p)
{
    char word[32];
    next_word(p, word);
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(word, types[i].names[0]) == 0 || strcmp(word, types[i].names[1]) == 0)
            return &types[i];
    spoilt(p->wrong, p->line, "'%s' is not a type of PLY", word);
    return NULL;
}

static ply_use find_use(const char *of, const char *name, bool list)
{
    if (strcmp(of, "face") == 0 && list && strncmp(name, "vertex_ind", 10) == 0)
        return PLY_CORNERS;
    if (strcmp(of, "vertex") == 0 && !list && strlen(name) == 1 && *name >= 'x' && *name <= 'z')
        return (ply_use)(*name - 'x');
    return PLY_SKIP;
}

static bool read_property(ply *p)
{
    char word[32];
    const char *mark = p->at;
    bool list = strcmp(next_word(p, word), "list") == 0;
    if (p->n_elements == 0)
        return spoilt(p->wrong, p->line, "a property of no element");
    element *e = &p->elements[p->n_elements - 1];
    if (e->n_properties == MAX_PROPERTIES)
        return spoilt(p->wrong, p->line, "more than %d properties", MAX_PROPERTIES);
    if (!list)
        p->at = mark;
    property *q = &e->properties[e->n_properties++];
    q->count = list ? find_type(p) : NULL;
    if (list && q->count == NULL)
        return false;
    q->type = find_type(p);
    q->use = find_use(e->name, next_word(p, word), list);
    return q->type != NULL;
}

static bool read_element(ply *p)
{
    char word[32];
    double n;
    if (p->n_elements == MAX_ELEMENTS)
        return spoilt(p->wrong, p->line, "more than %d elements", MAX_ELEMENTS);
    element *e = &p->elements[p->n_elements++];
    next_word(p, e->name);
    if (number_parse(next_word(p, word), &n) != NUMBER_OK || !(n >= 0 && n < 4e9) || floor(n) != n)
        return spoilt(p->wrong, p->line, "'%s' is not a number of items", word);
    e->n = (size_t)n;
    if (strcmp(e->name, "vertex") == 0)
        p->n_vertices = e->n;
    return true;
}

/* Up to and with end_header. */
static bool read_header(ply *p)
{
    char word[32];
    bool formed = false;
    while (next_line(p)) {
        next_word(p, word);
        if (strcmp(word, "end_header") == 0)
            return formed ? next_line(p) : spoilt(p->wrong, p->line, "the header names no format");
        bool good = true;
        if (strcmp(word, "format") == 0)
            formed = good = read_form(p);
        else if (strcmp(word, "element") == 0)
            good = read_element(p);
        else if (strcmp(word, "property") == 0)
            good = read_property(p);
        else if (*word != '\0' && strcmp(word, "comment") != 0 && strcmp(word, "obj_info") != 0)
            good = spoilt(p->wrong, p->line, "'%s' does not belong in the header", word);
        if (!good)
            return false;
    }
    return false;
}

/* -------------------------------------------------------------------- data */

static bool read_text_value(ply *p, double *value)
{
    char shown[32];
    while (p->at < p->end && strchr(" \t\r\n", *p->at) != NULL)
        p->line += *p->at++ == '\n';
    const char *word = p->at;
    if (p->at < p->end && number_read(&p->at, value) != NUMBER_BAD &&
        (p->at == p->end || strchr(" \t\r\n", *p->at) != NULL))
        return true;
    return p->at == p->end ? spoilt(p->wrong, p->line, "the file ends early")
                           : spoilt(p->wrong, p->line, "'%s' is not a number", quoted(shown, word));
}

static double to_double(uint64_t bits, const ply_type *type)
{
    if (type->kind == 'f' && type->size == 4) {
        uint32_t half = (uint32_t)bits;
        float value;
        memcpy(&value, &half, 4);
        return (double)value;
    }
    if (type->kind == 'f') {
        double value;
        memcpy(&value, &bits, 8);
        return value;
    }
    double value = (double)bits, whole = ldexp(1, 8 * (int)type->size);
    return type->kind == 'i' && value >= whole / 2 ? value - whole : value;
}

static bool read_value(ply *p, const ply_type *type, double *value)
{
    if (p->form == PLY_TEXT)
        return read_text_value(p, value);
    if ((size_t)(p->end - p->at) < type->size)
        return spoilt(p->wrong, 0, "the file ends early");
    uint64_t bits = 0;
    for (size_t i = 0; i < type->size; i++) {
        size_t k = p->form == PLY_BIG ? i : type->size - 1 - i;
        bits = bits << 8 | (unsigned char)p->at[k];
    }
    p->at += type->size;
    *value = to_double(bits, type);
    return true;
}

static bool read_corner(ply *p, const ply_type *type, size_t k)
{
    double index;
    if (!read_value(p, type, &index))
        return false;
    if (!(index >= 0 && index < (double)p->n_vertices && floor(index) == index))
        return spoilt(p->wrong, p->line, "the face has the vertex %.17g; there are %zu", index,
                      p->n_vertices);
    cage_add_corner(p->out, k, (uint32_t)index, p->line);
    return true;
}

static bool read_list(ply *p, const property *q)
{
    double n, unused;
    if (!read_value(p, q->count, &n))
        return false;
    bool face = q->use == PLY_CORNERS;
    if (!(n >= (face ? 3 : 0) && n < 1e6 && floor(n) == n))
        return spoilt(p->wrong, p->line,
                      face ? "the face has %.17g corners" : "a list of %.17g items", n);
    for (size_t k = 0; k < (size_t)n; k++)
        if (!(face ? read_corner(p, q->type, k) : read_value(p, q->type, &unused)))
            return false;
    return true;
}

static bool read_item(ply *p, const element *e)
{
    double at[3] = {0, 0, 0}, value;
    for (size_t k = 0; k < e->n_properties; k++) {
        const property *q = &e->properties[k];
        if (!(q->count != NULL ? read_list(p, q) : read_value(p, q->type, &value)))
            return false;
        if (q->count == NULL && q->use != PLY_SKIP)
            at[q->use] = value;
    }
    if (strcmp(e->name, "vertex") != 0)
        return true;
    if (!(isfinite(at[0]) && isfinite(at[1]) && isfinite(at[2])))
        return spoilt(p->wrong, p->line, "vertex %zu is not finite", p->out->n);
    cage_add_point(p->out, at, p->line);
    return true;
}

bool cage_read_ply(cage *out, const char *text, size_t n, problem *wrong)
{
    ply *p = need(1, sizeof *p);
    *p = (ply){.out = out, .at = text, .end = text + n, .line = 1, .wrong = wrong};
    bool good = read_header(p);
    p->line = p->form == PLY_TEXT ? p->line : 0;
    for (size_t k = 0; good && k < p->n_elements; k++)
        for (size_t i = 0; good && i < p->elements[k].n && p->elements[k].n_properties > 0; i++)
            good = read_item(p, &p->elements[k]);
    free(p);
    return good;
}
