/* Objects as bytes: little-endian numbers after a header with the kind of object, the version of
 * its format, the length and a checksum (CRC-32 of IEEE 802.3). Described in docs/formats.md. */
#ifndef ICCP_BLOB_H
#define ICCP_BLOB_H

#include "base/env.h"

#include <stdbool.h>

/* Bytes of a number. */
enum { ICCP_U32 = 4, ICCP_F64 = 8 };

/* A writer counts always, and writes what fits into its capacity. */
typedef struct iccp_blob_writer {
    unsigned char *data;
    size_t capacity, n;
} iccp_blob_writer;

/* `kind` is four letters, such as "SMPL". */
void iccp_blob_begin(iccp_blob_writer *w, void *data, size_t capacity, const char *kind,
                     uint32_t version);
void iccp_blob_u32(iccp_blob_writer *w, size_t n, const uint32_t *values);
void iccp_blob_u64(iccp_blob_writer *w, uint64_t value);
void iccp_blob_f64(iccp_blob_writer *w, size_t n, const double *values);
/* Fills in length and checksum and tells the bytes that are needed. */
void iccp_blob_end(iccp_blob_writer *w, size_t *n_bytes);

/* A reader that has failed once gives zeros from then on. */
typedef struct iccp_blob_reader {
    const unsigned char *data;
    size_t n, at;
    bool failed;
} iccp_blob_reader;

/* ICC_ERR_FORMAT unless the header is whole, of that kind and with the right length and checksum;
 * ICC_ERR_VERSION for a version beyond `version`. */
icc_status iccp_blob_open(iccp_blob_reader *r, const void *data, size_t n_bytes, const char *kind,
                          uint32_t version, icc_error *err);
void iccp_blob_read_u32(iccp_blob_reader *r, size_t n, uint32_t *values);
uint64_t iccp_blob_read_u64(iccp_blob_reader *r);
void iccp_blob_read_f64(iccp_blob_reader *r, size_t n, double *values);
/* A count of items that take at least `size` bytes each of those that are left; else the reader
 * fails, so that nobody allocates for more than there is. */
size_t iccp_blob_read_count(iccp_blob_reader *r, size_t size);
/* Whether everything was read, and nothing failed. */
bool iccp_blob_done(const iccp_blob_reader *r);

/* What cannot be is malformed: ICC_ERR_FORMAT for all failures but those that say nothing about the
 * bytes (no memory, no patience) or have been explained (ICC_ERR_VERSION). ICC_OK stays. `what` the
 * bytes should be: "shape". */
icc_status iccp_blob_blame(icc_error *err, icc_status status, const char *what);

#endif
