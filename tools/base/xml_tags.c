/* A small scanner for XML tags and attributes. */
#include "base/xml_tags.h"

#include <string.h>

static const char blanks[] = " \t\r\n";

bool tag_is(const tag *t, const char *name)
{
    return t->n_name == strlen(name) && strncmp(t->name, name, t->n_name) == 0;
}

/* The '>' that ends a tag, outside quotes, or NULL. */
static const char *tag_end(const char *p)
{
    char quote = '\0';
    for (; *p != '\0'; p++) {
        if (quote != '\0')
            quote = *p == quote ? '\0' : quote;
        else if (*p == '"' || *p == '\'')
            quote = *p;
        else if (*p == '>')
            return p;
    }
    return NULL;
}

bool tag_next(tag *out, const char *p)
{
    while ((p = strchr(p, '<')) != NULL) {
        if (strncmp(p, "<!--", 4) == 0) {
            p = strstr(p + 4, "-->");
            if (p == NULL)
                return false;
            continue;
        }
        const char *end = tag_end(p);
        if (end == NULL)
            return false;
        if (p[1] == '!' || p[1] == '?') {
            p = end;
            continue;
        }
        out->closes = p[1] == '/';
        out->stands_alone = end[-1] == '/';
        out->name = p + 1 + out->closes;
        out->n_name = strcspn(out->name, " \t\r\n/>");
        out->end = end;
        return true;
    }
    return false;
}

const char *tag_attribute(const tag *t, const char *name, size_t n, const char **end)
{
    const char *p = t->name + t->n_name;
    while (p < t->end) {
        p += strspn(p, blanks);
        const char *key = p;
        p += strcspn(p, "= \t\r\n/>\"'");
        size_t n_key = (size_t)(p - key);
        p += strspn(p, blanks);
        if (*p != '=') {
            p += p < t->end && (p == key || *p == '/');
            continue;
        }
        p++;
        p += strspn(p, blanks);
        if (*p != '"' && *p != '\'')
            continue;
        const char *value = p + 1;
        *end = strchr(value, *p);
        if (*end == NULL || *end > t->end)
            return NULL;
        if (n_key == n && strncmp(key, name, n) == 0)
            return value;
        p = *end + 1;
    }
    return NULL;
}

bool tag_has(const tag *t, const char *name, size_t n, const char *wanted)
{
    const char *end, *value = tag_attribute(t, name, n, &end);
    return value != NULL && (size_t)(end - value) == strlen(wanted) &&
           strncmp(value, wanted, strlen(wanted)) == 0;
}
