/* The command's reader of points and lines inside a solid: what it takes from each format, and what it refuses. */
#include "solid/marks.h"

#include "../suite.h"

#include <check.h>
#include <string.h>

static marks accepted(mark_kind kind, const char *text)
{
    marks m;
    problem wrong = {0, ""};
    if (!marks_read(&m, kind, text, strlen(text), &wrong))
        ck_abort_msg("%s: %s", text, wrong.text);
    return m;
}

static problem refused(mark_kind kind, const char *text)
{
    marks m;
    problem wrong = {0, ""};
    ck_assert_msg(!marks_read(&m, kind, text, strlen(text), &wrong), "accepted: %s", text);
    ck_assert(wrong.text[0] != '\0');
    marks_free(&m);
    return wrong;
}

/* Checks a mark with one place on each of n_sides sides: 1, 2, 3 and 4, 5, 6. */
static void check_point(const mark *m, const char *name, int n_sides)
{
    ck_assert_str_eq(m->name, name);
    for (int side = 0; side < 2; side++) {
        ck_assert_uint_eq(m->n[side], side < n_sides);
        for (int k = 0; k < 3 && side < n_sides; k++)
            ck_assert(m->points[side][k] == 1 + 3 * side + k);
    }
}

START_TEST(test_tables)
{
    static const struct {
        const char *text, *name;
        int n_sides;
    } good[] = {{"name,x,y,z,x',y',z'\ntip,1,2,3,4,5,6\n", "tip", 2},
                {"\xef\xbb\xbfname;x;y;z\r\n\"the tip\";1;2;3\r\n", "the tip", 1},
                {"# places\n\n1 2 3 4 5 6", "", 2},
                {"tip 1 2 3\n", "tip", 1},
                {"x,y,z\n1,2,3\n", "", 1},
                {" 1 , 2 , 3e0 \n", "", 1}};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        marks m = accepted(MARK_POINT, good[i].text);
        ck_assert_uint_eq(m.n, 1);
        check_point(&m.items[0], good[i].name, good[i].n_sides);
        marks_free(&m);
    }
    ck_assert_uint_eq(refused(MARK_POINT, "name,x,y,z\na,1,2,3\nb,1,2\n").line, 3);
    ck_assert_uint_eq(refused(MARK_POINT, "1,2,3\n4,5,six\n").line, 2);
    ck_assert_uint_eq(refused(MARK_POINT, "1,2,3\n4,5,inf\n").line, 2);
    ck_assert_uint_eq(refused(MARK_POINT, "1,2,3\n1,2,3,4,5,6\n").line, 2);
    refused(MARK_POINT, "name,x,y,z\n");
    refused(MARK_POINT, "");
    refused(MARK_LINE, "1,2,3\n4,5,6\n");
}
END_TEST

START_TEST(test_slicer)
{
    marks m = accepted(MARK_POINT,
                       "# Markups fiducial file version = 4.11\n"
                       "# CoordinateSystem = LPS\n"
                       "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
                       "1,1,2,3,0,0,0,1,1,1,0,F-1,,,2,0\n");
    ck_assert_uint_eq(m.n, 1);
    check_point(&m.items[0], "F-1", 1);
    ck_assert_uint_eq(m.items[0].line, 4);
    ck_assert_str_eq(m.axes, "LPS");
    marks_free(&m);
    m = accepted(
        MARK_POINT,
        "# Markups fiducial file version = 4.6\n# CoordinateSystem = 0\n"
        "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label\nvtk_0,1,2,3,0,0,0,1,1,1,0,tip\n");
    check_point(&m.items[0], "tip", 1);
    ck_assert_str_eq(m.axes, "RAS");
    marks_free(&m);
    static const char json[] =
        "{\"@schema\": \"x\", \"markups\": [\n"
        "{\"type\": \"Fiducial\", \"coordinateSystem\": \"LPS\", \"controlPoints\": [\n"
        " {\"label\": \"tip\", \"position\": [1, 2, 3]}, {\"label\": \"end\", \"position\": [4, 5, "
        "6]}]},\n"
        "{\"type\": \"Curve\", \"name\": \"vessel\", \"coordinateSystem\": \"LPS\", "
        "\"controlPoints\": [\n"
        " {\"position\": [1, 2, 3]}, {\"position\": [4, 5, 6]}]},\n"
        "{\"type\": \"ClosedCurve\", \"controlPoints\": [{\"position\": [0, 0, 0]},\n"
        " {\"position\": [1, 0, 0]}, {\"position\": [0, 1, 0]}]}]}";
    m = accepted(MARK_POINT, json);
    ck_assert_uint_eq(m.n, 2);
    check_point(&m.items[0], "tip", 1);
    ck_assert_uint_eq(m.items[1].line, 3);
    marks_free(&m);
    m = accepted(MARK_LINE, json);
    ck_assert_uint_eq(m.n, 2);
    ck_assert_str_eq(m.items[0].name, "vessel");
    ck_assert_uint_eq(m.items[0].n[0], 2);
    ck_assert(m.items[0].points[0][5] == 6);
    ck_assert_uint_eq(m.items[1].n[0], 4);
    ck_assert_mem_eq(m.items[1].points[0], m.items[1].points[0] + 9, 3 * sizeof(double));
    marks_free(&m);
    refused(MARK_POINT, "# Markups fiducial file version = 4.11\n1,2\n");
    refused(
        MARK_POINT,
        "{\"markups\": [{\"type\": \"Fiducial\", \"controlPoints\": [{\"position\": [1, 2]}]}]}");
    refused(
        MARK_LINE,
        "{\"markups\": [{\"type\": \"Curve\", \"controlPoints\": [{\"position\": [1, 2, 3]}]}]}");
    refused(MARK_POINT, "{\"markups\": [{\"coordinateSystem\": \"LPS\", \"controlPoints\": []},"
                        "{\"coordinateSystem\": \"RAS\", \"controlPoints\": []}]}");
    refused(MARK_POINT, "{\"markups\": []}");
    refused(MARK_POINT, "{\"type\": \"FeatureCollection\"}");
}
END_TEST

