/* Three bytes are four digits of six bits each. */
#include "base/base64.h"

#include "base/allocate.h"

#include <stdint.h>
#include <string.h>

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

char *base64_encode(const void *bytes, size_t n, size_t *n_text)
{
    const unsigned char *from = bytes;
    char *text = need(n / 3 + 2, 4), *to = text;
    for (size_t i = 0; i < n; i += 3) {
        uint32_t group = 0;
        for (size_t k = 0; k < 3; k++)
            group = group << 8 | (i + k < n ? from[i + k] : 0U);
        for (size_t k = 0; k < 4; k++)
            *to++ = i + k > n ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
    *n_text = (size_t)(to - text);
    return text;
}

bool base64_decode(const char *text, size_t n, char *out, size_t *n_out)
{
    uint32_t group = 0;
    size_t n_bits = 0;
    *n_out = 0;
    for (size_t end = 0; n > 0 && text[n - 1] == '=' && end < 2; end++)
        n--;
    for (size_t i = 0; i < n; i++) {
        const char *digit = memchr(digits, text[i], sizeof digits - 1);
        if (digit == NULL)
            return false;
        group = (group << 6 | (uint32_t)(digit - digits)) & 0xffff;
        n_bits += 6;
        if (n_bits >= 8) {
            n_bits -= 8;
            out[(*n_out)++] = (char)(group >> n_bits & 0xff);
        }
    }
    return n % 4 != 1;
}

/* Decodes the next four characters. */
static bool next_group(base64 *b)
{
    uint32_t group = 0;
    size_t n_padded = 0;
    for (size_t k = 0; k < 4; b->at++) {
        if (b->at >= b->end)
            return false;
        if (memchr(" \t\r\n", *b->at, 4) != NULL)
            continue;
        const char *digit = memchr(digits, *b->at, sizeof digits - 1);
        if (digit == NULL ? *b->at != '=' || k < 2 : n_padded > 0)
            return false;
        n_padded += digit == NULL;
        group = group << 6 | (digit == NULL ? 0U : (uint32_t)(digit - digits));
        k++;
    }
    b->n_group = b->n_left = 3 - n_padded;
    for (size_t i = 0; i < 3; i++)
        b->group[i] = (char)(group >> (16 - 8 * i) & 255);
    return true;
}

bool base64_take(base64 *b, char *out, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        if (b->n_left == 0 && !next_group(b))
            return false;
        out[i] = b->group[b->n_group - b->n_left--];
    }
    return true;
}
