/* Lists reasons by the counts in the library's info structs. */
#include "report/reason.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Adds a reason if its count is not 0. */
static void add(char text[REASON_LENGTH], size_t count, const char *format, ...)
{
    va_list values;
    size_t used = strlen(text);
    if (count == 0)
        return;
    if (used > 0)
        used += (size_t)snprintf(text + used, REASON_LENGTH - used, "; ");
    va_start(values, format);
    vsnprintf(text + used, REASON_LENGTH - used, format, values);
    va_end(values);
}

const char *reason_of_chart(char text[REASON_LENGTH], const chart_facts *chart)
{
    const icc_field_info *f = &chart->field;
    text[0] = '\0';
    if (chart->common.method == ICC_METHOD_GRADIENT)
        add(text, 1, "the curves of method gradient merge");
    add(text, f->n_infeasible, "at %zu of %zu grid vertices no vector points uphill on all sides",
        f->n_infeasible, f->n_inside);
    add(text, f->n_not_inward,
        "at %zu of %zu contacts with the boundary (%.3g %%) the curves do not enter",
        f->n_not_inward, f->n_contacts, 100 * (double)f->n_not_inward / (double)f->n_contacts);
    add(text, f->n_stray, "%zu grid %s given up", f->n_stray,
        f->n_stray == 1 ? "vertex inside was" : "vertices inside were");
    return text;
}

const char *reason_of_map(char text[REASON_LENGTH], const icc_map_info *map,
                          const icc_map_report *made)
{
    text[0] = '\0';
    if (map->reason_side != 0)
        add(text, 1, "the %s's chart is not", map->reason_side == 1 ? "source" : "target");
    add(text, made->n_lost,
        "%zu of %zu sample points do not come back, because they need more digits", made->n_lost,
        made->n_samples);
    if (map->reason == ICC_REASON_FLAT || made->n_lost > 0)
        add(text, made->n_flat, "it flattens the surroundings of %zu of %zu sample points",
            made->n_flat, made->n_samples);
    return text;
}
