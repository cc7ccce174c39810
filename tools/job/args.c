/* Parses the command line by the table of options. */
#include "job/args.h"

#include "base/guess.h"
#include "base/number.h"
#include "base/say.h"
#include "job/option_table.h"

#include <stdio.h>
#include <string.h>

/* The state of reading. */
typedef struct reading {
    args *out;
    const command *command;
    int argc, at;
    char **argv;
    int *help;
} reading;

static bool *flag_at(args *a, size_t offset)
{
    return (bool *)((char *)a + offset);
}

static int set_choice(reading *r, const option *o, const char *value)
{
    char list[128] = "";
    for (const choice *c = o->choices; c->name != NULL; c++) {
        if (strcmp(c->name, value) == 0 && c->value == 0)
            return misused(r->command->name, "--%s %s is not available in this version", o->name,
                           value);
        if (strcmp(c->name, value) == 0) {
            *(int32_t *)((char *)r->out + o->offset) = c->value;
            return DONE;
        }
        if (c->value != 0)
            snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", *list ? ", " : "",
                     c->name);
    }
    return misused(r->command->name, "--%s '%.40s' is unknown; it may be: %s", o->name, value,
                   list);
}

static int set_count(reading *r, const option *o, const char *value)
{
    double number;
    if (number_parse(value, &number) != NUMBER_OK || number < o->low || number > o->high ||
        number != (double)(int32_t)number)
        return misused(r->command->name, "--%s '%.40s' must be a whole number from %d to %d",
                       o->name, value, (int)o->low, (int)o->high);
    *(int32_t *)((char *)r->out + o->offset) = (int32_t)number;
    return DONE;
}

static int set_length(reading *r, const option *o, const char *value)
{
    double *length = (double *)((char *)r->out + o->offset);
    char most[32] = "";
    if (o->most > 0)
        snprintf(most, sizeof most, " and at most %g", o->most);
    if (number_parse(value, length) != NUMBER_OK || *length < 0 || (*length <= 0 && !o->zero) ||
        (o->most > 0 && *length > o->most))
        return misused(r->command->name, "--%s '%.40s' must be a number %s 0%s", o->name, value,
                       o->zero ? "of at least" : "above", most);
    return DONE;
}

static int set_functions(reading *r, const char *value)
{
    problem wrong;
    r->out->n_functions = functions_parse(r->out->functions, value, &wrong);
    return r->out->n_functions > 0 ? DONE : misused(r->command->name, "%s", wrong.text);
}

static int set_point(reading *r, const option *o, const char *value)
{
    double *at = (double *)((char *)r->out + o->offset);
    size_t n = 0;
    bool good = true, more = true;
    for (const char *p = value; good && more; p += more) {
        good = n < ICC_MAX_DIM && number_read(&p, &at[n++]) == NUMBER_OK;
        more = *p == ',';
        good = good && (more || *p == '\0');
    }
    if (!good)
        return misused(r->command->name, "--%s '%.40s' must be numbers X,Y or X,Y,Z and so on",
                       o->name, value);
    *(size_t *)((char *)r->out + o->present) = n;
    return DONE;
}

/* Reads RRGGBB with or without alpha, two digits a channel. Other programs print a # before it, so
 * that is accepted. */
static int set_colour(reading *r, const option *o, const char *value)
{
    static const char digits[] = "0123456789abcdef";
    unsigned char *rgba = (unsigned char *)r->out + o->offset;
    const char *p = value + (*value == '#');
    size_t n = strlen(p);
    bool good = n == 6 || n == 8;
    rgba[3] = 255;
    for (size_t i = 0; good && i < n; i++) {
        const char *digit = strchr(digits, p[i] >= 'A' && p[i] <= 'F' ? p[i] | 0x20 : p[i]);
        good = digit != NULL;
        if (good)
            rgba[i / 2] = (unsigned char)(i % 2 == 0 ? 16 * (digit - digits)
                                                     : rgba[i / 2] + (digit - digits));
    }
    if (!good)
        return misused(r->command->name, "--%s '%.40s' must be a colour RRGGBB or RRGGBBAA",
                       o->name, value);
    *flag_at(r->out, o->present) = true;
    return DONE;
}

static int add_file(reading *r, const option *o, const char *value)
{
    file_list *files = (file_list *)((char *)r->out + o->offset);
    if (files->n == MAX_FILES)
        return misused(r->command->name, "--%s takes at most %d files", o->name, (int)MAX_FILES);
    files->names[files->n++] = value;
    return DONE;
}

static int set_value(reading *r, const option *o, const char *value)
{
    switch (o->kind) {
    case OPTION_COUNT:
        return set_count(r, o, value);
    case OPTION_LENGTH:
        return set_length(r, o, value);
    case OPTION_CHOICE:
        return set_choice(r, o, value);
    case OPTION_FUNCTIONS:
        return set_functions(r, value);
    case OPTION_POINT:
        return set_point(r, o, value);
    case OPTION_COLOUR:
        return set_colour(r, o, value);
    case OPTION_FILES:
        return add_file(r, o, value);
    default:
        *(const char **)((char *)r->out + o->offset) = value;
        return DONE;
    }
}

