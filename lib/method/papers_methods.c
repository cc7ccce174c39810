/* The table of methods of a library with the papers alone (ICC_PAPERS_ONLY). */
#include "gradient/coordinates/chart_gradient.h"
#include "method/methods.h"

const iccp_chart_ops *const iccp_methods[] = {&iccp_gradient_ops, &iccp_gradient_stages_ops, NULL};
