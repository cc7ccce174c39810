/* Checks JSON values and converts them. */
#include "base/json_in.h"

#include "base/allocate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool json_is_object(const json_item *item, const char *where, const char *const *names,
                    problem *wrong)
{
    if (!json_is(item, JSON_OBJECT))
        return spoilt(wrong, 0, "%s is not an object { }", where);
    for (const json_item *member = json_first_member(item); member != NULL;
         member = json_next(member)) {
        const char *const *name = names;
        while (*name != NULL && strcmp(*name, member->name) != 0)
            name++;
        char shown[32], list[120] = "";
        if (*name != NULL)
            continue;
        for (name = names; *name != NULL; name++)
            snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", *list ? ", " : "",
                     *name);
        return spoilt(wrong, 0, "%s has a member '%s'; it may have: %s", where,
                      quoted(shown, member->name), list);
    }
    return true;
}

bool json_real(const json_item *item, const char *where, double *out, problem *wrong)
{
    if (!json_is(item, JSON_NUMBER) || !isfinite(item->number))
        return spoilt(wrong, 0, "%s is not a finite number", where);
    *out = item->number;
    return true;
}

bool json_reals(const json_item *item, const char *where, size_t n, double *out, problem *wrong)
{
    size_t k = 0;
    bool good = json_is(item, JSON_LIST);
    for (const json_item *x = json_first(item); x != NULL && good; x = json_next(x)) {
        good = k < n && json_is(x, JSON_NUMBER) && isfinite(x->number);
        if (good)
            out[k++] = x->number;
    }
    return (good && k == n) || spoilt(wrong, 0, "%s is not a list of %zu finite numbers", where, n);
}

bool json_list(const json_item *item, const char *where, size_t *n, problem *wrong)
{
    *n = 0;
    if (item == NULL)
        return true;
    if (!json_is(item, JSON_LIST))
        return spoilt(wrong, 0, "%s is not a list [ ]", where);
    *n = json_size(item);
    return true;
}

bool json_points(const json_item *item, const char *where, size_t dim, size_t *n, double **points,
                 problem *wrong)
{
    *points = NULL;
    if (!json_list(item, where, n, wrong))
        return false;
    *points = need(*n, dim * sizeof **points);
    size_t i = 0;
    for (const json_item *point = json_first(item); point != NULL; point = json_next(point)) {
        char name[96];
        snprintf(name, sizeof name, "%s[%zu]", where, i);
        if (!json_reals(point, name, dim, *points + dim * i++, wrong))
            return false;
    }
    return true;
}

bool json_index(const json_item *item, const char *where, const char *what, size_t limit,
                uint32_t *out, problem *wrong)
{
    double value = json_is(item, JSON_NUMBER) ? item->number : -1;
    if (!(value >= 0 && value < (double)limit && value < UINT32_MAX && value == floor(value)))
        return limit == 0 ? spoilt(wrong, 0, "%s must be a %s, but there is none", where, what)
                          : spoilt(wrong, 0, "%s must be a %s, a whole number from 0 to %zu", where,
                                   what, limit - 1);
    *out = (uint32_t)value;
    return true;
}

bool json_pairs(const json_item *item, const char *where, const char *what, size_t limit, size_t *n,
                uint32_t **pairs, problem *wrong)
{
    *pairs = NULL;
    if (!json_list(item, where, n, wrong))
        return false;
    *pairs = need(*n, 2 * sizeof **pairs);
    size_t i = 0;
    for (const json_item *pair = json_first(item); pair != NULL; pair = json_next(pair)) {
        char name[96];
        snprintf(name, sizeof name, "%s[%zu]", where, i / 2);
        if (json_size(pair) != 2)
            return spoilt(wrong, 0, "%s is not a pair of numbers", name);
        for (const json_item *end = json_first(pair); end != NULL; end = json_next(end))
            if (!json_index(end, name, what, limit, *pairs + i++, wrong))
                return false;
    }
    return true;
}
