/* The command's reader of JSON: what it accepts and refuses, with the place of the fault; and that every value comes out
 * as it was written. */
#include "base/json_in.h"
#include "base/json_tree.h"

#include "../random.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Reads a copy without a '\0' behind it, so that a sanitizer sees the first byte read beyond the end. */
static bool read_bytes(json_tree *tree, const char *bytes, size_t n, bool sequence, problem *wrong)
{
    char *copy = malloc(n > 0 ? n : 1);
    ck_assert_ptr_nonnull(copy);
    memcpy(copy, bytes, n);
    *wrong = (problem){0, ""};
    bool good = (sequence ? json_tree_read_sequence : json_tree_read)(tree, copy, n, wrong);
    ck_assert(good == (wrong->text[0] == '\0'));
    free(copy);
    return good;
}

static json_tree accepted(const char *text)
{
    json_tree tree;
    problem wrong;
    if (!read_bytes(&tree, text, strlen(text), false, &wrong))
        ck_abort_msg("%s: %s", text, wrong.text);
    return tree;
}

static problem refused(const char *bytes, size_t n)
{
    json_tree tree;
    problem wrong;
    ck_assert_msg(!read_bytes(&tree, bytes, n, false, &wrong), "accepted: %s", bytes);
    json_tree_free(&tree);
    return wrong;
}

static double number_in(const char *text)
{
    json_tree tree = accepted(text);
    ck_assert(json_is(tree.root, JSON_NUMBER));
    double number = tree.root->number;
    json_tree_free(&tree);
    return number;
}

START_TEST(test_grammar)
{
    static const char *const good[] = {"{}",
                                       "[]",
                                       " [ ] ",
                                       "\t\r\n0\n",
                                       "\"\"",
                                       "true",
                                       "false",
                                       "null",
                                       "-0",
                                       "10",
                                       "0.5",
                                       "1e5",
                                       "1E+5",
                                       "1.5e-7",
                                       "[[],{}]",
                                       "{\"\":0}",
                                       "{\"a\":{\"a\":[{\"a\":1}]},\"b\":1}",
                                       "\xef\xbb\xbf[1]",
                                       "\"\x7f\"",
                                       "\"/\\/\""};
    static const char *const bad[] = {
        "",        " ",           "tru",        "True",     "nul",      "NaN",        "Infinity",
        "-",       "+1",          "01",         "-01",      "1.",       ".5",         "1e",
        "1e+",     "0x10",        "1 2",        "[1,]",     "[,1]",     "[1 2]",      "[1",
        "]",       "[}",          "{]",         "{\"a\"}",  "{\"a\":}", "{\"a\":1,}", "{,}",
        "{a:1}",   "{1:1}",       "{\"a\" 1}",  "'a'",      "\"a",      "\"a\nb\"",   "\"a\tb\"",
        "\"\\x\"", "\"\\u12g4\"", "\"\\u123\"", "\"\\",     "[1]x",     "[1]]",       "[1],",
        "{}{}",    "// no\n1",    "[1]/**/",    "\xef\xbb", "\xa0[]",   "[\v1]"};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        json_tree tree = accepted(good[i]);
        ck_assert_ptr_nonnull(tree.root);
        json_tree_free(&tree);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        refused(bad[i], strlen(bad[i]));
    refused("1\0", 2);
    refused("[1,\0 2]", 7);
    refused("\"a\0b\"", 5);
}
END_TEST

