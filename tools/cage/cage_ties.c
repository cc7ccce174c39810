/* Finds the ends of ties and compares the ties of two cages. */
#include "cage/cage_ties.h"

#include "base/allocate.h"
#include "cage/cage_features.h"

#include <string.h>

/* The vertex of a list at a place, or n. */
static size_t find(size_t n, const double *points, const double *at)
{
    size_t i = 0;
    while (i < n && !(points[2 * i] == at[0] && points[2 * i + 1] == at[1]))
        i++;
    return i;
}

static bool find_end(uint32_t *end, const cage *c, const double *at)
{
    size_t i = find(c->n, c->points, at), before = c->n;
    bool found = i < c->n;
    for (size_t k = 0; k < c->n_features && !found; k++) {
        const cage_feature *f = &c->features[k];
        i = find(f->n, f->points, at);
        found = i < f->n;
        i += before;
        before += f->n;
    }
    *end = (uint32_t)i;
    return found;
}

bool tie_find_ends(uint32_t ends[2], const cage *c, size_t i, problem *wrong)
{
    const cage_feature *tie = &c->ties[i];
    feature_text name;
    for (size_t k = 0; k < 2; k++) {
        const double *at = tie->points + (k == 0 ? 0 : 2 * (tie->n - 1));
        if (!find_end(&ends[k], c, at))
            return spoilt(wrong, tie->line,
                          "%s %s at (%.12g, %.12g), where the cage and what is inside it have no "
                          "vertex",
                          feature_name(name, tie), k == 0 ? "begins" : "ends", at[0],
                          cage_given_y(c, at));
    }
    return true;
}

bool ties_correspond(const cage *source, const cage *target, int *side, problem *wrong)
{
    feature_text name;
    for (size_t i = 0; i < source->n_ties; i++) {
        uint32_t ends[2][2];
        for (*side = 1; *side <= 2; ++*side)
            if (!tie_find_ends(ends[*side - 1], *side == 1 ? source : target, i, wrong))
                return false;
        *side = 2;
        if (memcmp(ends[0], ends[1], sizeof ends[0]) != 0)
            return spoilt(wrong, target->ties[i].line, "%s joins other vertices than in the source",
                          feature_name(name, &target->ties[i]));
    }
    return true;
}

icc_tie *ties_list(const cage *source, const cage *target)
{
    icc_tie *list = source->n_ties > 0 ? need(source->n_ties, sizeof *list) : NULL;
    for (size_t i = 0; i < source->n_ties; i++) {
        problem ignored;
        list[i] = (icc_tie){.size = sizeof *list,
                            .n_source = source->ties[i].n - 2,
                            .source = source->ties[i].points + 2,
                            .n_target = target->ties[i].n - 2,
                            .target = target->ties[i].points + 2};
        tie_find_ends(list[i].vertex, source, i, &ignored);
    }
    return list;
}
