/* Around the lines of the front page: they turn a picture of one colour in a square. */
#include <icc/icc.h>

#include <stdio.h>
#include <string.h>

int main(void)
{
    enum { n = 4, SIDE = 8 };
    static const double before[] = {0, 0, 8, 0, 8, 8, 0, 8}, after[] = {4, 0, 8, 4, 4, 8, 0, 4};
    static unsigned char pixels[SIDE * SIDE], result[SIDE * SIDE];
    icc_picture picture = {.size = sizeof picture,
                           .width = SIDE,
                           .height = SIDE,
                           .channels = 1,
                           .bytes = 1,
                           .stride = SIDE},
                warped;
    icc_error err = {sizeof err, ICC_OK, 0, -1, ICC_ITEM_NONE, ""};
    icc_map *map = NULL;
    picture.pixels = memset(pixels, 200, sizeof pixels);
    warped = picture;
    warped.pixels = result;

    SNIPPET

    if (result[4 * SIDE + 4] != 200 || result[0] != 0)
        err.status = ICC_ERR_ARGUMENT;
    icc_map_free(map);
    return err.status != ICC_OK;
}
