/* Finds a method in the table. */
#include "method/methods.h"

const iccp_chart_ops *iccp_method_find(int32_t number, bool has_mesh)
{
    for (size_t k = 0; iccp_methods[k] != NULL; ++k)
        if (iccp_methods[k]->number == number && (has_mesh || !iccp_methods[k]->needs_mesh))
            return iccp_methods[k];
    return NULL;
}

const iccp_chart_ops *iccp_method_of_format(uint64_t format)
{
    for (size_t k = 0; iccp_methods[k] != NULL; ++k)
        if (iccp_methods[k]->format == format)
            return iccp_methods[k];
    return NULL;
}
