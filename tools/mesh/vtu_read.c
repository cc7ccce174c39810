/* Reads the numbers of a VTU file's arrays. */
#include "mesh/vtu.h"

#include "base/allocate.h"
#include "base/base64.h"
#include "base/bytes.h"
#include "base/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/* Deflate makes at most so many bytes of one (https://zlib.net/zlib_tech.html). */
static const double MOST_INFLATION = 1032;

/* ---------------------------------------------------------------------- text */

static const char blanks[] = " \t\r\n";

static bool read_text(const vtu *v, vtu_array *a, problem *wrong)
{
    const char *p = v->text + a->tag_end;
    char name[32], shown[32];
    p += strspn(p, blanks);
    a->at = a->at_end = (size_t)(p - v->text);
    for (size_t i = 0; i < a->n; i++) {
        const char *word = p;
        number_kind kind = number_read(&p, &a->values[i]);
        if (kind == NUMBER_NOT_FINITE)
            a->values[i] = (double)NAN;
        if (kind == NUMBER_BAD || strchr(" \t\r\n<", *p) == NULL)
            return spoilt(wrong, line_of(v->text, word),
                          "'%s' where number %zu of %zu of the array '%s' is expected",
                          quoted(shown, word), i, a->n, vtu_name(v, a, name));
        a->at_end = (size_t)(p - v->text);
        p += strspn(p, blanks);
    }
    return *p == '<' ||
           spoilt(wrong, line_of(v->text, p), "the array '%s' has more than %zu numbers",
                  vtu_name(v, a, name), a->n);
}

/* ---------------------------------------------------------------------- bytes */

/* Bytes of an array, which may be coded. */
typedef struct source {
    const vtu *v;
    vtu_array *a;
    problem *wrong;
    bool is_coded;
    base64 text; /* or raw bytes */
} source;

static source source_of(const vtu *v, vtu_array *a, problem *wrong)
{
    source s = {.v = v, .a = a, .wrong = wrong, .is_coded = !a->is_appended || v->is_coded};
    const char *at = v->text + a->tag_end, *end = v->text + a->end;
    if (a->is_appended && a->offset > v->n_text - v->data) {
        at = end = v->text + v->n_text;
    } else if (a->is_appended) {
        at = v->text + v->data + a->offset;
        end = v->text + v->n_text;
    }
    while (s.is_coded && at < end && strchr(blanks, *at) != NULL && *at != '\0')
        at++;
    s.text = (base64){.at = at, .end = end};
    return s;
}

static bool is_short(source *s)
{
    char name[32];
    return spoilt(s->wrong, 0, "the bytes of the array '%s' end early, or are not base64",
                  vtu_name(s->v, s->a, name));
}

static bool take(source *s, char *out, size_t n)
{
    if (s->is_coded)
        return base64_take(&s->text, out, n) || is_short(s);
    if ((size_t)(s->text.end - s->text.at) < n)
        return is_short(s);
    memcpy(out, s->text.at, n);
    s->text.at += n;
    return true;
}

/* An unsigned number of n bytes. */
static uint64_t whole(const vtu *v, const char *bytes, size_t n)
{
    if (!v->is_little)
        return big_endian(bytes, n);
    uint64_t value = 0;
    for (size_t i = n; i-- > 0;)
        value = value << 8 | (unsigned char)bytes[i];
    return value;
}

static bool take_size(source *s, uint64_t *size)
{
    char bytes[8];
    if (!take(s, bytes, s->v->n_word))
        return false;
    *size = whole(s->v, bytes, s->v->n_word);
    return true;
}

static bool has_size(source *s, double n, size_t wanted)
{
    char name[32];
    return !(n < (double)wanted || n > (double)wanted) ||
           spoilt(s->wrong, 0, "the array '%s' has %.17g bytes where %zu are expected",
                  vtu_name(s->v, s->a, name), n, wanted);
}

static bool take_plain(source *s, char *out, size_t n)
{
    uint64_t size;
    return take_size(s, &size) && has_size(s, (double)size, n) && take(s, out, n);
}

/* Inflates a block of `packed` bytes to exactly n bytes. */
static bool inflate_block(source *s, char *out, size_t n, size_t packed)
{
    char name[32], *bytes = need(packed, 1);
    uLongf made = (uLongf)n;
    bool taken = take(s, bytes, packed);
    bool good =
        taken && uncompress((Bytef *)out, &made, (const Bytef *)bytes, (uLong)packed) == Z_OK;
    free(bytes);
    if (taken && (!good || made != n))
        return spoilt(s->wrong, 0, "a compressed block of the array '%s' is not %zu bytes of zlib",
                      vtu_name(s->v, s->a, name), n);
    return good;
}

