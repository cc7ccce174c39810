/* Describes what is wrong with a cage, and where in its file. */
#ifndef CAGE_DEFECTS_H
#define CAGE_DEFECTS_H

#include "cage/cage.h"

#include <icc/icc.h>

typedef struct defect_list {
    size_t n;
    int32_t *kinds;  /* n kinds, ICC_DEFECT_* */
    uint32_t *items; /* n pairs */
} defect_list;

/* Lists at most `limit` defects (0: all). `n_all` receives their number, and may be NULL. */
icc_status defects_find(defect_list *out, const cage *c, size_t limit, size_t *n_all,
                        const icc_env *env, icc_error *err);

/* True if the list is as long as the library makes it (icc_boundary_defects()), so more may follow. */
bool defects_may_be_more(const defect_list *list, const cage *c);
void defects_free(defect_list *list);

/* Describes defect i. Its place is vertex items[2 i]. Returns `out`. */
const char *defect_text(char out[200], const defect_list *list, size_t i, const cage *c);

#endif
