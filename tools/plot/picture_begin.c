/* Chooses the format by the name of the file, and refuses what it cannot hold. */
#include "plot/picture_begin.h"

#include "base/say.h"
#include "job/output_name.h"
#include "picture/picture_file.h"

/* If the name has no format, Netpbm's is the simplest that can hold the picture. */
static picture_format like(const picture *p, picture_format format)
{
    if (format < PICTURE_PGM)
        return format;
    return picture_has_alpha(p) ? PICTURE_PAM : format == PICTURE_PAM ? format : PICTURE_PNM;
}

/* Chooses how to write `p`: in the format of the name, or else in that of `from`, with the notes of
 * `from`. */
static int choose(picture_style *style, const picture *p, const picture *from, const args *a,
                  const char *name)
{
    int32_t quality = a->quality;
    picture_format format = picture_kind_named(output_format(name));
    if (format == PICTURE_NONE)
        format = like(p, from->format);
    const picture_kind *kind = picture_kind_of(format);
    *style = (picture_style){.format = format, .notes = &from->notes, .quality = quality};
    if (quality > 0 && format != PICTURE_JPEG)
        return misused(a->command, "--quality is for JPEG, and '%.200s' will be %s", name,
                       kind->name);
    if (!picture_is_plain(p) && format != PICTURE_NPY)
        return failed(name, 0, "the picture has %s, which %s cannot hold; .npy can",
                      p->values != NULL ? "floats" : "more than four channels", kind->name);
    if (picture_has_alpha(p) && !kind->has_alpha)
        return failed(name, 0,
                      "the picture has an alpha, which %s cannot hold; PNG, PAM and .npy can",
                      kind->name);
    if (p->channels >= 3 && !kind->has_colours)
        return failed(name, 0, "the picture has colours, which %s cannot hold; PPM can",
                      kind->name);
    return DONE;
}

int picture_begin(picture *to, picture_style *style, picture *from, const args *a, const char *name)
{
    bool clears = a->has_background || a->outside == OUTSIDE_NULL;
    if (a->has_background && !picture_is_plain(from))
        return misused(a->command, "--background is a colour, and the picture is an array of %s",
                       from->values != NULL ? "floats" : "more than four channels");
    if (clears && from->values == NULL && !picture_is_plain(from))
        return misused(a->command, "an array of whole numbers with more than four channels has no "
                                   "value for pixels without an image");
    *to = picture_canvas(from, clears ? a->background : NULL);
    return choose(style, to, from, a, name);
}