/* The sizes of blocks after compression. Their sum must be able to become n bytes. */
static bool take_sizes(source *s, size_t n_blocks, uint64_t *sizes, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n_blocks; i++) {
        if (!take_size(s, &sizes[i]))
            return false;
        sum += (double)sizes[i];
    }
    return (sum <= (double)s->v->n_text && (double)n <= sum * MOST_INFLATION) || is_short(s);
}

static bool take_blocks(source *s, char *out, size_t n, size_t n_blocks, const uint64_t *sizes)
{
    for (size_t i = 0, done = 0; i < n_blocks; i++) {
        size_t size = s->a->block < n - done ? (size_t)s->a->block : n - done;
        if (!inflate_block(s, out + done, size, (size_t)sizes[i]))
            return false;
        done += size;
    }
    return true;
}

/* All blocks are as long as the first one, except the last one. */
static bool take_zipped(source *s, char **out, size_t n)
{
    uint64_t n_blocks, last;
    if (!take_size(s, &n_blocks) || !take_size(s, &s->a->block) || !take_size(s, &last))
        return false;
    if (n_blocks > s->v->n_text)
        return is_short(s);
    bool is_partial = last > 0 && n_blocks > 0;
    if (last > s->a->block)
        return is_short(s);
    if (!has_size(s, (double)(n_blocks - is_partial) * (double)s->a->block + (double)last, n))
        return false;
    uint64_t *sizes = need((size_t)n_blocks, sizeof *sizes);
    bool good = take_sizes(s, (size_t)n_blocks, sizes, n);
    if (good) {
        *out = need(n, 1);
        good = take_blocks(s, *out, n, (size_t)n_blocks, sizes);
    }
    free(sizes);
    return good;
}

/* ------------------------------------------------------------------- numbers */

static double number_of(const vtu *v, const vtu_array *a, const char *bytes)
{
    uint64_t bits = whole(v, bytes, a->width);
    uint32_t half = (uint32_t)bits;
    float single;
    double value;
    if (a->kind == 'f' && a->width == 4) {
        memcpy(&single, &half, 4);
        return (double)single;
    }
    if (a->kind == 'f') {
        memcpy(&value, &bits, 8);
        return value;
    }
    bool is_negative = a->kind == 'i' && bits >> (8 * a->width - 1) != 0;
    return is_negative ? -(double)((~bits + 1) & (UINT64_MAX >> (64 - 8 * a->width)))
                       : (double)bits;
}

static bool read_bytes(const vtu *v, vtu_array *a, problem *wrong)
{
    source s = source_of(v, a, wrong);
    const char *begin = s.text.at;
    size_t n = a->n * a->width;
    char *bytes = NULL;
    bool good = false;
    if (v->is_zipped) {
        good = take_zipped(&s, &bytes, n);
    } else if (n <= v->n_text) {
        bytes = need(n, 1);
        good = take_plain(&s, bytes, n);
    } else {
        is_short(&s);
    }
    if (good) {
        a->values = need(a->n, sizeof *a->values);
        for (size_t i = 0; i < a->n; i++)
            a->values[i] = number_of(v, a, bytes + a->width * i);
    }
    free(bytes);
    a->at = (size_t)(begin - v->text);
    a->at_end = (size_t)(s.text.at - v->text);
    return good;
}

bool vtu_read(const vtu *v, vtu_array *a, uint64_t n, problem *wrong)
{
    char name[32];
    if (a->kind == '?')
        return spoilt(wrong, line_of(v->text, v->text + a->tag),
                      "the array '%s' is not of a type of numbers", vtu_name(v, a, name));
    if (a->is_appended && v->data == 0)
        return spoilt(wrong, 0, "the array '%s' is appended, but there are no AppendedData",
                      vtu_name(v, a, name));
    double most = (double)v->n_text * (a->is_text ? 1 : MOST_INFLATION);
    if ((double)n * (double)a->width > most * (double)(a->is_text ? a->width : 1))
        return spoilt(wrong, 0, "the array '%s' has no room for %.17g numbers",
                      vtu_name(v, a, name), (double)n);
    free(a->values);
    a->values = NULL;
    a->n = (size_t)n;
    a->at = a->at_end = a->tag_end;
    if (n == 0)
        return true;
    if (!a->is_text)
        return read_bytes(v, a, wrong);
    a->values = need(a->n, sizeof *a->values);
    return read_text(v, a, wrong);
}
