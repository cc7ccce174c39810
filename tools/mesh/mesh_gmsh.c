/* Gmsh's .msh, versions 2.2 and 4.1, as text or as bytes in either order
 * (https://gmsh.info/doc/texinfo/gmsh.html#File-formats). Only the sections of nodes and elements
 * are read. Nodes have tags, which need not be consecutive. Everything else is copied. */
#include "mesh/element_kinds.h"
#include "mesh/mesh_lines.h"
#include "mesh/mesh_vectors.h"

#include "base/allocate.h"
#include "base/bytes.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MAKE_MSH "; 'gmsh FILE -save -format msh41 -o OUT.msh' makes one of version 4.1"

/* A kind of element: Gmsh's number, VTK's number, and the place of each of VTK's nodes among
 * Gmsh's, or NULL if they have the same order. */
typedef struct gmsh_kind {
    uint32_t gmsh;
    int kind;
    size_t n_nodes;
    const unsigned char *order;
} gmsh_kind;

static const unsigned char tetrahedron_2[] = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
/* The quadratic hexahedron is the beginning of the triquadratic one, likewise for prisms. */
static const unsigned char hexahedron_2[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                             19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};
static const unsigned char prism_2[] = {0,  1,  2,  3, 4,  5,  6,  9,  7,
                                        12, 14, 13, 8, 10, 11, 15, 17, 16};
static const unsigned char pyramid_2[] = {0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12};

static const gmsh_kind gmsh_kinds[] = {{1, 3, 2, NULL},
                                       {2, ELEMENT_TRIANGLE, 3, NULL},
                                       {3, ELEMENT_QUADRILATERAL, 4, NULL},
                                       {4, ELEMENT_TETRAHEDRON, 4, NULL},
                                       {5, ELEMENT_HEXAHEDRON, 8, NULL},
                                       {6, ELEMENT_WEDGE, 6, NULL},
                                       {7, ELEMENT_PYRAMID, 5, NULL},
                                       {8, 21, 3, NULL},
                                       {9, ELEMENT_TRIANGLE_2, 6, NULL},
                                       {10, ELEMENT_QUADRILATERAL_9, 9, NULL},
                                       {11, ELEMENT_TETRAHEDRON_2, 10, tetrahedron_2},
                                       {12, 29, 27, hexahedron_2},
                                       {13, 32, 18, prism_2},
                                       {14, ELEMENT_LAGRANGE_PYRAMID, 14, NULL},
                                       {15, 1, 1, NULL},
                                       {16, 23, 8, NULL},
                                       {17, 25, 20, hexahedron_2},
                                       {18, 26, 15, prism_2},
                                       {19, 27, 13, pyramid_2}};

typedef struct tag {
    uint32_t tag, vertex;
} tag;

typedef struct gmsh {
    lines *r;
    bool new; /* version 4.1 */
    tag *tags;
    size_t room;
    mesh_vector_list *vectors; /* NULL, or vectors are looked for */
    tag *elements;             /* then: of all elements, sorted when the first vectors come */
    size_t n_elements, room_elements;
    bool sorted;
} gmsh;

/* ------------------------------------------------------------------------- numbers */

/* The next `size` bytes as a whole number. */
static bool take_bytes(lines *r, size_t size, uint64_t *bits)
{
    const mesh_file *m = r->mesh;
    size_t at = (size_t)(r->at - m->text);
    *bits = 0;
    if (m->n_text - at < size)
        return spoilt(r->wrong, 0, "byte %zu: the file ends early", at);
    for (size_t i = 0; i < size; i++) {
        size_t k = m->form == MESH_LITTLE ? size - 1 - i : i;
        *bits = *bits << 8 | (unsigned char)r->at[k];
    }
    r->at += size;
    return true;
}

/* A count or tag below `limit`, of `size` bytes if it is binary. */
static bool take_count(lines *r, size_t size, double limit, uint32_t *count)
{
    uint64_t bits;
    if (r->mesh->form == MESH_TEXT)
        return lines_next_count(r, limit, count);
    if (!take_bytes(r, size, &bits))
        return false;
    *count = (uint32_t)bits;
    return (double)bits < limit ||
           spoilt(r->wrong, 0, "byte %zu: %llu where a whole number below %.17g is expected",
                  (size_t)(r->at - r->mesh->text) - size, (unsigned long long)bits, limit);
}

/* A tag, which may be negative. */
static bool take_tag_number(lines *r, double *value)
{
    uint64_t bits;
    if (r->mesh->form == MESH_TEXT)
        return lines_word(r) && lines_number(r, value);
    if (!take_bytes(r, 4, &bits))
        return false;
    *value = (double)(int32_t)(uint32_t)bits;
    return true;
}

