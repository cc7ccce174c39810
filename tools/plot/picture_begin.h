/* Begins the picture that a command writes: its size, its channels and the format of its file. */
#ifndef PICTURE_BEGIN_H
#define PICTURE_BEGIN_H

#include "job/args.h"
#include "picture/picture.h"

/* Makes the picture that is drawn on, as the options ask. Chooses how to write it to a file: in the
 * format of the name, or else in that of `from`, with the notes of `from`. FAILED or MISUSED with a
 * message on stderr if the format cannot hold the picture, or an option does not apply. Free `to`
 * in any case. */
int picture_begin(picture *to, picture_style *style, picture *from, const args *a,
                  const char *name);

#endif
