/* A report in JSON, written member by member. */
#ifndef JSON_H
#define JSON_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct json {
    FILE *stream;
    size_t depth;
    bool first; /* the innermost object or list is empty until now */
} json;

/* Each takes the name of a member, or NULL inside a list. */
void json_open(json *j, const char *name, char bracket); /* '{' or '[' */
void json_close(json *j, char bracket);                  /* '}' or ']' */
void json_text(json *j, const char *name, const char *value);
void json_count(json *j, const char *name, size_t value);
void json_flag(json *j, const char *name, bool value);
void json_number(json *j, const char *name, double value); /* writes null if it is not finite */
/* A value that is JSON already. */
void json_raw(json *j, const char *name, const char *text, size_t n);

/* Writes a string alone. */
void json_string(FILE *stream, const char *text);

#endif
