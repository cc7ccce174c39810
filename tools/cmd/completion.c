/* Each shell reads a file in its own language. If an option has choices, their names are offered,
 * otherwise files. Options are offered after a dash.
 *
 * bash: https://www.gnu.org/software/bash/manual/html_node/Programmable-Completion.html zsh:
 * zshcompsys(1), _arguments; fish: https://fishshell.com/docs/current/cmds/complete.html */
#include "cmd/completion.h"

#include "base/say.h"
#include "job/option_table.h"

#include <stdio.h>
#include <string.h>

/* Prints text within single quotes. For zsh it escapes brackets and colons, which _arguments would
 * interpret. */
static void print_quoted(const char *text, const char *special)
{
    for (const char *c = text; *c != '\0'; c++)
        if (*c == '\'')
            fputs("'\\''", stdout);
        else
            printf("%s%c", strchr(special, *c) != NULL ? "\\" : "", *c);
}

static void print_names(const choice *choices)
{
    for (const choice *c = choices; c->name != NULL; c++)
        if (c->value != 0)
            printf("%s%s", c == choices ? "" : " ", c->name);
}

static bool has(const command *c, const option *o)
{
    return (o->commands & c->bit) != 0;
}

static void print_commands(size_t n, const command *commands)
{
    for (size_t i = 0; i < n; i++)
        printf("%s ", commands[i].name);
    fputs("help completion", stdout);
}

/* Prints two lists by `case`: what may follow an option of a command, and the options of a
 * command. */
static void print_bash(size_t n, const command *commands)
{
    fputs("_libicc() {\n"
          "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\n"
          "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n        words='",
          stdout);
    print_commands(n, commands);
    fputs(" --help --version'\n    else\n        case \"${COMP_WORDS[1]} $before\" in\n", stdout);
    for (const command *c = commands; c < commands + n; c++)
        for (size_t i = 0; i < n_options; i++) {
            const option *o = &options[i];
            if (!has(c, o) || o->choices == NULL)
                continue;
            printf("        '%s --%s'", c->name, o->name);
            if (o->letter != '\0')
                printf(" | '%s -%c'", c->name, o->letter);
            fputs(") words='", stdout);
            print_names(o->choices);
            fputs("' ;;\n", stdout);
        }
    fputs("        'help '*) words='", stdout);
    print_commands(n, commands);
    fputs("' ;;\n        'completion '*) words='bash zsh fish' ;;\n        esac\n    fi\n"
          "    case \"${COMP_WORDS[1]} $word\" in\n",
          stdout);
    for (const command *c = commands; c < commands + n; c++) {
        printf("    '%s -'*) words='", c->name);
        for (size_t i = 0; i < n_options; i++)
            if (has(c, &options[i]))
                printf("--%s ", options[i].name);
        fputs("' ;;\n", stdout);
    }
    fputs("    esac\n"
          "    [ -z \"$words\" ] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
          "}\n"
          "complete -o default -F _libicc libicc\n",
          stdout);
}

/* '(-s --source)'{-s,--source}'[help]:VALUE:_files' */
static void print_zsh_option(const option *o)
{
    fputs("            ", stdout);
    if (o->letter != '\0')
        printf("'(-%c --%s)'{-%c,--%s}", o->letter, o->name, o->letter, o->name);
    else
        printf("--%s", o->name);
    fputs("'[", stdout);
    print_quoted(o->help, "[]:");
    fputs("]", stdout);
    if (option_takes_word(o)) {
        fputs(":", stdout);
        print_quoted(o->value, "[]:");
        fputs(o->choices != NULL ? ":(" : option_is_file(o) ? ":_files" : ": ", stdout);
        if (o->choices != NULL) {
            print_names(o->choices);
            fputs(")", stdout);
        }
    }
    fputs("' \\\n", stdout);
}

/* Offers commands by _describe. After one of them, which then counts as the first word, _arguments
 * offers its options. */
static void print_zsh(size_t n, const command *commands)
{
    fputs("#compdef libicc\n"
          "_libicc() {\n"
          "    local -a commands\n"
          "    commands=(\n",
          stdout);
    for (const command *c = commands; c < commands + n; c++) {
        printf("        '%s:", c->name);
        print_quoted(c->summary, "");
        fputs("'\n", stdout);
    }
    fputs("        'help:Describes a command'\n"
          "        'completion:Prints what a shell needs for completion'\n"
          "    )\n"
          "    if ((CURRENT == 2)); then\n"
          "        _describe command commands\n"
          "        return\n"
          "    fi\n"
          "    local command=$words[2]\n"
          "    shift words\n"
          "    ((CURRENT--))\n"
          "    case $command in\n"
          "        help) _describe command commands ;;\n"
          "        completion) _values shell bash zsh fish ;;\n",
          stdout);
    for (const command *c = commands; c < commands + n; c++) {
        printf("        %s) _arguments \\\n", c->name);
        for (size_t i = 0; i < n_options; i++)
            if (has(c, &options[i]))
                print_zsh_option(&options[i]);
        fputs("            '*:file:_files' ;;\n", stdout);
    }
    fputs("    esac\n"
          "}\n"
          "_libicc \"$@\"\n",
          stdout);
}

static void print_fish_option(const command *c, const option *o)
{
    printf("complete -c libicc -n '__fish_seen_subcommand_from %s' -l %s", c->name, o->name);
    if (o->letter != '\0')
        printf(" -s %c", o->letter);
    if (option_takes_word(o) && o->choices != NULL) {
        fputs(" -x -a '", stdout);
        print_names(o->choices);
        fputs("'", stdout);
    } else if (option_takes_word(o)) {
        fputs(option_is_file(o) ? " -r" : " -x", stdout);
    }
    fputs(" -d '", stdout);
    print_quoted(o->help, "");
    fputs("'\n", stdout);
}

static void print_fish_command(const char *name, const char *summary)
{
    printf("complete -c libicc -n __fish_use_subcommand -f -a %s -d '", name);
    print_quoted(summary, "");
    fputs("'\n", stdout);
}

/* Prints a line for each command and for each option of a command. */
static void print_fish(size_t n, const command *commands)
{
    for (const command *c = commands; c < commands + n; c++)
        print_fish_command(c->name, c->summary);
    print_fish_command("help", "Describes a command");
    print_fish_command("completion", "Prints what a shell needs for completion");
    fputs("complete -c libicc -n '__fish_seen_subcommand_from help' -f -a '", stdout);
    print_commands(n, commands);
    fputs(
        "'\ncomplete -c libicc -n '__fish_seen_subcommand_from completion' -f -a 'bash zsh fish'\n",
        stdout);
    for (const command *c = commands; c < commands + n; c++)
        for (size_t i = 0; i < n_options; i++)
            if (has(c, &options[i]))
                print_fish_option(c, &options[i]);
}

int completion_print(const char *shell, size_t n, const command *commands)
{
    if (shell != NULL && strcmp(shell, "bash") == 0)
        print_bash(n, commands);
    else if (shell != NULL && strcmp(shell, "zsh") == 0)
        print_zsh(n, commands);
    else if (shell != NULL && strcmp(shell, "fish") == 0)
        print_fish(n, commands);
    else
        return misused("completion", "for which shell? bash, zsh or fish");
    return DONE;
}
