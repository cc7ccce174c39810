/* Files of pictures: PNG, JPEG, Netpbm's PBM, PGM, PPM and PAM, all called PNM, and NumPy's .npy. */
#ifndef PICTURE_FILE_H
#define PICTURE_FILE_H

#include "job/args.h"
#include "plot/picture.h"

/* What a file is by its first bytes; PICTURE_NONE: none of these. */
picture_format picture_told(const char *bytes, size_t n);

/* Decodes bytes[0..n) with bytes[n] == '\0'. Palettes and small depths are widened; a photograph
 * that lies on its side is put upright. False: see `wrong`. */
bool picture_decode(picture *out, const char *bytes, size_t n, problem *wrong);

/* Encodes a picture; free() the bytes. NULL: see `wrong`. */
unsigned char *picture_encode(const picture *p, const picture_style *style, size_t *n,
                              problem *wrong);

/* Makes what is drawn on, as the options say, and chooses how it is written to a file: in the
 * format that its name says, else in that of `from`, with the notes of `from`. FAILED or MISUSED
 * with a line on stderr when the format cannot hold the picture, or an option is not for it; `to`
 * is to be freed in any case. */
int picture_begin(picture *to, picture_style *style, picture *from, const args *a,
                  const char *name);

/* picture_decode() of a file, also of one that has been read, and picture_encode() to a file: DONE,
 * or FAILED with a line on stderr. */
int picture_read(picture *out, const char *name);
int picture_take(picture *out, const char *name, const char *bytes, size_t n);
int picture_save(const picture *p, const picture_style *style, const char *name);

/* The formats. Decoders are given what begins like a file of theirs. */
bool png_decode(picture *out, const char *bytes, size_t n, problem *wrong);
bool jpeg_decode(picture *out, const char *bytes, size_t n, problem *wrong);
bool npy_decode(picture *out, const char *bytes, size_t n, problem *wrong);
bool pnm_decode(picture *out, const char *bytes, size_t n, problem *wrong);
unsigned char *png_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);
unsigned char *jpeg_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);
unsigned char *npy_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);
unsigned char *pnm_encode(const picture *p, const picture_style *style, size_t *n, problem *wrong);

#endif
