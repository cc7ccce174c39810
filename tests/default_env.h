/* The environment of a caller who says nothing. */
#ifndef TESTS_DEFAULT_ENV_H
#define TESTS_DEFAULT_ENV_H

#include "base/env.h"

#include <check.h>

static inline iccp_env default_env(void)
{
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    return env;
}

#endif
