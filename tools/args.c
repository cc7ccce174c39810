#include "args.h"

#include "number.h"
#include "options.h"
#include "say.h"

#include <icc/kernel.h>
#include <stdio.h>
#include <string.h>

/* Where the reading is. */
typedef struct reading {
    args *out;
    const command *command;
    int argc, at;
    char **argv;
    bool *help;
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
    if (number_parse(value, length) != NUMBER_OK || !(*length > 0) ||
        (o->most > 0 && *length > o->most))
        return misused(r->command->name, "--%s '%.40s' must be a number above 0%s", o->name, value,
                       most);
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
    default:
        *(const char **)((char *)r->out + o->offset) = value;
        return DONE;
    }
}

/* An option that was found, with the text behind '=' or NULL. */
static int take_option(reading *r, const option *o, const char *attached)
{
    if (o->kind == OPTION_REPORT) {
        *flag_at(r->out, o->offset) = true;
        *(const char **)((char *)r->out + o->present) = attached != NULL ? attached : "-";
        return DONE;
    }
    if (o->kind == OPTION_FLAG || o->kind == OPTION_HELP) {
        if (attached != NULL)
            return misused(r->command->name, "--%s takes no value", o->name);
        *(o->kind == OPTION_HELP ? r->help : flag_at(r->out, o->offset)) = true;
        return DONE;
    }
    if (attached == NULL && r->at == r->argc)
        return misused(r->command->name, "--%s needs a value: %s", o->name, o->value);
    return set_value(r, o, attached != NULL ? attached : r->argv[r->at++]);
}

static const option *find_long(const command *c, const char *name, size_t n)
{
    for (size_t i = 0; i < N_OPTIONS; i++)
        if (options[i].commands & c->bit && strlen(options[i].name) == n &&
            strncmp(options[i].name, name, n) == 0)
            return &options[i];
    return NULL;
}

static const option *find_short(const command *c, char letter)
{
    for (size_t i = 0; i < N_OPTIONS; i++)
        if (options[i].commands & c->bit && options[i].letter == letter)
            return &options[i];
    return NULL;
}

static int take_long(reading *r, const char *text)
{
    size_t n = strcspn(text, "=");
    const option *o = find_long(r->command, text, n);
    if (o == NULL && strcmp(text, "mesh") == 0)
        return misused(r->command->name, "--%s is not available in this version", text);
    if (o == NULL)
        return misused(r->command->name, "there is no option --%.40s", text);
    return take_option(r, o, text[n] == '=' ? text + n + 1 : NULL);
}

/* -q, -qi, -o FILE and -oFILE. */
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

static int take_operand(reading *r, const char *text)
{
    const command *c = r->command;
    size_t most = c->n_operands_geojson > c->n_operands ? c->n_operands_geojson : c->n_operands;
    if (r->out->n_operands == most)
        return misused(c->name, "'%.60s' is one argument too many", text);
    r->out->operands[r->out->n_operands++] = text;
    return DONE;
}

/* Options that only some methods have. */
static int check_method(const args *a, const command *c)
{
    const char *gradient_only = a->n_functions > 0 ? "function"
                                : a->constrained   ? "constrained"
                                : a->unconstrained ? "unconstrained"
                                : a->eta > 0       ? "eta"
                                : a->solver != 0   ? "solver"
                                : a->tree != 0     ? "tree"
                                : a->elevation     ? "elevation"
                                : a->compression   ? "compression"
                                                   : NULL;
    if (gradient_only != NULL && a->method != ICC_METHOD_GRADIENT)
        return misused(c->name, "--%s needs --method gradient", gradient_only);
    if (a->map == ICC_MAP_MESH && a->method == ICC_METHOD_GRADIENT)
        return misused(c->name, "--map mesh needs a method that can be certified, not gradient");
    if (a->triangles &&
        (a->target == NULL || a->map == ICC_MAP_CURVES || a->method == ICC_METHOD_GRADIENT))
        return misused(c->name, "--triangles needs a map of kind mesh: --target FILE --map mesh");
    if (a->method == ICC_METHOD_DISC && (a->n_maximum > 0 || a->n_target_maximum > 0))
        return misused(c->name, "--method disc has no --maximum: it finds its own");
    return DONE;
}

