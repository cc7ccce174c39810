/* Reads and writes objects as bytes: little-endian numbers after a header. The header holds the
 * kind of object, the version of its format, the length and a checksum (CRC-32 of IEEE 802.3).
 * docs/reference/formats.md describes it.
 *
 * One function visits the parts of an object in both directions: it writes the values that it
 * names, or reads into them. Writing changes no value, so several threads may save an object at
 * once. */
#ifndef ICCP_BLOB_H
#define ICCP_BLOB_H

#include "base/env.h"

#include <stdbool.h>

/* Size of a number in bytes. */
enum { ICCP_U32 = 4, ICCP_U64 = 8, ICCP_F64 = 8 };

typedef struct iccp_blob {
    bool reads;
    icc_status status;         /* of reading: ICC_ERR_FORMAT or ICC_ERR_MEMORY after a failure */
    const unsigned char *from; /* the bytes to read, or: */
    unsigned char *to;         /* room for the bytes written; the rest is only counted */
    size_t size, at;           /* bytes in total, and bytes visited */
    uint32_t version;          /* version of the format */
    iccp_memory memory;        /* allocates the arrays that are read */
} iccp_blob;

/* Begins to write. `kind` is four letters, such as "SMPL". */
void iccp_blob_begin(iccp_blob *b, void *data, size_t capacity, const char *kind, uint32_t version);
/* Fills in length and checksum, and reports how many bytes are needed. */
void iccp_blob_end(iccp_blob *b, size_t *n_bytes);

/* Begins to read. Returns ICC_ERR_FORMAT unless the header is complete, of this kind, and has the
 * right length and checksum. Returns ICC_ERR_VERSION for a version beyond `version`. */
icc_status iccp_blob_open(iccp_blob *b, const void *data, size_t n_bytes, const char *kind,
                          uint32_t version, const iccp_memory *memory, icc_error *err);
/* Returns true if all bytes were read and nothing failed. */
bool iccp_blob_done(const iccp_blob *b);

/* ---- both directions; after a failure of reading, numbers are 0 and arrays NULL ---- */

void iccp_blob_u32(iccp_blob *b, size_t n, uint32_t *values);
void iccp_blob_u64(iccp_blob *b, size_t n, uint64_t *values);
void iccp_blob_f64(iccp_blob *b, size_t n, double *values);

/* An integer from `least` to `most` in ICCP_U32 or ICCP_U64 bytes. */
void iccp_blob_i32(iccp_blob *b, int n_bytes, int32_t least, int32_t most, int32_t *value);
/* A count of items, as a u64. */
void iccp_blob_size(iccp_blob *b, size_t *n);
/* Tells if an object follows: writes whether there is one, or reads that. */
bool iccp_blob_follows(iccp_blob *b, const void *object);
/* A count of items that follow and take at least `size` bytes each. Reading fails if fewer bytes
 * are left, so nobody allocates more than the input can fill. */
void iccp_blob_count(iccp_blob *b, size_t size, size_t *n);

/* Arrays. Reading allocates them, and needs as many bytes as they take. */
void iccp_blob_array_u32(iccp_blob *b, size_t n, uint32_t **values);
void iccp_blob_array_f64(iccp_blob *b, size_t n, double **values);

/* ---- reading only; while writing, these return true or do nothing ---- */

/* Returns true if n items of `size` bytes are left. */
bool iccp_blob_has(const iccp_blob *b, size_t n, size_t size);
/* Allocates n items; NULL on failure. */
void *iccp_blob_alloc(iccp_blob *b, size_t n, size_t size);
/* Reading fails as malformed unless `holds`. */
void iccp_blob_require(iccp_blob *b, bool holds);

/* Turns a failure of rebuilding an object into ICC_ERR_FORMAT, because the bytes describe something
 * impossible. Keeps ICC_OK, failures that say nothing about the bytes (memory, cancelled), and
 * ICC_ERR_VERSION. `what` names the object: "shape". */
icc_status iccp_blob_blame(icc_error *err, icc_status status, const char *what);

#endif
