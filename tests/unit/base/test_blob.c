/* Objects as bytes. */
#include "base/blob.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t NUMBERS[3] = {0, 0x01020304, UINT32_MAX};
static const double REALS[4] = {-0.0, 1.0 / 3, 4.9406564584124654e-324, 1.7976931348623157e308};

static size_t write_all(void *data, size_t capacity)
{
    iccp_blob_writer w;
    size_t n;
    iccp_blob_begin(&w, data, capacity, "TEST", 3);
    iccp_blob_u64(&w, UINT64_MAX - 1);
    iccp_blob_u64(&w, 3);
    iccp_blob_u32(&w, 3, NUMBERS);
    iccp_blob_f64(&w, 4, REALS);
    iccp_blob_end(&w, &n);
    return n;
}

START_TEST(what_was_written_is_read)
{
    unsigned char data[256];
    uint32_t numbers[3];
    double reals[4];
    iccp_blob_reader r;
    const size_t n = write_all(data, sizeof data);
    ck_assert_uint_eq(n, 24 + 8 + 8 + 12 + 32);
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 3, NULL), ICC_OK);
    ck_assert_uint_eq(iccp_blob_read_u64(&r), UINT64_MAX - 1);
    ck_assert_uint_eq(iccp_blob_read_count(&r, 4), 3);
    iccp_blob_read_u32(&r, 3, numbers);
    ck_assert(!iccp_blob_done(&r));
    iccp_blob_read_f64(&r, 4, reals);
    ck_assert(iccp_blob_done(&r));
    ck_assert_int_eq(memcmp(numbers, NUMBERS, sizeof numbers), 0);
    ck_assert_int_eq(memcmp(reals, REALS, sizeof reals), 0);
    /* Beyond the end there are zeros, and the reader knows. */
    ck_assert_uint_eq(iccp_blob_read_u64(&r), 0);
    ck_assert(r.failed && !iccp_blob_done(&r));
}
END_TEST

/* The bytes of docs/formats.md, the checksum from zlib: the same on every machine. */
START_TEST(the_format_is_the_documented_one)
{
    static const unsigned char EXPECTED[32] = {
        'L', 'I', 'C', 'C', 'T', 'E', 'S', 'T', 1, 0, 0, 0, 0xc1, 0x34, 0xc4, 0x34,
        32,  0,   0,   0,   0,   0,   0,   0,   0, 0, 0, 0, 0,    0,    0xf0, 0xbf};
    const double minus_one = -1;
    unsigned char data[32];
    iccp_blob_writer w;
    size_t n;
    iccp_blob_begin(&w, data, sizeof data, "TEST", 1);
    iccp_blob_f64(&w, 1, &minus_one);
    iccp_blob_end(&w, &n);
    ck_assert_uint_eq(n, 32);
    ck_assert_int_eq(memcmp(data, EXPECTED, 32), 0);
}
END_TEST

START_TEST(any_capacity_tells_what_is_needed)
{
    unsigned char whole[256], data[256];
    const size_t n = write_all(whole, sizeof whole);
    ck_assert_uint_eq(write_all(NULL, 0), n);
    for (size_t capacity = 0; capacity <= n; ++capacity) {
        memset(data, 0x5a, sizeof data);
        ck_assert_uint_eq(write_all(data, capacity), n);
        for (size_t i = capacity; i < sizeof data; ++i)
            ck_assert_uint_eq(data[i], 0x5a);
    }
    ck_assert_int_eq(memcmp(data, whole, n), 0);
}
END_TEST

START_TEST(nothing_else_is_opened)
{
    unsigned char data[256];
    iccp_blob_reader r;
    icc_error err = {.size = sizeof err};
    const size_t n = write_all(data, sizeof data);
    for (size_t size = 0; size < n; ++size)
        ck_assert_int_eq(iccp_blob_open(&r, data, size, "TEST", 3, &err), ICC_ERR_FORMAT);
    ck_assert_int_eq(iccp_blob_open(&r, data, n + 1, "TEST", 3, &err), ICC_ERR_FORMAT);
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "MESH", 3, &err), ICC_ERR_FORMAT);
    ck_assert_ptr_nonnull(strstr(err.message, "MESH"));
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 2, &err), ICC_ERR_VERSION);
    for (size_t bit = 0; bit < 8 * n; ++bit) {
        data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 3, &err), ICC_ERR_FORMAT);
        data[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 4, &err), ICC_OK);
}
END_TEST

START_TEST(counts_are_believed_only_if_the_bytes_are_there)
{
    static const uint64_t COUNTS[] = {2, 3, UINT64_MAX, UINT64_MAX / 8, (uint64_t)1 << 61};
    for (size_t i = 0; i < sizeof COUNTS / sizeof *COUNTS; ++i) {
        unsigned char data[64];
        iccp_blob_writer w;
        iccp_blob_reader r;
        size_t n;
        iccp_blob_begin(&w, data, sizeof data, "TEST", 1);
        iccp_blob_u64(&w, COUNTS[i]);
        iccp_blob_f64(&w, 2, REALS);
        iccp_blob_end(&w, &n);
        ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, NULL), ICC_OK);
        ck_assert_uint_eq(iccp_blob_read_count(&r, 8), i == 0 ? 2 : 0);
        ck_assert_int_eq(r.failed, i > 0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("blob");
    TCase *c = tcase_create("blob");
    tcase_add_test(c, what_was_written_is_read);
    tcase_add_test(c, the_format_is_the_documented_one);
    tcase_add_test(c, any_capacity_tells_what_is_needed);
    tcase_add_test(c, nothing_else_is_opened);
    tcase_add_test(c, counts_are_believed_only_if_the_bytes_are_there);
    suite_add_tcase(suite, c);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
