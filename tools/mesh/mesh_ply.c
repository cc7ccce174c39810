/* PLY, as text or binary: G. Turk, The PLY Polygon File Format, 1994. Reads x, y and z of the
 * vertices, nx, ny and nz if they are floating-point numbers, and the list vertex_indices of the
 * faces. Everything else is copied. */
#include "mesh/mesh_lines.h"

#include "base/allocate.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct ply_type {
    const char *names[2];
    size_t size;
    char kind; /* i: signed, u: unsigned, f: floating point */
} ply_type;

static const ply_type types[] = {{{"char", "int8"}, 1, 'i'},     {{"uchar", "uint8"}, 1, 'u'},
                                 {{"short", "int16"}, 2, 'i'},   {{"ushort", "uint16"}, 2, 'u'},
                                 {{"int", "int32"}, 4, 'i'},     {{"uint", "uint32"}, 4, 'u'},
                                 {{"float", "float32"}, 4, 'f'}, {{"double", "float64"}, 8, 'f'}};

/* How a property is used here. */
typedef enum ply_use { PLY_X, PLY_Y, PLY_Z, PLY_NX, PLY_NY, PLY_NZ, PLY_CORNERS, PLY_SKIP } ply_use;

typedef struct property {
    const ply_type *type, *count; /* count: the type of a list's length, else NULL */
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
    lines *r; /* its line number is right in text only; `end` is the end of the file */
    const char *end;
    const char *word;    /* of text: the beginning of the last number */
    bool used[PLY_SKIP]; /* which properties have been declared */
    size_t n_vertices;   /* as the header announces */
    size_t n_elements;
    element elements[MAX_ELEMENTS];
} ply;

/* ------------------------------------------------------------------ header */

/* The next word of this line, at most 31 characters of it. Empty at the line's end. */
static const char *next_word(ply *p, char out[32])
{
    size_t n = 0;
    lines *r = p->r;
    while (r->at < p->end && (*r->at == ' ' || *r->at == '\t' || *r->at == '\r'))
        r->at++;
    while (r->at < p->end && strchr(" \t\r\n", *r->at) == NULL) {
        if (n < 31)
            out[n++] = *r->at > 32 && *r->at < 127 ? *r->at : '?';
        r->at++;
    }
    out[n] = '\0';
    return out;
}

static bool next_line(ply *p)
{
    const char *stop = memchr(p->r->at, '\n', (size_t)(p->end - p->r->at));
    if (stop == NULL)
        return spoilt(p->r->wrong, p->r->line, "the file ends early");
    p->r->at = stop + 1;
    p->r->line++;
    return true;
}

static bool read_form(ply *p)
{
    static const char *const forms[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    char word[32];
    next_word(p, word);
    for (int i = 0; i < 3; i++)
        if (strcmp(word, forms[i]) == 0) {
            p->r->mesh->form = (mesh_form)i;
            return true;
        }
    return spoilt(p->r->wrong, p->r->line, "'%s' is not a form of PLY", word);
}

static const ply_type *find_type(ply *p)
{
    char word[32];
    next_word(p, word);
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(word, types[i].names[0]) == 0 || strcmp(word, types[i].names[1]) == 0)
            return &types[i];
    spoilt(p->r->wrong, p->r->line, "'%s' is not a type of PLY", word);
    return NULL;
}

static ply_use find_use(const char *of, const char *name, bool list)
{
    if (strcmp(of, "face") == 0 && list && strncmp(name, "vertex_ind", 10) == 0)
        return PLY_CORNERS;
    if (strcmp(of, "vertex") == 0 && !list && strlen(name) == 1 && *name >= 'x' && *name <= 'z')
        return (ply_use)(*name - 'x');
    if (strcmp(of, "vertex") == 0 && !list && strlen(name) == 2 && *name == 'n' && name[1] >= 'x' &&
        name[1] <= 'z')
        return (ply_use)(PLY_NX + (name[1] - 'x'));
    return PLY_SKIP;
}

static bool is_normal(ply_use use)
{
    return use >= PLY_NX && use <= PLY_NZ;
}

/* A coordinate becomes a double, so that rounding does not fold what the map keeps one-to-one. */
static void take_coordinate(ply *p, ply_use use, const char *type_end, const ply_type *type)
{
    mesh_file *m = p->r->mesh;
    size_t n_word = strlen(type->names[0]);
    const char *begin = type_end - n_word;
    if (strncmp(begin, type->names[0], n_word) != 0)
        begin = type_end - strlen(type->names[1]);
    m->types[m->n_types][0] = (size_t)(begin - m->text);
    m->types[m->n_types][1] = (size_t)(type_end - m->text);
    m->order[m->n_types++] = (unsigned char)use;
}

/* Reads a property of the last element. Properties that are not used are copied, but their size
 * must be known to skip them. A coordinate that is declared twice would be ambiguous. */
