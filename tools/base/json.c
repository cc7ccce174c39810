/* Writes JSON with commas and escapes in the right places. */
#include "base/json.h"

#include <math.h>

void json_string(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (const char *c = text; *c != '\0'; c++) {
        if (*c == '"' || *c == '\\')
            fputc('\\', stream);
        if ((unsigned char)*c < 32)
            fprintf(stream, "\\u%04x", (unsigned)*c);
        else
            fputc(*c, stream);
    }
    fputc('"', stream);
}

static void begin(json *j, const char *name)
{
    if (j->depth > 0)
        fprintf(j->stream, "%s\n%*s", j->first ? "" : ",", (int)(2 * j->depth), "");
    j->first = false;
    if (name != NULL) {
        json_string(j->stream, name);
        fputs(": ", j->stream);
    }
}

void json_open(json *j, const char *name, char bracket)
{
    begin(j, name);
    fputc(bracket, j->stream);
    j->depth++;
    j->first = true;
}

void json_close(json *j, char bracket)
{
    j->depth--;
    if (!j->first)
        fprintf(j->stream, "\n%*s", (int)(2 * j->depth), "");
    fputc(bracket, j->stream);
    j->first = false;
    if (j->depth == 0)
        fputc('\n', j->stream);
}

void json_text(json *j, const char *name, const char *value)
{
    begin(j, name);
    json_string(j->stream, value);
}

void json_raw(json *j, const char *name, const char *text, size_t n)
{
    begin(j, name);
    fwrite(text, 1, n, j->stream);
}

void json_count(json *j, const char *name, size_t value)
{
    begin(j, name);
    fprintf(j->stream, "%zu", value);
}

void json_flag(json *j, const char *name, bool value)
{
    begin(j, name);
    fputs(value ? "true" : "false", j->stream);
}

void json_number(json *j, const char *name, double value)
{
    begin(j, name);
    if (isfinite(value))
        fprintf(j->stream, "%.17g", value);
    else
        fputs("null", j->stream);
}