/* Takes an option, with the text after '=' or NULL. */
static int take_option(reading *r, const option *o, const char *attached)
{
    if (o->kind == OPTION_REPORT) {
        *flag_at(r->out, o->offset) = true;
        *(const char **)((char *)r->out + o->present) = attached != NULL ? attached : "-";
        return DONE;
    }
    if (o->kind == OPTION_WITH_LENGTH) {
        option length = *o;
        length.offset = o->present;
        *flag_at(r->out, o->offset) = true;
        return attached != NULL ? set_length(r, &length, attached) : DONE;
    }
    if (o->kind == OPTION_WITH_CHOICE) {
        option named = *o;
        named.offset = o->present;
        *flag_at(r->out, o->offset) = true;
        return attached != NULL ? set_choice(r, &named, attached) : DONE;
    }
    if (o->kind == OPTION_FLAG || o->kind == OPTION_HELP) {
        if (attached != NULL)
            return misused(r->command->name, "--%s takes no value", o->name);
        if (o->kind == OPTION_HELP)
            *r->help = o->low;
        else
            *flag_at(r->out, o->offset) = true;
        return DONE;
    }
    if (attached == NULL && r->at == r->argc)
        return misused(r->command->name, "--%s needs a value: %s", o->name, o->value);
    return set_value(r, o, attached != NULL ? attached : r->argv[r->at++]);
}

static bool is_name(const char *name, const char *text, size_t n)
{
    return name != NULL && strlen(name) == n && strncmp(name, text, n) == 0;
}

static const option *find_long(const command *c, const char *name, size_t n)
{
    for (size_t i = 0; i < n_options; i++)
        if (options[i].commands & c->bit &&
            (is_name(options[i].name, name, n) || is_name(options[i].former, name, n)))
            return &options[i];
    return NULL;
}

static const option *find_short(const command *c, char letter)
{
    for (size_t i = 0; i < n_options; i++)
        if (options[i].commands & c->bit && options[i].letter == letter)
            return &options[i];
    return NULL;
}

static int no_option(const command *c, const char *text, size_t n)
{
    guess near = {0};
    guess_text said;
    for (size_t i = 0; i < n_options; i++)
        if (options[i].commands & c->bit)
            guess_try(&near, text, n, options[i].name);
    return misused(c->name, "there is no option --%.40s%s", text, guess_say(said, &near, "--"));
}

static int take_long(reading *r, const char *text)
{
    size_t n = strcspn(text, "=");
    const option *o = find_long(r->command, text, n);
    if (o == NULL && strcmp(text, "mesh") == 0)
        return misused(r->command->name, "--%s is not available in this version", text);
    if (o == NULL)
        return no_option(r->command, text, n);
    return take_option(r, o, text[n] == '=' ? text + n + 1 : NULL);
}

/* Takes short options: -q, -qi, -o FILE and -oFILE. */
static int take_short(reading *r, const char *text)
{
    for (; *text != '\0'; text++) {
        const option *o = find_short(r->command, *text);
        if (o == NULL)
            return misused(r->command->name, "there is no option -%c",
                           *text > 32 && *text < 127 ? *text : '?');
        bool alone = o->kind == OPTION_FLAG || o->kind == OPTION_HELP;
        int result = take_option(r, o, !alone && text[1] != '\0' ? text + 1 : NULL);
        if (result != DONE || !alone)
            return result;
    }
    return DONE;
}

static int take_operand(reading *r, char *text)
{
    const command *c = r->command;
    size_t n = c->n_operands + c->n_operands_more;
    size_t most = c->n_operands_geojson > n ? c->n_operands_geojson : n;
    if (r->out->n_operands == most)
        return misused(c->name, "'%.60s' is one argument too many", text);
    r->out->operands[r->out->n_operands++] = text;
    return DONE;
}

int args_parse(args *out, const command *c, int argc, char **argv, int *help)
{
    *out = (args){
        .program = argv[0], .command = c->name, .operands = argv + 2, .improve = -1, .snap = -1};
    *help = HELP_NONE;
    reading r = {.out = out, .command = c, .argc = argc, .at = 2, .argv = argv, .help = help};
    bool only_operands = false;
    int result = DONE;
    while (r.at < argc && result == DONE && !*help) {
        char *text = argv[r.at++];
        if (only_operands || text[0] != '-' || text[1] == '\0')
            result = take_operand(&r, text);
        else if (strcmp(text, "--") == 0)
            only_operands = true;
        else
            result = text[1] == '-' ? take_long(&r, text + 2) : take_short(&r, text + 1);
    }
    if (result != DONE || *help)
        return result;
    return args_check(out, c);
}