START_TEST(test_place_of_fault)
{
    static const struct {
        const char *text;
        size_t line;
        const char *message;
    } faults[] = {
        {"[1,\n [2, 3}", 2, "this is not valid JSON: this bracket closes none (column 7)"},
        {"[1,\n2", 2, "the JSON ends early (column 2)"},
        {"", 1, "the JSON ends early (column 1)"},
        {"{\"a\": 1,\n\n  \"b\" 2}", 3,
         "this is not valid JSON: a colon should be here (column 7)"},
        {"[1 2]", 1, "this is not valid JSON: a comma should be here (column 4)"},
        {"[1]\n{}", 2, "this is not valid JSON: something follows its end (column 1)"},
        {"{\"a\\n\\n\":1,\n\"b\":\"\\n\",\n\"c\":?}", 3, "this is not valid JSON (column 5)"},
        {"[\"a\\u\"]", 1, "this string is not valid JSON (column 5)"},
        {"{\"a\tb\": 1}", 1, "this string is not valid JSON (column 4)"},
        {"{1: 2}", 1, "this is not valid JSON: the name of a member should be here (column 2)"},
        {"[-]", 1, "this number is not valid JSON (column 3)"},
        {"[\n\"\xff\"]", 2, "this string is not UTF-8 (column 1)"},
        {"[\"\\ud800\"]", 1, "this string has half of a surrogate pair (column 2)"},
        {"{\"a\":1,\n\"b\":2,\"a\":3}", 2,
         "an earlier member of this object has the same name (column 11)"}};
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) {
        problem wrong = refused(faults[i].text, strlen(faults[i].text));
        ck_assert_str_eq(wrong.text, faults[i].message);
        ck_assert_uint_eq(wrong.line, faults[i].line);
    }
}
END_TEST

/* Every beginning of a text is refused, because it ends early or within a word or number. */
START_TEST(test_truncated)
{
    static const char text[] = "{\"type\": \"Feat\\u00e9\\ud83d\\ude00\", \"list\": [-1.5e-3, "
                               "true, false, null, {}], \"\xc3\xa9\": []}";
    for (size_t n = 0; n < sizeof text - 1; n++)
        refused(text, n);
    json_tree tree = accepted(text);
    json_tree_free(&tree);
}
END_TEST

START_TEST(test_numbers)
{
    ck_assert(number_in("0.1") == 0.1 && number_in("-1.5e3") == -1500 && number_in("1E2") == 100);
    ck_assert(number_in("-0") == 0 && signbit(number_in("-0")) && signbit(number_in("-0.0e5")));
    ck_assert(number_in("1e400") == HUGE_VAL && number_in("-1e400") == -HUGE_VAL);
    ck_assert(number_in("1e-400") == 0 && number_in("4.9406564584124654e-324") > 0);
    ck_assert(number_in("0e999999999999999999999") == 0);
    ck_assert(number_in("1.7976931348623157e308") < HUGE_VAL);
    ck_assert(number_in("9007199254740993") == 9007199254740992); /* a tie, to even */
    ck_assert(number_in("9007199254740993.0000000000000000000000000000001") == 9007199254740994);
    ck_assert(number_in("2.2250738585072011e-308") == 0x0.fffffffffffffp-1022);
    random_source r = {7};
    for (int round = share_of(20000); round > 0; round--) {
        char text[64];
        double x = ldexp(random_between(&r, -1, 1), (int)random_between(&r, -1060, 1020));
        snprintf(text, sizeof text, "%.17g", x);
        ck_assert(number_in(text) == x);
    }
}
END_TEST

