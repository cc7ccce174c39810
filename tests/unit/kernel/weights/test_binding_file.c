/* Bindings as bytes: they come back bit for bit, and anything else is refused. */
#include "../../../handle_fixtures.h"
#include "../../../suite.h"
#include "base/blob.h"

#include <math.h>
#include <string.h>

START_TEST(bindings_come_back_bit_for_bit)
{
    icc_sampling *sampling = sample_square(0.1);
    icc_weights *weights = make(sampling, 5, HANDLES, NULL);
    double *points = random_places(2, 50), transforms[30], images[2][100], jacobians[2][200];
    random_source r = {1};
    random_transforms(2, 5, transforms, &r);
    for (int32_t derivatives = 0; derivatives < 2; ++derivatives) {
        icc_binding *binding, *loaded;
        size_t n_bytes, n_points, n_handles;
        int32_t dim;
        ck_assert_int_eq(icc_binding_create(&binding, weights, 50, points, derivatives, NULL, NULL),
                         ICC_OK);
        unsigned char *data = save(binding, &n_bytes);
        ck_assert_int_eq(icc_binding_load(&loaded, n_bytes, data, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_binding_get_counts(loaded, &n_points, &n_handles, &dim), ICC_OK);
        ck_assert(n_points == 50 && n_handles == 5 && dim == 2);
        double *wanted = derivatives ? jacobians[0] : NULL,
               *got = derivatives ? jacobians[1] : NULL;
        ck_assert_int_eq(icc_binding_pose(binding, transforms, images[0], wanted, NULL), ICC_OK);
        ck_assert_int_eq(icc_binding_pose(loaded, transforms, images[1], got, NULL), ICC_OK);
        ck_assert_mem_eq(images[0], images[1], sizeof *images);
        if (derivatives)
            ck_assert_mem_eq(jacobians[0], jacobians[1], sizeof *jacobians);
        double handles[10];
        ck_assert_int_eq(icc_binding_get_weights(loaded, handles, NULL), ICC_OK);
        ck_assert_mem_eq(handles, HANDLES, sizeof handles);
        size_t n_again;
        unsigned char *again = save(loaded, &n_again);
        ck_assert_uint_eq(n_again, n_bytes);
        ck_assert_mem_eq(data, again, n_bytes);
        free(data);
        free(again);
        icc_binding_free(binding);
        icc_binding_free(loaded);
    }
    free(points);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

static icc_status try_load(size_t n_bytes, const void *data)
{
    icc_binding *binding = (icc_binding *)&binding;
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_binding_load(&binding, n_bytes, data, NULL, &err);
    ck_assert_int_eq(status == ICC_OK, binding != NULL);
    ck_assert_int_eq(status, err.status);
    icc_binding_free(binding);
    return status;
}

/* Cut off anywhere, with any byte changed, and with honest checksums around lies. */
START_TEST(hostile_bytes_are_refused)
{
    icc_sampling *sampling = sample_square(0.2);
    icc_weights *weights = make(sampling, 4, SQUARE, NULL);
    icc_binding *binding;
    double *points = random_places(2, 3);
    size_t n_bytes;
    ck_assert_int_eq(icc_binding_create(&binding, weights, 3, points, 1, NULL, NULL), ICC_OK);
    unsigned char *data = save(binding, &n_bytes), *lie = allocate(n_bytes + 1, 1);
    ck_assert_int_eq(try_load(n_bytes, data), ICC_OK);
    for (size_t n = 0; n < n_bytes; ++n) {
        ck_assert_int_eq(try_load(n, data), ICC_ERR_FORMAT);
        memcpy(lie, data, n_bytes);
        lie[n] ^= (unsigned char)(1 + n % 255);
        const icc_status status = try_load(n_bytes, lie);
        ck_assert(status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION);
    }
    memcpy(lie, data, n_bytes);
    ck_assert_int_eq(try_load(n_bytes + 1, lie), ICC_ERR_FORMAT);
    static const uint64_t HANDLES_AND_POINTS[][2] = {{4, UINT64_MAX},
                                                     {UINT64_MAX, 3},
                                                     {4, UINT64_MAX / 8 + 2},
                                                     {UINT64_MAX / 16 + 1, 1},
                                                     {2, 3},
                                                     {0, 0},
                                                     {4, 4},
                                                     {4, 2},
                                                     {1u << 31, 1u << 31}};
    for (size_t k = 0; k < sizeof HANDLES_AND_POINTS / sizeof *HANDLES_AND_POINTS + 4; ++k) {
        const bool counts = k >= 4;
        uint32_t head[2] = {k == 0 ? 1 : k == 1 ? 4 : 2, k == 2 ? 2 : 1};
        uint64_t sizes[2] = {counts ? HANDLES_AND_POINTS[k - 4][0] : 4,
                             counts ? HANDLES_AND_POINTS[k - 4][1] : 3};
        double numbers[50] = {0};
        iccp_blob w;
        size_t needed;
        if (k == 3)
            numbers[9] = NAN;
        iccp_blob_begin(&w, lie, n_bytes, "BIND", 1);
        iccp_blob_u32(&w, 2, head);
        iccp_blob_u64(&w, 2, sizes);
        iccp_blob_f64(&w, 50, numbers);
        iccp_blob_end(&w, &needed);
        ck_assert_uint_eq(needed, n_bytes);
        ck_assert_msg(try_load(n_bytes, lie) == ICC_ERR_FORMAT, "lie %zu", k);
    }
    free(points);
    free(data);
    free(lie);
    icc_binding_free(binding);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("binding_file");
    TCase *tests = tcase_create("binding_file");
    tcase_add_test(tests, bindings_come_back_bit_for_bit);
    tcase_add_test(tests, hostile_bytes_are_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
