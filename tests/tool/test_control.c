/* The command's readers of control points: every format gives the same points, and bad rows are named by their lines. */
#include "control/affine_fit.h"
#include "control/control_read.h"

#include "../suite.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static control_points accepted(const char *text)
{
    control_points c;
    problem wrong;
    if (!control_decode(&c, text, strlen(text), &wrong))
        ck_abort_msg("%s: %zu: %s", text, wrong.line, wrong.text);
    return c;
}

static void refused(const char *text, size_t line, const char *why)
{
    control_points c;
    problem wrong = {0, ""};
    if (control_decode(&c, text, strlen(text), &wrong))
        ck_abort_msg("accepted: %s", text);
    control_free(&c);
    ck_assert_msg(wrong.line == line, "line %zu, not %zu: %s: %s", wrong.line, line, wrong.text,
                  text);
    ck_assert_msg(strstr(wrong.text, why) != NULL, "'%s' is not in '%s'", why, wrong.text);
}

/* The points of all files below: a square of pixels, whose y is multiplied by `down`, and its places on a map. */
static void have_points(const control_points *c, size_t n, double down)
{
    static const double from[3][2] = {{0, 0}, {100, 0.5}, {100, 80}},
                        to[3][2] = {{10, 50}, {20, 50.25}, {20, 42}};
    ck_assert_uint_eq(c->n, n);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 2; k++) {
            ck_assert_double_eq(c->from[2 * i + k], from[i][k] * (k == 1 ? down : 1));
            ck_assert_double_eq(c->to[2 * i + k], to[i][k]);
        }
}

START_TEST(test_qgis)
{
    static const char *const heads[] = {"mapX,mapY,sourceX,sourceY,enable,dX,dY,residual",
                                        "mapX,mapY,pixelX,pixelY,enable"};
    for (size_t i = 0; i < 2; i++) {
        char text[400];
        snprintf(
            text, sizeof text,
            "\xef\xbb\xbf#CRS: EPSG:25832 "
            "\r\n%s\r\n10,50,0,0,1,0,0,0\r\n1,2,3,4,0\r\n\r\n20,50.25,100,-0.5,1\n20,42,100,-80,1",
            heads[i]);
        control_points c = accepted(text);
        have_points(&c, 3, -1);
        ck_assert_str_eq(c.crs, "EPSG:25832");
        ck_assert_uint_eq(c.n_disabled, 1);
        ck_assert_uint_eq(c.lines[0], 3);
        ck_assert_uint_eq(c.lines[2], 7);
        ck_assert(!c.rows_down && !affine_mirrors(&c));
        control_free(&c);
    }
    refused("mapX,mapY,pixelX,pixelY,enable\n1,2,3,4,1\n1,2,x,4,1\n", 3,
            "'x,4,1' is not a finite number");
    refused("mapX,mapY,sourceX,sourceY\n1,2,3,4\n", 2, "a row begins with mapX");
}
END_TEST

START_TEST(test_tables)
{
    static const char *const texts[] = {
        "0 0 10 50\n100 0.5 20 50.25\n100 80 20 42\n",
        "# pairs\n\n0\t0\t10\t50 0\r\n100\t0.5\t20\t50.25 0\r\n100 80 20 42 2",
        "0,0,10,50\n100,0.5,20,50.25\n,,,\n100,80,20,42\n",
        "0;0;10;50\n100;0.5;20;50.25\n100;80;20;42\n",
        "a,0,0,10,50\nb,100,0.5,20,50.25\n\"c\",100,80,20,42\n",
        "x,y,to_x,to_y\n0,0,10,50\n100,0.5,20,50.25\n100,80,20,42\n",
        "id,Latitude,Longitude,col,row,n\n1,50,10,0,0,a\n2,50.25,20,100,.5,\n3,42,20,100,80,\"\"\n",
        "x,y,lon,lat\n0,0,10,50\n100,0.5,20,50.25\n100,80,20,42\n",
        "x y to_x to_y sigma\n0 0 10 50 1\n100 0.5 20 50.25 1\n100 80 20 42 1\n",
        "one,two,three,four\n0,0,10,50\n100,0.5,20,50.25\n100,80,20,42\n",
        "enabled,x,y,to_x,to_y\n1,0,0,10,50\n0,1,1,1,1\n1,100,0.5,20,50.25\n1,100,80,20,42\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        control_points c = accepted(texts[i]);
        have_points(&c, 3, 1);
        ck_assert(c.has_tolerances == (i == 1 || i == 8));
        ck_assert(c.has_names == (i == 4 || i == 6));
        ck_assert_uint_eq(c.n_disabled, i == 10);
        control_free(&c);
    }
    control_points c = accepted("\xef\xbb\xbf\"church, old\",1,2,3,4\n,1,2,3,4\n");
    ck_assert_str_eq(c.names[0], "church, old");
    ck_assert_ptr_null(c.names[1]);
    control_free(&c);
    c = accepted("");
    ck_assert_uint_eq(c.n, 0);
    control_free(&c);
}
END_TEST

