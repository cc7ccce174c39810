/* Converts numbers to and from bytes, independently of the machine's byte order. */
#ifndef BYTES_H
#define BYTES_H

#include <stddef.h>
#include <stdint.h>

/* Reads an integer of n bytes, n at most 4, the least significant byte first. */
uint32_t little_endian(const char *bytes, size_t n);

/* Reads a float of four bytes in the same order. */
float little_endian_float(const char *bytes);

/* Read an integer of n bytes, n at most 8, a float and a double, the most significant byte
 * first. */
uint64_t big_endian(const char *bytes, size_t n);
float big_endian_float(const char *bytes);
double big_endian_double(const char *bytes);

/* Writes the four bytes of a number, the least significant first. */
void put_little_endian(unsigned char out[4], uint32_t value);

/* Writes the four bytes of a float in the same order. */
void put_little_endian_float(char *out, float value);

#endif
