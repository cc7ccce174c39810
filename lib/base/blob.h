/* Objects as bytes: little-endian numbers after a header with the kind of object, the version of
 * its format, the length and a checksum (CRC-32 of IEEE 802.3). Described in docs/formats.md.
 *
 * One function visits the parts of an object both ways: bytes are written from the values that it
 * names, or read into them. Visiting to write leaves all values alone, so that an object may be
 * saved by several threads at once. */
#ifndef ICCP_BLOB_H
#define ICCP_BLOB_H

#include "base/env.h"

#include <stdbool.h>

/* Bytes of a number. */
enum { ICCP_U32 = 4, ICCP_U64 = 8, ICCP_F64 = 8 };

typedef struct iccp_blob {
    bool reads;
    icc_status status;         /* of reading: ICC_ERR_FORMAT or ICC_ERR_MEMORY once it has failed */
    const unsigned char *from; /* what is read, or: */
    unsigned char *to;         /* where to write as much as fits; all is counted */
    size_t size, at;           /* bytes there, and bytes so far */
    uint32_t version;          /* of the format */
    iccp_memory memory;        /* of the arrays that are read */
} iccp_blob;

/* To write. `kind` is four letters, such as "SMPL". */
void iccp_blob_begin(iccp_blob *b, void *data, size_t capacity, const char *kind, uint32_t version);
/* Fills in length and checksum and reports the bytes that are needed. */
void iccp_blob_end(iccp_blob *b, size_t *n_bytes);

/* To read. ICC_ERR_FORMAT unless the header is whole, of that kind and with the right length and
 * checksum; ICC_ERR_VERSION for a version beyond `version`. */
icc_status iccp_blob_open(iccp_blob *b, const void *data, size_t n_bytes, const char *kind,
                          uint32_t version, const iccp_memory *memory, icc_error *err);
/* Whether everything was read, and nothing failed. */
bool iccp_blob_done(const iccp_blob *b);

/* ---- either way; once reading has failed, numbers are 0 and arrays NULL ---- */

void iccp_blob_u32(iccp_blob *b, size_t n, uint32_t *values);
void iccp_blob_u64(iccp_blob *b, size_t n, uint64_t *values);
void iccp_blob_f64(iccp_blob *b, size_t n, double *values);

/* An integer from `least` to `most` in ICCP_U32 or ICCP_U64 bytes. */
void iccp_blob_i32(iccp_blob *b, int n_bytes, int32_t least, int32_t most, int32_t *value);
/* A number of items, as a u64. */
void iccp_blob_size(iccp_blob *b, size_t *n);
/* The same for items that follow, and take at least `size` bytes each of those that are left: so
 * nobody allocates for more than there is. */
void iccp_blob_count(iccp_blob *b, size_t size, size_t *n);

/* Arrays that reading allocates, from the bytes that are left. */
void iccp_blob_array_u32(iccp_blob *b, size_t n, uint32_t **values);
void iccp_blob_array_f64(iccp_blob *b, size_t n, double **values);

/* ---- for reading; else it has everything, and they do nothing ---- */

/* Whether n items of `size` bytes are left. */
bool iccp_blob_has(const iccp_blob *b, size_t n, size_t size);
/* Memory for n items; NULL on failure. */
void *iccp_blob_alloc(iccp_blob *b, size_t n, size_t size);
/* What is read is malformed unless `holds`. */
void iccp_blob_require(iccp_blob *b, bool holds);

/* What cannot be is malformed: ICC_ERR_FORMAT for all failures but those that say nothing about the
 * bytes (no memory, no patience) or have been explained (ICC_ERR_VERSION). ICC_OK stays. `what` the
 * bytes should be: "shape". */
icc_status iccp_blob_blame(icc_error *err, icc_status status, const char *what);

#endif