START_TEST(test_bad_tables)
{
    refused("0 0 10 50\n1 2 3\n", 2, "3 columns in this line, not 4");
    refused("0 0 10\n", 1, "a control point is `x y to_x to_y`");
    refused("0,0,10,50\n\n# a\n1,2,3,x\n", 4, "'x' is not a finite number");
    refused("0,0,10,50\n1,2,3,inf\n", 2, "'inf' is not a finite number");
    refused("0,0,10,50\n1,,3,4\n", 2, "'' is not a finite number");
    refused("0,0,10,50,-1\n", 1, "below 0");
    refused("x,y\n1,2\n", 1, "the heading lacks columns");
    refused("x,y,to_x,to_y,to_x\n1,2,3,4,5\n", 1, "two columns are called to_x");
}
END_TEST

START_TEST(test_gdal)
{
    control_points c = accepted(
        "<VRTDataset rasterXSize=\"1\">\n  <GCPList Projection=\"GEOGCS[&quot;WGS 84&quot;]\">\n"
        "    <GCP Id=\"a\" Pixel=\"0\" Line=\"0\" X=\"10\" Y=\"50\" Z=\"0\"/>\n"
        "    <GCP Id=\"\" Pixel=\"1.000000E+02\" Line=\"0.5\" X=\"20\" Y=\"50.25\"/>\n"
        "    <GCP Pixel=\"100\" Line=\"80\" X=\"20\" Y=\"42\"/>\n  </GCPList>\n</VRTDataset>\n");
    have_points(&c, 3, 1);
    ck_assert_str_eq(c.crs, "GEOGCS[\"WGS 84\"]");
    ck_assert_str_eq(c.names[0], "a");
    ck_assert_ptr_null(c.names[1]);
    ck_assert_uint_eq(c.lines[2], 5);
    ck_assert(c.rows_down && affine_mirrors(&c));
    control_free(&c);
    c = accepted("gdal_translate -of VRT -gcp 0 0 10 50 \\\n  -gcp 100 0.5 20 50.25 0 -gcp '100' "
                 "80 20 42 in.tif out.vrt\n");
    have_points(&c, 3, 1);
    ck_assert_uint_eq(c.lines[1], 2);
    ck_assert(c.rows_down);
    control_free(&c);
    refused("<VRTDataset>\n</VRTDataset>", 0, "no ground control points");
    refused("<VRTDataset><GCPList>\n<GCP Pixel=\"1\" Line=\"2\" X=\"3\"/>", 2, "no attribute Y");
    refused("<VRTDataset><GCPList>\n<GCP Pixel=\"1\" Line=\"2\" X=\"x\" Y=\"1\"/>", 2,
            "is not a finite number");
    refused("\n-gcp 1 2 3\n", 2, "not a finite number");
}
END_TEST

#define GCP(pixel, place)                                                                          \
    "{\"type\": \"Feature\", \"properties\": {" pixel                                              \
    "},\n\"geometry\": {\"type\": \"Point\", \"coordinates\": " place "}}"
#define BODY                                                                                       \
    "\"body\": {\"type\": \"FeatureCollection\", \"features\": [" GCP(                             \
        "\"resourceCoords\": [0, 0]",                                                              \
        "[10, 50]") "," GCP("\"resourceCoords\": [100, 0.5]",                                      \
                            "[20, 50.25]") "," GCP("\"pixelCoords\": [100, 80]", "[20, 42]") "]}"

