/* The table of all methods. A method for meshes stands before the method of the same number that
 * needs none, and the first format of a method before its others. */
#include "field/chart_field.h"
#include "foliation/chart_disc.h"
#include "foliation/chart_foliation.h"
#include "gradient/coordinates/chart_gradient.h"
#include "method/methods.h"
#include "shelling/shelling_state.h"

const iccp_chart_ops *const iccp_methods[] = {&iccp_gradient_ops,
                                              &iccp_field_ops,
                                              &iccp_shelling_ops,
                                              &iccp_foliation_ops,
                                              &iccp_disc_ops,
                                              &iccp_gradient_stages_ops,
                                              NULL};
