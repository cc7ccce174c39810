/* Scalable Vector Graphics 1.1, second edition, 2011, section 7.6. */
#include "cage/svg_transform.h"

#include "base/number.h"
#include "cage/svg_arc.h"

#include <math.h>
#include <string.h>

static const char separators[] = " \t\r\n,";

transform transform_none(void)
{
    return (transform){{1, 0, 0, 1, 0, 0}};
}

void transform_apply(const transform *t, double point[2])
{
    double x = point[0], y = point[1];
    point[0] = t->m[0] * x + t->m[2] * y + t->m[4];
    point[1] = t->m[1] * x + t->m[3] * y + t->m[5];
}

/* Applies `inner` first, then `outer`. */
static transform both(const transform *outer, const transform *inner)
{
    const double *a = outer->m, *b = inner->m;
    return (transform){{a[0] * b[0] + a[2] * b[1], a[1] * b[0] + a[3] * b[1],
                        a[0] * b[2] + a[2] * b[3], a[1] * b[2] + a[3] * b[3],
                        a[0] * b[4] + a[2] * b[5] + a[4], a[1] * b[4] + a[3] * b[5] + a[5]}};
}

static transform translation(double x, double y)
{
    return (transform){{1, 0, 0, 1, x, y}};
}

static transform rotation(size_t n, const double *v)
{
    double c, s;
    turn_by(v[0], &c, &s);
    transform turned = {{c, s, -s, c, 0, 0}};
    if (n == 1)
        return turned;
    transform there = translation(v[1], v[2]), back = translation(-v[1], -v[2]);
    turned = both(&turned, &back);
    return both(&there, &turned);
}

static transform skew(double degrees, bool along_x)
{
    double c, s;
    turn_by(degrees, &c, &s);
    return (transform){{1, along_x ? 0 : s / c, along_x ? s / c : 0, 1, 0, 0}};
}

/* Makes a transform from its name and its n numbers. */
static bool make(transform *out, const char *name, size_t n_name, size_t n, const double *v)
{
    static const struct {
        const char *name;
        unsigned counts; /* bit k is set if it may have k numbers */
    } kinds[] = {{"matrix", 1U << 6},          {"translate", 1U << 1 | 1U << 2},
                 {"scale", 1U << 1 | 1U << 2}, {"rotate", 1U << 1 | 1U << 3},
                 {"skewX", 1U << 1},           {"skewY", 1U << 1}};
    size_t k = 0;
    while (k < 6 && !(strlen(kinds[k].name) == n_name && strncmp(name, kinds[k].name, n_name) == 0))
        k++;
    if (k == 6 || !(kinds[k].counts & 1U << n))
        return false;
    *out = k == 0   ? (transform){{v[0], v[1], v[2], v[3], v[4], v[5]}}
           : k == 1 ? translation(v[0], n > 1 ? v[1] : 0)
           : k == 2 ? (transform){{v[0], 0, 0, n > 1 ? v[1] : v[0], 0, 0}}
           : k == 3 ? rotation(n, v)
                    : skew(v[0], k == 4);
    return true;
}

/* Reads NAME ( NUMBERS ) and moves *cursor after it. */
static bool read_one(transform *out, const char **cursor, const char *end)
{
    const char *name = *cursor;
    double v[6];
    size_t n = 0, n_name = strcspn(name, "( \t\r\n\"'<");
    const char *p = name + n_name + strspn(name + n_name, " \t\r\n");
    if (*p++ != '(')
        return false;
    for (p += strspn(p, separators); p < end && *p != ')'; p += strspn(p, separators))
        if (n == 6 || number_read(&p, &v[n++]) != NUMBER_OK)
            return false;
    *cursor = p + 1;
    return p < end && make(out, name, n_name, n, v);
}

bool transform_read(transform *out, const transform *after, const char *list, const char *end)
{
    *out = *after;
    for (list += strspn(list, separators); list < end; list += strspn(list, separators)) {
        transform next;
        if (!read_one(&next, &list, end))
            return false;
        *out = both(out, &next);
    }
    return true;
}

double transform_stretch(const transform *t)
{
    const double *m = t->m;
    double det = m[0] * m[3] - m[1] * m[2];
    double sum = m[0] * m[0] + m[1] * m[1] + m[2] * m[2] + m[3] * m[3];
    return sqrt((sum + sqrt(fmax(sum * sum - 4 * det * det, 0))) / 2);
}
