/* Cages as well-known text: POLYGON ((x y, x y, ...), (..), ..), where holes follow the outer ring,
 * or a MULTIPOLYGON. SRID=...; may come first. Heights and measures (Z, M, ZM, or
 * further numbers) are ignored. */
#include "cage/cage_readers.h"

#include "base/number.h"
#include "cage/cage_features.h"

#include <string.h>

typedef struct reader {
    const char *text; /* the whole file, for line numbers */
    const char *at;
    problem *wrong;
    size_t n_numbers; /* of each vertex; 0: as many as the first vertex has */
    bool several;     /* a MULTIPOLYGON */
    size_t line;      /* of `counted` */
    const char *counted;
} reader;

static const char blanks[] = " \t\r\n";

static bool next_is(reader *r, char c)
{
    r->at += strspn(r->at, blanks);
    if (*r->at != c)
        return false;
    r->at++;
    return true;
}

/* Takes a word, in capitals or not, if it comes next and ends there. */
static bool next_word(reader *r, const char *word)
{
    r->at += strspn(r->at, blanks);
    const char *p = r->at;
    for (; *word != '\0'; word++, p++)
        if ((*p >= 'a' && *p <= 'z' ? *p - 32 : *p) != *word)
            return false;
    if ((*p | 0x20) >= 'a' && (*p | 0x20) <= 'z')
        return false;
    r->at = p;
    return true;
}

static bool expect(reader *r, char c)
{
    char shown[32];
    if (next_is(r, c))
        return true;
    if (*r->at == '\0')
        return spoilt(r->wrong, line_of(r->text, r->at), "the text ends early; '%c' is missing", c);
    return spoilt(r->wrong, line_of(r->text, r->at), "'%s' where '%c' is expected",
                  quoted(shown, r->at), c);
}

static bool read_number(reader *r, double *value)
{
    r->at += strspn(r->at, blanks);
    char shown[32];
    const char *word = r->at;
    number_kind kind = number_read(&r->at, value);
    if (kind == NUMBER_OK && strchr(" \t\r\n,()", *r->at) != NULL)
        return true;
    return spoilt(r->wrong, line_of(r->text, word), "'%s' is not a %s", quoted(shown, word),
                  kind == NUMBER_NOT_FINITE ? "finite number" : "number");
}

/* Reads x and y, and the vertex's other numbers, up to four in all. */
static bool read_vertex(reader *r, double xy[2])
{
    double number;
    size_t n = 0;
    r->at += strspn(r->at, blanks);
    const char *begin = r->at;
    do {
        if (!read_number(r, n < 2 ? &xy[n] : &number))
            return false;
        n++;
        r->at += strspn(r->at, blanks);
    } while (strchr(",()", *r->at) == NULL && n < 4);
    if (r->n_numbers == 0)
        r->n_numbers = n;
    if (n >= 2 && n == r->n_numbers)
        return true;
    return spoilt(r->wrong, line_of(r->text, begin), "%zu number%s where a vertex has %zu", n,
                  n == 1 ? "" : "s", r->n_numbers > 2 ? r->n_numbers : 2);
}

static bool read_ring(reader *r, cage *out)
{
    if (!expect(r, '('))
        return false;
    size_t first = out->n;
    do {
        double xy[2];
        if (!read_vertex(r, xy))
            return false;
        r->line += line_of(r->counted, r->at) - 1;
        r->counted = r->at;
        cage_add(out, xy[0], xy[1], r->line);
        out->n_heights += r->n_numbers > 2;
    } while (next_is(r, ','));
    return expect(r, ')') && cage_end_ring(out, first, r->wrong);
}

/* Reads up to the first bracket: PostGIS' SRID, which is ignored, [MULTI]POLYGON, and Z, M or ZM.
 * These tell how many numbers a vertex has. Some programs write them without a space after the
 * word. */
static bool read_type(reader *r)
{
    static const struct {
        const char *tag, *joined;
        size_t n_numbers;
    } tags[] = {{"Z", "POLYGONZ", 3}, {"M", "POLYGONM", 3}, {"ZM", "POLYGONZM", 4}};
    size_t line = line_of(r->text, r->at);
    if (next_word(r, "SRID")) {
        r->at += strcspn(r->at, ";");
        r->at += *r->at == ';';
    }
    r->at += strspn(r->at, blanks);
    r->several = (*r->at | 0x20) == 'm' && strlen(r->at) > 5;
    r->at += r->several ? 5 : 0; /* MULTI */
    bool known = next_word(r, "POLYGON");
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++)
        if (known ? next_word(r, tags[i].tag) : next_word(r, tags[i].joined)) {
            r->n_numbers = tags[i].n_numbers;
            known = true;
            break;
        }
    if (!known)
        return spoilt(r->wrong, line, "a cage is a POLYGON");
    if (next_word(r, "EMPTY"))
        return spoilt(r->wrong, line, "the polygon is empty");
    return true;
}

static bool read_polygon(reader *r, cage *out)
{
    if (!expect(r, '('))
        return false;
    do {
        if (!read_ring(r, out))
            return false;
    } while (next_is(r, ','));
    return expect(r, ')');
}

/* Reads a polygon of several, after the first. */
static bool read_further(reader *r, cage *out)
{
    cage *c = cage_add_polygon(out);
    bool good = read_polygon(r, c);
    out->n_heights += c->n_heights;
    return good;
}

bool cage_read_wkt(cage *out, const char *text, size_t n, problem *wrong)
{
    reader r = {.text = text, .at = text, .wrong = wrong, .line = 1, .counted = text};
    if (n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        r.at += 3;
    r.at += strspn(r.at, blanks);
    if (!read_type(&r) || (r.several && !expect(&r, '(')))
        return false;
    if (!read_polygon(&r, out))
        return false;
    while (r.several && next_is(&r, ','))
        if (!read_further(&r, out))
            return false;
    if (r.several && !expect(&r, ')'))
        return false;
    if (out->n_more > 0)
        cage_join_outlines(out);
    next_is(&r, ';');
    r.at += strspn(r.at, blanks);
    if (r.at != text + n)
        return spoilt(wrong, line_of(text, r.at), "there is more text after the polygon");
    return true;
}
