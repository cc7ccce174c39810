/* The checksum follows xxHash (Y. Collet, 2012) in what makes it fast: four lanes of 64 bits that
 * do not wait for one another. Every step, of a lane for a word and of the end for a lane, takes
 * different words to different states and different states to different ones, so that no change
 * within a single word, such as a single bit, goes unnoticed. */
#include "base/blob.h"

#include "base/error.h"

#include <string.h>

/* The header: "LICC", kind, version, the length of the whole, and checksum: the first word of each
 * lane. */
enum { KIND_AT = 4, VERSION_AT = 8, LENGTH_AT = 16, CHECKSUM_AT = 24, HEADER = 32 };

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

/* Odd factors and rotations lose nothing. */
static uint64_t stir(uint64_t state, uint64_t word)
{
    state += word * 0xbf58476d1ce4e5b9u;
    state = state << 31 | state >> 33;
    return state * 0x9e3779b97f4a7c15u;
}

/* The end of D. Steele, G. Lea, C. Flood, Fast splittable pseudorandom number generators, 2014. */
static uint64_t spread(uint64_t state)
{
    state = (state ^ state >> 30) * 0xbf58476d1ce4e5b9u;
    state = (state ^ state >> 27) * 0x94d049bb133111ebu;
    return state ^ state >> 31;
}

/* Of n >= HEADER bytes; those of the checksum itself count as 0. */
static uint64_t checksum(const unsigned char *data, size_t n)
{
    uint64_t lane[4] = {1, 2, 3, 4}, state = n;
    for (size_t k = 0; k < 4; ++k)
        lane[k] = stir(lane[k], 8 * k == CHECKSUM_AT ? 0 : word_at(data + 8 * k));
    size_t at = HEADER;
    for (; n - at >= 32; at += 32)
        for (size_t k = 0; k < 4; ++k)
            lane[k] = stir(lane[k], word_at(data + at + 8 * k));
    for (size_t k = 0; at < n; at += 8, ++k)
        lane[k] = stir(lane[k], get(data + at, n - at < 8 ? (int)(n - at) : 8));
    for (size_t k = 0; k < 4; ++k)
        state = stir(state, lane[k]);
    return spread(state);
}

/* ---- reading and writing ---- */

bool iccp_blob_has(const iccp_blob *b, size_t n, size_t size)
{
    return !b->reads || n <= (b->size - b->at) / size;
}

/* The number that is written or, reading, the one that is there. */
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

/* Numbers of `size` bytes, from one place to another that has them in the other order. */
static void turn_round(unsigned char *to, const unsigned char *from, size_t n, size_t size)
{
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < size; ++k)
            to[size * i + k] = from[size * i + size - 1 - k];
}

/* Numbers as the machine has them, and as they are written. */
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
    *b = (iccp_blob){.to = data, .size = capacity};
    for (int i = 0; i < 4; ++i)
        (void)visit_number(b, (unsigned char)MAGIC[i], 1);
    for (int i = 0; i < 4; ++i)
        (void)visit_number(b, (unsigned char)kind[i], 1);
    (void)visit_number(b, version, 8);
    (void)visit_number(b, 0, 8);
    (void)visit_number(b, 0, 8);
}

void iccp_blob_end(iccp_blob *b, size_t *n_bytes)
{
    *n_bytes = b->at;
    if (b->at > b->size)
        return;
    put(b->to + LENGTH_AT, b->at, 8);
    put(b->to + CHECKSUM_AT, checksum(b->to, b->at), 8);
}

icc_status iccp_blob_open(iccp_blob *b, const void *data, size_t n_bytes, const char *kind,
                          uint32_t version, const iccp_memory *memory, icc_error *err)
{
    const unsigned char *bytes = data;
    *b =
        (iccp_blob){.reads = true, .from = bytes, .size = n_bytes, .at = HEADER, .memory = *memory};
    if (n_bytes < HEADER || memcmp(bytes, MAGIC, sizeof MAGIC) != 0)
        return iccp_fail(err, ICC_ERR_FORMAT, "these bytes are none of libicc's");
    if (memcmp(bytes + KIND_AT, kind, 4) != 0)
        return iccp_fail(err, ICC_ERR_FORMAT, "these bytes are not of the kind \"%.4s\"", kind);
    if (get(bytes + LENGTH_AT, 8) != n_bytes)
        return iccp_fail(err, ICC_ERR_FORMAT, "%zu bytes instead of those that were written",
                         n_bytes);
    if (get(bytes + CHECKSUM_AT, 8) != checksum(bytes, n_bytes))
        return iccp_fail(err, ICC_ERR_FORMAT, "the bytes have changed: the checksum is wrong");
    const uint64_t written = get(bytes + VERSION_AT, 8);
    if (written > version)
        return iccp_fail(err, ICC_ERR_VERSION,
                         "version %llu of the format; this library knows up to %lu",
                         (unsigned long long)written, (unsigned long)version);
    if (written == 0)
        return iccp_fail(err, ICC_ERR_FORMAT, "version 0 of the format does not exist");
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

/* Room for an array whose items are left to be read, else NULL. */
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
