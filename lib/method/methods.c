/* The table of all methods. A method for meshes stands before the method of the same number that
 * needs none. */
#include "method/methods.h"

#include "field/chart_field.h"
#include "foliation/chart_disc.h"
#include "foliation/chart_foliation.h"
#include "gradient/coordinates/chart_gradient.h"
#include "shelling/shelling_state.h"

static const iccp_chart_ops *const METHODS[] = {
    &iccp_gradient_ops, &iccp_field_ops, &iccp_shelling_ops, &iccp_foliation_ops, &iccp_disc_ops};
enum { N_METHODS = sizeof METHODS / sizeof *METHODS };

const iccp_chart_ops *iccp_method_find(int32_t number, bool has_mesh)
{
    for (size_t k = 0; k < N_METHODS; ++k)
        if (METHODS[k]->number == number && (has_mesh || !METHODS[k]->needs_mesh))
            return METHODS[k];
    return NULL;
}

const iccp_chart_ops *iccp_method_of_format(uint64_t format)
{
    for (size_t k = 0; k < N_METHODS; ++k)
        if (METHODS[k]->format == format)
            return METHODS[k];
    return NULL;
}
