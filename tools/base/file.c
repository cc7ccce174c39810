/* Whole files in memory, and output files that are replaced in a single step. */
#include "base/file.h"

#include "base/allocate.h"
#include "base/gltf_pack.h"
#include "base/say.h"
#include "base/system.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* The first n characters of a text; free() them. */
static char *text_copy(const char *text, size_t n)
{
    char *copy = need(n + 1, 1);
    memcpy(copy, text, n);
    copy[n] = '\0';
    return copy;
}

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

char *file_read_shape(const char *name, size_t *n)
{
    char *text = file_read(name, n);
    problem wrong;
    if (text == NULL || !gltf_told(text, *n))
        return text;
    char *packed = gltf_pack(name, text, *n, n, &wrong);
    if (packed == NULL && wrong.text[0] != '\0')
        failed(name, wrong.line, "%s", wrong.text);
    free(text);
    return packed;
}

/* The text after the first # before which a file is named; NULL: the whole name is a file's. */
static const char *choice_in(const char *name)
{
    for (const char *mark = strchr(name, '#'); mark != NULL && !system_exists(name);
         mark = strchr(mark + 1, '#')) {
        char *file = text_copy(name, (size_t)(mark - name));
        bool found = strcmp(file, "-") == 0 || system_exists(file);
        free(file);
        if (found)
            return mark + 1;
    }
    return NULL;
}

char *file_chosen_name(const char *name)
{
    const char *choice = choice_in(name);
    return text_copy(name, choice != NULL ? (size_t)(choice - 1 - name) : strlen(name));
}

char *file_read_chosen(const char *name, size_t *n, const char **choice)
{
    char *file = file_chosen_name(name);
    *choice = choice_in(name);
    char *text = file_read_shape(file, n);
    free(file);
    return text;
}

bool file_is_same(const char *input, const char *output)
{
    return system_is_same(strcmp(input, "-") == 0 ? NULL : input,
                          strcmp(output, "-") == 0 ? NULL : output);
}

bool outfile_open(outfile *out, const char *name)
{
    bool standard = strcmp(name, "-") == 0;
    *out = (outfile){.name = standard ? STANDARD_OUTPUT : name};
    out->place = standard ? NULL : system_place(name);
    if (standard)
        out->stream = stdout;
    else if (out->place != NULL)
        out->stream = system_open_beside(out->place, &out->temporary);
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
    if (good && out->temporary != NULL && !system_replace(out->temporary, out->place)) {
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
