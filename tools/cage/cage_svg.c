/* Cages as SVG: the outline of a <path> or a <polygon>.
 *
 * Coordinates are taken as they are written, y downwards as in every picture. An element with the
 * id, or the inkscape:label, "source" or "target" is chosen by the role of the cage; else the file
 * must have one shape only. A transform on the shape or around it is refused, since reading on
 * would misplace the cage. */
#include "cage/cage_readers.h"

#include "base/number.h"
#include "cage/cage_features.h"

#include <string.h>

static const char blanks[] = " \t\r\n";

/* A tag between '<' and '>': its name, and its attributes behind it. */
typedef struct tag {
    const char *name, *end;
    size_t n_name;
    bool closes, stands_alone;
} tag;

typedef struct shape {
    tag tag;
    size_t n_all, n_chosen;
    bool transformed;
} shape;

static bool is_named(const tag *t, const char *name)
{
    return t->n_name == strlen(name) && strncmp(t->name, name, t->n_name) == 0;
}

/* The '>' that ends a tag, minding quotes; NULL if there is none. */
static const char *tag_end(const char *p)
{
    char quote = '\0';
    for (; *p != '\0'; p++) {
        if (quote != '\0')
            quote = *p == quote ? '\0' : quote;
        else if (*p == '"' || *p == '\'')
            quote = *p;
        else if (*p == '>')
            return p;
    }
    return NULL;
}

/* The next tag at or behind p, comments and declarations left out; false at the end of the file. */
static bool next_tag(const char *p, tag *out)
{
    while ((p = strchr(p, '<')) != NULL) {
        if (strncmp(p, "<!--", 4) == 0) {
            p = strstr(p + 4, "-->");
            if (p == NULL)
                return false;
            continue;
        }
        const char *end = tag_end(p);
        if (end == NULL)
            return false;
        if (p[1] == '!' || p[1] == '?') {
            p = end;
            continue;
        }
        out->closes = p[1] == '/';
        out->stands_alone = end[-1] == '/';
        out->name = p + 1 + out->closes;
        out->n_name = strcspn(out->name, " \t\r\n/>");
        out->end = end;
        return true;
    }
    return false;
}

/* The value of an attribute: from the result up to *end; NULL if the tag does not have it. */
static const char *attribute(const tag *t, const char *name, const char **end)
{
    const char *p = t->name + t->n_name;
    size_t n = strlen(name);
    while (p < t->end) {
        p += strspn(p, blanks);
        const char *key = p;
        p += strcspn(p, "= \t\r\n/>\"'");
        size_t n_key = (size_t)(p - key);
        p += strspn(p, blanks);
        if (*p != '=') {
            p += p < t->end && (p == key || *p == '/');
            continue;
        }
        p++;
        p += strspn(p, blanks);
        if (*p != '"' && *p != '\'')
            continue;
        const char *value = p + 1;
        *end = strchr(value, *p);
        if (*end == NULL || *end > t->end)
            return NULL;
        if (n_key == n && strncmp(key, name, n) == 0)
            return value;
        p = *end + 1;
    }
    return NULL;
}

static bool is_attribute(const tag *t, const char *name, const char *wanted)
{
    const char *end, *value = attribute(t, name, &end);
    return value != NULL && (size_t)(end - value) == strlen(wanted) &&
           strncmp(value, wanted, strlen(wanted)) == 0;
}

/* By its id, or by what Inkscape's panel of objects shows. */
static bool is_called(const tag *t, const char *name)
{
    return is_attribute(t, "id", name) || is_attribute(t, "inkscape:label", name);
}

/* Finds the shape to read. Tags nest; `outer` is the depth of the outermost open transform. */
static shape find_shape(const char *text, cage_role role)
{
    shape found = {0};
    size_t depth = 0, outer = 0;
    tag t;
    for (const char *p = text; next_tag(p, &t); p = t.end + 1) {
        const char *end;
        if (t.closes) {
            depth -= depth > 0;
            outer = depth < outer ? 0 : outer;
            continue;
        }
        bool moved = attribute(&t, "transform", &end) != NULL;
        if (is_named(&t, "path") || is_named(&t, "polygon")) {
            bool chosen = is_called(&t, cage_role_name(role));
            if (chosen || found.n_all == 0) {
                found.tag = t;
                found.transformed = moved || outer > 0;
            }
            found.n_all++;
            found.n_chosen += chosen;
        }
        if (!t.stands_alone) {
            depth++;
            outer = outer == 0 && moved ? depth : outer;
        }
    }
    return found;
}

/* The `points` of a polygon: pairs of numbers, separated by commas or spaces. The last vertex
 * joins the first. */
static bool read_polygon(cage *out, const char *p, const char *end, size_t line, problem *wrong)
{
    double xy[2];
    size_t n = 0;
    for (;;) {
        p += strspn(p, " \t\r\n,");
        if (p >= end)
            break;
        char shown[32];
        const char *word = p;
        if (number_read(&p, &xy[n % 2]) != NUMBER_OK)
            return spoilt(wrong, line, "'%s' in the polygon's points is not a finite number",
                          quoted(shown, word));
        if (n++ % 2 == 1)
            cage_add(out, xy[0], xy[1], line);
    }
    if (n % 2 == 1)
        return spoilt(wrong, line, "the polygon's last vertex lacks its y");
    return cage_end_ring(out, 0, wrong);
}

bool cage_svg_has(cage_role role, const char *text)
{
    return find_shape(text, role).n_chosen > 0;
}

bool cage_read_svg(cage *out, cage_role role, const char *text, size_t n, problem *wrong)
{
    (void)n;
    const char *id = cage_role_name(role), *end = NULL;
    shape found = find_shape(text, role);
    if (found.n_all == 0)
        return spoilt(wrong, 0, "there is no complete <path> or <polygon> in this SVG");
    if (found.n_chosen > 1 || (found.n_chosen == 0 && found.n_all > 1))
        return spoilt(wrong, 0,
                      "%zu of the %zu shapes have the id or label \"%s\"; exactly one must",
                      found.n_chosen, found.n_all, id);
    bool polygon = is_named(&found.tag, "polygon");
    const char *data = attribute(&found.tag, polygon ? "points" : "d", &end);
    size_t line = line_of(text, data != NULL ? data : found.tag.name);
    if (found.transformed)
        return spoilt(wrong, line, "the shape has a transform; apply it to the coordinates first");
    if (data == NULL)
        return spoilt(wrong, line, "the shape has no outline");
    return polygon ? read_polygon(out, data, end, line, wrong)
                   : cage_read_path(out, data, end, line, wrong);
}
