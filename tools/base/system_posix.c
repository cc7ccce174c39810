/* The functions of system.h for POSIX. */
#define _XOPEN_SOURCE 700

#include "base/system.h"

#include "base/allocate.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

void system_begin(void)
{
}

const char *system_last_part(const char *name)
{
    const char *slash = strrchr(name, '/');
    return slash != NULL ? slash + 1 : name;
}

bool system_exists(const char *name)
{
    return access(name, F_OK) == 0;
}

bool system_is_same(const char *input, const char *output)
{
    struct stat in, out;
    bool known = (input == NULL ? fstat(STDIN_FILENO, &in) : stat(input, &in)) == 0 &&
                 (output == NULL ? fstat(STDOUT_FILENO, &out) : stat(output, &out)) == 0;
    return known && S_ISREG(in.st_mode) && in.st_dev == out.st_dev && in.st_ino == out.st_ino;
}

char *system_place(const char *name)
{
    struct stat info;
    if (stat(name, &info) == 0)
        return S_ISREG(info.st_mode) ? realpath(name, NULL) : NULL;
    if (lstat(name, &info) == 0)
        return NULL;
    char *place = need(strlen(name) + 1, 1);
    return strcpy(place, name);
}

FILE *system_open_beside(const char *place, char **name)
{
    size_t n = strlen(place) + 32;
    *name = need(n, 1);
    snprintf(*name, n, "%s.%ld.part", place, (long)getpid());
    int descriptor = open(*name, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    FILE *stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (stream == NULL && descriptor >= 0)
        close(descriptor);
    return stream;
}

bool system_replace(const char *name, const char *place)
{
    return rename(name, place) == 0;
}

bool system_make_folder(const char *name)
{
    return mkdir(name, 0777) == 0;
}

char *system_make_temporary_folder(void)
{
    const char *parent = getenv("TMPDIR");
    if (parent == NULL || *parent == '\0')
        parent = "/tmp";
    size_t room = strlen(parent) + sizeof "/libicc-XXXXXX";
    char *name = need(room, 1);
    snprintf(name, room, "%s/libicc-XXXXXX", parent);
    if (mkdtemp(name) != NULL)
        return name;
    free(name);
    return NULL;
}

void system_remove_folder(const char *name)
{
    rmdir(name);
}

bool collector_begin(collector *c)
{
    *c = (collector){0};
    c->stream = open_memstream(&c->bytes, &c->n);
    return c->stream != NULL;
}

bool collector_end(collector *c)
{
    bool good = !ferror(c->stream);
    return fclose(c->stream) == 0 && good;
}

double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

size_t system_processors(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n > 0 ? (size_t)n : 1;
}

int system_columns(void)
{
    if (!isatty(STDERR_FILENO))
        return 0;
#ifdef TIOCGWINSZ
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
#endif
    return 80;
}

void system_print_word(const char *text)
{
    static const char plain[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,+=@%";
    if (text[0] != '\0' && text[strspn(text, plain)] == '\0') {
        fputs(text, stdout);
        return;
    }
    putchar('\'');
    for (const char *c = text; *c != '\0'; c++)
        fputs(*c == '\'' ? "'\\''" : (char[]){*c, '\0'}, stdout);
    putchar('\'');
}
