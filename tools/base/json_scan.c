/* A scanner for JSON with a stack of brackets instead of recursion. */
#include "base/json_scan.h"

#include "base/allocate.h"
#include "base/json_decode.h"

#include <stdlib.h>
#include <string.h>

/* The pieces that may come next. */
enum { VALUE, VALUE_OR_CLOSE, NAME, NAME_OR_CLOSE, COMMA_OR_CLOSE };

void json_scan_start(json_scan *s, const char *text, size_t n)
{
    *s = (json_scan){.text = text, .n = n, .expected = VALUE};
    if (n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0)
        s->at = 3;
}

void json_scan_end(json_scan *s)
{
    free(s->open);
    *s = (json_scan){0};
}

static json_kind bad(json_scan *s, const char *why)
{
    s->begin = s->end = s->at;
    s->why = s->at >= s->n ? "the JSON ends early" : why;
    return JSON_BAD;
}

static void skip_blanks(json_scan *s)
{
    const char *p = s->text + s->at;
    while (*p == ' ' || *p == '\n' || *p == '\r' || *p == '\t')
        p++;
    s->at = (size_t)(p - s->text);
}

static json_kind open_bracket(json_scan *s, char bracket)
{
    s->open = grow(s->open, &s->room, s->depth + 1, 1);
    s->open[s->depth++] = bracket;
    s->at++;
    s->expected = bracket == '{' ? NAME_OR_CLOSE : VALUE_OR_CLOSE;
    return bracket == '{' ? JSON_OBJECT : JSON_LIST;
}

/* The brackets differ by 2 in ASCII, {} and [] alike. */
static json_kind close_bracket(json_scan *s)
{
    if (s->depth == 0 || s->text[s->at] != s->open[s->depth - 1] + 2)
        return bad(s, "this is not valid JSON: this bracket closes none");
    s->depth--;
    s->at++;
    s->expected = COMMA_OR_CLOSE;
    return JSON_CLOSE;
}

/* Scans a string, with `at` on its first quote. On failure `at` is at the fault. */
static bool scan_string(json_scan *s)
{
    const char *p = s->text + s->at + 1;
    for (; *p != '"' && (unsigned char)*p >= 32; p++) {
        if (*p != '\\')
            continue;
        p++;
        bool known = *p != '\0' && strchr("\"\\/bfnrtu", *p) != NULL;
        for (int k = 0; known && *p == 'u' && k < 4; k++)
            known = json_hex_digit(p[1 + k]) >= 0;
        if (!known)
            break;
        p += *p == 'u' ? 4 : 0;
    }
    bool good = *p == '"';
    s->at = (size_t)(p - s->text) + good;
    return good;
}

static const char *digits(const char *p)
{
    while (*p >= '0' && *p <= '9')
        p++;
    return p;
}

/* -? (0 | [1-9][0-9]*) (. [0-9]+)? ([eE] [+-]? [0-9]+)? */
static bool scan_number(json_scan *s)
{
    const char *p = s->text + s->at, *part = p + (*p == '-');
    p = *part == '0' ? part + 1 : digits(part);
    bool good = p > part;
    if (good && *p == '.') {
        part = p + 1;
        p = digits(part);
        good = p > part;
    }
    if (good && (*p == 'e' || *p == 'E')) {
        part = p + 1 + (p[1] == '+' || p[1] == '-');
        p = digits(part);
        good = p > part;
    }
    s->at = (size_t)(p - s->text);
    return good;
}

static json_kind scan_word(json_scan *s)
{
    static const char *const words[] = {"true", "false", "null"};
    static const json_kind kinds[] = {JSON_TRUE, JSON_FALSE, JSON_NULL};
    for (size_t w = 0; w < 3; w++)
        if (strncmp(s->text + s->at, words[w], strlen(words[w])) == 0) {
            s->at += strlen(words[w]);
            return kinds[w];
        }
    return bad(s, "this is not valid JSON");
}

static json_kind scan_value(json_scan *s)
{
    char c = s->text[s->at];
    if (c == '{' || c == '[')
        return open_bracket(s, c);
    s->expected = COMMA_OR_CLOSE;
    if (c == '"')
        return scan_string(s) ? JSON_STRING : bad(s, "this string is not valid JSON");
    if (c == '-' || (c >= '0' && c <= '9'))
        return scan_number(s) ? JSON_NUMBER : bad(s, "this number is not valid JSON");
    return scan_word(s);
}

