/* Names and arguments are UTF-8, as libicc.manifest asks for (Windows 10 1903 and newer). */
#define WIN32_LEAN_AND_MEAN

#include "base/system.h"

#include "base/allocate.h"

#include <windows.h>

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <stdlib.h>
#include <string.h>

void system_begin(void)
{
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(_fileno(stdout), _O_BINARY);
    _setmode(_fileno(stderr), _O_BINARY);
    SetConsoleOutputCP(CP_UTF8);
}

const char *system_last_part(const char *name)
{
    const char *part = name;
    for (; *name != '\0'; name++)
        if (strchr("/\\:", *name) != NULL)
            part = name + 1;
    return part;
}

/* Sets errno from the last failure of a Windows function. */
static void set_errno(void)
{
    switch (GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
        errno = ENOENT;
        break;
    case ERROR_ACCESS_DENIED:
    case ERROR_SHARING_VIOLATION:
        errno = EACCES;
        break;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS:
        errno = EEXIST;
        break;
    case ERROR_DISK_FULL:
        errno = ENOSPC;
        break;
    default:
        errno = EIO;
    }
}

bool system_exists(const char *name)
{
    return GetFileAttributesA(name) != INVALID_FILE_ATTRIBUTES;
}

/* Opens a file only to query it. */
static HANDLE look_at(const char *name)
{
    return CreateFileA(name, 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, NULL,
                       OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, NULL);
}

static bool is_plain(HANDLE file, BY_HANDLE_FILE_INFORMATION *info)
{
    return file != INVALID_HANDLE_VALUE && GetFileType(file) == FILE_TYPE_DISK &&
           GetFileInformationByHandle(file, info) &&
           (info->dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) == 0;
}

static bool look_up(const char *name, FILE *standard, BY_HANDLE_FILE_INFORMATION *info)
{
    if (name == NULL)
        return is_plain((HANDLE)_get_osfhandle(_fileno(standard)), info);
    HANDLE file = look_at(name);
    bool plain = is_plain(file, info);
    if (file != INVALID_HANDLE_VALUE)
        CloseHandle(file);
    return plain;
}

bool system_is_same(const char *input, const char *output)
{
    BY_HANDLE_FILE_INFORMATION in, out;
    return look_up(input, stdin, &in) && look_up(output, stdout, &out) &&
           in.dwVolumeSerialNumber == out.dwVolumeSerialNumber &&
           in.nFileIndexHigh == out.nFileIndexHigh && in.nFileIndexLow == out.nFileIndexLow;
}

static char *copy(const char *name)
{
    return strcpy(need(strlen(name) + 1, 1), name);
}

char *system_place(const char *name)
{
    BY_HANDLE_FILE_INFORMATION info;
    HANDLE file = look_at(name);
    if (file == INVALID_HANDLE_VALUE)
        return system_exists(name) ? NULL : copy(name);
    char *place = NULL;
    if (is_plain(file, &info)) {
        DWORD room = GetFinalPathNameByHandleA(file, NULL, 0, FILE_NAME_NORMALIZED);
        place = need((size_t)room + 1, 1);
        if (GetFinalPathNameByHandleA(file, place, room + 1, FILE_NAME_NORMALIZED) == 0) {
            free(place);
            place = copy(name);
        }
    }
    CloseHandle(file);
    return place;
}

FILE *system_open_beside(const char *place, char **name)
{
    size_t n = strlen(place) + 32;
    *name = need(n, 1);
    snprintf(*name, n, "%s.%ld.part", place, (long)_getpid());
    return fopen(*name, "wb");
}

bool system_replace(const char *name, const char *place)
{
    if (MoveFileExA(name, place, MOVEFILE_REPLACE_EXISTING))
        return true;
    set_errno();
    return false;
}

bool system_make_folder(const char *name)
{
    if (CreateDirectoryA(name, NULL))
        return true;
    set_errno();
    return false;
}

char *system_make_temporary_folder(void)
{
    char parent[MAX_PATH + 1];
    DWORD length = GetTempPathA(sizeof parent, parent);
    size_t room = sizeof parent + 64;
    char *name = need(room, 1);
    for (unsigned i = 0; length > 0 && length <= MAX_PATH && i < 1000; i++) {
        snprintf(name, room, "%slibicc-%ld-%u", parent, (long)_getpid(), i);
        if (system_make_folder(name))
            return name;
        if (errno != EEXIST)
            break;
    }
    free(name);
    return NULL;
}

void system_remove_folder(const char *name)
{
    RemoveDirectoryA(name);
}

/* The file disappears when it is closed. T keeps it in memory if there is room; D deletes it. */
bool collector_begin(collector *c)
{
    char folder[MAX_PATH + 1], name[MAX_PATH + 1];
    *c = (collector){0};
    DWORD length = GetTempPathA(sizeof folder, folder);
    if (length > 0 && length <= MAX_PATH && GetTempFileNameA(folder, "icc", 0, name) != 0)
        c->stream = fopen(name, "w+bTD");
    return c->stream != NULL;
}

bool collector_end(collector *c)
{
    long n = fflush(c->stream) == 0 && !ferror(c->stream) ? ftell(c->stream) : -1;
    if (n >= 0) {
        c->n = (size_t)n;
        c->bytes = need(c->n + 1, 1);
        rewind(c->stream);
    }
    bool good = n >= 0 && fread(c->bytes, 1, c->n, c->stream) == c->n;
    return fclose(c->stream) == 0 && good;
}

double seconds_now(void)
{
    LARGE_INTEGER count, frequency;
    QueryPerformanceCounter(&count);
    QueryPerformanceFrequency(&frequency);
    return (double)count.QuadPart / (double)frequency.QuadPart;
}

size_t system_processors(void)
{
    SYSTEM_INFO info;
    GetSystemInfo(&info);
    return info.dwNumberOfProcessors > 0 ? info.dwNumberOfProcessors : 1;
}

/* A console that does not support the sequence for "erase the line" gets no bar. */
int system_columns(void)
{
    HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
    CONSOLE_SCREEN_BUFFER_INFO info;
    DWORD mode;
    if (!GetConsoleMode(console, &mode) || !GetConsoleScreenBufferInfo(console, &info) ||
        !SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING))
        return 0;
    return info.dwSize.X > 0 ? info.dwSize.X : 80;
}

void system_print_word(const char *text)
{
    const char *quote = strpbrk(text, " &()[]{}^=;!'+,`~") != NULL ? "\"" : "";
    printf("%s%s%s", quote, text, quote);
}
