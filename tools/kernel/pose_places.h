/* Places inside a shape and where a pose takes them. */
#ifndef POSE_PLACES_H
#define POSE_PLACES_H

#include "kernel/pose_outline.h"

/* The samples inside the shape, by the weights alone. */
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
    size_t *handles;   /* the handle that is there; SIZE_MAX: none */
} posed_places;

void posed_places_add(posed_places *out, const double *rest, const double *posed, size_t handle);
void posed_places_free(posed_places *places);

/* Adds samples, evenly spread, that are away from all places added before, from the outline and
 * from where the pose folds. */
int posed_places_follow(posed_places *out, pose *p, const posed_samples *s,
                        const posed_outline *ring);

#endif
