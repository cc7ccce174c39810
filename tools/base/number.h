/* Reads numbers from text. The program never calls setlocale(), so strtod() and printf() stay in
 * the "C" locale, where the decimal sign is always a point. */
#ifndef NUMBER_H
#define NUMBER_H

typedef enum number_kind {
    NUMBER_OK,
    NUMBER_NOT_FINITE, /* nan, inf, or too large for a double */
    NUMBER_BAD         /* not a number */
} number_kind;

/* Reads a decimal number at *cursor ([+-]digits[.digits][e[+-]digits], or nan/inf/infinity in any
 * case) and moves *cursor after it. If there is none, *cursor does not move. The caller judges the
 * text that follows. The text must end with a '\0'. */
number_kind number_read(const char **cursor, double *value);

/* Reads a whole string as a number. */
number_kind number_parse(const char *text, double *value);

#endif
