/* Numbers as bytes, whatever the order of the machine. */
#ifndef BYTES_H
#define BYTES_H

#include <stddef.h>
#include <stdint.h>

/* A whole number of n bytes, n at most 4, the least significant first. */
uint32_t little_endian(const char *bytes, size_t n);

/* A float of four bytes. */
float little_endian_float(const char *bytes);

/* A whole number of n bytes, n at most 8, a float and a double, the most significant byte first. */
uint64_t big_endian(const char *bytes, size_t n);
float big_endian_float(const char *bytes);
double big_endian_double(const char *bytes);

/* The four bytes of a number, the least significant first. */
void put_little_endian(unsigned char out[4], uint32_t value);

/* The four bytes of a float. */
void put_little_endian_float(char *out, float value);

#endif
