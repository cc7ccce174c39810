/* GeoJSON is in degrees (RFC 7946, section 4). It has a straight line between two positions, even
 * between longitudes 179 and -179, so shapes that cross the antimeridian should be cut there
 * (section 3.1.9). Many files are not cut, and their rings jump. */
#include "cage/cage_degrees.h"

#include "base/degrees.h"
#include "cage/cage_features.h"

#include <stdio.h>

/* True if all coordinates that were read may be degrees. */
static bool is_in_degrees(const cage *c)
{
    bool good = are_degrees(c->n, c->points);
    for (size_t i = 0; i < c->n_features && good; i++)
        good = are_degrees(c->features[i].n, c->features[i].points);
    return good;
}

/* Refuses a polyline, or if closed a ring, at its first edge that jumps. */
static bool goes_on(size_t n, const double *points, bool closed, const char *of, problem *wrong)
{
    for (size_t i = 0; i + !closed < n; i++) {
        double x = points[2 * i], y = points[2 * ((i + 1) % n)];
        if (longitudes_jump(x, y))
            return spoilt(wrong, 0,
                          "the longitude jumps from %.9g to %.9g after vertex %zu%s: to cross the "
                          "antimeridian write %.9g, and shift all later vertices in the same way; "
                          "to go the long way round "
                          "add a vertex",
                          x, y, i, of, y + (x > 0 ? 360 : -360));
    }
    return true;
}

static bool all_go_on(const cage *c, problem *wrong)
{
    bool good = goes_on(c->n, c->points, true, "", wrong);
    for (size_t i = 0; i < c->n_features && good; i++) {
        const cage_feature *f = &c->features[i];
        feature_text name;
        char of[80];
        snprintf(of, sizeof of, " of %s", feature_name(name, f));
        good = goes_on(f->n, f->points, feature_is_ring(f), of, wrong);
    }
    return good;
}

/* True if one of several outlines has an edge along a meridian. */
static bool runs_along(const cage *c, double x)
{
    for (size_t k = 0; k < c->n_features; k++) {
        const cage_feature *f = &c->features[k];
        for (size_t i = 0; i < f->n && f->of_outline; i++)
            if (f->points[2 * i] == x && f->points[2 * ((i + 1) % f->n)] == x)
                return true;
    }
    return false;
}

bool cage_check_degrees(cage *c, problem *wrong)
{
    if (!is_in_degrees(c))
        return true;
    c->cut = runs_along(c, 180) && runs_along(c, -180);
    return all_go_on(c, wrong);
}

const char *cage_cut_text(const cage *c)
{
    return c->cut
               ? "; it is cut at the antimeridian: joined, with longitudes that go on beyond 180, "
                 "it is mapped as one"
               : "";
}