/* Options that only functions which solve an equation have. */
static int check_functions(const args *a, const command *c)
{
    const char *solved_only = a->constrained     ? "constrained"
                              : a->unconstrained ? "unconstrained"
                              : a->eta > 0       ? "eta"
                              : a->solver != 0   ? "solver"
                                                 : NULL;
    bool solves = false;
    for (size_t i = 0; i < a->n_functions; i++)
        solves = solves || function_solves(a->functions[i].function);
    if (solved_only != NULL && !solves)
        return misused(c->name, "--%s needs --function laplace, bilaplace or clamped", solved_only);
    if (a->constrained && a->unconstrained)
        return misused(c->name, "--constrained and --unconstrained exclude each other");
    if (a->n_functions > 1 && !(c->bit & FOR_PLOT))
        return misused(c->name, "--function takes one name here; only plot takes several");
    return DONE;
}

/* The flags stand for the functions that say nothing themselves. */
static void settle_functions(args *a)
{
    for (size_t i = 0; i < a->n_functions; i++)
        if (a->functions[i].constraints == 0 && function_solves(a->functions[i].function))
            a->functions[i].constraints = a->constrained     ? ICC_CONSTRAINTS_ALL
                                          : a->unconstrained ? ICC_CONSTRAINTS_NONE
                                                             : 0;
}

/* A binding has its points, so that `pose` needs no file with them. */
static bool has_bound(const args *a, const command *c)
{
    return c->bit & FOR_POSE && a->binding != NULL;
}

static int check_operands(const args *a, const command *c)
{
    size_t n_operands = a->geojson ? c->n_operands_geojson : c->n_operands - has_bound(a, c);
    if (a->n_operands < n_operands && a->geojson)
        return misused(c->name, "--geojson needs two files, IN and OUT");
    if (a->n_operands < n_operands)
        return misused(c->name, "usage: libicc %s %s", c->name, c->usage);
    if (a->n_operands > n_operands && has_bound(a, c))
        return misused(c->name, "--binding has its points; it takes one file, OUT");
    if (a->n_operands > n_operands)
        return misused(c->name, "'%.60s' is one argument too many without --geojson",
                       a->operands[0]);
    if (a->geojson && (a->points != NULL || a->output != NULL))
        return misused(c->name, "--points and --output do not go with --geojson IN OUT");
    if (a->repair_mesh && a->inverse)
        return misused(c->name, "--repair does not go with --inverse");
    if (a->tolerance > 0 && !a->geojson)
        return misused(c->name, "--tolerance goes with --geojson only");
    return DONE;
}

static int check_kernel(const args *a, const command *c)
{
    bool bound = has_bound(a, c);
    if (c->bit & FOR_POSE && a->pose == NULL)
        return misused(c->name, "--pose FILE is missing");
    if (a->handles == NULL && !bound)
        return misused(c->name, "--handles FILE is missing");
    if (bound && (a->handles != NULL || a->source != NULL))
        return misused(c->name, "--source and --handles do not go with --binding");
    if (a->n_along > 0 && a->points != NULL)
        return misused(c->name, "--points and --along exclude each other");
    if (a->n_along > 0 && a->n_along != 4 && a->n_along != 6)
        return misused(c->name, "--along must be X0,Y0,X1,Y1 or X0,Y0,Z0,X1,Y1,Z1");
    if (a->picture == NULL && (a->logarithmic || a->handle > 0 || a->y_down))
        return misused(c->name, "--log, --handle and --y-down go with --picture");
    if (a->steps > 0 && a->initial == ICC_INITIAL_INVERSE)
        return misused(c->name, "--steps does not go with --initial inverse");
    if (a->seed > 0 && a->sampling == ICC_SAMPLING_GRID)
        return misused(c->name, "--seed does not go with --sampling grid");
    return DONE;
}

