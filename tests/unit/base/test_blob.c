/* Objects as bytes. */
#include "base/blob.h"

#include "../../suite.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

static const iccp_memory *const MEMORY = &iccp_memory_default;
static const uint32_t NUMBERS[3] = {0, 0x01020304, UINT32_MAX};
static const double REALS[4] = {-0.0, 1.0 / 3, 4.9406564584124654e-324, 1.7976931348623157e308};

typedef struct content {
    uint64_t first;
    size_t n;
    uint32_t *numbers;
    double reals[4];
    int32_t small, wide;
} content;

/* Both ways. */
static void visit(iccp_blob *b, content *c)
{
    iccp_blob_u64(b, 1, &c->first);
    iccp_blob_count(b, 4, &c->n);
    iccp_blob_array_u32(b, c->n, &c->numbers);
    iccp_blob_f64(b, 4, c->reals);
    iccp_blob_i32(b, ICCP_U32, -3, 7, &c->small);
    iccp_blob_i32(b, ICCP_U64, 0, INT32_MAX, &c->wide);
}

static size_t write_all(void *data, size_t capacity)
{
    uint32_t numbers[3];
    content c = {
        .first = UINT64_MAX - 1, .n = 3, .numbers = numbers, .small = 7, .wide = INT32_MAX};
    memcpy(numbers, NUMBERS, sizeof numbers);
    memcpy(c.reals, REALS, sizeof c.reals);
    iccp_blob w;
    size_t n;
    iccp_blob_begin(&w, data, capacity, "TEST", 3);
    visit(&w, &c);
    iccp_blob_end(&w, &n);
    return n;
}

START_TEST(what_was_written_is_read)
{
    unsigned char data[256];
    content c = {0};
    iccp_blob r;
    uint64_t beyond = 1;
    double *none;
    const size_t n = write_all(data, sizeof data);
    ck_assert_uint_eq(n, 24 + 8 + 8 + 12 + 32 + 4 + 8);
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 3, MEMORY, NULL), ICC_OK);
    ck_assert(!iccp_blob_done(&r));
    visit(&r, &c);
    ck_assert(iccp_blob_done(&r));
    ck_assert_uint_eq(c.first, UINT64_MAX - 1);
    ck_assert_uint_eq(c.n, 3);
    ck_assert_int_eq(memcmp(c.numbers, NUMBERS, sizeof NUMBERS), 0);
    ck_assert_int_eq(memcmp(c.reals, REALS, sizeof REALS), 0);
    ck_assert_int_eq(c.small, 7);
    ck_assert_int_eq(c.wide, INT32_MAX);
    /* Beyond the end there are zeros and no arrays, and the reader knows. */
    iccp_blob_u64(&r, 1, &beyond);
    ck_assert_uint_eq(beyond, 0);
    ck_assert_int_eq(r.status, ICC_ERR_FORMAT);
    iccp_blob_array_f64(&r, 0, &none);
    ck_assert_ptr_null(none);
    ck_assert(!iccp_blob_done(&r));
    free(c.numbers);
}
END_TEST

START_TEST(writing_leaves_values_alone)
{
    const content original = {.first = 5, .n = 1, .reals = {1, 2, 3, 4}, .small = 2, .wide = 9};
    content c = original;
    uint32_t number = 8;
    unsigned char data[256];
    iccp_blob w;
    c.numbers = &number;
    iccp_blob_begin(&w, data, sizeof data, "TEST", 1);
    visit(&w, &c);
    iccp_blob_require(&w, false);
    ck_assert_int_eq(w.status, ICC_OK);
    ck_assert_ptr_eq(c.numbers, &number);
    ck_assert_uint_eq(number, 8);
    ck_assert(c.first == original.first && c.n == original.n && c.small == original.small &&
              c.wide == original.wide);
    ck_assert_int_eq(memcmp(c.reals, original.reals, sizeof c.reals), 0);
}
END_TEST

