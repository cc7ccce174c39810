/* The energy of a vertex's star. It is that of J. Smith, S. Schaefer, Bijective Parameterization
 * with Free Boundaries, 2015. */
#include "match/sphere/drawn_star.h"

#include "match/surface/direction.h"
#include "math/vec.h"

#include <math.h>

/* This share of a face's squared sides is added to each of them, so that needles do not prevent
 * their neighbours from moving. */
static const double fatter = 1e-3;

/* The smallest squared side that a face may count with, on the unit sphere. Directions are 2^-51
 * apart. */
static const double least_side2 = 1e-12;

/* If the plane of a drawn face is closer to the centre than this, the energy grows with the inverse
 * square of its distance. Otherwise large faces could come to lie along a great circle, with no
 * room left beside them. Few faces are large, so the derivatives ignore this. */
static const double least_distance = 0.2;

bool iccp_drawn_star_create(iccp_drawn_star *star, size_t n, const iccp_memory *memory)
{
    star->ring = iccp_alloc(memory, n + 1, sizeof *star->ring);
    star->face = iccp_alloc(memory, n, sizeof *star->face);
    return star->ring != NULL && star->face != NULL;
}

void iccp_drawn_star_free(iccp_drawn_star *star, const iccp_memory *memory)
{
    iccp_free(memory, star->ring);
    iccp_free(memory, star->face);
}

static iccp_drawn_star_face face_of(const double *o, const double *p, const double *q, double scale)
{
    double a[3], b[3];
    for (int k = 0; k < 3; ++k) {
        a[k] = scale * (p[k] - o[k]);
        b[k] = scale * (q[k] - o[k]);
    }
    iccp_drawn_star_face f = {iccp_vec_dot(3, a, a), iccp_vec_dot(3, a, b), iccp_vec_dot(3, b, b),
                              0, 0};
    const double more = fatter * 2 * (f.aa - f.ab + f.bb) + least_side2;
    f.aa += more; /* the sides of an equilateral triangle, so all three sides grow alike */
    f.ab += more / 2;
    f.bb += more;
    const double square = f.aa * f.bb - f.ab * f.ab;
    f.inverse = 1 / square;
    f.weight = sqrt(square);
    return f;
}

void iccp_drawn_star_gather(iccp_drawn_star *star, const iccp_half_edges *m, uint32_t vertex,
                            const double *x, double scale, const double *directions)
{
    const double *const o = x + 3 * (size_t)vertex;
    uint32_t h = m->out[vertex];
    size_t p = iccp_edge_end(m, h);
    star->n = 0;
    star->weight = 0;
    do {
        h = iccp_edge_turn(m, h);
        const size_t q = iccp_edge_end(m, h);
        star->ring[star->n] = directions + 3 * p;
        star->face[star->n++] = face_of(o, x + 3 * p, x + 3 * q, scale);
        star->weight += star->face[star->n - 1].weight;
        p = q;
    } while (h != m->out[vertex]);
    star->ring[star->n] = star->ring[0];
}

bool iccp_drawn_star_holds(const iccp_drawn_star *star, const double p[3])
{
    for (size_t i = 0; i < star->n; ++i)
        if (iccp_direction_sign(p, star->ring[i], star->ring[i + 1]) <= 0)
            return false;
    return true;
}

/* A face of the drawing: its sides g and h at the vertex, their products, and its energy. */
typedef struct drawn {
    double g[3], h[3], gg, gh, hh;
    double square;  /* (2 area)^2 */
    double stretch; /* 4 area of the surface's face times the sum of the squared singular values */
    double energy;
    double value; /* energy^1.5, and more if the face is near the centre */
} drawn;