/* Skips numbers that libicc does not use, which may be negative. */
static bool skip_integers(lines *r, size_t n)
{
    for (; n > 0; n--) {
        double value;
        uint64_t bits;
        if (r->mesh->form == MESH_TEXT ? !lines_word(r) || !lines_number(r, &value)
                                       : !take_bytes(r, 4, &bits))
            return false;
    }
    return true;
}

static bool take_vertex(lines *r)
{
    mesh_file *m = r->mesh;
    size_t at = (size_t)(r->at - m->text);
    if (m->form == MESH_TEXT)
        return lines_word(r) && lines_vertex(r);
    mesh_make_room(m);
    for (size_t k = 0; k < 3; k++) {
        uint64_t bits;
        double value;
        if (!take_bytes(r, 8, &bits))
            return false;
        memcpy(&value, &bits, 8);
        if (k < m->dim && !isfinite(value))
            return spoilt(r->wrong, 0, "byte %zu: vertex %zu is not finite", at, m->n_vertices);
        if (k < m->dim)
            m->points[m->dim * m->n_vertices + k] = value;
    }
    m->spans[2 * m->n_vertices] = at;
    m->spans[2 * m->n_vertices + 1] = at + 8 * m->dim;
    m->n_vertices++;
    return true;
}

/* Continues with the line that begins, or ends, after bytes. */
static void go_on(lines *r)
{
    r->end = r->at + strcspn(r->at, "\n");
}

/* ------------------------------------------------------------------------- nodes */

/* Tags come before their vertices: `ahead` is the number of tags without a vertex. */
static bool take_tag(gmsh *g, size_t size, size_t ahead)
{
    size_t i = g->r->mesh->n_vertices + ahead;
    g->tags = grow(g->tags, &g->room, i + 1, sizeof *g->tags);
    g->tags[i].vertex = (uint32_t)i;
    return take_count(g->r, size, 4e9, &g->tags[i].tag);
}

static bool read_block_of_nodes(gmsh *g)
{
    lines *r = g->r;
    uint32_t dim, n, parametric;
    double ignored;
    if (!take_count(r, 4, 4, &dim) || !skip_integers(r, 1) || !take_count(r, 4, 2, &parametric) ||
        !take_count(r, 8, 4e9, &n))
        return false;
    for (uint32_t i = 0; i < n; i++)
        if (!take_tag(g, 8, i))
            return false;
    for (uint32_t i = 0; i < n; i++) {
        if (!take_vertex(r))
            return false;
        if (r->mesh->form == MESH_TEXT && r->mesh->dim == 2 && !lines_number(r, &ignored))
            return false;
        for (uint32_t k = 0; k < parametric * dim; k++)
            if (r->mesh->form == MESH_TEXT ? !lines_number(r, &ignored) : !skip_integers(r, 2))
                return false;
    }
    return true;
}

static int by_tag(const void *a, const void *b)
{
    const tag *p = a, *q = b;
    return (p->tag > q->tag) - (p->tag < q->tag);
}

static bool sort_tags(gmsh *g)
{
    size_t n = g->r->mesh->n_vertices;
    if (n > 0)
        qsort(g->tags, n, sizeof *g->tags, by_tag);
    for (size_t i = 1; i < n; i++)
        if (g->tags[i - 1].tag == g->tags[i].tag)
            return spoilt(g->r->wrong, 0, "two nodes have the tag %u", (unsigned)g->tags[i].tag);
    return true;
}

/* Moves past the number of items of version 2.2, which is text, and its end of line. */
static bool read_number_of_items(lines *r, uint32_t *n)
{
    if (!lines_next_count(r, 4e9, n))
        return false;
    if (r->mesh->form != MESH_TEXT)
        r->at = r->end + (*r->end == '\n');
    return true;
}

static bool read_nodes(gmsh *g)
{
    lines *r = g->r;
    uint32_t n, ignored;
    if (r->mesh->n_vertices > 0)
        return spoilt(r->wrong, r->line, "a second section $Nodes; a mesh has one");
    if (g->new) {
        if (!take_count(r, 8, 4e9, &n))
            return false;
        for (int i = 0; i < 3; i++)
            if (!take_count(r, 8, 4e9, &ignored))
                return false;
        for (; n > 0; n--)
            if (!read_block_of_nodes(g))
                return false;
    } else {
        if (!read_number_of_items(r, &n))
            return false;
        for (; n > 0; n--)
            if (!take_tag(g, 4, 0) || !take_vertex(r))
                return false;
            else if (r->mesh->form == MESH_TEXT)
                r->at = r->end; /* a third coordinate in the plane */
    }
    return sort_tags(g);
}

