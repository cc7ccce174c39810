/* libicc demo: writes a pair of cages and a picture to try the other commands with, and prints
 * these commands. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "base/file.h"
#include "base/say.h"
#include "base/system.h"
#include "cmd/demo_picture.h"
#include "plot/picture_file.h"

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

/* Prints a word quoted for a shell. */
static void print_word(const char *text)
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

/* Prints a line to try, with this program in front of its arguments. */
static void print_call(const char *program, const char *lead, const char *arguments)
{
    printf("  %s", lead);
    print_word(program);
    printf(" %s\n", arguments);
}

/* Prints what to try next. The commands run inside the folder, so they are short, and they call
 * this program as the user called it. */
static void print_next(const char *folder, const char *program)
{
    fputs("In ", stdout);
    print_word(folder);
    puts(" are a picture, fish.png, and two cages: a polygon round the fish,\n"
         "before.txt, and where its corners go, after.txt. To try next:\n");
    fputs("  cd ", stdout);
    print_word(folder);
    puts("\n\nIs the map from one cage to the other one-to-one?");
    print_call(program, "", "check -s before.txt -t after.txt");
    puts("\nBend the fish; look at bent.png:");
    print_call(program, "",
               "warp -s before.txt -t after.txt --background 78b9d7 fish.png bent.png");
    puts("\nSee what becomes of a checkerboard; look at map.svg:");
    print_call(program, "", "plot -s before.txt -t after.txt --y-down map.svg");
    puts("\nWhere does the eye go, and back?");
    print_call(program, "echo 358 140 | ", "map -s before.txt -t after.txt >eye.txt; cat eye.txt");
    print_call(program, "", "map -s before.txt -t after.txt --inverse <eye.txt");
    puts(
        "\nMake a film of it, from before to after in 24 steps; look at film-0000.png and\nso on:");
    print_call(program, "",
               "animate -s before.txt --steps 24 --background 78b9d7 fish.png film.png "
               "before.txt after.txt");
    puts("\nMove corners in after.txt, a text file, and warp again. See what else there is:");
    print_call(program, "", "help");
}

int run_demo(const args *a)
{
    const char *folder = a->n_operands > 0 ? a->operands[0] : "libicc-demo";
    if (!system_make_folder(folder))
        return failed(folder, 0, "cannot be made: %s%s", strerror(errno),
                      errno == EEXIST ? "; 'libicc demo FOLDER' makes another" : "");
    int result = write_cage(folder, "before.txt", before);
    if (result == DONE)
        result = write_cage(folder, "after.txt", after);
    if (result == DONE)
        result = write_picture(folder);
    if (result == DONE) {
        char *program = system_program(a->program);
        print_next(folder, program);
        free(program);
    }
    return result;
}
