/* Limits what a call may spend. Objects that are rebuilt from a few bytes could ask for any amount
 * of memory and time. So code asks first if it is about to allocate, or to compute, more than a
 * fixed multiple of its input. If the budget is exceeded, the request returns ICC_ERR_CANCELLED,
 * which every caller passes on. The call that set the budget then says why. */
#ifndef ICCP_BUDGET_H
#define ICCP_BUDGET_H

#include "base/env.h"

#include <stdbool.h>

typedef struct iccp_budget {
    double limit;       /* bytes that the caller allows */
    double bytes, work; /* bytes and multiplications that are left */
    double wanted;      /* bytes that were refused, or 0 */
    bool is_long;       /* multiplications were refused */
} iccp_budget;

/* Starts a budget as icc_env::load_limit says. Returns `env` with this budget. */
iccp_env iccp_budget_begin(iccp_budget *budget, const iccp_env *env);

/* Asks for memory that the call, or its result, keeps. */
icc_status iccp_budget_keep(const iccp_env *env, double bytes);

/* Asks for memory that is freed soon. */
icc_status iccp_budget_borrow(const iccp_env *env, double bytes);

icc_status iccp_budget_work(const iccp_env *env, double multiplications);

/* Returns ICC_ERR_FORMAT with the reason if a request was refused, else `status`. */
icc_status iccp_budget_end(const iccp_budget *budget, icc_status status, icc_error *err);

#endif
