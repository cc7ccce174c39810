/* Prints the text of --help in lines of at most 80 columns. */
#include "job/args.h"
#include "job/option_table.h"

#include <stdio.h>
#include <string.h>

enum { COLUMNS = 80, OPTION_COLUMN = 29 };

/* Prints words until `end`, with blanks or line ends between them, as lines that begin at
 * `indent`. The first begins at `column`, where the cursor stands. */
static void print_words(const char *text, const char *end, int indent, int column)
{
    bool first = true;
    for (text += strspn(text, " \n"); text < end; text += strspn(text, " \n")) {
        int n = (int)strcspn(text, " \n");
        if (!first && column + 1 + n > COLUMNS) {
            printf("\n%*s", indent, "");
            column = indent;
        } else if (!first) {
            putchar(' ');
            column++;
        }
        printf("%.*s", n, text);
        column += n;
        text += n;
        first = false;
    }
    putchar('\n');
}

void help_paragraphs(const char *text)
{
    while (*text != '\0') {
        const char *end = text + strcspn(text, "\n");
        bool kept = *text == ' ' || *text == '\n';
        while (!kept && *end == '\n' && end[1] != '\0' && end[1] != ' ' && end[1] != '\n')
            end += 1 + strcspn(end + 1, "\n");
        if (kept)
            printf("%.*s\n", (int)(end - text), text);
        else
            print_words(text, end, 0, 0);
        text = end + (*end == '\n');
    }
}

static void print_option(const option *o)
{
    char letter[8] = "    ";
    if (o->letter != '\0' && !o->quiet_letter)
        snprintf(letter, sizeof letter, "-%c, ", o->letter);
    int n = printf("  %s--%s%s%s", letter, o->name, option_takes_word(o) ? " " : "",
                   o->value ? o->value : "");
    if (n + 2 > OPTION_COLUMN) {
        putchar('\n');
        n = 0;
    }
    printf("%*s", OPTION_COLUMN - n, "");
    print_words(o->help, o->help + strlen(o->help), OPTION_COLUMN, OPTION_COLUMN);
}

/* Prints one group of a command's options, or nothing if it has none of them. */
static void print_group(const command *c, option_group group, const char *heading)
{
    for (size_t i = 0; i < n_options; i++) {
        const option *o = &options[i];
        if (!(o->commands & c->bit) || o->group != group)
            continue;
        printf("%s", heading);
        heading = "";
        print_option(o);
    }
}

/* Prints one line for each way to call the command. A long one continues below its first option. */
static void print_usage(const command *c)
{
    const char *head = "Usage:";
    for (const char *way = c->usage, *end; *way != '\0'; way = end + (*end == '\n')) {
        end = way + strcspn(way, "\n");
        int n = printf("%s libicc %s ", head, c->name);
        print_words(way, end, n, n);
        head = "      ";
    }
}

static bool has_group(const command *c, option_group group)
{
    for (size_t i = 0; i < n_options; i++)
        if (options[i].commands & c->bit && options[i].group == group)
            return true;
    return false;
}

void args_help(const command *c, int help)
{
    bool kernel = (c->bit & FOR_KERNEL) != 0;
    print_usage(c);
    printf("%s.\n\nExample:\n  libicc %s %s\n\n", c->summary, c->name, c->example);
    help_paragraphs(c->details);
    print_group(c, OPTIONS_USUAL, "\nOptions:\n");
    print_group(c, OPTIONS_RARE, "\nFurther options:\n");
    if (help == HELP_ALL)
        print_group(c, OPTIONS_PAPERS,
                    kernel ? "\nOptions of the thesis (how weights are computed):\n"
                           : "\nOptions of the papers' method (--method gradient):\n");
    else if (has_group(c, OPTIONS_PAPERS))
        printf("\n'libicc %s --help-all' also lists the options of the %s.\n", c->name,
               kernel ? "thesis" : "papers' method");
}
