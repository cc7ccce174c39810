/* Draws a fish from discs, an ellipse and triangles. Each pixel is the mean of FINE * FINE colours.
 * They are computed from products and sums of integers, so that all machines draw the same. */
#include "cmd/demo_picture.h"

#include <stdlib.h>

enum { WIDTH = 480, HEIGHT = 330, FINE = 4 };

typedef struct colour {
    int r, g, b;
} colour;

/* A point, in quarters of a pixel. */
typedef struct spot {
    int64_t x, y;
} spot;

static bool in_ellipse(spot p, int64_t x, int64_t y, int64_t a, int64_t b)
{
    int64_t dx = p.x - FINE * x, dy = p.y - FINE * y;
    return dx * dx * b * b + dy * dy * a * a <= FINE * FINE * a * a * b * b;
}

/* True inside a triangle, whose corners are in pixels and counter-clockwise on the screen. */
static bool in_triangle(spot p, const int64_t c[3][2])
{
    bool inside = true;
    for (int i = 0; i < 3 && inside; i++) {
        const int64_t *from = c[i], *to = c[(i + 1) % 3];
        inside = (to[0] - from[0]) * (p.y - FINE * from[1]) <=
                 (to[1] - from[1]) * (p.x - FINE * from[0]);
    }
    return inside;
}

static bool in_fin(spot p)
{
    static const int64_t fins[][3][2] = {{{42, 75}, {80, 160}, {160, 160}},
                                         {{42, 245}, {160, 160}, {80, 160}},
                                         {{215, 108}, {310, 106}, {262, 58}},
                                         {{225, 210}, {262, 258}, {295, 214}}};
    bool inside = false;
    for (size_t i = 0; i < sizeof fins / sizeof *fins; i++)
        inside = inside || in_triangle(p, fins[i]);
    return inside;
}

/* True between arcs of large circles, which bound the stripes. */
static bool in_stripe(spot p)
{
    bool inside = false;
    for (int64_t x = 175; x <= 305; x += 65)
        inside = inside ||
                 (in_ellipse(p, x - 280, 160, 300, 300) && !in_ellipse(p, x - 280, 160, 280, 280));
    return inside;
}

static colour colour_at(spot p)
{
    if (in_ellipse(p, 358, 140, 7, 7))
        return (colour){20, 24, 32};
    if (in_ellipse(p, 355, 140, 15, 15))
        return (colour){255, 255, 255};
    if (in_ellipse(p, 272, 160, 132, 66))
        return in_stripe(p) ? (colour){250, 244, 230} : (colour){240, 120, 40};
    if (in_fin(p))
        return (colour){214, 88, 32};
    return (colour){120, 185, 215};
}

picture demo_picture(void)
{
    picture p = picture_make(WIDTH, HEIGHT, 3, 8);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            colour sum = {FINE * FINE / 2, FINE * FINE / 2, FINE * FINE / 2};
            for (int k = 0; k < FINE * FINE; k++) {
                colour c = colour_at((spot){FINE * x + k % FINE, FINE * y + k / FINE});
                sum = (colour){sum.r + c.r, sum.g + c.g, sum.b + c.b};
            }
            uint16_t *pixel = p.samples + 3 * (y * WIDTH + x);
            pixel[0] = (uint16_t)(sum.r / (FINE * FINE));
            pixel[1] = (uint16_t)(sum.g / (FINE * FINE));
            pixel[2] = (uint16_t)(sum.b / (FINE * FINE));
        }
    return p;
}
