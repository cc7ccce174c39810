/* Objects as bytes. The checksum is that of IEEE 802.3, clause 3.2.9, which PNG and gzip use. It
 * covers all bytes except its own, so every single changed byte is noticed. The code reads eight
 * bytes at a time: M. Kounavis, F. Berry, A systematic approach to building high performance
 * software-based CRC generators, 2005. It also runs several strands side by side, and none waits
 * for another. */
#include "base/blob.h"

#include "base/compiler.h"
#include "base/error.h"

#include <string.h>

/* The header: "LICC", kind, version, checksum, and the length of the whole object in 8 bytes. */
enum { KIND_AT = 4, VERSION_AT = 8, CHECKSUM_AT = 12, LENGTH_AT = 16, HEADER = 24 };

static const char MAGIC[4] = {'L', 'I', 'C', 'C'};

static bool is_little_endian(void)
{
    const uint16_t one = 1;
    unsigned char low;
    memcpy(&low, &one, 1);
    return low == 1;
}

static void put(unsigned char *at, uint64_t value, int n_bytes)
{
    for (int i = 0; i < n_bytes; ++i)
        at[i] = (unsigned char)(value >> 8 * i);
}

static uint64_t get(const unsigned char *at, int n_bytes)
{
    uint64_t value = 0;
    for (int i = 0; i < n_bytes; ++i)
        value |= (uint64_t)at[i] << 8 * i;
    return value;
}

/* ---- the checksum ---- */

static uint64_t word_at(const unsigned char *at)
{
    uint64_t word;
    if (!is_little_endian())
        return get(at, 8);
    memcpy(&word, at, sizeof word);
    return word;
}

/* A state is a polynomial modulo that of the checksum. The highest bit is the coefficient of 1. */
static const uint32_t POLYNOMIAL = 0xedb88320u, ONE = (uint32_t)1 << 31;

static uint32_t times_x(uint32_t a)
{
    return a >> 1 ^ ((a & 1) != 0 ? POLYNOMIAL : 0);
}

static uint32_t times(uint32_t a, uint32_t b)
{
    uint32_t product = 0;
    for (; a != 0; a <<= 1, b = times_x(b))
        product ^= (a & ONE) != 0 ? b : 0;
    return product;
}

/* Returns x^(8 n), the factor by which n more bytes multiply a state. */
static uint32_t power_of(size_t n)
{
    uint32_t power = ONE, square = ONE >> 8;
    for (; n != 0; n /= 2, square = times(square, square))
        power = n % 2 != 0 ? times(power, square) : power;
    return power;
}

/* by[k][byte] is the contribution of a byte that k others follow. */
typedef struct tables {
    uint32_t by[8][256];
} tables;

static void make_tables(tables *t)
{
    uint32_t(*table)[256] = t->by;
    for (uint32_t byte = 0; byte < 256; ++byte) {
        table[0][byte] = byte;
        for (int bit = 0; bit < 8; ++bit)
            table[0][byte] = times_x(table[0][byte]);
    }
    for (int k = 1; k < 8; ++k)
        for (uint32_t byte = 0; byte < 256; ++byte) {
            const uint32_t before = table[k - 1][byte];
            table[k][byte] = before >> 8 ^ table[0][before & 0xff];
        }
}

static uint32_t add_bytes(const tables *t, uint32_t crc, const unsigned char *data, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        crc = crc >> 8 ^ t->by[0][(crc ^ data[i]) & 0xff];
    return crc;
}

static ICCP_INLINE uint32_t add_word(const tables *t, uint32_t crc, uint64_t word)
{
    const uint64_t w = word ^ crc;
    return t->by[7][w & 0xff] ^ t->by[6][w >> 8 & 0xff] ^ t->by[5][w >> 16 & 0xff] ^
           t->by[4][w >> 24 & 0xff] ^ t->by[3][w >> 32 & 0xff] ^ t->by[2][w >> 40 & 0xff] ^
           t->by[1][w >> 48 & 0xff] ^ t->by[0][w >> 56];
}

