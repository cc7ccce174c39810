/* The field object: values on the vertices of a tree. */
#ifndef ICCP_FIELD_H
#define ICCP_FIELD_H

#include "tree/cousin.h"

struct icc_field {
    iccp_memory memory;
    icc_tree *tree;
    int32_t function; /* ICC_FUNCTION_* */
    double *values;   /* one per grid vertex; NaN where the tree does not reach */
};

/* See icc_field_create(). The decay would underflow from some 13,850 generations on (cells = 16384
 * get there); from there on the values are -1, -2, .., so that they always fall from one generation to
 * the next. */
icc_status iccp_field_create(icc_field **out, const icc_tree *tree, int32_t function,
                             const iccp_env *env, icc_error *err);

/* NULL is a no-op. Nothing shares a field yet, so it has one owner. */
void iccp_field_release(icc_field *field);

#endif
