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

/* ----------------------------------------------------------------- writing */

static void write_number(iccp_blob_writer *w, uint64_t value, int n_bytes)
{
    const size_t size = (size_t)n_bytes;
    if (w->n <= w->capacity && size <= w->capacity - w->n)
        put(w->data + w->n, value, n_bytes);
    w->n += size;
}

void iccp_blob_begin(iccp_blob_writer *w, void *data, size_t capacity, const char *kind,
                     uint32_t version)
{
    *w = (iccp_blob_writer){.data = data, .capacity = capacity};
    for (int i = 0; i < 4; ++i)
        write_number(w, (unsigned char)MAGIC[i], 1);
    for (int i = 0; i < 4; ++i)
        write_number(w, (unsigned char)kind[i], 1);
    write_number(w, version, 4);
    write_number(w, 0, 4);
    write_number(w, 0, 8);
}

void iccp_blob_u32(iccp_blob_writer *w, size_t n, const uint32_t *values)
{
    for (size_t i = 0; i < n; ++i)
        write_number(w, values[i], 4);
}

void iccp_blob_u64(iccp_blob_writer *w, uint64_t value)
{
    write_number(w, value, 8);
}

void iccp_blob_f64(iccp_blob_writer *w, size_t n, const double *values)
{
    for (size_t i = 0; i < n; ++i) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        write_number(w, bits, 8);
    }
}

void iccp_blob_end(iccp_blob_writer *w, size_t *n_bytes)
{
    *n_bytes = w->n;
    if (w->n > w->capacity)
        return;
    put(w->data + LENGTH_AT, w->n, 8);
    put(w->data + CHECKSUM_AT, checksum(w->data, w->n), 4);
}

/* ----------------------------------------------------------------- reading */

icc_status iccp_blob_open(iccp_blob_reader *r, const void *data, size_t n_bytes, const char *kind,
                          uint32_t version, icc_error *err)
{
    const unsigned char *bytes = data;
    *r = (iccp_blob_reader){.data = bytes, .n = n_bytes, .at = HEADER};
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

static uint64_t read_number(iccp_blob_reader *r, int n_bytes)
{
    const size_t size = (size_t)n_bytes;
    if (r->failed || r->n - r->at < size) {
        r->failed = true;
        return 0;
    }
    r->at += size;
    return get(r->data + r->at - size, n_bytes);
}

void iccp_blob_read_u32(iccp_blob_reader *r, size_t n, uint32_t *values)
{
    for (size_t i = 0; i < n; ++i)
        values[i] = (uint32_t)read_number(r, 4);
}

uint64_t iccp_blob_read_u64(iccp_blob_reader *r)
{
    return read_number(r, 8);
}

void iccp_blob_read_f64(iccp_blob_reader *r, size_t n, double *values)
{
    for (size_t i = 0; i < n; ++i) {
        const uint64_t bits = read_number(r, 8);
        memcpy(&values[i], &bits, sizeof bits);
    }
}

size_t iccp_blob_read_count(iccp_blob_reader *r, size_t size)
{
    const uint64_t count = read_number(r, 8);
    if (r->failed || count > (r->n - r->at) / size) {
        r->failed = true;
        return 0;
    }
    return (size_t)count;
}

bool iccp_blob_done(const iccp_blob_reader *r)
{
    return !r->failed && r->at == r->n;
}

icc_status iccp_blob_blame(icc_error *err, icc_status status, const char *what)
{
    if (status == ICC_OK || status == ICC_ERR_VERSION)
        return status;
    if (status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED)
        return iccp_explain(err, status);
    return iccp_fail(err, ICC_ERR_FORMAT, "the bytes do not describe a %s", what);
}