START_TEST(test_lists)
{
    marks m = accepted(MARK_LINE, "[{\"name\": \"line.1\",\n \"source\": [[1, 2, 3], [0, 0, 0]],"
                                  " \"target\": [[4, 5, 6], [7, 8, 9]]}]");
    ck_assert_uint_eq(m.n, 1);
    ck_assert_str_eq(m.items[0].name, "line.1");
    ck_assert_uint_eq(m.items[0].n[0], 2);
    ck_assert_uint_eq(m.items[0].n[1], 2);
    ck_assert(m.items[0].points[1][5] == 9);
    marks_free(&m);
    m = accepted(MARK_POINT, "[{\"source\": [1, 2, 3], \"target\": [4, 5, 6]}]");
    check_point(&m.items[0], "", 2);
    marks_free(&m);
    m = accepted(MARK_POINT, "[{\"name\": \"tip\", \"source\": [[1, 2, 3]]}]");
    check_point(&m.items[0], "tip", 1);
    marks_free(&m);
    ck_assert_ptr_nonnull(
        strstr(refused(MARK_LINE, "[{\"source\": [[1, 2, 3]]}]").text, "at least 2"));
    ck_assert_ptr_nonnull(
        strstr(refused(MARK_LINE, "[{\"source\": [[1, 2, 3], [4, 5]]}]").text, "line 0.source"));
    refused(MARK_LINE, "[{\"source\": [[1, 2, 3], [4, 5, 6]], \"target\": [[1, 2, 3]]}]");
    refused(MARK_LINE, "[{\"target\": [[1, 2, 3], [4, 5, 6]]}]");
    refused(MARK_LINE, "[{\"sauce\": [[1, 2, 3], [4, 5, 6]]}]");
    refused(MARK_LINE, "[]");
    refused(MARK_LINE, "[");
}
END_TEST

START_TEST(test_obj)
{
    static const char text[] = "# lines\no vessel\nv 1 2 3\nv 4 5 6\nv 7 8 9\nl 1 2\nl 2 3\nl 1 3\n"
                               "g part\no nerve\nl 3 2 -3\n";
    marks m = accepted(MARK_LINE, text);
    ck_assert_uint_eq(m.n, 3);
    ck_assert_str_eq(m.items[0].name, "vessel");
    ck_assert_uint_eq(m.items[0].n[0], 3);
    ck_assert(m.items[0].points[0][8] == 9);
    ck_assert_uint_eq(m.items[1].n[0], 2);
    ck_assert_str_eq(m.items[1].name, "vessel");
    ck_assert_str_eq(m.items[2].name, "nerve");
    ck_assert_uint_eq(m.items[2].n[0], 3);
    ck_assert(m.items[2].points[0][6] == 1);
    marks_free(&m);
    m = accepted(MARK_POINT, text);
    ck_assert_uint_eq(m.n, 3);
    check_point(&m.items[0], "", 1);
    marks_free(&m);
    ck_assert_uint_eq(refused(MARK_LINE, "v 1 2 3\nv 4 5 6\nl 1 3\n").line, 3);
    ck_assert_uint_eq(refused(MARK_LINE, "v 1 2 3\nl 1\n").line, 2);
    refused(MARK_LINE, "v 1 2 3\nv 4 5 6\n");
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("marks");
    TCase *tc = tcase_create("marks");
    tcase_add_test(tc, test_tables);
    tcase_add_test(tc, test_slicer);
    tcase_add_test(tc, test_lists);
    tcase_add_test(tc, test_obj);
    suite_add_tcase(suite, tc);
    return suite_run(suite);
}