static bool read_property(ply *p)
{
    char word[32];
    const char *mark = p->r->at;
    bool list = strcmp(next_word(p, word), "list") == 0;
    if (p->n_elements == 0)
        return spoilt(p->r->wrong, p->r->line, "a property of no element");
    element *e = &p->elements[p->n_elements - 1];
    if (e->n_properties == MAX_PROPERTIES)
        return spoilt(p->r->wrong, p->r->line, "more than %d properties", MAX_PROPERTIES);
    if (!list)
        p->r->at = mark;
    property *q = &e->properties[e->n_properties++];
    q->count = list ? find_type(p) : NULL;
    if (list && q->count == NULL)
        return false;
    q->type = find_type(p);
    const char *type_end = p->r->at;
    q->use = find_use(e->name, next_word(p, word), list);
    if (q->type != NULL && is_normal(q->use) && (q->type->kind != 'f' || p->used[q->use]))
        q->use = PLY_SKIP;
    if (q->type == NULL || q->use == PLY_SKIP)
        return q->type != NULL;
    if (p->used[q->use])
        return spoilt(p->r->wrong, p->r->line, "the property %s is declared twice", word);
    p->used[q->use] = true;
    if ((size_t)q->use < p->r->mesh->dim)
        take_coordinate(p, q->use, type_end, q->type);
    return true;
}

static bool read_element(ply *p)
{
    char word[32];
    double n;
    if (p->n_elements == MAX_ELEMENTS)
        return spoilt(p->r->wrong, p->r->line, "more than %d elements", MAX_ELEMENTS);
    element *e = &p->elements[p->n_elements++];
    next_word(p, e->name);
    if (number_parse(next_word(p, word), &n) != NUMBER_OK || !(n >= 0 && n < 4e9) || floor(n) != n)
        return spoilt(p->r->wrong, p->r->line, "'%s' is not a number of items", word);
    e->n = (size_t)n;
    for (const element *other = p->elements; other < e; other++)
        if (strcmp(other->name, e->name) == 0)
            return spoilt(p->r->wrong, p->r->line, "the element %s is declared twice", e->name);
    if (strcmp(e->name, "vertex") == 0)
        p->n_vertices = e->n;
    return true;
}

/* Normals stay as they are unless they have three numbers of one type. */
static void check_normals(ply *p)
{
    mesh_normals *of = &p->r->mesh->vertex_normals;
    property *normals[3];
    bool same = true;
    for (size_t i = 0; i < p->n_elements; i++)
        for (size_t k = 0; k < p->elements[i].n_properties; k++) {
            property *q = &p->elements[i].properties[k];
            if (!is_normal(q->use))
                continue;
            of->order[of->n_spans] = (unsigned char)(q->use - PLY_NX);
            of->width = q->type->size;
            normals[of->n_spans++] = q;
            same = same && q->type->size == normals[0]->type->size;
        }
    if (of->n_spans == 3 && same)
        return;
    for (size_t k = 0; k < of->n_spans; k++)
        normals[k]->use = PLY_SKIP;
    *of = (mesh_normals){.n = 0};
}

/* At end_header: true if everything that a mesh needs has been declared. */
static bool end_header(ply *p, bool formed)
{
    static const char *const names[] = {"x", "y", "z"};
    if (!formed)
        return spoilt(p->r->wrong, p->r->line, "the header does not name a format");
    for (size_t k = 0; k < p->r->mesh->dim; k++)
        if (!p->used[k])
            return spoilt(p->r->wrong, p->r->line, "the vertices have no property %s", names[k]);
    check_normals(p);
    return next_line(p);
}

/* Reads lines up to end_header. Elements and properties may come in any order that PLY allows.
 * Comments are skipped. */
static bool read_header(ply *p)
{
    char word[32];
    bool formed = false;
    while (next_line(p)) {
        next_word(p, word);
        if (strcmp(word, "end_header") == 0)
            return end_header(p, formed);
        bool good = true;
        if (strcmp(word, "format") == 0 && formed)
            good = spoilt(p->r->wrong, p->r->line, "the format is named twice");
        else if (strcmp(word, "format") == 0)
            formed = good = read_form(p);
        else if (strcmp(word, "element") == 0)
            good = read_element(p);
        else if (strcmp(word, "property") == 0)
            good = read_property(p);
        else if (*word != '\0' && strcmp(word, "comment") != 0 && strcmp(word, "obj_info") != 0)
            good = spoilt(p->r->wrong, p->r->line, "'%s' does not belong in the header", word);
        if (!good)
            return false;
    }
    return false;
}

/* -------------------------------------------------------------------- data */

static bool read_text_value(ply *p, double *value)
{
    char shown[32];
    while (p->r->at < p->end && strchr(" \t\r\n", *p->r->at) != NULL)
        p->r->line += *p->r->at++ == '\n';
    const char *word = p->word = p->r->at;
    if (p->r->at < p->end && number_read(&p->r->at, value) != NUMBER_BAD &&
        (p->r->at == p->end || strchr(" \t\r\n", *p->r->at) != NULL))
        return true;
    return p->r->at == p->end
               ? spoilt(p->r->wrong, p->r->line, "the file ends early")
               : spoilt(p->r->wrong, p->r->line, "'%s' is not a number", quoted(shown, word));
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
    if (p->r->mesh->form == MESH_TEXT)
        return read_text_value(p, value);
    if ((size_t)(p->end - p->r->at) < type->size)
        return spoilt(p->r->wrong, 0, "the file ends early");
    uint64_t bits = 0;
    for (size_t i = 0; i < type->size; i++) {
        size_t k = p->r->mesh->form == MESH_BIG ? i : type->size - 1 - i;
        bits = bits << 8 | (unsigned char)p->r->at[k];
    }
    p->r->at += type->size;
    *value = to_double(bits, type);
    return true;
}