START_TEST(integers_beyond_their_range_are_refused)
{
    static const uint64_t VALUES[] = {2, 3, 7, 8, UINT32_MAX, UINT64_MAX, (uint64_t)1 << 32 | 3};
    for (size_t i = 0; i < sizeof VALUES / sizeof *VALUES; ++i) {
        const bool fits = VALUES[i] >= 3 && VALUES[i] <= 7;
        uint64_t value = VALUES[i];
        int32_t number = 1;
        unsigned char data[64];
        iccp_blob b;
        size_t n;
        iccp_blob_begin(&b, data, sizeof data, "TEST", 1);
        iccp_blob_u64(&b, 1, &value);
        iccp_blob_end(&b, &n);
        ck_assert_int_eq(iccp_blob_open(&b, data, n, "TEST", 1, MEMORY, NULL), ICC_OK);
        iccp_blob_i32(&b, ICCP_U64, 3, 7, &number);
        ck_assert_int_eq(b.status, fits ? ICC_OK : ICC_ERR_FORMAT);
        ck_assert_int_eq(number, fits ? (int32_t)value : 0);
    }
}
END_TEST

/* The bytes of docs/reference/formats.md, the checksum from zlib: the same on every machine. */
START_TEST(the_format_is_the_documented_one)
{
    static const unsigned char EXPECTED[32] = {
        'L', 'I', 'C', 'C', 'T', 'E', 'S', 'T', 1, 0, 0, 0, 0xc1, 0x34, 0xc4, 0x34,
        32,  0,   0,   0,   0,   0,   0,   0,   0, 0, 0, 0, 0,    0,    0xf0, 0xbf};
    double minus_one = -1;
    unsigned char data[32];
    iccp_blob w;
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
    iccp_blob r;
    icc_error err = {.size = sizeof err};
    const size_t n = write_all(data, sizeof data);
    for (size_t size = 0; size < n; ++size)
        ck_assert_int_eq(iccp_blob_open(&r, data, size, "TEST", 3, MEMORY, &err), ICC_ERR_FORMAT);
    ck_assert_int_eq(iccp_blob_open(&r, data, n + 1, "TEST", 3, MEMORY, &err), ICC_ERR_FORMAT);
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "MESH", 3, MEMORY, &err), ICC_ERR_FORMAT);
    ck_assert_ptr_nonnull(strstr(err.message, "MESH"));
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 2, MEMORY, &err), ICC_ERR_VERSION);
    for (size_t bit = 0; bit < 8 * n; ++bit) {
        data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 3, MEMORY, &err), ICC_ERR_FORMAT);
        data[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 4, MEMORY, &err), ICC_OK);
}
END_TEST

/* Wherever they are, in one strand of the checksum or in two. */
START_TEST(two_changed_bits_are_noticed)
{
    enum { WORDS = 24 };
    double reals[WORDS - 3];
    unsigned char data[8 * WORDS];
    iccp_blob w, r;
    size_t n;
    for (size_t i = 0; i < WORDS - 3; ++i)
        reals[i] = i % 3 == 0 ? 0 : 1.0 / (double)i;
    iccp_blob_begin(&w, data, sizeof data, "TEST", 1);
    iccp_blob_f64(&w, WORDS - 3, reals);
    iccp_blob_end(&w, &n);
    ck_assert_uint_eq(n, sizeof data);
    for (size_t a = 8 * 24; a < 8 * 40; ++a)
        for (size_t b = a + 1; b < 8 * n; ++b) {
            data[a / 8] ^= (unsigned char)(1u << a % 8);
            data[b / 8] ^= (unsigned char)(1u << b % 8);
            ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, MEMORY, NULL), ICC_ERR_FORMAT);
            data[a / 8] ^= (unsigned char)(1u << a % 8);
            data[b / 8] ^= (unsigned char)(1u << b % 8);
        }
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, MEMORY, NULL), ICC_OK);
}
END_TEST

/* Words that have changed places. */
START_TEST(exchanged_words_are_noticed)
{
    enum { WORDS = 16 };
    uint64_t words[WORDS];
    unsigned char data[8 * (3 + WORDS)], old[8];
    iccp_blob w, r;
    size_t n;
    for (size_t i = 0; i < WORDS; ++i)
        words[i] = i * 0x9e3779b97f4a7c15u;
    iccp_blob_begin(&w, data, sizeof data, "TEST", 1);
    iccp_blob_u64(&w, WORDS, words);
    iccp_blob_end(&w, &n);
    for (size_t a = 0; a < WORDS; ++a)
        for (size_t b = a + 1; b < WORDS; ++b)
            for (int back = 0; back < 2; ++back) {
                unsigned char *x = data + 24 + 8 * a, *y = data + 24 + 8 * b;
                memcpy(old, x, 8);
                memcpy(x, y, 8);
                memcpy(y, old, 8);
                ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, MEMORY, NULL),
                                 back ? ICC_OK : ICC_ERR_FORMAT);
            }
}
END_TEST

