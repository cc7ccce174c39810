/* Writes elements of SVG. */
#include "plot/svg.h"

#include "base/allocate.h"
#include "base/base64.h"
#include "picture/picture_file.h"

#include <stdlib.h>

void svg_begin(FILE *svg, double width, double height)
{
    fprintf(
        svg,
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
        "width=\"%.0f\" height=\"%.0f\" viewBox=\"0 0 %.0f %.0f\">\n"
        "<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
        width, height, width, height);
}

void svg_end(FILE *svg)
{
    fputs("</svg>\n", svg);
}

void svg_label(FILE *svg, double x, double y, const char *text)
{
    fprintf(svg,
            "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-family=\"Helvetica, Arial, "
            "sans-serif\" "
            "font-size=\"15\" fill=\"#444\">%s</text>\n",
            x, y, text);
}

int svg_picture(FILE *svg, double x, double y, double width, double height, const char *clip,
                const picture *p)
{
    problem wrong;
    size_t n;
    unsigned char *bytes = png_encode(p, &(picture_style){0}, &n, &wrong);
    if (bytes == NULL)
        return failed(NULL, 0, "%s", wrong.text);
    fprintf(svg,
            "<g clip-path=\"url(#%s)\"><image x=\"%.2f\" y=\"%.2f\" width=\"%.2f\" height=\"%.2f\" "
            "preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,",
            clip, x, y, width, height);
    char *text = base64_encode(bytes, n, &n);
    fputs(text, svg);
    free(text);
    fputs("\"/></g>\n", svg);
    free(bytes);
    return DONE;
}

void svg_polyline(FILE *svg, size_t n, const double *points)
{
    for (size_t i = 0; i < n; i++)
        fprintf(svg, "%c%.2f %.2f", i == 0 ? 'M' : 'L', points[2 * i], points[2 * i + 1]);
}
