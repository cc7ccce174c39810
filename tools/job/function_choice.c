/* Parses --function and names functions. */
#include "job/function_choice.h"

#include "job/option_table.h"

#include <stdio.h>
#include <string.h>

static const choice constraints[] = {
    {"constrained", ICC_CONSTRAINTS_ALL}, {"unconstrained", ICC_CONSTRAINTS_NONE}, {NULL, 0}};

/* The value of the name text[0..n), or 0. */
static int32_t choice_value(const choice *choices, const char *text, size_t n)
{
    for (const choice *c = choices; c->name != NULL; c++)
        if (strlen(c->name) == n && strncmp(c->name, text, n) == 0)
            return c->value;
    return 0;
}

bool function_solves(int32_t function)
{
    return function == ICC_FUNCTION_LAPLACE || function == ICC_FUNCTION_BILAPLACE ||
           function == ICC_FUNCTION_CLAMPED || function == ICC_FUNCTION_HARMONIC;
}

/* One function, text[0..n). */
static bool parse_one(function_choice *out, const char *text, size_t n, problem *wrong)
{
    size_t name = strcspn(text, ":,");
    *out = (function_choice){.function = choice_value(functions, text, name)};
    if (out->function == 0)
        return spoilt(wrong, 0,
                      "--function '%.*s' is unknown; it may be: decay, distance, laplace, "
                      "bilaplace, clamped, harmonic",
                      (int)(name < 40 ? name : 40), text);
    if (name == n)
        return true;
    out->constraints = choice_value(constraints, text + name + 1, n - name - 1);
    if (out->constraints == 0 || !function_solves(out->function))
        return spoilt(wrong, 0,
                      "--function '%.*s': after the colon of laplace, bilaplace, clamped or "
                      "harmonic write constrained or unconstrained",
                      (int)(n < 40 ? n : 40), text);
    return true;
}

size_t functions_parse(function_choice out[MAX_FUNCTIONS], const char *text, problem *wrong)
{
    for (size_t count = 0; count < MAX_FUNCTIONS; count++) {
        size_t n = strcspn(text, ",");
        if (!parse_one(&out[count], text, n, wrong))
            return 0;
        if (text[n] == '\0')
            return count + 1;
        text += n + 1;
    }
    spoilt(wrong, 0, "--function takes at most %d names", (int)MAX_FUNCTIONS);
    return 0;
}

const char *function_label(char text[48], const icc_function_info *info)
{
    snprintf(text, 48, "%s%s", choice_name(functions, info->function),
             !function_solves(info->function) ? ""
             : info->constrained              ? ", constrained"
                                              : ", unconstrained");
    return text;
}

void function_report(json *j, const icc_function_info *info, const icc_solver_report *made)
{
    json_text(j, "function", choice_name(functions, info->function));
    if (!function_solves(info->function))
        return;
    json_open(j, "solution", '{');
    json_flag(j, "constrained", info->constrained != 0);
    json_text(j, "solver", choice_name(solvers, info->solver));
    json_count(j, "unknowns", info->n_unknowns);
    json_count(j, "violated", info->n_violated);
    json_count(j, "active", info->n_active);
    json_count(j, "iterations", made->n_iterations);
    json_count(j, "inner_iterations", made->n_inner);
    json_number(j, "factorisation_work", made->work);
    json_number(j, "residual_before_sweep", made->residual_before);
    json_number(j, "residual", info->residual);
    json_number(j, "least_log", info->least_log);
    json_open(j, "seconds", '{');
    json_number(j, "setup", made->seconds_setup);
    json_number(j, "order", made->seconds_order);
    json_number(j, "factor", made->seconds_factor);
    json_number(j, "solve", made->seconds_solve);
    json_number(j, "verify", made->seconds_verify);
    json_close(j, '}');
    json_close(j, '}');
}
