/* The checksum is the one of IEEE 802.3, clause 3.2.9, as PNG and gzip have it. It covers all bytes
 * but its own, so that no single changed bit goes unnoticed. */
#include "base/blob.h"

#include "base/error.h"

#include <string.h>

/* The header: "LICC", kind, version, checksum, and the length of the whole in 8 bytes. */
enum { KIND_AT = 4, VERSION_AT = 8, CHECKSUM_AT = 12, LENGTH_AT = 16, HEADER = 24 };

static const char MAGIC[4] = {'L', 'I', 'C', 'C'};

static void make_table(uint32_t table[256])
{
    for (uint32_t i = 0; i < 256; ++i) {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit)
            table[i] = (table[i] >> 1) ^ ((table[i] & 1) != 0 ? 0xedb88320u : 0);
    }
}

static uint32_t checksum(const unsigned char *data, size_t n)
{
    uint32_t table[256], crc = 0xffffffffu;
    make_table(table);
    for (size_t i = 0; i < n; ++i)
        if (i < CHECKSUM_AT || i >= LENGTH_AT)
            crc = (crc >> 8) ^ table[(crc ^ data[i]) & 0xff];
    return ~crc;
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

/* ---- the header ---- */

void iccp_blob_begin(iccp_blob *b, void *data, size_t capacity, const char *kind, uint32_t version)
{
    *b = (iccp_blob){.to = data, .size = capacity};
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
        return iccp_fail(err, ICC_ERR_FORMAT, "these bytes are none of libicc's");
    if (memcmp(bytes + KIND_AT, kind, 4) != 0)
        return iccp_fail(err, ICC_ERR_FORMAT, "these bytes are not of the kind \"%.4s\"", kind);
    if (get(bytes + LENGTH_AT, 8) != n_bytes)
        return iccp_fail(err, ICC_ERR_FORMAT, "%zu bytes instead of those that were written",
                         n_bytes);
    if (get(bytes + CHECKSUM_AT, 4) != checksum(bytes, n_bytes))
        return iccp_fail(err, ICC_ERR_FORMAT, "the bytes have changed: the checksum is wrong");
    const uint32_t written = (uint32_t)get(bytes + VERSION_AT, 4);
    if (written > version)
        return iccp_fail(err, ICC_ERR_VERSION,
                         "version %lu of the format; this library knows up to %lu",
                         (unsigned long)written, (unsigned long)version);
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
    for (size_t i = 0; i < n; ++i) {
        const uint32_t value = (uint32_t)visit_number(b, b->reads ? 0 : values[i], ICCP_U32);
        if (b->reads)
            values[i] = value;
    }
}

void iccp_blob_u64(iccp_blob *b, size_t n, uint64_t *values)
{
    for (size_t i = 0; i < n; ++i) {
        const uint64_t value = visit_number(b, b->reads ? 0 : values[i], ICCP_U64);
        if (b->reads)
            values[i] = value;
    }
}

void iccp_blob_f64(iccp_blob *b, size_t n, double *values)
{
    for (size_t i = 0; i < n; ++i) {
        uint64_t bits = 0;
        if (!b->reads)
            memcpy(&bits, &values[i], sizeof bits);
        bits = visit_number(b, bits, ICCP_F64);
        if (b->reads)
            memcpy(&values[i], &bits, sizeof bits);
    }
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
