/* Films: PNG pictures one after the other in one file, an animated PNG (APNG, part of PNG's
 * third edition, W3C 2025). Programs that do not know it show the first picture. */
#ifndef FILM_H
#define FILM_H

#include "base/file.h"

#include <stddef.h>
#include <stdint.h>

typedef struct film {
    outfile file;
    uint32_t rate; /* pictures in a second */
    uint32_t n_pictures, n_written;
    uint32_t n_parts; /* numbered so far: the format numbers what it adds to PNG */
} film;

/* Begins a film of n pictures, which is played again and again. False: a message is on stderr. */
bool film_open(film *out, const char *name, uint32_t n_pictures, uint32_t rate);

/* Adds an encoded PNG picture. All have the same size and colours. */
void film_add(film *f, const unsigned char *png, size_t n);

/* Ends the film. False: a message is on stderr, and nothing is left behind. */
bool film_close(film *f);

/* Gives the film up. */
void film_abandon(film *f);

#endif
