/* The library's version and the names of statuses. */
#include "base/version.h"
#include "icc/base.h"

#define TEXT_OF(number) #number
#define TEXT(number) TEXT_OF(number)

const char *icc_version(void)
{
    return TEXT(ICCP_VERSION_MAJOR) "." TEXT(ICCP_VERSION_MINOR) "." TEXT(ICCP_VERSION_PATCH);
}

int32_t icc_version_number(void)
{
    return 10000 * ICCP_VERSION_MAJOR + 100 * ICCP_VERSION_MINOR + ICCP_VERSION_PATCH;
}

const char *icc_status_name(icc_status status)
{
    static const char *const names[] = {
        [ICC_OK] = "ICC_OK",
        [ICC_ERR_ARGUMENT] = "ICC_ERR_ARGUMENT",
        [ICC_ERR_MEMORY] = "ICC_ERR_MEMORY",
        [ICC_ERR_VERSION] = "ICC_ERR_VERSION",
        [ICC_ERR_BOUNDARY] = "ICC_ERR_BOUNDARY",
        [ICC_ERR_RESOLUTION] = "ICC_ERR_RESOLUTION",
        [ICC_ERR_TOPOLOGY] = "ICC_ERR_TOPOLOGY",
        [ICC_ERR_OUTSIDE] = "ICC_ERR_OUTSIDE",
        [ICC_ERR_SOLVER] = "ICC_ERR_SOLVER",
        [ICC_ERR_TRACE] = "ICC_ERR_TRACE",
        [ICC_ERR_CERTIFICATE] = "ICC_ERR_CERTIFICATE",
        [ICC_ERR_CANCELLED] = "ICC_ERR_CANCELLED",
        [ICC_ERR_UNSUPPORTED] = "ICC_ERR_UNSUPPORTED",
        [ICC_ERR_FORMAT] = "ICC_ERR_FORMAT",
        [ICC_ERR_AMBIGUOUS] = "ICC_ERR_AMBIGUOUS",
    };
    if (status < 0 || (size_t)status >= sizeof names / sizeof names[0])
        return "unknown status";
    return names[status];
}
