/* Numbers as text. The program never calls setlocale(), so strtod() and printf() stay in the "C"
 * locale: a point is a point everywhere. */
#ifndef NUMBER_H
#define NUMBER_H

typedef enum number_kind {
    NUMBER_OK,
    NUMBER_NOT_FINITE, /* nan, inf, or too large for a double */
    NUMBER_BAD         /* no number */
} number_kind;

/* Reads a decimal number at *cursor ([+-]digits[.digits][e[+-]digits], or nan/inf/infinity in any
 * case) and moves *cursor behind it; leaves *cursor alone when there is none. What follows is for
 * the caller to judge. The text must end with a '\0'. */
number_kind number_read(const char **cursor, double *value);

/* Reads a whole string as a number. */
number_kind number_parse(const char *text, double *value);

#endif