/* Four strands of equal length, one behind the other, and then the remaining bytes. */
static uint32_t add_many(const tables *t, uint32_t crc, const unsigned char *data, size_t n)
{
    const size_t length = n / 32 * 8;
    uint32_t a = crc, b = 0, c = 0, d = 0;
    for (size_t at = 0; at < length; at += 8) {
        a = add_word(t, a, word_at(data + at));
        b = add_word(t, b, word_at(data + length + at));
        c = add_word(t, c, word_at(data + 2 * length + at));
        d = add_word(t, d, word_at(data + 3 * length + at));
    }
    const uint32_t power = power_of(length);
    crc = times(power, times(power, times(power, a) ^ b) ^ c) ^ d;
    return add_bytes(t, crc, data + 4 * length, n - 4 * length);
}

static uint32_t checksum(const unsigned char *data, size_t n)
{
    tables t;
    make_tables(&t);
    const uint32_t crc = add_bytes(&t, 0xffffffffu, data, CHECKSUM_AT);
    return ~add_many(&t, crc, data + LENGTH_AT, n - LENGTH_AT);
}

/* ---- reading and writing ---- */

bool iccp_blob_has(const iccp_blob *b, size_t n, size_t size)
{
    return !b->reads || n <= (b->size - b->at) / size;
}

/* Returns `value` after writing it, or the number that was read. */
static uint64_t visit_number(iccp_blob *b, uint64_t value, int n_bytes)
{
    const size_t size = (size_t)n_bytes;
    if (b->reads) {
        iccp_blob_require(b, iccp_blob_has(b, 1, size));
        if (b->status != ICC_OK)
            return 0;
        value = get(b->from + b->at, n_bytes);
    } else if (b->at <= b->size && size <= b->size - b->at) {
        put(b->to + b->at, value, n_bytes);
    }
    b->at += size;
    return value;
}

/* Copies numbers of `size` bytes and reverses the order of their bytes. */
static void turn_round(unsigned char *to, const unsigned char *from, size_t n, size_t size)
{
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < size; ++k)
            to[size * i + k] = from[size * i + size - 1 - k];
}

/* Copies numbers between the machine's byte order and the written one. */
static void copy(void *to, const void *from, size_t n, size_t size)
{
    if (is_little_endian())
        memcpy(to, from, n * size);
    else
        turn_round(to, from, n, size);
}

static void visit_numbers(iccp_blob *b, size_t n, size_t size, void *values)
{
    if (n == 0)
        return;
    if (b->reads) {
        iccp_blob_require(b, iccp_blob_has(b, n, size));
        if (b->status != ICC_OK) {
            memset(values, 0, n * size);
            return;
        }
        copy(values, b->from + b->at, n, size);
    } else if (b->at < b->size) {
        const size_t room = (b->size - b->at) / size;
        copy(b->to + b->at, values, n < room ? n : room, size);
    }
    b->at += n * size;
}

/* ---- the header ---- */

void iccp_blob_begin(iccp_blob *b, void *data, size_t capacity, const char *kind, uint32_t version)
{
    *b = (iccp_blob){.to = data, .size = capacity, .version = version};
    for (int i = 0; i < 4; ++i)
        (void)visit_number(b, (unsigned char)MAGIC[i], 1);
    for (int i = 0; i < 4; ++i)
        (void)visit_number(b, (unsigned char)kind[i], 1);
    (void)visit_number(b, version, 4);
    (void)visit_number(b, 0, 4);
    (void)visit_number(b, 0, 8);
}

void iccp_blob_end(iccp_blob *b, size_t *n_bytes)
{
    *n_bytes = b->at;
    if (b->at > b->size)
        return;
    put(b->to + LENGTH_AT, b->at, 8);
    put(b->to + CHECKSUM_AT, checksum(b->to, b->at), 4);
}

icc_status iccp_blob_open(iccp_blob *b, const void *data, size_t n_bytes, const char *kind,
                          uint32_t version, const iccp_memory *memory, icc_error *err)
{
    const unsigned char *bytes = data;
    *b =
        (iccp_blob){.reads = true, .from = bytes, .size = n_bytes, .at = HEADER, .memory = *memory};
    if (n_bytes < HEADER || memcmp(bytes, MAGIC, sizeof MAGIC) != 0)
        return iccp_fail(err, ICC_ERR_FORMAT, "these bytes were not saved by libicc");
    if (memcmp(bytes + KIND_AT, kind, 4) != 0)
        return iccp_fail(err, ICC_ERR_FORMAT, "these bytes hold no object of the kind \"%.4s\"",
                         kind);
    if (get(bytes + LENGTH_AT, 8) != n_bytes)
        return iccp_fail(err, ICC_ERR_FORMAT,
                         "there are %zu bytes, which is not how many were written", n_bytes);
    if (get(bytes + CHECKSUM_AT, 4) != checksum(bytes, n_bytes))
        return iccp_fail(err, ICC_ERR_FORMAT, "the bytes have changed: the checksum is wrong");
    const uint32_t written = (uint32_t)get(bytes + VERSION_AT, 4);
    if (written > version)
        return iccp_fail(
            err, ICC_ERR_VERSION,
            "the bytes have version %lu of the format, but this library reads versions up to %lu",
            (unsigned long)written, (unsigned long)version);
    if (written == 0)
        return iccp_fail(err, ICC_ERR_FORMAT, "version 0 of the format does not exist");
    b->version = written;
    return ICC_OK;
}

