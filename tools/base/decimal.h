/* Converts between doubles and decimal text, with the same bytes and the same numbers as printf()
 * and strtod(), but several times as fast. */
#ifndef DECIMAL_H
#define DECIMAL_H

#include <stddef.h>

enum { DECIMAL_ROOM = 32 }; /* bytes for any number and its '\0' */

/* Writes a number as printf("%.17g"). Returns the length. */
size_t decimal_write(char text[DECIMAL_ROOM], double value);

/* The same with 15 digits if these read back as the same number. */
size_t decimal_write_short(char text[DECIMAL_ROOM], double value);

/* Reads the number at p as strtod(p, NULL). */
double decimal_read(const char *p);

#endif