/* ------------------------------------------------------------------------- elements */

static const gmsh_kind *find_kind(lines *r, uint32_t type)
{
    for (size_t i = 0; i < sizeof gmsh_kinds / sizeof *gmsh_kinds; i++)
        if (gmsh_kinds[i].gmsh == type)
            return &gmsh_kinds[i];
    spoilt(r->wrong, r->mesh->form == MESH_TEXT ? r->line : 0,
           "an element of Gmsh's type %u; libicc reads those of degree 1 and 2 (types 1 to 19)",
           (unsigned)type);
    return NULL;
}

/* The tag of the next element. */
static bool take_element(gmsh *g, size_t size)
{
    tag next = {.vertex = (uint32_t)g->r->mesh->n_elements};
    if (!take_count(g->r, size, 4e9, &next.tag))
        return false;
    if (g->vectors == NULL)
        return true;
    g->elements = grow(g->elements, &g->room_elements, g->n_elements + 1, sizeof *g->elements);
    g->elements[g->n_elements++] = next;
    return true;
}

static bool read_element(gmsh *g, const gmsh_kind *kind)
{
    lines *r = g->r;
    uint32_t nodes[ELEMENT_MOST_NODES], ordered[ELEMENT_MOST_NODES];
    for (size_t i = 0; i < kind->n_nodes; i++) {
        tag key = {0};
        if (!take_count(r, g->new ? 8 : 4, 4e9, &key.tag))
            return false;
        const tag *found = r->mesh->n_vertices == 0 ? NULL
                                                    : bsearch(&key, g->tags, r->mesh->n_vertices,
                                                              sizeof *g->tags, by_tag);
        if (found == NULL)
            return spoilt(r->wrong, r->mesh->form == MESH_TEXT ? r->line : 0,
                          "an element has a node with the tag %u; there is none",
                          (unsigned)key.tag);
        nodes[i] = found->vertex;
    }
    for (size_t i = 0; i < kind->n_nodes; i++)
        ordered[i] = nodes[kind->order != NULL ? kind->order[i] : i];
    return lines_element(r, kind->kind, kind->n_nodes, ordered);
}

/* The tags of an element of version 2.2. The first one is its physical group, or 0, and the second
 * one its entity. */
static bool take_tags(gmsh *g, uint32_t n, double *region)
{
    *region = 0;
    for (uint32_t i = 0; i < n; i++) {
        double number;
        if (!take_tag_number(g->r, &number))
            return false;
        if (i == 0 || (i == 1 && fabs(*region) < 1))
            *region = number;
    }
    return true;
}

/* A block of version 4.1. Its region is the entity. */
static bool read_block_of_elements(gmsh *g)
{
    lines *r = g->r;
    uint32_t dim, type, n;
    double region;
    if (!take_count(r, 4, 4, &dim) || !take_tag_number(r, &region) ||
        !take_count(r, 4, 4e9, &type) || !take_count(r, 8, 4e9, &n))
        return false;
    const gmsh_kind *kind = find_kind(r, type);
    for (; kind != NULL && n > 0; n--) {
        if (!take_element(g, 8) || !read_element(g, kind))
            return false;
        mesh_set_region(r->mesh, r->mesh->n_elements - 1, region);
    }
    return kind != NULL;
}

/* An element of version 2.2 as text, or a block of elements as bytes. *n is reduced by their
 * number. */
static bool read_old_elements(gmsh *g, uint32_t *n)
{
    lines *r = g->r;
    bool text = r->mesh->form == MESH_TEXT;
    uint32_t type, n_block = 1, n_tags;
    if ((text && !take_element(g, 4)) || !take_count(r, 4, 4e9, &type) ||
        (!text && !take_count(r, 4, (double)*n + 1, &n_block)) || !take_count(r, 4, 4e9, &n_tags))
        return false;
    if (n_block == 0)
        return spoilt(r->wrong, 0, "byte %zu: a block without elements",
                      (size_t)(r->at - r->mesh->text));
    const gmsh_kind *kind = find_kind(r, type);
    *n -= n_block;
    for (; kind != NULL && n_block > 0; n_block--) {
        double region;
        if ((!text && !take_element(g, 4)) || !take_tags(g, n_tags, &region) ||
            !read_element(g, kind))
            return false;
        mesh_set_region(r->mesh, r->mesh->n_elements - 1, region);
    }
    return kind != NULL;
}