START_TEST(test_annotations)
{
    static const char *const texts[] = {
        "{\"type\": \"Annotation\", " BODY "}",
        "{\"@context\": \"http://www.w3.org/ns/anno.jsonld\", \"type\": \"AnnotationPage\", "
        "\"items\": [{\"type\": \"Annotation\", " BODY "}]}",
        "{\"type\": \"GeoreferencedMap\", \"gcps\": [{\"resource\": [0, 0], \"geo\": [10, 50]}, "
        "{\"resource\": [100, 0.5], \"geo\": [20, 50.25]},"
        "{\"resource\": [100, 80], \"geo\": [20, 42]}]}",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        control_points c = accepted(texts[i]);
        have_points(&c, 3, 1);
        ck_assert(c.rows_down && affine_mirrors(&c));
        control_free(&c);
    }
    refused("{\"type\": \"AnnotationPage\", \"items\": []}", 0, "the page has 0 annotations");
    refused("{\"type\": \"Annotation\", \"body\": {}}", 0, "no control points");
    refused(
        "{\"type\": \"Annotation\", \"body\": {\"features\": [\n" GCP("\"a\": 1", "[1, 2]") "]}}",
        2, "control point 0 has no pixel");
    refused("{\"type\": \"Annotation\", \"body\": {\"features\": [\n" GCP(
                "\"resourceCoords\": [1, 2]", "[1]") "]}}",
            2, "control point 0 has no place");
}
END_TEST

#define FEATURE(type, properties, coordinates)                                                     \
    "{\"type\": \"Feature\", \"properties\": " properties ", \"geometry\": {\"type\": \"" type     \
    "\", \"coordinates\": " coordinates "}}"
#define COLLECTION(features) "{\"type\": \"FeatureCollection\", \"features\": [\n" features "]}"
#define OUTLINE FEATURE("Polygon", "{\"role\": \"source\"}", "[[[0,0],[1,0],[1,1],[0,0]]]")
#define PAIR(role, id, at) FEATURE("Point", "{\"role\": \"" role "\", " id "}", at)

START_TEST(test_links)
{
    static const char *const texts[] = {
        COLLECTION(OUTLINE "," FEATURE("LineString", "null", "[[0,0],[5,5],[10,50]]") ",\n" FEATURE(
            "LineString", "{}",
            "[[100,0.5],[20,50.25]]") "," FEATURE("LineString", "{\"enabled\": false}",
                                                  "[[1,2],[3,4]]") "," FEATURE("LineString", "{}",
                                                                               "[[100,80],[20,42]"
                                                                               "]")),
        COLLECTION(FEATURE("MultiLineString", "{}",
                           "[[[0,0],[10,50]],[[100,0.5],[20,50.25]],[[100,80],[20,42]]]")),
        COLLECTION(
            PAIR("source", "\"id\": 7", "[0,0]") "," PAIR("target", "\"feature\": 3", "[20,50.25]") "," PAIR(
                "source", "\"feature\": 3",
                "[100,0.5]") "," PAIR("target", "\"id\": 7",
                                      "[10,50]") "," PAIR("target", "\"id\": \"c\"",
                                                          "[20,42]") "," PAIR("source",
                                                                              "\"id\": \"c\"",
                                                                              "[100,80]")),
        FEATURE("LineString", "{}", "[[0,0],[10,50]]") "\n" FEATURE(
            "LineString", "{}", "[[100,0.5],[20,50.25]]") "\n" FEATURE("LineString", "{}",
                                                                       "[[100,80],[20,42]]"),
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        control_points c = accepted(texts[i]);
        have_points(&c, 3, 1);
        ck_assert(c.has_names == (i == 2));
        control_free(&c);
    }
    control_points c = accepted(COLLECTION(
        FEATURE("LineString", "{\"name\": \"hill\", \"tolerance\": 2.5}", "[[0,0],[10,50]]")));
    ck_assert_str_eq(c.names[0], "hill");
    ck_assert_double_eq(c.tolerances[0], 2.5);
    ck_assert_uint_eq(c.lines[0], 2);
    control_free(&c);
}
END_TEST

