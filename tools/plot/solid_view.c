/* Axes and bounds of a view. */
#include "plot/solid_view.h"

#include <math.h>
#include <string.h>

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double out[3])
{
    for (size_t k = 0; k < 3; k++) {
        size_t i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = a[i] * b[j] - a[j] * b[i];
    }
}

static void make_unit(double v[3])
{
    double length = sqrt(dot(v, v));
    for (size_t k = 0; k < 3; k++)
        v[k] /= length;
}

solid_view view_make(const double eye[3])
{
    solid_view v = {.box = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    double up[3] = {0, 1, 0};
    memcpy(v.axes[2], eye, sizeof v.axes[2]);
    make_unit(v.axes[2]);
    if (fabs(v.axes[2][1]) > 0.9) {
        up[1] = 0;
        up[2] = v.axes[2][1] > 0 ? -1 : 1;
    }
    cross(up, v.axes[2], v.axes[0]);
    make_unit(v.axes[0]);
    cross(v.axes[2], v.axes[0], v.axes[1]);
    return v;
}

void view_default_eye(const double normal[3], double eye[3])
{
    solid_view front = view_make(normal);
    for (size_t k = 0; k < 3; k++)
        eye[k] = front.axes[2][k] + 0.45 * front.axes[0][k] + 0.3 * front.axes[1][k];
}

void view_widen(solid_view *v, const corners *c, size_t side)
{
    for (size_t i = 0; i < c->n; i++)
        for (size_t k = 0; k < 2; k++) {
            double x = dot(v->axes[k], c->all[i].at[side]);
            v->box[k] = fmin(v->box[k], x);
            v->box[k + 2] = fmax(v->box[k + 2], x);
        }
}

void view_place(const solid_view *v, double margin, const double at[3], double out[3])
{
    out[0] = margin + v->scale * (dot(v->axes[0], at) - v->box[0]);
    out[1] = margin + v->scale * (v->box[3] - dot(v->axes[1], at));
    out[2] = v->scale * dot(v->axes[2], at);
}
