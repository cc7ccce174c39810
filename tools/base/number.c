/* Checks the grammar of a number before it is converted. */
#include "base/number.h"

#include "base/decimal.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

static const char *skip_digits(const char *p)
{
    while (is_digit(*p))
        p++;
    return p;
}

/* Returns the end of the decimal number at p, or NULL. strtod() alone accepts more: blanks, 0x1p3,
 * nan(7). */
static const char *decimal_end(const char *p)
{
    if (*p == '+' || *p == '-')
        p++;
    const char *whole = skip_digits(p);
    bool any = whole > p;
    p = whole;
    if (*p == '.') {
        const char *part = skip_digits(p + 1);
        any = any || part > p + 1;
        p = part;
    }
    if (!any)
        return NULL;
    if (*p == 'e' || *p == 'E') {
        const char *q = p + 1;
        if (*q == '+' || *q == '-')
            q++;
        if (is_digit(*q))
            p = skip_digits(q);
    }
    return p;
}

/* The length of a word for a number that is not finite, including its sign, or 0. */
static size_t special_length(const char *p)
{
    static const char *const words[] = {"infinity", "inf", "nan"};
    size_t sign = *p == '+' || *p == '-';
    for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
        size_t n = 0;
        while (words[w][n] != '\0' && (p[sign + n] | 0x20) == words[w][n])
            n++;
        if (words[w][n] == '\0')
            return sign + n;
    }
    return 0;
}

number_kind number_read(const char **cursor, double *value)
{
    const char *end;
    if (decimal_read_plain(*cursor, &end, value)) {
        *cursor = end;
        return NUMBER_OK;
    }
    end = decimal_end(*cursor);
    if (end == NULL) {
        size_t special = special_length(*cursor);
        *value = NAN;
        *cursor += special;
        return special > 0 ? NUMBER_NOT_FINITE : NUMBER_BAD;
    }
    *value = decimal_read(*cursor);
    *cursor = end;
    return isfinite(*value) ? NUMBER_OK : NUMBER_NOT_FINITE;
}

number_kind number_parse(const char *text, double *value)
{
    number_kind kind = number_read(&text, value);
    return *text == '\0' ? kind : NUMBER_BAD;
}
