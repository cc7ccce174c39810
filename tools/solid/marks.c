/* Recognises the format of points and lines inside a solid. */
#include "solid/marks.h"

#include "base/allocate.h"
#include "base/foreign.h"

#include <stdlib.h>
#include <string.h>

mark *marks_add(marks *m, const char *name, size_t n, size_t line)
{
    m->items = grow(m->items, &m->room, m->n + 1, sizeof *m->items);
    mark *added = &m->items[m->n++];
    *added = (mark){.name = need(n + 1, 1), .line = line};
    memcpy(added->name, name, n);
    return added;
}

void marks_free(marks *m)
{
    for (size_t i = 0; i < m->n; i++) {
        free(m->items[i].name);
        free(m->items[i].points[0]);
        free(m->items[i].points[1]);
    }
    free(m->items);
    *m = (marks){0};
}

static bool begins_with(const char *text, const char *word)
{
    return strncmp(text, word, strlen(word)) == 0;
}

/* True if the first line that is no comment begins with a word of OBJ. */
static bool is_obj(const char *text)
{
    static const char *const words[] = {"v ", "v\t", "o ", "g ", "l ", "mtllib "};
    while (*text == '#' || *text == '\n' || *text == '\r')
        text += strcspn(text, "\n") + (text[strcspn(text, "\n")] != '\0');
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (begins_with(text, words[i]))
            return true;
    return false;
}

static bool read_json(marks *out, mark_kind kind, const char *text, size_t n, problem *wrong)
{
    json_tree tree;
    bool good =
        json_tree_read(&tree, text, n, wrong) && marks_read_json(out, kind, &tree, text, wrong);
    json_tree_free(&tree);
    return good;
}

static bool read_any(marks *out, mark_kind kind, const char *text, size_t n, problem *wrong)
{
    const char *p = begins_with(text, "\xef\xbb\xbf") ? text + 3 : text;
    const char *first = p + strspn(p, " \t\r\n");
    if (strlen(text) != n)
        return foreign_told(text, n, wrong) ? false
                                            : spoilt(wrong, 0,
                                                     "there is a zero byte; this is not "
                                                     "text");
    if (*first == '{' || *first == '[')
        return read_json(out, kind, text, n, wrong);
    if (is_obj(first))
        return marks_read_obj(out, kind, text, n, wrong);
    if (kind == MARK_LINE)
        return spoilt(wrong, 0, "lines are read from JSON, files .mrk.json of 3D Slicer, and OBJ");
    if (begins_with(first, "# Markups fiducial file"))
        return marks_read_fcsv(out, text, wrong);
    return !foreign_told(text, n, wrong) && marks_read_table(out, text, wrong);
}

bool marks_read(marks *out, mark_kind kind, const char *text, size_t n, problem *wrong)
{
    *out = (marks){0};
    if (!read_any(out, kind, text, n, wrong))
        return false;
    for (size_t i = 0; i < out->n; i++) {
        const mark *m = &out->items[i];
        if (m->n[1] > 0 && m->n[0] != m->n[1])
            return spoilt(wrong, m->line,
                          "%s has %zu vertices in the source, but %zu in the target", m->name,
                          m->n[0], m->n[1]);
        if ((m->n[1] > 0) != (out->items[0].n[1] > 0))
            return spoilt(wrong, m->line, "some have a place in the target, and some have none");
    }
    return out->n > 0 ||
           spoilt(wrong, 0, kind == MARK_POINT ? "there are no points" : "there are no lines");
}
