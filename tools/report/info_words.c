/* Words for the results of `libicc info`, which both of its reports use. */
#include "report/info.h"

#include <stdio.h>
#include <string.h>

/* By Euler's formula, each hole brings one saddle to any function. Further critical points are its
 * own. */
static const char *own_reason(const info *x)
{
    const grid_facts *g = &x->chart.grid;
    if (x->field.beside && g->n_maxima == 1)
        return "the function is greatest there, beside the root, where curves are to end";
    if (g->n_maxima == 1 && g->n_minima == 0 && g->n_saddles <= x->n_holes)
        return NULL;
    if (x->domain.dim > 2)
        return "beyond the plane the inequalities of a tree would not exclude them";
    if (function_solves(x->field.function) && !x->field.constrained)
        return "the inequalities that keep such points away were not imposed";
    if (g->n_cousin_violations > 0)
        return "the tree breaks the cousin rule, so falling along it does not exclude them";
    return "the function keeps to the inequalities only up to its residual";
}

const char *info_reason(char text[240], const info *x)
{
    const char *own = own_reason(x);
    text[0] = '\0';
    if (x->n_holes > 0)
        snprintf(
            text, 240,
            "gaps narrower than a cell make %zu hole%s in the shape, each with a saddle, until "
            "--cells resolves them%s",
            x->n_holes, x->n_holes == 1 ? "" : "s", own != NULL ? "; and " : "");
    size_t used = strlen(text);
    snprintf(text + used, 240 - used, "%s", own != NULL ? own : "");
    return text;
}

const char *info_growth(char text[160], const info *x)
{
    const icc_grow_report *g = &x->growth;
    if (g->method == ICC_GROW_AS_GIVEN)
        snprintf(text, 160, "the order of the function has no critical vertex but the maximum");
    else if (!x->grown)
        snprintf(text, 160, "stuck: %zu vertices cannot be placed, %zu are left by thinning",
                 g->n_unplaced, g->n_remaining);
    else
        snprintf(text, 160, "%s, %zu vertices had to wait, %zu edges against the function",
                 g->method == ICC_GROW_GROWN ? "grown" : "thinned", g->n_deferred, g->n_reversed);
    return text;
}
