/* Pictures and their files. */
#include "base/file.h"
#include "plot/picture.h"

#include <stdlib.h>

int picture_take(picture *out, const char *name, const char *bytes, size_t n)
{
    problem wrong;
    return picture_decode(out, bytes, n, &wrong) ? DONE : failed(name, 0, "%s", wrong.text);
}

picture picture_canvas(picture *from, const unsigned char *background)
{
    if (background != NULL)
        picture_widen(from, background[0] != background[1] || background[0] != background[2],
                      background[3] < 255);
    picture canvas = picture_copy(from);
    for (size_t i = 0; background != NULL && i < canvas.width * canvas.height; i++)
        picture_set(&canvas, i, background);
    return canvas;
}

int picture_save(const picture *p, const struct png_keep *keep, const char *name)
{
    problem wrong;
    size_t n;
    unsigned char *bytes = picture_encode(p, keep, &n, &wrong);
    if (bytes == NULL)
        return failed(name, 0, "%s", wrong.text);
    outfile file;
    int result = outfile_open(&file, name) ? DONE : FAILED;
    if (result == DONE) {
        fwrite(bytes, 1, n, file.stream);
        result = outfile_close(&file) ? DONE : FAILED;
    }
    free(bytes);
    return result;
}