static bool read_elements(gmsh *g)
{
    lines *r = g->r;
    uint32_t n, ignored;
    if (r->mesh->n_vertices == 0)
        return spoilt(r->wrong, r->line, "the section $Elements comes before $Nodes");
    if (r->mesh->n_elements > 0)
        return spoilt(r->wrong, r->line, "a second section $Elements; a mesh has one");
    if (!g->new) {
        if (!read_number_of_items(r, &n))
            return false;
        while (n > 0)
            if (!read_old_elements(g, &n))
                return false;
        return true;
    }
    if (!take_count(r, 8, 4e9, &n))
        return false;
    for (int i = 0; i < 3; i++)
        if (!take_count(r, 8, 4e9, &ignored))
            return false;
    for (; n > 0; n--)
        if (!read_block_of_elements(g))
            return false;
    return true;
}

/* ------------------------------------------------------------------------- sections */

static bool read_head(gmsh *g)
{
    lines *r = g->r;
    mesh_file *m = r->mesh;
    double version;
    uint32_t binary, size;
    uint64_t one;
    if (!lines_take(r, "$MeshFormat") || !lines_word(r) || !lines_number(r, &version) ||
        !lines_count(r, 2, &binary) || !lines_count(r, 9, &size))
        return spoilt(r->wrong, r->line, "'$MeshFormat', a version, 0 or 1, and 8 are expected");
    g->new = version > 4;
    if (!(version >= 2 && version < 3) && !(version > 4 && version < 4.2))
        return spoilt(r->wrong, r->line, "version %g of Gmsh's format; libicc reads 2.2 and 4.1%s",
                      version, MAKE_MSH);
    if (size != 8)
        return spoilt(r->wrong, r->line, "numbers of %u bytes; libicc reads those of 8%s",
                      (unsigned)size, MAKE_MSH);
    if (binary == 0)
        return strlen(m->text) == m->n_text ||
               spoilt(r->wrong, 0, "this is not a text file, though it says so");
    r->at = r->end + (*r->end == '\n');
    m->form = MESH_LITTLE;
    if (!take_bytes(r, 4, &one))
        return false;
    m->form = one == 1 ? MESH_LITTLE : MESH_BIG;
    go_on(r);
    return one == 1 || one == 1 << 24 ||
           spoilt(r->wrong, 0, "byte %zu: the number 1 is expected, which shows the order of bytes",
                  (size_t)(r->at - m->text) - 4);
}

/* Moves after the end of a section, whose name is `name`. False if there is none. */
static bool pass_end(lines *r, const char *name, size_t n_name)
{
    const char *end = r->mesh->text + r->mesh->n_text;
    for (const char *p = r->at; (p = memchr(p, '$', (size_t)(end - p))) != NULL; p++)
        if ((size_t)(end - p) >= n_name + 4 && memcmp(p, "$End", 4) == 0 &&
            memcmp(p + 4, name, n_name) == 0) {
            for (; r->mesh->form == MESH_TEXT && r->at < p; r->at++)
                r->line += *r->at == '\n';
            r->at = p + 4 + n_name;
            go_on(r);
            return true;
        }
    char shown[32];
    return spoilt(r->wrong, r->line, "the section '%s' has no end", quoted(shown, name));
}

/* ------------------------------------------------------------------------- vectors */

/* The numbers before the data: texts, real and whole numbers, each kind with its number of items. Whole
 * numbers are a step of time, the components of an item, and the number of items. */
static bool read_head_of_data(lines *r, uint32_t *n_components, uint32_t *n_items)
{
    uint32_t n, value, counts[3] = {0};
    if (!lines_next_count(r, 4e9, &n))
        return false;
    for (; n > 0; n--)
        if ((r->at = r->end, !lines_word(r)))
            return false;
    r->at = r->end;
    if (!lines_next_count(r, 4e9, &n))
        return false;
    for (; n > 0; n--)
        if ((r->at = r->end, !lines_word(r)))
            return false;
    r->at = r->end;
    if (!lines_next_count(r, 4e9, &n))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        if (!lines_next_count(r, 4e9, &value))
            return false;
        if (i < 3)
            counts[i] = value;
    }
    *n_components = counts[1];
    *n_items = counts[2];
    if (r->mesh->form != MESH_TEXT)
        r->at = r->end + (*r->end == '\n');
    return true;
}

