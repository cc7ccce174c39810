/* Numbers as bytes, the least significant first, whatever the order of the machine. */
#ifndef BYTES_H
#define BYTES_H

#include <stddef.h>
#include <stdint.h>

/* A whole number of n bytes, n at most 4. */
uint32_t little_endian(const char *bytes, size_t n);

/* A float of four bytes. */
float little_endian_float(const char *bytes);

/* The four bytes of a number. */
void put_little_endian(unsigned char out[4], uint32_t value);

#endif
