#define _POSIX_C_SOURCE 200809L

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

/* A rename would turn a device or a link into a plain file, so those are written directly. */
static bool is_plain_or_absent(const char *name)
{
    struct stat info;
    return lstat(name, &info) != 0 || S_ISREG(info.st_mode);
}

static FILE *open_beside(const char *name, char **temporary)
{
    size_t n = strlen(name) + 32;
    char *path = need(n, 1);
    snprintf(path, n, "%s.%ld.part", name, (long)getpid());
    int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    FILE *stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (stream == NULL && descriptor >= 0)
        close(descriptor);
    *temporary = path;
    return stream;
}

bool outfile_open(outfile *out, const char *name)
{
    *out = (outfile){.name = name};
    if (strcmp(name, "-") == 0)
        out->stream = stdout;
    else if (is_plain_or_absent(name))
        out->stream = open_beside(name, &out->temporary);
    else
        out->stream = fopen(name, "wb");
    if (out->stream != NULL)
        return true;
    failed(name, 0, "cannot be written: %s", strerror(errno));
    free(out->temporary);
    return false;
}

bool outfile_close(outfile *out)
{
    bool good = fflush(out->stream) == 0 && !ferror(out->stream);
    int why = errno;
    if (out->stream != stdout && fclose(out->stream) != 0 && good) {
        good = false;
        why = errno;
    }
    if (good && out->temporary != NULL && rename(out->temporary, out->name) != 0) {
        good = false;
        why = errno;
    }
    if (!good) {
        failed(out->name, 0, "cannot be written: %s", strerror(why));
        if (out->temporary != NULL)
            remove(out->temporary);
    }
    free(out->temporary);
    return good;
}

void outfile_abandon(outfile *out)
{
    if (out->stream != stdout)
        fclose(out->stream);
    if (out->temporary != NULL)
        remove(out->temporary);
    free(out->temporary);
}