/* Whatever the length. */
START_TEST(every_length_has_its_checksum)
{
    unsigned char data[128];
    for (uint32_t n_numbers = 0; n_numbers < 20; ++n_numbers) {
        uint32_t numbers[20] = {0};
        iccp_blob w, r;
        size_t n;
        iccp_blob_begin(&w, data, sizeof data, "TEST", 1);
        iccp_blob_u32(&w, n_numbers, numbers);
        iccp_blob_end(&w, &n);
        ck_assert_uint_eq(n, 24 + 4 * n_numbers);
        ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, MEMORY, NULL), ICC_OK);
        for (size_t i = 0; i < n; ++i) {
            data[i] ^= 0x81;
            ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, MEMORY, NULL), ICC_ERR_FORMAT);
            data[i] ^= 0x81;
        }
    }
}
END_TEST

START_TEST(counts_are_believed_only_if_the_bytes_are_there)
{
    static const uint64_t COUNTS[] = {2, 3, UINT64_MAX, UINT64_MAX / 8, (uint64_t)1 << 61};
    for (size_t i = 0; i < sizeof COUNTS / sizeof *COUNTS; ++i) {
        uint64_t written = COUNTS[i];
        double reals[2] = {1, 2}, *array;
        unsigned char data[64];
        iccp_blob w, r;
        size_t n, count;
        iccp_blob_begin(&w, data, sizeof data, "TEST", 1);
        iccp_blob_u64(&w, 1, &written);
        iccp_blob_f64(&w, 2, reals);
        iccp_blob_end(&w, &n);
        ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, MEMORY, NULL), ICC_OK);
        iccp_blob_count(&r, 8, &count);
        ck_assert_uint_eq(count, i == 0 ? 2 : 0);
        ck_assert_int_eq(r.status, i > 0 ? ICC_ERR_FORMAT : ICC_OK);
        ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 1, MEMORY, NULL), ICC_OK);
        iccp_blob_size(&r, &count);
        iccp_blob_array_f64(&r, count, &array);
        ck_assert_int_eq(array != NULL, i == 0);
        ck_assert_int_eq(iccp_blob_done(&r), i == 0);
        free(array);
    }
}
END_TEST

static void *refuse(void *user, size_t size)
{
    (void)user;
    (void)size;
    return NULL;
}

START_TEST(a_failing_allocation_is_remembered)
{
    const iccp_memory none = {.alloc = refuse, .dealloc = iccp_memory_default.dealloc};
    unsigned char data[256];
    content c = {0};
    iccp_blob r;
    const size_t n = write_all(data, sizeof data);
    ck_assert_int_eq(iccp_blob_open(&r, data, n, "TEST", 3, &none, NULL), ICC_OK);
    visit(&r, &c);
    ck_assert_int_eq(r.status, ICC_ERR_MEMORY);
    ck_assert_ptr_null(c.numbers);
    ck_assert(c.reals[0] >= 0 && c.reals[0] <= 0 && c.small == 0 && c.wide == 0);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("blob");
    TCase *c = tcase_create("blob");
    tcase_add_test(c, what_was_written_is_read);
    tcase_add_test(c, writing_leaves_values_alone);
    tcase_add_test(c, integers_beyond_their_range_are_refused);
    tcase_add_test(c, the_format_is_the_documented_one);
    tcase_add_test(c, any_capacity_tells_what_is_needed);
    tcase_add_test(c, nothing_else_is_opened);
    tcase_add_test(c, two_changed_bits_are_noticed);
    tcase_add_test(c, exchanged_words_are_noticed);
    tcase_add_test(c, every_length_has_its_checksum);
    tcase_add_test(c, counts_are_believed_only_if_the_bytes_are_there);
    tcase_add_test(c, a_failing_allocation_is_remembered);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
