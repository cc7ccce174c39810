/* Files of pictures: PNG, JPEG, Netpbm's PBM, PGM, PPM and PAM, all called PNM, and NumPy's
 * .npy. */
#ifndef PICTURE_FILE_H
#define PICTURE_FILE_H

#include "picture/picture.h"

/* What a format can hold. */
typedef struct picture_kind {
    const char *name;
    bool has_colours, has_alpha;
} picture_kind;

const picture_kind *picture_kind_of(picture_format format);

/* The format of this name, or PICTURE_NONE. The name may be NULL. */
picture_format picture_kind_named(const char *name);

/* The format of a file by its first bytes, or PICTURE_NONE. */
picture_format picture_told(const char *bytes, size_t n);

/* Decodes bytes[0..n) with bytes[n] == '\0'. Palettes and small depths are widened. A photograph
 * that lies on its side is turned upright. False: see `wrong`. */
bool picture_decode(picture *out, const char *bytes, size_t n, problem *wrong);

/* Encodes a picture; free() the bytes. NULL: see `wrong`. */
unsigned char *picture_encode(const picture *p, const picture_style *style, size_t *n,
                              problem *wrong);

/* Read a file and decode it, also one read before, and encode a picture to a file. DONE, or FAILED
 * with a message on stderr. */
int picture_read(picture *out, const char *name);
int picture_take(picture *out, const char *name, const char *bytes, size_t n);
int picture_save(const picture *p, const picture_style *style, const char *name);

/* The decoders of the formats. Each gets only data that begin like its files. */
bool png_decode(picture *out, const char *bytes, size_t n, problem *wrong);
bool jpeg_decode(picture *out, const char *bytes, size_t n, problem *wrong);
bool npy_decode(picture *out, const char *bytes, size_t n, problem *wrong);
bool pnm_decode(picture *out, const char *bytes, size_t n, problem *wrong);
unsigned char *png_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);
unsigned char *jpeg_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);
unsigned char *npy_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);
unsigned char *pnm_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);

#endif
