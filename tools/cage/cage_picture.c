/* The opaque part of a picture with an alpha, as the shape of a cutout. */
#include "cage/cage_readers.h"

#include "cage/alpha_contours.h"
#include "cage/cage_features.h"
#include "cage/contours.h"
#include "cage/grow_polygons.h"
#include "cage/thin_polygons.h"
#include "picture/picture_file.h"

/* How far the outline may be from where alpha is one half, in pixels, if nothing else is asked
 * for. */
static const double CLOSE = 1;

bool cage_take_alpha(cage *out, const picture *p, double distance, double growth, problem *wrong)
{
    if (!picture_has_alpha(p))
        return spoilt(
            wrong, 0,
            "the picture has no transparent ground, so it has no outline; give an outline, or a "
            "picture with an alpha");
    alpha_contours c = alpha_contours_find(p);
    if (c.n_contours == 0) {
        alpha_contours_free(&c);
        return spoilt(wrong, 0, "the picture is transparent everywhere, so it has no outline");
    }
    c.n = thin_polygons(c.points, c.n, c.firsts, c.n_contours, distance > 0 ? distance : CLOSE);
    grow_polygons(c.points, c.n, c.firsts, c.n_contours, growth,
                  (const double[]){(double)p->width, (double)p->height});
    for (size_t v = 0; v < c.n; v++)
        cage_add(out, c.points[2 * v], c.points[2 * v + 1], 0);
    cage_take_contours(out, c.n_contours, c.firsts);
    alpha_contours_free(&c);
    return true;
}

bool cage_read_picture(cage *out, const cage_choice *choice, const char *text, size_t n,
                       problem *wrong)
{
    picture p;
    if (!picture_decode(&p, text, n, wrong))
        return false;
    bool good = cage_take_alpha(out, &p, choice->flat.length, 0, wrong);
    picture_free(&p);
    if (good && out->n_more > 0)
        cage_join_outlines(out);
    out->of_picture = good;
    return good;
}
