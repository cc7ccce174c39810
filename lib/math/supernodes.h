/* Supernodes: runs of columns of a sparse factor with the same rows below them, kept as one dense
 * panel each. */
#ifndef ICCP_SUPERNODES_H
#define ICCP_SUPERNODES_H

#include "math/etree.h"

/* A panel has a row for each of its columns, then the rows below; the rows come in strips of
 * ICCP_STRIP, the last one padded, and a strip is stored column by column. */
enum { ICCP_STRIP = 4 };

typedef struct iccp_supernodes {
    size_t n;
    uint32_t *column;    /* n + 1: where the supernodes begin */
    uint32_t *owner;     /* the supernode of each column */
    uint32_t *parent;    /* ICCP_NO_PARENT at a root */
    size_t *first_row;   /* n + 1: where their rows begin in `row` */
    uint32_t *row;       /* rows below each supernode, rising */
    size_t *first_value; /* n + 1: where their panels begin */
    size_t most_columns; /* of one supernode */
    size_t most_rows;    /* of one panel */
} iccp_supernodes;

/* The tree is one of groups of `block` columns with the same pattern, and so are the counts.
 * Neighbouring supernodes are merged where few zeros have to be stored for it. On failure nothing
 * is left allocated. */
icc_status iccp_supernodes_create(iccp_supernodes *nodes, const iccp_etree *tree, size_t block,
                                  const uint32_t *count, const iccp_env *env);
void iccp_supernodes_free(iccp_supernodes *nodes, const iccp_memory *memory);

static inline size_t iccp_supernodes_columns(const iccp_supernodes *nodes, size_t s)
{
    return nodes->column[s + 1] - nodes->column[s];
}

/* Rows below supernode s. */
static inline size_t iccp_supernodes_below(const iccp_supernodes *nodes, size_t s)
{
    return nodes->first_row[s + 1] - nodes->first_row[s];
}

#endif