static json_kind scan_name(json_scan *s)
{
    if (s->text[s->at] != '"')
        return bad(s, "this is not valid JSON: the name of a member should be here");
    if (!scan_string(s))
        return bad(s, "this string is not valid JSON");
    s->end = s->at;
    skip_blanks(s);
    if (s->text[s->at] != ':')
        return bad(s, "this is not valid JSON: a colon should be here");
    s->at++;
    s->expected = VALUE;
    return JSON_NAME;
}

/* Scans one piece, and skips commas where they belong. There is no piece after the outermost
 * value. */
json_kind json_scan_next(json_scan *s)
{
    skip_blanks(s);
    if (s->expected == COMMA_OR_CLOSE && s->depth == 0) {
        if (s->at < s->n)
            return bad(s, "this is not valid JSON: something follows its end");
        s->begin = s->end = s->at;
        return JSON_END;
    }
    char c = s->text[s->at];
    bool closes = c == '}' || c == ']';
    if (s->expected == COMMA_OR_CLOSE && !closes) {
        if (c != ',')
            return bad(s, "this is not valid JSON: a comma should be here");
        s->at++;
        skip_blanks(s);
        s->expected = s->open[s->depth - 1] == '{' ? NAME : VALUE;
    }
    size_t begin = s->at;
    bool may_close = s->expected == COMMA_OR_CLOSE || s->expected == VALUE_OR_CLOSE ||
                     s->expected == NAME_OR_CLOSE;
    json_kind kind = closes && may_close                                   ? close_bracket(s)
                     : s->expected == NAME || s->expected == NAME_OR_CLOSE ? scan_name(s)
                                                                           : scan_value(s);
    if (kind == JSON_BAD)
        return kind;
    s->begin = begin;
    if (kind != JSON_NAME)
        s->end = s->at;
    return kind;
}

size_t json_scan_gap(const char *p, bool *apart)
{
    size_t n = strspn(p, " \t\r\n\x1e");
    *apart = memchr(p, '\n', n) != NULL || memchr(p, '\x1e', n) != NULL;
    return n;
}

bool json_scan_more(json_scan *s)
{
    const char *p = s->text + s->at;
    bool apart;
    size_t n = json_scan_gap(p, &apart);
    if (s->depth > 0 || !apart || p[n] != '{')
        return false;
    s->at += n;
    s->expected = VALUE;
    return true;
}

/* Skips numbers in a row, in a list, and the commas after them. What follows, or is wrong, is left to
 * json_scan_next(). */
static void skip_numbers(json_scan *s)
{
    while (s->expected == VALUE || s->expected == VALUE_OR_CLOSE) {
        skip_blanks(s);
        size_t begin = s->at;
        char c = s->text[begin];
        if ((c != '-' && !(c >= '0' && c <= '9')) || !scan_number(s)) {
            s->at = begin;
            return;
        }
        skip_blanks(s);
        s->expected = s->text[s->at] == ',' ? VALUE : COMMA_OR_CLOSE;
        s->at += s->text[s->at] == ',';
    }
}

json_kind json_scan_skip(json_scan *s, json_kind kind)
{
    size_t begin = s->begin, depth = s->depth;
    while ((kind == JSON_OBJECT || kind == JSON_LIST) && s->depth >= depth) {
        if (s->open[s->depth - 1] == '[')
            skip_numbers(s);
        if (json_scan_next(s) == JSON_BAD)
            return JSON_BAD;
    }
    s->begin = begin;
    return kind;
}

int json_fault(const char *text, size_t at, const char *why, problem *wrong)
{
    size_t line = at;
    while (line > 0 && text[line - 1] != '\n')
        line--;
    return spoilt(wrong, line_of(text, text + at), "%s (column %zu)", why, at - line + 1);
}

/* Returns the next character of a string if it is ASCII, else 0. */
static char next_char(const char **cursor)
{
    const char *p = *cursor;
    *cursor = p + 1;
    if (*p != '\\')
        return *p;
    *cursor = p + 2;
    if (p[1] != 'u')
        return 0;
    *cursor = p + 6;
    int code = 0;
    for (int k = 2; k < 6; k++)
        code = 16 * code + json_hex_digit(p[k]);
    return (char)(code < 128 ? code : 0);
}

bool json_string_is(const char *begin, const char *end, const char *word)
{
    const char *p = begin + 1;
    while (p < end - 1 && *word != '\0')
        if (next_char(&p) != *word++)
            return false;
    return p == end - 1 && *word == '\0';
}
