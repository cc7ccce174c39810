/* Chooses the reader by how a file begins. */
#include "cage/cage_read.h"

#include "base/foreign.h"
#include "base/npy.h"
#include "cage/cage_features.h"
#include "cage/cage_readers.h"
#include "mesh/mesh_file.h"
#include "picture/picture_file.h"

#include <string.h>

static bool begins_with(const char *text, const char *word)
{
    for (; *word != '\0'; text++, word++)
        if ((*text >= 'a' && *text <= 'z' ? *text - 32 : *text) != *word)
            return false;
    return true;
}

static bool is_wkt(const char *text)
{
    static const char *const words[] = {"SRID=", "POLYGON", "MULTIPOLYGON",       "POINT",
                                        "LINES", "MULTILI", "GEOMETRYCOLLECTION", "CURVEPOLYGON"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (begins_with(text, words[i]))
            return i == 0 ||
                   /* else a heading such as POINT_X,.. */
                   strcspn(text, ",;") >= strcspn(text, "(");
    return false;
}

/* OBJ has no mark at its beginning, but its lines begin with words. */
static bool is_obj(const char *text)
{
    static const char *const words[] = {"v", "vt", "vn", "vp", "f",      "o",
                                        "g", "s",  "l",  "p",  "mtllib", "usemtl"};
    size_t n = strcspn(text, " \t\r\n");
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == n && strncmp(text, words[i], n) == 0)
            return true;
    return false;
}

static const char *skip_comments(const char *text)
{
    while (*text == '#') {
        text += strcspn(text, "\n");
        text += strspn(text, " \t\r\n");
    }
    return text;
}

/* After a UTF-8 byte order mark and white space. */
static const char *first_word(const char *text, size_t n)
{
    const char *p = text;
    if (n >= 3 && memcmp(p, "\xef\xbb\xbf", 3) == 0)
        p += 3;
    return p + strspn(p, " \t\r\n");
}

static bool is_json(const char *p)
{
    return *p == '{' || *p == '[' || *p == '\x1e';
}

/* The first bytes decide the format of a cage, not the file's name, because standard input has
 * none. Known formats that cannot be read are tested first. Plain coordinates can begin with
 * anything, so they are tested last. */
static bool read_any(cage *out, const cage_choice *choice, size_t dim, const char *text, size_t n,
                     problem *wrong)
{
    const char *p = first_word(text, n);
    out->dim = 2;
    if (picture_told(text, n) == PICTURE_PNG)
        return cage_read_picture(out, choice, text, n, wrong);
    if (foreign_told(text, n, wrong))
        return false;
    bool is_mesh = mesh_told(text, n);
    if (choice->named != NULL && (is_mesh || (!is_json(p) && *p != '<'))) {
        char shown[64];
        return spoilt(wrong, 0, "only GeoJSON and SVG have names of shapes; %s was asked for",
                      choice_text(shown, choice->named));
    }
    out->dim = 3;
    if (is_mesh || is_obj(skip_comments(p)))
        return cage_read_surface(out, choice, dim, text, n, wrong);
    if (npy_told(text, n))
        return cage_read_npy(out, text, n, wrong);
    out->dim = 2;
    if (is_json(p))
        return cage_read_geojson(out, choice, text, n, wrong);
    if (*p == '<')
        return cage_read_svg(out, choice, text, n, wrong);
    if (is_wkt(p))
        return cage_read_wkt(out, text, n, wrong);
    out->dim = dim;
    return cage_read_text(out, dim, choice->may_slide, text, n, wrong);
}

bool cage_read(cage *out, const cage_choice *choice, size_t dim, const char *text, size_t n,
               problem *wrong)
{
    *out = (cage){0};
    bool good = read_any(out, choice, dim, text, n, wrong);
    size_t least = out->dim + 1;
    good = good && cage_sort_features(out, wrong);
    bool covered = false;
    for (size_t i = 0; good && out->n == 0 && i < out->n_features; i++) {
        const cage_feature *f = &out->features[i];
        feature_text name;
        covered = covered || f->kind == ICC_FEATURE_REGION;
        if (feature_is_ring(f) && f->n < least)
            good = spoilt(wrong, 0, "%s has %zu %s; it has at least %zu", feature_name(name, f),
                          f->n, f->n == 1 ? "vertex" : "vertices", least);
    }
    if (good && out->cells == NULL && out->n < least && !covered)
        good = spoilt(wrong, 0, "%zu %s; a cage has at least %zu", out->n,
                      out->n == 1 ? "vertex" : "vertices", least);
    if (!good)
        cage_free(out);
    return good;
}

bool cage_is_named(cage_role role, const char *text, size_t n)
{
    const char *p = first_word(text, n);
    return is_json(p) ? cage_geojson_has(role, text, n) : *p == '<' && cage_svg_has(role, text);
}
