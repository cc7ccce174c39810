/* Formats messages, and cleans them of unprintable characters. */
#include "base/say.h"

#include <stdio.h>
#include <string.h>

int spoilt(problem *out, size_t line, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    out->line = line;
    vsnprintf(out->text, sizeof out->text, format, list);
    va_end(list);
    return 0;
}

/* Prints a message as one line, whatever characters are in file names. */
static void print_line(const char *text)
{
    fputs("libicc: ", stderr);
    for (const char *c = text; *c != '\0'; c++)
        fputc(*c == '\n' || *c == '\r' ? ' ' : *c, stderr);
    fputc('\n', stderr);
}

int failed(const char *file, size_t line, const char *format, ...)
{
    char text[4096];
    size_t used = 0;
    if (file != NULL) {
        const char *shown = strcmp(file, "-") == 0 ? "standard input" : file;
        int n = line > 0 ? snprintf(text, 3072, "%s:%zu: ", shown, line)
                         : snprintf(text, 3072, "%s: ", shown);
        used = n < 0 ? 0 : n >= 3072 ? 3071 : (size_t)n;
    }
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, sizeof text - used, format, list);
    va_end(list);
    print_line(text);
    return FAILED;
}

int misused(const char *command, const char *format, ...)
{
    char text[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    fprintf(stderr, "libicc: %s (see 'libicc %s%s--help')\n", text, command ? command : "",
            command ? " " : "");
    return MISUSED;
}

void note(const char *format, ...)
{
    char text[4096];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    print_line(text);
}

const char *quoted(char out[32], const char *word)
{
    size_t n = 0;
    while (n < 24 && word[n] != '\0' && strchr(" \t\r\n", word[n]) == NULL) {
        out[n] = word[n] > 32 && word[n] < 127 ? word[n] : '?';
        n++;
    }
    out[n] = '\0';
    return out;
}

size_t line_of(const char *text, const char *at)
{
    size_t line = 1;
    for (const char *p = text; p < at; p++)
        line += *p == '\n';
    return line;
}

const char *elements_name(int32_t dim)
{
    return dim == 2 ? "triangles" : dim == 3 ? "tetrahedra" : "simplices";
}
