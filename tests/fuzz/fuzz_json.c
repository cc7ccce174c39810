/* Any bytes at all must be refused with a reason and a place, or become a tree in which each value stands where the text
 * has it, its strings are UTF-8, and the names of each object differ; and leak nothing. */
#include "base/json_tree.h"
#include "fuzz.h"

#include <stdlib.h>

static const json_item *first_of(const json_item *item)
{
    return item->kind == JSON_OBJECT ? json_first_member(item) : json_first(item);
}

static const json_item *last_of(const json_item *item)
{
    const json_item *last = NULL;
    for (const json_item *x = first_of(item); x != NULL; x = json_next(x))
        last = x;
    return last;
}

/* The number of bytes of a character, or 0. */
static size_t utf8_length(const unsigned char *p)
{
    size_t n = *p < 0x80 ? 1 : *p < 0xe0 ? 2 : *p < 0xf0 ? 3 : 4;
    unsigned long code = n == 1 ? *p : *p & (0x7fU >> n);
    static const unsigned long least[] = {0, 1, 0x80, 0x800, 0x10000};
    for (size_t k = 1; k < n; k++) {
        if ((p[k] & 0xc0) != 0x80)
            return 0;
        code = code << 6 | (p[k] & 0x3f);
    }
    bool zero = n == 2 && code == 0; /* an escaped U+0000 */
    bool good = code >= least[n] && code <= 0x10ffff && (code < 0xd800 || code > 0xdfff);
    return good || zero ? n : 0;
}

static void require_utf8(const char *string)
{
    for (const unsigned char *p = (const unsigned char *)string; *p != '\0';) {
        size_t n = utf8_length(p);
        require(n > 0);
        p += n;
    }
}

/* The contents of a list or an object come one after another inside it. */
static void check_contents(const json_item *item, const char *text)
{
    size_t n = 0, at = item->begin;
    for (const json_item *x = first_of(item); x != NULL; x = json_next(x)) {
        require(x > item && x->begin > at && x->end > x->begin && x->end < item->end);
        require((x->name != NULL) == (item->kind == JSON_OBJECT));
        require(x->name == NULL || json_get(item, x->name) == x);
        at = x->end;
        n++;
    }
    require(n == item->n);
    bool object = item->kind == JSON_OBJECT;
    require(text[item->begin] == (object ? '{' : '[') &&
            text[item->end - 1] == (object ? '}' : ']'));
}

static void check_value(const json_item *item, const char *text)
{
    const char *own = text + item->begin;
    size_t n = item->end - item->begin;
    double number = item->kind == JSON_NUMBER ? strtod(own, NULL) : 0;
    require(item->number >= number && item->number <= number);
    require((item->string != NULL) == (item->kind == JSON_STRING));
    if (item->string != NULL) {
        require_utf8(item->string);
        require(strlen(item->string) + 2 <= n && own[0] == '"' && own[n - 1] == '"');
    }
    if (item->name != NULL)
        require_utf8(item->name);
    if (item->kind == JSON_OBJECT || item->kind == JSON_LIST)
        check_contents(item, text);
    else
        require(item->n == 0);
    require(item->kind != JSON_TRUE || (n == 4 && memcmp(own, "true", n) == 0));
    require(item->kind != JSON_FALSE || (n == 5 && memcmp(own, "false", n) == 0));
    require(item->kind != JSON_NULL || (n == 4 && memcmp(own, "null", n) == 0));
}

/* Looks at all values without recursion: in the array the last value is the end of the last one's contents. */
static void check_texts(const json_item *first, const char *text)
{
    for (; first != NULL; first = json_next(first)) {
        const json_item *last = first;
        while (last_of(last) != NULL)
            last = last_of(last);
        for (const json_item *item = first; item <= last; item++)
            check_value(item, text);
    }
}

static void require_reason(const problem *wrong)
{
    require(wrong->text[0] != '\0' && strpbrk(wrong->text, "\r\n") == NULL && wrong->line > 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char *text = text_of(data, size);
    if (text == NULL)
        return 0;
    json_tree one, many;
    problem wrong = {.text = ""}, wrong_sequence = {.text = ""};
    bool good = json_tree_read(&one, (const char *)data, size, &wrong);
    bool good_sequence = json_tree_read_sequence(&many, (const char *)data, size, &wrong_sequence);
    require(good_sequence || !good);
    if (good)
        check_texts(one.root, text);
    else
        require_reason(&wrong);
    if (good_sequence)
        check_texts(json_first(many.root), text);
    else
        require_reason(&wrong_sequence);
    json_tree_free(&one);
    json_tree_free(&many);
    free(text);
    return 0;
}