static drawn draw(const iccp_drawn_star *star, size_t i, const double p[3])
{
    const iccp_drawn_star_face *const f = &star->face[i];
    const double *const a = star->ring[i], *const b = star->ring[i + 1];
    drawn d;
    double n[3];
    for (int k = 0; k < 3; ++k) {
        d.g[k] = a[k] - p[k];
        d.h[k] = b[k] - p[k];
    }
    iccp_vec_cross(d.g, d.h, n);
    d.gg = iccp_vec_dot(3, d.g, d.g);
    d.gh = iccp_vec_dot(3, d.g, d.h);
    d.hh = iccp_vec_dot(3, d.h, d.h);
    d.square = iccp_vec_dot(3, n, n);
    d.stretch = f->aa * d.hh - 2 * f->ab * d.gh + f->bb * d.gg;
    d.energy = d.stretch * (f->inverse + 1 / d.square);
    const double distance = iccp_vec_dot(3, p, n) / sqrt(d.square);
    const double factor = distance < least_distance ? least_distance / distance : 1;
    d.value = factor * factor * d.energy * sqrt(d.energy);
    return d;
}

double iccp_drawn_star_energy(const iccp_drawn_star *star, const double p[3])
{
    double sum = 0;
    for (size_t i = 0; i < star->n; ++i)
        sum += star->face[i].weight * draw(star, i, p).value;
    return sum;
}

/* With D the stretch and S the square, E = D (1 / S0 + 1 / S). D is a quadratic function of p with
 * the Hessian 2 |a - b|^2 I, where a and b are of the surface. S is one with the Hessian 2 (|w|^2 I
 * - w w^T), where w = g - h. On the sphere a path along a coordinate bends towards the centre. So
 * the derivative along p is subtracted from the diagonal. */
static void add_face(iccp_drawn_star_jet *jet, const iccp_drawn_star_face *f, const drawn *d,
                     const double *p)
{
    const double k = f->inverse + 1 / d->square, s2 = 1 / (d->square * d->square);
    double stretch[2], square[2], w[2], energy[2], along = 0;
    double gradient[2][3];
    for (int i = 0; i < 3; ++i) {
        gradient[0][i] = 2 * ((f->ab - f->bb) * d->g[i] + (f->ab - f->aa) * d->h[i]);
        gradient[1][i] = 2 * ((d->gh - d->hh) * d->g[i] + (d->gh - d->gg) * d->h[i]);
        along += (k * gradient[0][i] - d->stretch * s2 * gradient[1][i]) * p[i];
    }
    for (int i = 0; i < 2; ++i) {
        stretch[i] = iccp_vec_dot(3, gradient[0], jet->axis[i]);
        square[i] = iccp_vec_dot(3, gradient[1], jet->axis[i]);
        w[i] = iccp_vec_dot(3, d->g, jet->axis[i]) - iccp_vec_dot(3, d->h, jet->axis[i]);
        energy[i] = k * stretch[i] - d->stretch * s2 * square[i];
    }
    const double w2 = d->gg - 2 * d->gh + d->hh;
    const double diagonal = 2 * k * (f->aa - 2 * f->ab + f->bb) - 2 * d->stretch * s2 * w2 - along;
    const double root = sqrt(d->energy);
    const double first = 1.5 * f->weight * root, second = 0.75 * f->weight / root;
    jet->value += f->weight * d->value;
    for (int i = 0, n = 0; i < 2; ++i) {
        jet->gradient[i] += first * energy[i];
        for (int j = i; j < 2; ++j, ++n) {
            const double h =
                (i == j ? diagonal : 0) - s2 * (stretch[i] * square[j] + stretch[j] * square[i]) +
                2 * d->stretch * s2 * (square[i] * square[j] / d->square + w[i] * w[j]);
            jet->hessian[n] += first * h + second * energy[i] * energy[j];
        }
    }
}

void iccp_drawn_star_expand(iccp_drawn_star_jet *jet, const iccp_drawn_star *star,
                            const double p[3])
{
    *jet = (iccp_drawn_star_jet){0};
    iccp_direction_axes(p, jet->axis);
    for (size_t i = 0; i < star->n; ++i) {
        const drawn d = draw(star, i, p);
        add_face(jet, &star->face[i], &d, p);
    }
}