START_TEST(test_strings)
{
    static const struct {
        const char *text, *string;
    } good[] = {
        {"\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"", "\"\\/\b\f\n\r\t"},
        {"\"\\u0041\\u00e9\\u20AC\\uFFFF\"", "A\xc3\xa9\xe2\x82\xac\xef\xbf\xbf"},
        {"\"\\ud83d\\ude00|\\uDBFF\\uDFFF|\\ud800\\udc00\"",
         "\xf0\x9f\x98\x80|\xf4\x8f\xbf\xbf|\xf0\x90\x80\x80"},
        {"\"a\\u0000b\"", "a\xc0\x80"
                          "b"},
        {"\"\xc2\x80\xdf\xbf\xe0\xa0\x80\xed\x9f\xbf\xee\x80\x80\xf0\x90\x80\x80\xf4\x8f\xbf\xbf\"",
         "\xc2\x80\xdf\xbf\xe0\xa0\x80\xed\x9f\xbf\xee\x80\x80\xf0\x90\x80\x80\xf4\x8f\xbf\xbf"}};
    static const char *const bad[] = {
        "\"\\ud800\"",          "\"\\udc00\"",      "\"\\ud800\\ud800\"",
        "\"\\ud800x\"",         "\"\\ud800\\n\"",   "\"\\udc00\\ud800\"",
        "\"\\ud800\\u0041\"",   "\"\x80\"",         "\"\xc0\x80\"",
        "\"\xc1\xbf\"",         "\"\xc3\"",         "\"\xc3(\"",
        "\"\xe0\x9f\xbf\"",     "\"\xe2\x82\"",     "\"\xed\xa0\x80\"",
        "\"\xf0\x8f\xbf\xbf\"", "\"\xf0\x9f\x98\"", "\"\xf4\x90\x80\x80\"",
        "\"\xf5\x80\x80\x80\"", "\"\xff\"",         "{\"\xff\":1}",
        "\"\xc3\\u00a9\""};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        json_tree tree = accepted(good[i].text);
        ck_assert_str_eq(json_string_of(tree.root), good[i].string);
        json_tree_free(&tree);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        refused(bad[i], strlen(bad[i]));
}
END_TEST

/* A million open brackets cost memory only. */
START_TEST(test_depth)
{
    enum { DEPTH = 1000000 };
    char *text = malloc(2 * DEPTH);
    ck_assert_ptr_nonnull(text);
    memset(text, '[', DEPTH);
    memset(text + DEPTH, ']', DEPTH);
    json_tree tree;
    problem wrong;
    ck_assert(read_bytes(&tree, text, 2 * DEPTH, false, &wrong));
    size_t depth = 0;
    for (const json_item *x = tree.root; x != NULL; x = json_first(x))
        depth++;
    ck_assert_uint_eq(depth, DEPTH);
    json_tree_free(&tree);
    ck_assert(!read_bytes(&tree, text, 2 * DEPTH - 1, false, &wrong));
    ck_assert(strncmp(wrong.text, "the JSON ends early", 19) == 0);
    json_tree_free(&tree);
    ck_assert(!read_bytes(&tree, text, DEPTH, false, &wrong));
    json_tree_free(&tree);
    free(text);
}
END_TEST

START_TEST(test_tree)
{
    static const char text[] = "{\"a\": [1, [2, 3], {\"b\": \"x\"}], \"c\": true, \"d\": {}}";
    json_tree tree = accepted(text);
    const json_item *a = json_get(tree.root, "a"), *pair = json_next(json_first(a)),
                    *object = json_next(pair);
    ck_assert(json_size(a) == 3 && json_first(a)->number == 1 && json_size(pair) == 2);
    ck_assert(json_next(json_first(pair))->number == 3 &&
              json_next(json_next(json_first(pair))) == NULL);
    ck_assert_str_eq(json_string_of(json_get(object, "b")), "x");
    ck_assert(json_next(object) == NULL && json_get(object, "a") == NULL &&
              json_get(a, "a") == NULL);
    ck_assert(json_size(object) == 0 && json_first(object) == NULL && json_first_member(a) == NULL);
    ck_assert(json_is(json_next(a), JSON_TRUE) && json_next(a) == json_get(tree.root, "c"));
    ck_assert(json_first_member(json_get(tree.root, "d")) == NULL);
    ck_assert(pair->end - pair->begin == 6 && strncmp(text + pair->begin, "[2, 3]", 6) == 0);
    ck_assert(tree.root->begin == 0 && tree.root->end == sizeof text - 1);
    ck_assert(json_get(NULL, "a") == NULL && json_next(NULL) == NULL && json_size(NULL) == 0 &&
              !json_is(NULL, JSON_NULL));
    json_tree_free(&tree);
}
END_TEST

