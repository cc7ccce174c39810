/* The picture of `libicc demo`. */
#ifndef DEMO_PICTURE_H
#define DEMO_PICTURE_H

#include "picture/picture.h"

/* A fish in a sea of one colour, 78b9d7: RGB, 480 x 330 pixels, the same on every machine. */
picture demo_picture(void);

#endif
