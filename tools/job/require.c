/* Compares the certificates of maps with --require. */
#include "job/require.h"

static bool chart_is_certified(const icc_chart *chart)
{
    icc_chart_info info = {.size = sizeof info};
    return chart == NULL || (icc_chart_get_info(chart, &info) == ICC_OK && info.certified);
}

static bool is_certified(const job *j)
{
    icc_map_info info = {.size = sizeof info};
    return icc_map_get_info(j->map, &info) == ICC_OK && info.certified &&
           chart_is_certified(icc_map_source_chart(j->map)) &&
           chart_is_certified(icc_map_target_chart(j->map));
}

int require_maps(job *j)
{
    bool good = j->args->require == 0 || is_certified(j);
    progress_end(&j->bar);
    return good ? DONE
                : failed(j->args->source, 0,
                         "the map is not certified, so nothing is written; 'libicc check' with the "
                         "same options says why");
}
