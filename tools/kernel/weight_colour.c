/* Colours of weights. Equal steps of weight are equal steps of lightness to the eye, in the colour
 * space Oklab (B. Ottosson, A perceptual color space for image processing, 2020): from dark violet
 * over teal to yellow. */
#include "kernel/weight_plot.h"

#include <math.h>

/* Converts lightness (0 to 1), chroma and hue (in degrees) to sRGB. Values outside sRGB are
 * clipped. */
static void from_oklch(double lightness, double chroma, double hue, double rgb[3])
{
    double angle = hue * 3.14159265358979323846 / 180;
    double a = chroma * cos(angle), b = chroma * sin(angle);
    double l = pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3),
           m = pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3),
           s = pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
    double linear[3] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                        -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    for (int k = 0; k < 3; k++) {
        double c = fmin(fmax(linear[k], 0), 1);
        rgb[k] = 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055);
    }
}

double weight_level(double weight, bool logarithmic)
{
    return logarithmic ? fmax(1 + log10(fabs(weight)) / DECADES, 0) : weight;
}

/* On a linear scale negative weights turn red gradually, fully at -1/4. */
void weight_colour(double weight, bool logarithmic, double rgb[3])
{
    double level = fmin(weight_level(weight, logarithmic), 1), red[3];
    double share = weight >= 0 ? 0 : logarithmic ? 1 : fmin(-4 * weight, 1);
    double redness = logarithmic ? level : share;
    from_oklch(0.2 + 0.45 * redness, 0.04 + 0.16 * redness, 25, red);
    level = fmax(level, 0);
    from_oklch(0.2 + 0.75 * level, 0.08 + 0.06 * level, 290 - 185 * level, rgb);
    for (int k = 0; k < 3; k++)
        rgb[k] += share * (red[k] - rgb[k]);
}

const char *curve_colour(char out[8], size_t i, size_t n)
{
    double rgb[3];
    from_oklch(i % 2 == 0 ? 0.62 : 0.5, 0.16, 30 + 360 * (double)i / (double)n, rgb);
    snprintf(out, 8, "#%02x%02x%02x", (unsigned)rgb[0], (unsigned)rgb[1], (unsigned)rgb[2]);
    return out;
}
