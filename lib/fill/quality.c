/* Measures the least dihedral angle of a tetrahedron. If two faces with the areas A and B share an
 * edge of length e, the sine of the angle between them is 3 V e / (2 A B). V is the volume. */
#include "fill/quality.h"

#include "base/minmax.h"

/* Returns four times the square of a triangle's area. */
static double square_area(const double *a, const double *b, const double *c)
{
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    return x * x + y * y + z * z;
}

double iccp_square_sine(const double *a, const double *b, const double *c, const double *d)
{
    const double volume = iccp_points_volume(a, b, c, d);
    if (!(volume > 0.0))
        return 0.0;
    const double at_a = square_area(b, c, d), at_b = square_area(a, c, d);
    const double at_c = square_area(a, b, d), at_d = square_area(a, b, c);
    double least = at_a * at_b * iccp_square_distance(a, b);
    least = iccp_min(least, at_a * at_c * iccp_square_distance(a, c));
    least = iccp_min(least, at_a * at_d * iccp_square_distance(a, d));
    least = iccp_min(least, at_b * at_c * iccp_square_distance(b, c));
    least = iccp_min(least, at_b * at_d * iccp_square_distance(b, d));
    least = iccp_min(least, at_c * at_d * iccp_square_distance(c, d));
    const double all = (at_a * at_b) * (at_c * at_d);
    return all > 0.0 ? volume * volume * least / all : 0.0;
}
