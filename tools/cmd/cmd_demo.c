/* libicc demo: writes a pair of cages and a picture to try the other commands with, and prints
 * these commands. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/file.h"
#include "base/say.h"
#include "base/system.h"
#include "cmd/demo_picture.h"
#include "picture/picture_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { N_VERTICES = 12 };

/* Around the fish, which swims to the right, before and after it bends. */
static const int before[N_VERTICES][2] = {{30, 55},   {115, 105}, {190, 62},  {262, 40},
                                          {345, 72},  {425, 160}, {345, 248}, {262, 275},
                                          {190, 258}, {115, 215}, {30, 265},  {58, 160}};
static const int after[N_VERTICES][2] = {{92, 58},   {136, 134}, {200, 106}, {252, 86},
                                         {314, 102}, {414, 146}, {373, 262}, {274, 312},
                                         {180, 296}, {100, 238}, {8, 234},   {65, 162}};

/* `NAME` in the folder; free() it. */
static char *inside(const char *folder, const char *name)
{
    size_t n = strlen(folder) + strlen(name) + 2;
    char *path = need(n, 1);
    snprintf(path, n, "%s/%s", folder, name);
    return path;
}

static int write_cage(const char *folder, const char *name, const int vertices[][2])
{
    char *path = inside(folder, name);
    int result = FAILED;
    outfile file;
    if (outfile_open(&file, path)) {
        for (size_t i = 0; i < N_VERTICES; i++)
            fprintf(file.stream, "%d %d\n", vertices[i][0], vertices[i][1]);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    free(path);
    return result;
}

static int write_picture(const char *folder)
{
    char *path = inside(folder, "fish.png");
    picture p = demo_picture();
    int result = picture_save(&p, &(picture_style){.format = PICTURE_PNG, .notes = &p.notes}, path);
    picture_free(&p);
    free(path);
    return result;
}

/* Prints a file of the folder after a blank. */
static void print_file(const char *folder, const char *name)
{
    char *path = inside(folder, name);
    putchar(' ');
    system_print_word(path);
    free(path);
}

/* Prints a line to try, without its end: this program as the user called it, a command, and its two
 * cages. It works in the folder that the user is in. */
static void print_call(const args *a, const char *folder, const char *lead, const char *name)
{
    printf("  %s", lead);
    system_print_word(a->program);
    printf(" %s -s", name);
    print_file(folder, "before.txt");
    fputs(" -t", stdout);
    print_file(folder, "after.txt");
}

/* The film begins with the cage before, so both cages are on its path. */
static void print_film(const args *a, const char *folder)
{
    fputs("\nMake a film from before to after in 24 steps. Look at film-0000.png and so on:\n  ",
          stdout);
    system_print_word(a->program);
    fputs(" animate -s", stdout);
    print_file(folder, "before.txt");
    fputs(" --steps 24 --background 78b9d7", stdout);
    static const char *const files[] = {"fish.png", "film.png", "before.txt", "after.txt"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        print_file(folder, files[i]);
    putchar('\n');
}

/* Prints commands that map a point and its image back. */
static void print_points(const args *a, const char *folder)
{
    puts("\nWhere does the eye go, and where does its image come from?");
    print_call(a, folder, "echo 358 140 | ", "map");
    fputs(" -o", stdout);
    print_file(folder, "eye.txt");
    putchar('\n');
    print_call(a, folder, "", "map");
    fputs(" --inverse -p", stdout);
    print_file(folder, "eye.txt");
    putchar('\n');
}

/* Prints what to try next. */
static void print_next(const args *a, const char *folder)
{
    fputs("The folder ", stdout);
    system_print_word(folder);
    puts(" now holds a picture, fish.png, and two cages.\n"
         "before.txt is a polygon around the fish, and after.txt says where its corners\n"
         "go. Try these commands:\n\nBend the fish. Look at bent.png:");
    print_call(a, folder, "", "warp");
    fputs(" --background 78b9d7", stdout);
    print_file(folder, "fish.png");
    print_file(folder, "bent.png");
    puts("\n\nIs the map from one cage to the other one-to-one?");
    print_call(a, folder, "", "check");
    puts("\n\nSee what becomes of a checkerboard. Look at map.svg:");
    print_call(a, folder, "", "plot");
    fputs(" --y-down", stdout);
    print_file(folder, "map.svg");
    putchar('\n');
    print_points(a, folder);
    print_film(a, folder);
    puts("\nMove corners in after.txt, a text file, and warp again. For the other commands:");
    fputs("  ", stdout);
    system_print_word(a->program);
    puts(" help");
}

int run_demo(const args *a)
{
    const char *folder = a->n_operands > 0 ? a->operands[0] : "libicc-demo";
    if (!system_make_folder(folder))
        return failed(folder, 0, "cannot be made: %s%s", strerror(errno),
                      errno == EEXIST ? "; choose another name: libicc demo FOLDER" : "");
    int result = write_cage(folder, "before.txt", before);
    if (result == DONE)
        result = write_cage(folder, "after.txt", after);
    if (result == DONE)
        result = write_picture(folder);
    if (result == DONE)
        print_next(a, folder);
    return result;
}
