/* Pins of a figure as JSON: {"pins": [{"name": "hand", "at": [x, y], "to": [x, y], "turn": 20}, ..],
 * "bones": [[0, 1], ..]}. The studio saves such files. A pin without "to" stays. A turn is in degrees
 * from x to y. A bone is the straight line between two pins, which it keeps straight. */
#include "control/control_readers.h"

#include "base/allocate.h"
#include "base/json_in.h"

#include <stdio.h>
#include <string.h>

bool control_has_pins(const json_tree *tree)
{
    return json_get(json_first(tree->root), "pins") != NULL;
}

static bool read_pin(control_points *out, const json_item *pin, size_t i, size_t line,
                     problem *wrong)
{
    static const char *const members[] = {"name", "at", "to", "turn", NULL};
    char where[48], at[64], to[64], turn[64];
    double from[2], target[2], degrees;
    snprintf(where, sizeof where, "pins[%zu]", i);
    snprintf(at, sizeof at, "%s.at", where);
    snprintf(to, sizeof to, "%s.to", where);
    snprintf(turn, sizeof turn, "%s.turn", where);
    if (!json_is_object(pin, where, members, wrong) ||
        !json_reals(json_get(pin, "at"), at, 2, from, wrong))
        return false;
    memcpy(target, from, sizeof target);
    if (json_get(pin, "to") != NULL && !json_reals(json_get(pin, "to"), to, 2, target, wrong))
        return false;
    control_add(out, from, target, line);
    const char *name = json_string_of(json_get(pin, "name"));
    if (json_get(pin, "name") != NULL && name == NULL)
        return spoilt(wrong, 0, "%s.name is not a string", where);
    if (name != NULL)
        control_name(out, name, strlen(name));
    if (json_get(pin, "turn") == NULL)
        return true;
    if (!json_real(json_get(pin, "turn"), turn, &degrees, wrong))
        return false;
    control_turn(out, degrees);
    return true;
}

static bool read_bones(control_points *out, const json_item *list, problem *wrong)
{
    if (!json_pairs(list, "bones", "pin", out->n, &out->n_bones, &out->bones, wrong))
        return false;
    for (size_t i = 0; i < out->n_bones; i++)
        if (out->bones[2 * i] == out->bones[2 * i + 1])
            return spoilt(wrong, 0, "bones[%zu] begins and ends at one pin", i);
    return true;
}

bool control_read_pins(control_points *out, const json_tree *tree, const char *text, problem *wrong)
{
    static const char *const members[] = {"pins", "bones", NULL};
    const json_item *file = json_first(tree->root), *pins = json_get(file, "pins");
    line_finder at = {text, 1};
    size_t n, i = 0;
    out->format = "pins in JSON";
    out->rows_down = true;
    if (!json_is_object(file, "the file", members, wrong) || !json_list(pins, "pins", &n, wrong))
        return false;
    for (const json_item *pin = json_first(pins); pin != NULL; pin = json_next(pin)) {
        size_t line = line_finder_at(&at, text + pin->begin);
        if (!read_pin(out, pin, i++, line, wrong)) {
            wrong->line = line;
            return false;
        }
    }
    return read_bones(out, json_get(file, "bones"), wrong);
}
