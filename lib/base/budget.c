/* Limits what a call may spend on rebuilding an object. */
#include "base/budget.h"

#include "base/error.h"

static const double DEFAULT_LIMIT = 256e6;

/* Multiplications allowed for each byte: about ten seconds for the default limit. */
static const double WORK_PER_BYTE = 40;

iccp_env iccp_budget_begin(iccp_budget *budget, const iccp_env *env)
{
    iccp_env own = *env;
    const double limit = env->load_limit > 0 ? (double)env->load_limit : DEFAULT_LIMIT;
    *budget = (iccp_budget){.limit = limit, .bytes = limit, .work = WORK_PER_BYTE * limit};
    own.budget = budget;
    return own;
}

icc_status iccp_budget_borrow(const iccp_env *env, double bytes)
{
    iccp_budget *b = env->budget;
    if (b == NULL || bytes <= b->bytes)
        return ICC_OK;
    b->wanted = b->limit - b->bytes + bytes;
    return ICC_ERR_CANCELLED;
}

icc_status iccp_budget_keep(const iccp_env *env, double bytes)
{
    const icc_status status = iccp_budget_borrow(env, bytes);
    if (status == ICC_OK && env->budget != NULL)
        env->budget->bytes -= bytes;
    return status;
}

icc_status iccp_budget_work(const iccp_env *env, double multiplications)
{
    iccp_budget *b = env->budget;
    if (b == NULL || multiplications <= b->work) {
        if (b != NULL)
            b->work -= multiplications;
        return ICC_OK;
    }
    b->is_long = true;
    return ICC_ERR_CANCELLED;
}

icc_status iccp_budget_end(const iccp_budget *budget, icc_status status, icc_error *err)
{
    const double limit = budget->limit / 1e6;
    if (budget->wanted > 0)
        return iccp_fail(
            err, ICC_ERR_FORMAT,
            "rebuilding the saved object takes about %.0f MB; icc_env.load_limit allows "
            "%.0f MB",
            budget->wanted / 1e6, limit);
    if (budget->is_long)
        return iccp_fail(err, ICC_ERR_FORMAT,
                         "rebuilding the saved object takes more work than icc_env.load_limit, "
                         "%.0f MB, allows",
                         limit);
    return status;
}