/* A number that may be infinite or NaN. */
static bool take_value(lines *r, double *value)
{
    uint64_t bits;
    char shown[32];
    if (r->mesh->form != MESH_TEXT) {
        if (!take_bytes(r, 8, &bits))
            return false;
        memcpy(value, &bits, 8);
        return true;
    }
    if (!lines_word(r))
        return false;
    const char *word = r->at;
    number_kind kind = number_read(&r->at, value);
    if (kind == NUMBER_NOT_FINITE)
        *value = (double)NAN;
    return kind != NUMBER_BAD ||
           spoilt(r->wrong, r->line, "'%s' is not a number", quoted(shown, word));
}

/* The vector of a node or of an element with this tag. Others are not in the mesh. */
static bool read_vector(gmsh *g, mesh_vectors *v)
{
    lines *r = g->r;
    tag key = {0};
    double value[3];
    if (!take_count(r, 4, 4e9, &key.tag))
        return false;
    r->at += r->mesh->form == MESH_TEXT ? strspn(r->at, " \t") : 0;
    size_t begin = (size_t)(r->at - r->mesh->text),
           n = v->in_elements ? g->n_elements : r->mesh->n_vertices;
    if (!take_value(r, &value[0]) || !take_value(r, &value[1]) || !take_value(r, &value[2]))
        return false;
    const tag *all = v->in_elements ? g->elements : g->tags;
    const tag *found = n == 0 ? NULL : bsearch(&key, all, n, sizeof *all, by_tag);
    if (found != NULL)
        vectors_add(v, found->vertex, value, begin, (size_t)(r->at - r->mesh->text));
    return true;
}

static bool read_vectors(gmsh *g, bool in_elements)
{
    lines *r = g->r;
    uint32_t n_components, n;
    if (r->mesh->n_vertices == 0 || (in_elements && g->n_elements == 0))
        return spoilt(r->wrong, r->mesh->form == MESH_TEXT ? r->line : 0,
                      "vectors come before their nodes or elements");
    if (!read_head_of_data(r, &n_components, &n))
        return false;
    if (n_components != 3)
        return true;
    if (in_elements && !g->sorted)
        qsort(g->elements, g->n_elements, sizeof *g->elements, by_tag);
    g->sorted = g->sorted || in_elements;
    mesh_vectors *v = vectors_begin(g->vectors, in_elements);
    v->width = 8;
    for (; n > 0; n--)
        if (!read_vector(g, v))
            return false;
    go_on(r);
    return true;
}

static bool read_section(gmsh *g)
{
    lines *r = g->r;
    char shown[32];
    if (*r->at != '$')
        return spoilt(r->wrong, r->line, "'%s' where a section ($..) is expected",
                      quoted(shown, r->at));
    const char *name = r->at + 1;
    size_t n_name = strcspn(name, " \t\r\n");
    bool nodes = lines_take(r, "$Nodes"), elements = !nodes && lines_take(r, "$Elements");
    if (r->mesh->form != MESH_TEXT && g->new && (nodes || elements))
        r->at = r->end + (*r->end == '\n');
    if ((nodes && !read_nodes(g)) || (elements && !read_elements(g)))
        return false;
    bool at_nodes = g->vectors != NULL && lines_take(r, "$NodeData");
    if ((at_nodes || (g->vectors != NULL && lines_take(r, "$ElementData"))) &&
        !read_vectors(g, !at_nodes))
        return false;
    if (nodes || elements)
        go_on(r);
    return pass_end(r, name, n_name);
}

/* True if there is another section. */
static bool find_section(lines *r)
{
    for (;;) {
        r->at += strspn(r->at, " \t\r");
        if (r->at < r->end)
            return true;
        if (!lines_next(r))
            return false;
    }
}

static bool read_sections(gmsh *g)
{
    bool good = read_head(g) && pass_end(g->r, "MeshFormat", strlen("MeshFormat"));
    while (good && find_section(g->r))
        good = read_section(g);
    free(g->tags);
    free(g->elements);
    return good;
}

bool mesh_read_gmsh(lines *r)
{
    gmsh g = {.r = r};
    return read_sections(&g);
}

/* Reads the file once more, because the tags have not been kept. */
bool gmsh_find_vectors(const mesh_file *m, mesh_vector_list *out, problem *wrong)
{
    mesh_file again = {
        .text = m->text, .n_text = m->n_text, .dim = m->dim, .n_spans = 1, .order = {0, 1, 2}};
    lines r = {.mesh = &again, .at = m->text, .line = 1, .wrong = wrong};
    gmsh g = {.r = &r, .vectors = out};
    lines_format(&r, m->n_text);
    bool good = read_sections(&g);
    mesh_free(&again);
    return good;
}
