/* Conversion of numbers by shifts, which is independent of the machine's byte order. */
#include "base/bytes.h"

#include <string.h>

uint32_t little_endian(const char *bytes, size_t n)
{
    uint32_t value = 0;
    for (size_t i = n; i-- > 0;)
        value = value << 8 | (unsigned char)bytes[i];
    return value;
}

float little_endian_float(const char *bytes)
{
    uint32_t bits = little_endian(bytes, 4);
    float value;
    memcpy(&value, &bits, 4);
    return value;
}

uint64_t big_endian(const char *bytes, size_t n)
{
    uint64_t value = 0;
    for (size_t i = 0; i < n; i++)
        value = value << 8 | (unsigned char)bytes[i];
    return value;
}

float big_endian_float(const char *bytes)
{
    uint32_t bits = (uint32_t)big_endian(bytes, 4);
    float value;
    memcpy(&value, &bits, 4);
    return value;
}

double big_endian_double(const char *bytes)
{
    uint64_t bits = big_endian(bytes, 8);
    double value;
    memcpy(&value, &bits, 8);
    return value;
}

void put_little_endian(unsigned char out[4], uint32_t value)
{
    for (size_t i = 0; i < 4; i++)
        out[i] = (unsigned char)(value >> 8 * i);
}

void put_little_endian_float(char *out, float value)
{
    uint32_t bits;
    unsigned char bytes[4];
    memcpy(&bits, &value, 4);
    put_little_endian(bytes, bits);
    memcpy(out, bytes, 4);
}