static int check_charts(const args *a, const command *c)
{
    if (a->source == NULL)
        return misused(c->name, "--source FILE is missing");
    if (c->needs_target && a->target == NULL)
        return misused(c->name, "--target FILE is missing");
    int result = check_method(a, c);
    return result == DONE ? check_functions(a, c) : result;
}

static int check_inputs(const args *a, const command *c)
{
    bool has_input = (c->n_operands == 2 || a->geojson) && !has_bound(a, c);
    const char *inputs[] = {a->source,  a->target, a->points ? a->points : a->coords,
                            a->handles, a->pose,   has_bound(a, c) ? a->binding : NULL,
                            has_input ? a->operands[0] : NULL};
    size_t n_standard = 0;
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++)
        n_standard += inputs[i] != NULL && strcmp(inputs[i], "-") == 0;
    if (n_standard > 1)
        return misused(c->name, "only one input can be standard input");
    return DONE;
}

/* What no single option can tell. */
static int check_together(const args *a, const command *c)
{
    int result = c->bit & FOR_KERNEL ? check_kernel(a, c) : check_charts(a, c);
    if (result == DONE)
        result = check_operands(a, c);
    return result == DONE ? check_inputs(a, c) : result;
}

/* Reads come by default from stdin, and results go by default to stdout. */
static int settle_streams(args *a, const command *c)
{
    bool draws = c->bit & FOR_WEIGHTS && (a->picture != NULL || a->n_along > 0);
    if (c->bit & (FOR_MAP | FOR_ENCODE | FOR_WEIGHTS) && a->points == NULL && !a->geojson && !draws)
        a->points = "-";
    if (c->bit & FOR_DECODE && a->coords == NULL)
        a->coords = "-";
    if (c->bit & FOR_WEIGHTS && a->output == NULL && a->picture == NULL && a->binding == NULL)
        a->output = "-";
    const char *result = a->output != NULL || c->bit & FOR_WEIGHTS ? a->output : "-";
    if (c->n_operands > 0 || a->geojson)
        result = a->n_operands > 0 ? a->operands[a->n_operands - 1] : NULL;
    if (a->json && !(c->bit & (FOR_CHECK | FOR_INFO)) && strcmp(a->json_file, "-") == 0 &&
        result != NULL && strcmp(result, "-") == 0)
        return misused(c->name,
                       "result and report cannot both go to standard output; use --json=FILE");
    return DONE;
}

int args_parse(args *out, const command *c, int argc, char **argv, bool *help)
{
    *out = (args){.command = c->name, .improve = -1};
    *help = false;
    reading r = {.out = out, .command = c, .argc = argc, .at = 2, .argv = argv, .help = help};
    bool only_operands = false;
    int result = DONE;
    while (r.at < argc && result == DONE && !*help) {
        const char *text = argv[r.at++];
        if (only_operands || text[0] != '-' || text[1] == '\0')
            result = take_operand(&r, text);
        else if (strcmp(text, "--") == 0)
            only_operands = true;
        else
            result = text[1] == '-' ? take_long(&r, text + 2) : take_short(&r, text + 1);
    }
    if (result != DONE || *help)
        return result;
    settle_functions(out);
    result = settle_streams(out, c);
    return result != DONE ? result : check_together(out, c);
}

void args_help(const command *c)
{
    printf("Usage: libicc %s %s\n%s.\n\n%s\nOptions:\n", c->name, c->usage, c->summary, c->details);
    for (size_t i = 0; i < N_OPTIONS; i++) {
        const option *o = &options[i];
        if (!(o->commands & c->bit))
            continue;
        char left[64], letter[8] = "    ";
        if (o->letter != '\0')
            snprintf(letter, sizeof letter, "-%c, ", o->letter);
        snprintf(left, sizeof left, "%s--%s%s%s", letter, o->name,
                 o->value != NULL && o->kind != OPTION_REPORT ? " " : "", o->value ? o->value : "");
        printf("  %-30s %s\n", left, o->help);
    }
}