static bool read_corner(ply *p, const ply_type *type)
{
    double index;
    if (!read_value(p, type, &index))
        return false;
    if (!(index >= 0 && index < (double)p->n_vertices && floor(index) == index))
        return spoilt(p->r->wrong, p->r->line, "the face has the vertex %.17g; there are %zu",
                      index, p->n_vertices);
    lines_corner(p->r, (uint32_t)index);
    return true;
}

static bool read_list(ply *p, const property *q)
{
    double n, unused;
    if (!read_value(p, q->count, &n))
        return false;
    bool face = q->use == PLY_CORNERS;
    if (!(n >= (face ? 3 : 0) && n < 1e6 && floor(n) == n))
        return spoilt(p->r->wrong, p->r->line,
                      face ? "the face has %.17g corners" : "a list of %.17g items", n);
    if (face)
        lines_begin_face(p->r);
    for (size_t k = 0; k < (size_t)n; k++)
        if (!(face ? read_corner(p, q->type) : read_value(p, q->type, &unused)))
            return false;
    return true;
}

/* Reads a coordinate and keeps its place. `k` counts the coordinates of the vertex read before. */
static bool read_coordinate(ply *p, const property *q, size_t k)
{
    mesh_file *m = p->r->mesh;
    size_t i = m->n_vertices;
    double *value = m->points + m->dim * i + q->use;
    if (!read_value(p, q->type, value))
        return false;
    size_t end = (size_t)(p->r->at - m->text), *span = m->spans + 2 * (m->dim * i + k);
    span[0] = m->form == MESH_TEXT ? (size_t)(p->word - m->text) : end - q->type->size;
    span[1] = end;
    return isfinite(*value) || spoilt(p->r->wrong, p->r->line, "vertex %zu is not finite", i);
}

/* Reads number `k` of a normal and keeps its place. */
static bool read_normal(ply *p, const property *q, size_t k)
{
    mesh_file *m = p->r->mesh;
    mesh_normals *of = &m->vertex_normals;
    if (k == 0) {
        of->values = grow(of->values, &of->room_values, 3 * (of->n + 1), sizeof *of->values);
        of->spans = grow(of->spans, &of->room_spans, 6 * (of->n + 1), sizeof *of->spans);
        of->uses = grow(of->uses, &of->room_uses, 2 * (of->n + 1), sizeof *of->uses);
        of->uses[2 * of->n] = of->uses[2 * of->n + 1] = (uint32_t)m->n_vertices;
        of->n_uses = ++of->n;
    }
    if (!read_value(p, q->type, of->values + 3 * (of->n - 1) + (q->use - PLY_NX)))
        return false;
    size_t end = (size_t)(p->r->at - m->text), *span = of->spans + 2 * (3 * (of->n - 1) + k);
    span[0] = m->form == MESH_TEXT ? (size_t)(p->word - m->text) : end - q->type->size;
    span[1] = end;
    return true;
}

static bool read_item(ply *p, const element *e)
{
    mesh_file *m = p->r->mesh;
    bool vertex = strcmp(e->name, "vertex") == 0;
    size_t n_read = 0, n_normal = 0;
    if (vertex)
        mesh_make_room(m);
    for (size_t k = 0; k < e->n_properties; k++) {
        const property *q = &e->properties[k];
        double value;
        bool taken = (size_t)q->use < m->dim;
        if (!(q->count != NULL    ? read_list(p, q)
              : taken             ? read_coordinate(p, q, n_read++)
              : is_normal(q->use) ? read_normal(p, q, n_normal++)
                                  : read_value(p, q->type, &value)))
            return false;
    }
    m->n_vertices += vertex;
    return true;
}

/* Nothing but blanks may follow the last element. */
static bool is_at_end(ply *p)
{
    while (p->r->at < p->end && strchr(" \t\r\n", *p->r->at) != NULL)
        p->r->at++;
    return p->r->at == p->end ||
           spoilt(p->r->wrong, p->r->line, "there is more after the last element");
}

bool mesh_read_ply(lines *r)
{
    ply *p = need(1, sizeof *p);
    *p = (ply){.r = r, .end = r->mesh->text + r->mesh->n_text};
    bool good = read_header(p);
    r->mesh->n_spans = r->mesh->dim;
    r->line = r->mesh->form == MESH_TEXT ? r->line : 0;
    for (size_t k = 0; good && k < p->n_elements; k++)
        for (size_t i = 0; good && i < p->elements[k].n && p->elements[k].n_properties > 0; i++)
            good = read_item(p, &p->elements[k]);
    good = good && is_at_end(p);
    free(p);
    return good;
}
