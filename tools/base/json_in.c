/* Checks JSON values and converts them, with cJSON as the parser. */
#include "base/json_in.h"

#include "base/allocate.h"
#include "base/foreign.h"
#include "base/json_scan.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

cJSON *json_parse(const char *text, size_t n, problem *wrong)
{
    const char *end = text;
    size_t mark = n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    cJSON *object = cJSON_ParseWithLengthOpts(text + mark, n + 1 - mark, &end, 0);
    const char *rest = end + (object != NULL ? strspn(end, " \t\r\n\x1e") : 0);
    if (object != NULL && rest == text + n)
        return object;
    if (object != NULL && *rest == '{')
        foreign_vector(wrong, line_of(text, rest), "a second object, as in GeoJSONSeq");
    else
        spoilt(wrong, line_of(text, rest),
               rest >= text + n ? "the JSON ends early" : "this is not valid JSON");
    cJSON_Delete(object);
    return NULL;
}

cJSON *json_parse_sequence(const char *text, size_t n, problem *wrong)
{
    cJSON *list = cJSON_CreateArray();
    const char *p = text + (n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0),
               *end = text + n;
    bool apart;
    p += json_scan_gap(p, &apart);
    apart = true; /* the first text needs no separator before it */
    while (p < end || cJSON_GetArraySize(list) == 0) {
        const char *stop = p;
        cJSON *item = apart ? cJSON_ParseWithLengthOpts(p, (size_t)(end - p) + 1, &stop, 0) : NULL;
        if (item == NULL) {
            spoilt(wrong, line_of(text, stop),
                   stop >= end ? "the JSON ends early" : "this is not valid JSON");
            cJSON_Delete(list);
            return NULL;
        }
        cJSON_AddItemToArray(list, item);
        p = stop + json_scan_gap(stop, &apart);
    }
    return list;
}

const cJSON *json_get(const cJSON *object, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(object, name);
}

bool json_is_object(const cJSON *item, const char *where, const char *const *names, problem *wrong)
{
    if (!cJSON_IsObject(item))
        return spoilt(wrong, 0, "%s is not an object { }", where);
    const cJSON *member;
    cJSON_ArrayForEach(member, item)
    {
        const char *const *name = names;
        while (*name != NULL && strcmp(*name, member->string) != 0)
            name++;
        char shown[32], list[120] = "";
        if (*name != NULL)
            continue;
        for (name = names; *name != NULL; name++)
            snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", *list ? ", " : "",
                     *name);
        return spoilt(wrong, 0, "%s has a member '%s'; it may have: %s", where,
                      quoted(shown, member->string), list);
    }
    return true;
}

bool json_real(const cJSON *item, const char *where, double *out, problem *wrong)
{
    if (!cJSON_IsNumber(item) || !isfinite(item->valuedouble))
        return spoilt(wrong, 0, "%s is not a finite number", where);
    *out = item->valuedouble;
    return true;
}

bool json_reals(const cJSON *item, const char *where, size_t n, double *out, problem *wrong)
{
    size_t k = 0;
    bool good = cJSON_IsArray(item);
    const cJSON *number = good ? item->child : NULL;
    for (; number != NULL && good; number = number->next) {
        good = k < n && cJSON_IsNumber(number) && isfinite(number->valuedouble);
        if (good)
            out[k++] = number->valuedouble;
    }
    return (good && k == n) || spoilt(wrong, 0, "%s is not a list of %zu finite numbers", where, n);
}

bool json_list(const cJSON *item, const char *where, size_t *n, problem *wrong)
{
    *n = 0;
    if (item == NULL)
        return true;
    if (!cJSON_IsArray(item))
        return spoilt(wrong, 0, "%s is not a list [ ]", where);
    *n = (size_t)cJSON_GetArraySize(item);
    return true;
}

bool json_points(const cJSON *item, const char *where, size_t dim, size_t *n, double **points,
                 problem *wrong)
{
    *points = NULL;
    if (!json_list(item, where, n, wrong))
        return false;
    *points = need(*n, dim * sizeof **points);
    size_t i = 0;
    const cJSON *point;
    cJSON_ArrayForEach(point, item)
    {
        char name[96];
        snprintf(name, sizeof name, "%s[%zu]", where, i);
        if (!json_reals(point, name, dim, *points + dim * i++, wrong))
            return false;
    }
    return true;
}

bool json_index(const cJSON *item, const char *where, const char *what, size_t limit, uint32_t *out,
                problem *wrong)
{
    double value = cJSON_IsNumber(item) ? item->valuedouble : -1;
    if (!(value >= 0 && value < (double)limit && value < UINT32_MAX && value == floor(value)))
        return limit == 0 ? spoilt(wrong, 0, "%s must be a %s, but there is none", where, what)
                          : spoilt(wrong, 0, "%s must be a %s, a whole number from 0 to %zu", where,
                                   what, limit - 1);
    *out = (uint32_t)value;
    return true;
}

bool json_pairs(const cJSON *item, const char *where, const char *what, size_t limit, size_t *n,
                uint32_t **pairs, problem *wrong)
{
    *pairs = NULL;
    if (!json_list(item, where, n, wrong))
        return false;
    *pairs = need(*n, 2 * sizeof **pairs);
    size_t i = 0;
    const cJSON *pair;
    cJSON_ArrayForEach(pair, item)
    {
        char name[96];
        snprintf(name, sizeof name, "%s[%zu]", where, i);
        if (!cJSON_IsArray(pair) || cJSON_GetArraySize(pair) != 2)
            return spoilt(wrong, 0, "%s is not a pair of numbers", name);
        const cJSON *end = pair->child;
        for (size_t k = 0; k < 2; k++, end = end->next)
            if (!json_index(end, name, what, limit, *pairs + 2 * i + k, wrong))
                return false;
        i++;
    }
    return true;
}
