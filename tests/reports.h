/* What objects tell of how they were made. */
#ifndef REPORTS_H
#define REPORTS_H

#include <icc/stages.h>

static inline icc_map_report report_of(const icc_map *map)
{
    icc_map_report report = {0};
    report.size = sizeof report;
    (void)icc_map_get_report(map, &report);
    return report;
}

static inline icc_solver_report solver_report_of(const icc_function *function)
{
    icc_solver_report report = {0};
    report.size = sizeof report;
    (void)icc_function_get_solver_report(function, &report);
    return report;
}

#endif
