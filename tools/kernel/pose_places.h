/* Places inside a shape, and their images under a pose. */
#ifndef POSE_PLACES_H
#define POSE_PLACES_H

#include "kernel/pose_outline.h"

/* The samples inside the shape, posed by the weights alone. */
typedef struct posed_samples {
    size_t n;
    double *rest, *posed; /* 2 n coordinates */
    double *growth;       /* n determinants of the pose's derivative */
} posed_samples;

int posed_samples_make(posed_samples *out, pose *p);
void posed_samples_free(posed_samples *s);

typedef struct posed_places {
    size_t n, room_rest, room_posed, room_handles;
    double *places[2]; /* 2 n coordinates, at rest and posed */
    size_t *handles;   /* the handle at that place; SIZE_MAX if there is none */
} posed_places;

void posed_places_add(posed_places *out, const double *rest, const double *posed, size_t handle);
void posed_places_free(posed_places *places);

/* Adds evenly spread samples. They keep away from all places added before, from the outline and
 * from folds of the pose. */
int posed_places_follow(posed_places *out, pose *p, const posed_samples *s,
                        const posed_outline *ring);

#endif
