/* Any bytes as a saved sampling or binding. The first byte says which; with its lowest bit the
 * header is put right, so that the content is looked at. What is accepted is sound, and saved again
 * it is the same. */
#include "icc/kernel.h"

#include "blobs.h"

#include <math.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_sampling(const uint8_t *bytes, size_t size)
{
    icc_sampling *sampling;
    icc_sampling_info info = {.size = sizeof info};
    size_t n;
    const icc_status status = icc_sampling_load(&sampling, size, bytes, NULL, NULL);
    require(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION);
    require((sampling != NULL) == (status == ICC_OK));
    if (sampling == NULL)
        return;
    require(icc_sampling_get_info(sampling, &info) == ICC_OK);
    require(info.n_samples > 0 && info.n_edge <= info.n_samples && info.sigma > 0);
    double *points = malloc(info.n_samples * (size_t)info.dim * sizeof *points);
    uint8_t *again = malloc(size);
    require(points != NULL && again != NULL);
    require(icc_sampling_get_points(sampling, points) == ICC_OK);
    for (size_t i = 0; i < info.n_samples * (size_t)info.dim; ++i)
        require(isfinite(points[i]));
    require(icc_sampling_save(sampling, size, again, &n) == ICC_OK);
    require(n == size && memcmp(again, bytes, size) == 0);
    free(again);
    free(points);
    icc_sampling_free(sampling);
}

static void check_binding(const uint8_t *bytes, size_t size)
{
    icc_binding *binding;
    size_t n, n_points, n_handles;
    int32_t dim;
    const icc_status status = icc_binding_load(&binding, size, bytes, NULL, NULL);
    require(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION);
    require((binding != NULL) == (status == ICC_OK));
    if (binding == NULL)
        return;
    require(icc_binding_get_counts(binding, &n_points, &n_handles, &dim) == ICC_OK);
    require((dim == 2 || dim == 3) && n_handles > (size_t)dim);
    uint8_t *again = malloc(size);
    require(again != NULL);
    require(icc_binding_save(binding, size, again, &n) == ICC_OK);
    require(n == size && memcmp(again, bytes, size) == 0);
    free(again);
    icc_binding_free(binding);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static uint8_t bytes[LARGEST];
    if (size < 1 + HEADER || size - 1 > LARGEST)
        return 0;
    const int binding = data[0] & 2;
    memcpy(bytes, data + 1, size - 1);
    if (data[0] & 1)
        put_right(bytes, size - 1, binding ? "BIND" : "SMPL");
    if (binding)
        check_binding(bytes, size - 1);
    else
        check_sampling(bytes, size - 1);
    return 0;
}
