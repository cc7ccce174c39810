/* Cages as well-known text: POLYGON ((x y, x y, ...)), with or without SRID=...; in front. */
#include "cage/cage_readers.h"

#include "base/number.h"

#include <string.h>

typedef struct reader {
    const char *text; /* the whole file, for line numbers */
    const char *at;
    problem *wrong;
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

/* Takes a word in capitals or not, if it comes next and ends there. */
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
        return spoilt(r->wrong, line_of(r->text, r->at), "the text ends early; '%c' is missing",
                      c);
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

static bool read_ring(reader *r, cage *out)
{
    if (!expect(r, '('))
        return false;
    size_t line = 1;
    const char *counted = r->text;
    do {
        double x, y;
        if (!read_number(r, &x) || !read_number(r, &y))
            return false;
        line += line_of(counted, r->at) - 1;
        counted = r->at;
        cage_add(out, x, y, line);
    } while (next_is(r, ','));
    return expect(r, ')');
}

static bool read_type(reader *r)
{
    size_t line = line_of(r->text, r->at);
    if (next_word(r, "SRID")) {
        r->at += strcspn(r->at, ";");
        r->at += *r->at == ';';
    }
    if (next_word(r, "MULTIPOLYGON"))
        return spoilt(r->wrong, line, "a MULTIPOLYGON has several parts; make one map per part");
    if (!next_word(r, "POLYGON"))
        return spoilt(r->wrong, line, "a cage is a POLYGON");
    if (next_word(r, "Z") || next_word(r, "M") || next_word(r, "ZM"))
        return spoilt(r->wrong, line, "the polygon has more than two coordinates a vertex");
    if (next_word(r, "EMPTY"))
        return spoilt(r->wrong, line, "the polygon is empty");
    return true;
}

bool cage_read_wkt(cage *out, const char *text, size_t n, problem *wrong)
{
    reader r = {.text = text, .at = text, .wrong = wrong};
    if (n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        r.at += 3;
    r.at += strspn(r.at, blanks);
    if (!read_type(&r) || !expect(&r, '(') || !read_ring(&r, out))
        return false;
    if (next_is(&r, ','))
        return spoilt(wrong, line_of(text, r.at),
                      "the polygon has a hole; cut it open into parts "
                      "without holes and make one map per part");
    if (!expect(&r, ')'))
        return false;
    next_is(&r, ';');
    r.at += strspn(r.at, blanks);
    if (r.at != text + n)
        return spoilt(wrong, line_of(text, r.at), "there is more text behind the polygon");
    cage_open_ring(out);
    return true;
}
