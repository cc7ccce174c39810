/* Bray, RFC 8259, 2017: section 7 (escapes). Yergeau, RFC 3629, 2003: section 4 (UTF-8). */
#include "base/json_decode.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A pair of surrogates stands for a code point beyond 16 bits: ten bits each. */
enum { HIGH_FIRST = 0xd800, LOW_FIRST = 0xdc00, LOW_END = 0xe000, BEYOND = 0x10000 };

int json_hex_digit(char c)
{
    char lower = (char)(c | 0x20);
    return c >= '0' && c <= '9' ? c - '0' : lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/* The number of bytes of the character at p, or 0 if it is not UTF-8. The text behind it ends with
 * a quote, which continues no character. */
static size_t character_length(const unsigned char *p)
{
    unsigned lead = p[0];
    size_t n = lead < 0x80 ? 1 : lead < 0xc2 ? 0 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    for (size_t k = 1; k < n; k++)
        if ((p[k] & 0xc0) != 0x80)
            return 0;
    bool overlong = (lead == 0xe0 && p[1] < 0xa0) || (lead == 0xf0 && p[1] < 0x90);
    bool surrogate = lead == 0xed && p[1] >= 0xa0;
    bool beyond = lead > 0xf4 || (lead == 0xf4 && p[1] >= 0x90);
    return overlong || surrogate || beyond ? 0 : n;
}

static char *put_character(char *out, uint32_t code)
{
    if (code > 0 && code < 0x80) {
        *out++ = (char)code;
        return out;
    }
    int n = code < 0x800 ? 2 : code < BEYOND ? 3 : 4;
    static const unsigned char leads[] = {0xc0, 0xe0, 0xf0};
    *out++ = (char)(leads[n - 2] | (code >> (6 * (n - 1))));
    for (int k = n - 2; k >= 0; k--)
        *out++ = (char)(0x80 | ((code >> (6 * k)) & 0x3f));
    return out;
}

/* The 16 bits of an escape \uXXXX. */
static uint32_t unit_at(const char *p)
{
    uint32_t unit = 0;
    for (int k = 2; k < 6; k++)
        unit = 16 * unit + (uint32_t)json_hex_digit(p[k]);
    return unit;
}

/* Converts the escape at *cursor and moves *cursor after it. False if it is half of a pair. */
static bool put_escape(char **out, const char **cursor)
{
    static const char letters[] = "bfnrt", controls[] = "\b\f\n\r\t";
    const char *p = *cursor;
    if (p[1] != 'u') {
        const char *letter = strchr(letters, p[1]);
        *(*out)++ = letter != NULL ? controls[letter - letters] : p[1];
        *cursor = p + 2;
        return true;
    }
    uint32_t code = unit_at(p);
    p += 6;
    if (code >= HIGH_FIRST && code < LOW_END) {
        uint32_t low = code < LOW_FIRST && p[0] == '\\' && p[1] == 'u' ? unit_at(p) : 0;
        if (low < LOW_FIRST || low >= LOW_END)
            return false;
        code = BEYOND + ((code - HIGH_FIRST) << 10) + (low - LOW_FIRST);
        p += 6;
    }
    *out = put_character(*out, code);
    *cursor = p;
    return true;
}

const char *json_decode(char *out, const char *begin, const char *end)
{
    const char *p = begin + 1;
    while (p < end - 1) {
        size_t n = *p == '\\' ? 0 : character_length((const unsigned char *)p);
        if (n > 0)
            memmove(out, p, n);
        else if (*p != '\\')
            return "this string is not UTF-8";
        else if (!put_escape(&out, &p))
            return "this string has half of a surrogate pair";
        out += n;
        p += n;
    }
    *out = '\0';
    return NULL;
}