START_TEST(test_bad_links)
{
    refused(COLLECTION(OUTLINE), 0, "no control points");
    refused(COLLECTION(FEATURE("LineString", "{}", "[[1,2]]")), 2, "at least 2 vertices");
    refused(COLLECTION("\n" FEATURE("LineString", "{}", "[[1,2],[3,null]]")), 3,
            "pair of finite numbers");
    refused(COLLECTION(FEATURE("LineString", "{\"tolerance\": -1}", "[[1,2],[3,4]]")), 2,
            "tolerance");
    refused(
        COLLECTION(PAIR("source", "\"id\": 7", "[0,0]") ",\n" PAIR("target", "\"id\": 8", "[0,0]")),
        2, "this source Point has no partner");
    refused(
        COLLECTION(PAIR("source", "\"id\": 7", "[0,0]") ",\n" PAIR("source", "\"id\": 7", "[1,0]")),
        3, "same name");
    refused(COLLECTION(PAIR("source", "\"id\": 7", "[0,0]") ",\n" PAIR(
                "target", "\"id\": 7", "[1,0]") ",\n" PAIR("target", "\"id\": 7", "[2,0]")),
            3, "same name");
    refused(COLLECTION(PAIR("source", "\"a\": 7", "[0,0]")), 2, "which pairs it");
    refused(COLLECTION("{\"type\": \"Feature\", \"properties\": {\"role\": \"source\", \"id\": 1}, "
                       "\"geometry\": {\"type\": \"Point\"}}"),
            2, "pair of finite numbers");
    refused(COLLECTION("{\"type\": \"LineString\"}"), 2, "at least 2 vertices");
    refused("{\"a\": ", 1, "");
}
END_TEST

/* An affine map has no residuals, and one wrong point has most of its error; the sense of turning is told, and without one the format tells it. */
START_TEST(test_affine)
{
    char text[400] = "";
    static const double places[5][2] = {{0, 0}, {7, 1}, {6, 5}, {1, 4}, {3, 2}};
    for (size_t i = 0; i < 5; i++) {
        double x = places[i][0], y = places[i][1];
        snprintf(text + strlen(text), sizeof text - strlen(text), "%g %g %.17g %.17g\n", x, y,
                 1e6 + 3 * x - y, 5e5 + x + 2 * y + (i == 4));
    }
    control_points c = accepted(text);
    double r[10];
    affine_residuals(&c, r);
    ck_assert(!affine_mirrors(&c));
    for (size_t i = 0; i < 4; i++)
        ck_assert_double_lt(hypot(r[2 * i], r[2 * i + 1]), 0.4);
    ck_assert_double_gt(hypot(r[8], r[9]), 0.6);
    c.to[9] -= 1;
    affine_residuals(&c, r);
    for (size_t i = 0; i < 10; i++)
        ck_assert_double_lt(fabs(r[i]), 1e-8);
    c.n = 2;
    affine_residuals(&c, r);
    for (size_t i = 0; i < 4; i++)
        ck_assert_double_lt(fabs(r[i]), 1e-8);
    c.rows_down = true;
    ck_assert(affine_mirrors(&c));
    affine_residuals(&c, r);
    for (size_t i = 0; i < 4; i++)
        ck_assert_double_lt(fabs(r[i]), 1e-8);
    c.n = 5;
    ck_assert(!affine_mirrors(&c));
    for (size_t i = 0; i < 5; i++)
        c.to[2 * i] = -c.to[2 * i];
    ck_assert(affine_mirrors(&c));
    affine_residuals(&c, r);
    for (size_t i = 0; i < 10; i++)
        ck_assert_double_lt(fabs(r[i]), 1e-8);
    control_free(&c);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("control");
    TCase *tests = tcase_create("control");
    tcase_add_test(tests, test_qgis);
    tcase_add_test(tests, test_tables);
    tcase_add_test(tests, test_bad_tables);
    tcase_add_test(tests, test_gdal);
    tcase_add_test(tests, test_annotations);
    tcase_add_test(tests, test_links);
    tcase_add_test(tests, test_bad_links);
    tcase_add_test(tests, test_affine);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
