/* What objects tell of themselves. */
#ifndef TESTS_INFOS_H
#define TESTS_INFOS_H

#include <check.h>
#include <icc/stages.h>

static inline icc_chart_info info_of_chart(const icc_chart *chart)
{
    icc_chart_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_chart_get_info(chart, &info), ICC_OK);
    return info;
}

static inline icc_map_info info_of_map(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    return info;
}

static inline icc_function_report report_of_function(const icc_function *field)
{
    icc_function_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_function_get_report(field, &report, NULL, NULL), ICC_OK);
    return report;
}

#endif
