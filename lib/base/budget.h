/* What a call may spend: objects that are rebuilt from a few bytes could ask for any amount of
 * memory and time. Whoever is about to allocate, or to compute, more than a fixed multiple of what
 * it was given asks first. Refused, it returns ICC_ERR_CANCELLED, which everything passes on; the
 * call that set the budget says why. */
#ifndef ICCP_BUDGET_H
#define ICCP_BUDGET_H

#include "base/env.h"

#include <stdbool.h>

typedef struct iccp_budget {
    double limit;       /* bytes that the caller allows */
    double bytes, work; /* left: bytes, and multiplications */
    double wanted;      /* bytes that were refused; 0: none */
    bool is_long;       /* multiplications were refused */
} iccp_budget;

/* As icc_env::load_limit says. The part of `env` that lives on it. */
iccp_env iccp_budget_begin(iccp_budget *budget, const iccp_env *env);

/* Memory for as long as the call lasts, or its result. */
icc_status iccp_budget_keep(const iccp_env *env, double bytes);

/* Memory that is given back soon. */
icc_status iccp_budget_borrow(const iccp_env *env, double bytes);

icc_status iccp_budget_work(const iccp_env *env, double multiplications);

/* ICC_ERR_FORMAT with the reason if something was refused; else `status`. */
icc_status iccp_budget_end(const iccp_budget *budget, icc_status status, icc_error *err);

#endif
