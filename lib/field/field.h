/* The field object: values on the vertices of a tree. */
#ifndef ICCP_FIELD_H
#define ICCP_FIELD_H

#include "tree/cousin.h"

struct icc_field {
    iccp_memory memory;
    atomic_size_t references;
    icc_tree *tree;
    int32_t function;  /* ICC_FUNCTION_* */
    double *values;    /* one per grid vertex; NaN where the tree does not reach */
};

icc_status iccp_field_create(icc_field **out, const icc_tree *tree, int32_t function,
                             const iccp_env *env, icc_error *err);
icc_field *iccp_field_retain(const icc_field *field);
void iccp_field_release(icc_field *field);

#endif
