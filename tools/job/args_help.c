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
static void print_group(const command *c, bool papers, const char *heading)
{
    for (size_t i = 0; i < n_options; i++) {
        const option *o = &options[i];
        if (!(o->commands & c->bit) || o->papers != papers)
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

void args_help(const command *c)
{
    print_usage(c);
    printf("%s.\n\n", c->summary);
    help_paragraphs(c->details);
    print_group(c, false, "\nOptions:\n");
    print_group(c, true,
                c->bit & FOR_KERNEL ? "\nOptions of the thesis' method:\n"
                                    : "\nOptions of the papers' method (--method gradient):\n");
}
