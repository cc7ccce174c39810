#define _XOPEN_SOURCE 700

#include "base/file.h"

#include "base/allocate.h"
#include "base/say.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char *read_stream(FILE *stream, size_t *n)
{
    char *text = NULL;
    size_t room = 0, got;
    *n = 0;
    do {
        text = grow(text, &room, *n + 65536, 1);
        got = fread(text + *n, 1, room - *n - 1, stream);
        *n += got;
    } while (got > 0);
    text[*n] = '\0';
    return text;
}

char *file_read(const char *name, size_t *n)
{
    bool standard = strcmp(name, "-") == 0;
    FILE *stream = standard ? stdin : fopen(name, "rb");
    if (stream == NULL) {
        failed(name, 0, "cannot be opened: %s", strerror(errno));
        return NULL;
    }
    char *text = read_stream(stream, n);
    bool bad = ferror(stream) != 0;
    int why = errno;
    if (!standard)
        fclose(stream);
    if (bad) {
        failed(name, 0, "cannot be read: %s", strerror(why));
        free(text);
        return NULL;
    }
    return text;
}

char *file_read_chosen(const char *name, size_t *n, const char **choice)
{
    *choice = NULL;
    for (const char *mark = strchr(name, '#'); mark != NULL && access(name, F_OK) != 0;
         mark = strchr(mark + 1, '#')) {
        size_t n_file = (size_t)(mark - name);
        char *file = need(n_file + 1, 1);
        memcpy(file, name, n_file);
        bool found = strcmp(file, "-") == 0 || access(file, F_OK) == 0;
        char *text = found ? file_read(file, n) : NULL;
        free(file);
        *choice = found ? mark + 1 : NULL;
        if (found)
            return text;
    }
    return file_read(name, n);
}

bool file_is_same(const char *input, const char *output)
{
    struct stat in, out;
    bool known = (strcmp(input, "-") == 0 ? fstat(STDIN_FILENO, &in) : stat(input, &in)) == 0 &&
                 (strcmp(output, "-") == 0 ? fstat(STDOUT_FILENO, &out) : stat(output, &out)) == 0;
    return known && S_ISREG(in.st_mode) && in.st_dev == out.st_dev && in.st_ino == out.st_ino;
}

/* Where a plain file of this name is or will be, with links followed: a rename onto a link would
 * cut it off from its file. NULL for devices, pipes and links to nowhere, which are written
 * directly. */
static char *find_place(const char *name)
{
    struct stat info;
    if (stat(name, &info) == 0)
        return S_ISREG(info.st_mode) ? realpath(name, NULL) : NULL;
    if (lstat(name, &info) == 0)
        return NULL;
    char *place = need(strlen(name) + 1, 1);
    return strcpy(place, name);
}

static FILE *open_beside(const char *place, char **temporary)
{
    size_t n = strlen(place) + 32;
    char *path = need(n, 1);
    snprintf(path, n, "%s.%ld.part", place, (long)getpid());
    int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    FILE *stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (stream == NULL && descriptor >= 0)
        close(descriptor);
    *temporary = path;
    return stream;
}

bool outfile_open(outfile *out, const char *name)
{
    bool standard = strcmp(name, "-") == 0;
    *out = (outfile){.name = standard ? STANDARD_OUTPUT : name};
    out->place = standard ? NULL : find_place(name);
    if (standard)
        out->stream = stdout;
    else if (out->place != NULL)
        out->stream = open_beside(out->place, &out->temporary);
    else
        out->stream = fopen(name, "wb");
    if (out->stream != NULL)
        return true;
    failed(out->name, 0, "cannot be written: %s", strerror(errno));
    free(out->temporary);
    free(out->place);
    return false;
}

const char *file_write_error(int why)
{
    return why != 0 ? strerror(why) : "an earlier write failed";
}

bool outfile_close(outfile *out)
{
    errno = 0;
    bool good = fflush(out->stream) == 0 && !ferror(out->stream);
    int why = errno;
    if (out->stream != stdout && fclose(out->stream) != 0 && good) {
        good = false;
        why = errno;
    }
    if (good && out->temporary != NULL && rename(out->temporary, out->place) != 0) {
        good = false;
        why = errno;
    }
    if (!good) {
        failed(out->name, 0, "cannot be written: %s", file_write_error(why));
        if (out->temporary != NULL)
            remove(out->temporary);
    }
    free(out->temporary);
    free(out->place);
    return good;
}

void outfile_abandon(outfile *out)
{
    if (out->stream != stdout)
        fclose(out->stream);
    if (out->temporary != NULL)
        remove(out->temporary);
    free(out->temporary);
    free(out->place);
}