bool iccp_blob_done(const iccp_blob *b)
{
    return b->status == ICC_OK && b->at == b->size;
}

/* ---- numbers ---- */

void iccp_blob_u32(iccp_blob *b, size_t n, uint32_t *values)
{
    visit_numbers(b, n, ICCP_U32, values);
}

void iccp_blob_u64(iccp_blob *b, size_t n, uint64_t *values)
{
    visit_numbers(b, n, ICCP_U64, values);
}

void iccp_blob_f64(iccp_blob *b, size_t n, double *values)
{
    visit_numbers(b, n, ICCP_F64, values);
}

void iccp_blob_i32(iccp_blob *b, int n_bytes, int32_t least, int32_t most, int32_t *value)
{
    const uint64_t number = visit_number(b, b->reads ? 0 : (uint64_t)*value, n_bytes);
    if (!b->reads)
        return;
    iccp_blob_require(b,
                      number <= INT32_MAX && (int32_t)number >= least && (int32_t)number <= most);
    *value = b->status == ICC_OK ? (int32_t)number : 0;
}

void iccp_blob_size(iccp_blob *b, size_t *n)
{
    const uint64_t number = visit_number(b, b->reads ? 0 : *n, ICCP_U64);
    if (!b->reads)
        return;
    iccp_blob_require(b, number <= SIZE_MAX);
    *n = b->status == ICC_OK ? (size_t)number : 0;
}

bool iccp_blob_follows(iccp_blob *b, const void *object)
{
    const uint64_t follows = visit_number(b, !b->reads && object != NULL, ICCP_U64);
    iccp_blob_require(b, follows <= 1);
    return b->status == ICC_OK && follows == 1;
}

void iccp_blob_count(iccp_blob *b, size_t size, size_t *n)
{
    iccp_blob_size(b, n);
    if (b->status != ICC_OK || iccp_blob_has(b, *n, size))
        return;
    iccp_blob_require(b, false);
    *n = 0;
}

/* ---- arrays ---- */

void *iccp_blob_alloc(iccp_blob *b, size_t n, size_t size)
{
    if (!b->reads || b->status != ICC_OK)
        return NULL;
    void *items = iccp_alloc(&b->memory, n, size);
    if (items == NULL)
        b->status = ICC_ERR_MEMORY;
    return items;
}

/* Allocates an array if the bytes for its items are left, else returns NULL. */
static void *alloc_array(iccp_blob *b, size_t n, size_t size)
{
    iccp_blob_require(b, iccp_blob_has(b, n, size));
    return iccp_blob_alloc(b, n, size);
}

void iccp_blob_array_u32(iccp_blob *b, size_t n, uint32_t **values)
{
    if (b->reads)
        *values = alloc_array(b, n, sizeof **values);
    if (b->status == ICC_OK)
        iccp_blob_u32(b, n, *values);
}

void iccp_blob_array_f64(iccp_blob *b, size_t n, double **values)
{
    if (b->reads)
        *values = alloc_array(b, n, sizeof **values);
    if (b->status == ICC_OK)
        iccp_blob_f64(b, n, *values);
}

/* ---- failures ---- */

void iccp_blob_require(iccp_blob *b, bool holds)
{
    if (b->reads && b->status == ICC_OK && !holds)
        b->status = ICC_ERR_FORMAT;
}

icc_status iccp_blob_blame(icc_error *err, icc_status status, const char *what)
{
    if (status == ICC_OK || status == ICC_ERR_VERSION)
        return status;
    if (status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED)
        return iccp_explain(err, status);
    return iccp_fail(err, ICC_ERR_FORMAT, "the bytes do not describe a %s", what);
}
