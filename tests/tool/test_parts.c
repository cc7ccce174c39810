/* OBJ files with several objects: which surface is the outer one, a void or a surface inside, and how two files are
 * paired. */
#include "cage/cage_features.h"
#include "cage/cage_parts.h"
#include "cage/cage_read.h"

#include "../suite.h"

#include <check.h>
#include <stdio.h>
#include <string.h>

enum { ROOM = 8000 };

/* A file that grows. */
typedef struct file {
    char text[ROOM];
    int n_vertices;
} file;

static void put(file *f, const char *line)
{
    ck_assert_uint_lt(strlen(f->text) + strlen(line), ROOM);
    strcat(f->text, line);
}

/* Adds a tetrahedron of a size, with a line such as "o void.1" before it. */
static void put_body(file *f, const char *heading, double size)
{
    char line[80];
    put(f, heading);
    for (int i = 0; i < 4; i++) {
        snprintf(line, sizeof line, "v %g %g %g\n", i == 1 ? size : 0, i == 2 ? size : 0,
                 i == 3 ? size : 0);
        put(f, line);
    }
    static const int faces[4][3] = {{1, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}};
    for (int i = 0; i < 4; i++) {
        snprintf(line, sizeof line, "f %d %d %d\n", f->n_vertices + faces[i][0],
                 f->n_vertices + faces[i][1], f->n_vertices + faces[i][2]);
        put(f, line);
    }
    f->n_vertices += 4;
}

static cage accepted(const file *f)
{
    cage c;
    problem wrong = {0, ""};
    const cage_choice choice = {.role = CAGE_SOURCE};
    if (!cage_read(&c, &choice, 2, f->text, strlen(f->text), &wrong))
        ck_abort_msg("%s: %s", f->text, wrong.text);
    ck_assert_uint_eq(c.dim, 3);
    return c;
}

static problem refused(const file *f)
{
    cage c;
    problem wrong = {0, ""};
    const cage_choice choice = {.role = CAGE_SOURCE};
    ck_assert(!cage_read(&c, &choice, 2, f->text, strlen(f->text), &wrong));
    return wrong;
}

START_TEST(test_names)
{
    file f = {"", 0};
    put_body(&f, "o Void.2\n", 0.1);
    put_body(&f, "o outer\n", 9);
    put_body(&f, "o surface.1\n", 0.2);
    put_body(&f, "o surfaces\ng x\n", 0.3);
    put(&f, "o nerve\nv 1 1 1\nv 2 2 2\nl 17 18\n");
    cage c = accepted(&f);
    ck_assert_uint_eq(c.n, 4);
    ck_assert_uint_eq(c.n_facets, 4);
    ck_assert(c.points[3] == 9);
    ck_assert_uint_eq(c.lines[0], 11);
    ck_assert_uint_eq(c.n_features, 4);
    static const int32_t kinds[] = {ICC_FEATURE_HOLE, ICC_FEATURE_REGION, ICC_FEATURE_REGION,
                                    ICC_FEATURE_LINE};
    static const char *const labels[] = {"Void.2", "surface.1", "surfaces", "nerve"};
    for (size_t i = 0; i < 4; i++) {
        feature_text name;
        ck_assert_int_eq(c.features[i].kind, kinds[i]);
        ck_assert_str_eq(c.features[i].label, labels[i]);
        ck_assert_str_eq(feature_name(name, &c.features[i]), labels[i]);
        ck_assert_uint_eq(c.features[i].n, i < 3 ? 4 : 2);
        ck_assert_uint_eq(c.features[i].n_facets, i < 3 ? 4 : 0);
    }
    ck_assert(c.features[1].points[3] == 0.2);
    ck_assert_uint_eq(c.features[1].facets[1], 2);
    ck_assert(c.features[3].points[3] == 2);
    cage_free(&c);
}
END_TEST

/* Without known names the largest object is the outer one. One object stays as it is. */
START_TEST(test_sizes)
{
    file f = {"", 0};
    put_body(&f, "g heart\n", 1);
    put_body(&f, "g torso\n", 5);
    cage c = accepted(&f);
    ck_assert(c.points[3] == 5);
    ck_assert_uint_eq(c.n_features, 1);
    ck_assert_int_eq(c.features[0].kind, ICC_FEATURE_REGION);
    ck_assert_str_eq(c.features[0].label, "heart");
    cage_free(&c);
    file one = {"", 0};
    put_body(&one, "o thing\n", 1);
    put(&one, "l 1 2\n");
    c = accepted(&one);
    ck_assert_uint_eq(c.n_features, 0);
    ck_assert_uint_eq(c.n, 4);
    cage_free(&c);
}
END_TEST

/* Groups of one surface share vertices. */
START_TEST(test_shared)
{
    file f = {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng bottom\nf 1 3 2\ng sides\nf 1 2 4\nf 2 3 4\nf "
              "3 1 4\n",
              4};
    cage c = accepted(&f);
    ck_assert_uint_eq(c.n_features, 0);
    ck_assert_uint_eq(c.n_facets, 4);
    cage_free(&c);
    file named = {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\no outer\nf 1 3 2\no void.1\nf 1 2 4\nf 2 3 "
                  "4\nf 3 1 4\n",
                  4};
    problem wrong = refused(&named);
    ck_assert_ptr_nonnull(strstr(wrong.text, "'outer' and 'void.1' share a vertex"));
    file inner = {"", 0};
    put_body(&inner, "o void.1\n", 1);
    put_body(&inner, "o void.2\n", 1);
    ck_assert_ptr_nonnull(strstr(refused(&inner).text, "outer"));
}
END_TEST

START_TEST(test_pairs)
{
    file f = {"", 0}, g = {"", 0}, h = {"", 0};
    problem wrong = {0, ""};
    put_body(&f, "o outer\n", 9);
    put_body(&f, "o void.1\n", 1);
    put_body(&f, "o void.2\n", 2);
    put_body(&g, "o void.2\n", 2);
    put_body(&g, "o outer\n", 9);
    put_body(&g, "o void.1\n", 1);
    put_body(&h, "o outer\n", 9);
    put_body(&h, "o void.1\n", 1);
    cage source = accepted(&f), target = accepted(&g), other = accepted(&h);
    ck_assert_str_eq(target.features[0].label, "void.2");
    ck_assert(cage_pair_parts(&source, &target, &wrong));
    ck_assert_str_eq(target.features[0].label, "void.1");
    ck_assert_str_eq(target.features[1].label, "void.2");
    ck_assert(target.features[1].points[3] == 2);
    ck_assert(features_correspond(&source, &target, &wrong));
    ck_assert(!cage_pair_parts(&source, &other, &wrong));
    ck_assert_str_eq(wrong.text, "'void.2' of the source has no partner in the target");
    target.features[0].facets[0]++;
    ck_assert(!cage_pair_parts(&source, &target, &wrong));
    ck_assert_ptr_nonnull(strstr(wrong.text, "'void.1' has other faces"));
    cage_free(&source);
    cage_free(&target);
    cage_free(&other);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("parts");
    TCase *tc = tcase_create("parts");
    tcase_add_test(tc, test_names);
    tcase_add_test(tc, test_sizes);
    tcase_add_test(tc, test_shared);
    tcase_add_test(tc, test_pairs);
    suite_add_tcase(suite, tc);
    return suite_run(suite);
}