/* Names are compared as they are meant. Different objects may have members of the same name. */
START_TEST(test_repeated_names)
{
    static const char *const bad[] = {"{\"a\":1,\"a\":1}", "{\"a\":1,\"b\":2,\"\\u0061\":3}",
                                      "[{\"\":[],\"\":{}}]"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        ck_assert(strstr(refused(bad[i], strlen(bad[i])).text, "same name") != NULL);
    json_tree tree = accepted("[{\"a\":{\"a\":1}},{\"a\":1,\"A\":2,\"a\\u0000\":3}]");
    json_tree_free(&tree);
}
END_TEST

static size_t n_texts(const char *text)
{
    json_tree tree;
    problem wrong;
    size_t n = read_bytes(&tree, text, strlen(text), true, &wrong) ? json_size(tree.root) : 0;
    json_tree_free(&tree);
    return n;
}

START_TEST(test_sequences)
{
    ck_assert_uint_eq(n_texts("{\"a\":1}"), 1);
    ck_assert_uint_eq(n_texts("{}\n{\"a\":[1]}\n\n{}\n"), 3);
    ck_assert_uint_eq(n_texts("\x1e{}\n\x1e{}\x1e{}"), 3);
    ck_assert_uint_eq(n_texts("\xef\xbb\xbf{}\r\n{}"), 2);
    ck_assert_uint_eq(n_texts("{} {}"), 0);
    ck_assert_uint_eq(n_texts("{}\n["), 0);
    ck_assert_uint_eq(n_texts("{}\n{"), 0);
    ck_assert_uint_eq(n_texts("\n"), 0);
    refused("{}\n{}", 5);
}
END_TEST

START_TEST(test_checked_values)
{
    json_tree tree = accepted("{\"r\": 1e400, \"p\": [[1, 2], [3, 4]], \"e\": [[0, 1], [2, 0]], "
                              "\"i\": 1.5, \"s\": \"1\"}");
    const json_item *file = tree.root;
    problem wrong;
    double x, *points;
    size_t n;
    uint32_t index, *pairs;
    ck_assert(!json_real(json_get(file, "r"), "r", &x, &wrong));
    ck_assert_str_eq(wrong.text, "r is not a finite number");
    ck_assert(!json_real(json_get(file, "s"), "s", &x, &wrong) &&
              !json_real(NULL, "missing", &x, &wrong));
    ck_assert(json_points(json_get(file, "p"), "p", 2, &n, &points, &wrong) && n == 2 &&
              points[3] == 4);
    free(points);
    ck_assert(!json_points(json_get(file, "p"), "p", 3, &n, &points, &wrong));
    ck_assert_str_eq(wrong.text, "p[0] is not a list of 3 finite numbers");
    free(points);
    ck_assert(json_pairs(json_get(file, "e"), "e", "handle", 3, &n, &pairs, &wrong) && n == 2 &&
              pairs[2] == 2);
    free(pairs);
    ck_assert(!json_pairs(json_get(file, "e"), "e", "handle", 2, &n, &pairs, &wrong));
    ck_assert_str_eq(wrong.text, "e[1] must be a handle, a whole number from 0 to 1");
    free(pairs);
    ck_assert(!json_index(json_get(file, "i"), "i", "handle", 3, &index, &wrong));
    json_tree_free(&tree);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("json");
    TCase *tests = tcase_create("json");
    tcase_add_test(tests, test_grammar);
    tcase_add_test(tests, test_place_of_fault);
    tcase_add_test(tests, test_truncated);
    tcase_add_test(tests, test_numbers);
    tcase_add_test(tests, test_strings);
    tcase_add_test(tests, test_depth);
    tcase_add_test(tests, test_tree);
    tcase_add_test(tests, test_repeated_names);
    tcase_add_test(tests, test_sequences);
    tcase_add_test(tests, test_checked_values);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
