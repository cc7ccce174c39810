/* Supernodes: runs of columns of a sparse factor with the same rows below them. Each is kept as one
 * dense panel. */
#ifndef ICCP_SUPERNODES_H
#define ICCP_SUPERNODES_H

#include "math/etree.h"

/* A panel has one row for each of its columns, then the rows below. Rows are stored in strips of
 * ICCP_STRIP, the last strip padded. A strip is stored column by column. */
enum { ICCP_STRIP = 4 };

typedef struct iccp_supernodes {
    size_t n;
    uint32_t *column;    /* n + 1: where the supernodes begin */
    uint32_t *owner;     /* the supernode of each column */
    uint32_t *parent;    /* ICCP_NO_PARENT at a root */
    size_t *first_row;   /* n + 1: where the rows of each supernode begin in `row` */
    uint32_t *row;       /* rows below each supernode, rising */
    size_t *first_value; /* n + 1: where the panel of each supernode begins */
    size_t most_columns; /* largest number of columns of a supernode */
    size_t most_rows;    /* largest number of rows of a panel */
} iccp_supernodes;

/* Finds the supernodes. `tree` and `count` refer to groups of `block` columns with the same
 * pattern. Neighbouring supernodes are merged if that stores few zeros. On failure nothing stays
 * allocated. */
icc_status iccp_supernodes_create(iccp_supernodes *nodes, const iccp_etree *tree, size_t block,
                                  const uint32_t *count, const iccp_env *env);
void iccp_supernodes_free(iccp_supernodes *nodes, const iccp_memory *memory);

static inline size_t iccp_supernodes_columns(const iccp_supernodes *nodes, size_t s)
{
    return nodes->column[s + 1] - nodes->column[s];
}

/* Number of rows below supernode s. */
static inline size_t iccp_supernodes_below(const iccp_supernodes *nodes, size_t s)
{
    return nodes->first_row[s + 1] - nodes->first_row[s];
}

#endif
