/* Recognises the format of control points by the beginning of the text. */
#include "control/control_read.h"

#include "base/file.h"
#include "base/foreign.h"
#include "base/json_tree.h"
#include "control/control_readers.h"

#include <stdlib.h>
#include <string.h>

static bool read_json(control_points *out, const char *text, size_t n, problem *wrong)
{
    json_tree tree;
    bool good = json_tree_read_sequence(&tree, text, n, wrong);
    if (good && control_is_annotation(&tree))
        good = control_read_annotation(out, &tree, text, wrong);
    else if (good && control_has_pins(&tree))
        good = control_read_pins(out, &tree, text, wrong);
    else if (good && json_get(json_first(tree.root), "type") == NULL)
        good = !foreign_told(text, n, wrong) &&
               spoilt(wrong, 0,
                      "this JSON has neither \"pins\" nor GeoJSON's \"type\"; pins are {\"pins\": "
                      "[{\"at\": [x, y], \"to\": [x, y]}, ..]}");
    else if (good)
        good = !foreign_told(text, n, wrong) && control_read_links(out, &tree, text, wrong);
    json_tree_free(&tree);
    return good;
}

bool control_decode(control_points *out, const char *text, size_t n, problem *wrong)
{
    *out = (control_points){0};
    const char *p = n >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? text + 3 : text;
    const char *first = p + strspn(p, " \t\r\n\x1e");
    if (strlen(text) != n && !foreign_told(text, n, wrong))
        spoilt(wrong, 0, "there is a zero byte; this is not text");
    if (strlen(text) != n)
        return false;
    if (control_is_qgis(text))
        return control_read_qgis(out, text, wrong);
    if (control_is_vrt(text))
        return control_read_vrt(out, text, wrong);
    if (*first == '{')
        return read_json(out, text, n, wrong);
    if (foreign_told(text, n, wrong))
        return false;
    if (*first == '[')
        return read_json(out, text, n, wrong);
    if (control_has_gcp_options(text))
        return control_read_gcp_options(out, text, wrong);
    return control_read_table(out, text, n, wrong);
}

int control_read(control_points *out, const char *name)
{
    size_t n;
    problem wrong;
    char *text = file_read(name, &n);
    *out = (control_points){0};
    if (text == NULL)
        return FAILED;
    bool good = control_decode(out, text, n, &wrong);
    free(text);
    return good ? DONE : failed(name, wrong.line, "%s", wrong.text);
}
