/* A motion of a solid's features from where the source has them to where the target has them.
 *
 * Words
 * - stage: the features shrink where they are, then move within the source's body, then the outer
 *   surface moves and takes them along, then they grow again.
 * - turn: the rotation that takes a feature's shape in the source to that in the target as well as
 *   a rotation can.
 * - bend: an arc that is added to the straight way of a feature, to keep it away from others. */
#ifndef ICCP_FEATURE_MOTION_H
#define ICCP_FEATURE_MOTION_H

#include "domain/features.h"

typedef enum iccp_motion_stage {
    ICCP_MOTION_SHRINKS,
    ICCP_MOTION_MOVES,
    ICCP_MOTION_OUTER,
    ICCP_MOTION_GROWS,
    ICCP_MOTION_STAGES
} iccp_motion_stage;

/* How the body of the source takes a small neighbourhood to the target. */
typedef struct iccp_carrier {
    double from[3];     /* the place in the source's body, */
    double rotation[9]; /* its rotation, row by row, and */
    double scale;       /* how much longer lengths become */
} iccp_carrier;

/* The motion of one feature. Places are those of its centre. A feature in a region moves relative
 * to that region, in the region's coordinates. */
typedef struct iccp_moving {
    uint32_t parent;  /* the region that contains it, or the number of features */
    double place[3];  /* in the source, */
    double via[3];    /* in the source's body, at the end of its way, */
    double last[3];   /* and in the target */
    double bend[3];   /* half way, beside the straight way */
    double turn[4];   /* on its way, a unit quaternion */
    double final[9];  /* its rotation in the target */
    double shrinkage; /* how much smaller lengths are in the source's body than in the target */
    double radius;    /* of a ball around it, in the source's body, at any time */
} iccp_moving;

typedef struct iccp_feature_motion {
    iccp_memory memory;
    const icc_domain *source, *target; /* borrowed */
    size_t n;                          /* features */
    iccp_moving *item;
    double scale; /* of small features */
    /* Vertices of features in the source and in the target, relative to their centres, in the
     * source's turn */
    double *shape[2];
    double *places;      /* the vertices of a waypoint: outer, then the features' */
    icc_feature *given;  /* the features of a waypoint, */
    uint32_t *triangles; /* and their triangles */
} iccp_feature_motion;

/* Finds the centre of a feature among the vertices of a domain, as the caller gave them. */
void iccp_feature_centre(const icc_domain *domain, size_t feature, double *centre);

/* Prepares the motion between two domains with the same features. carriers[f] says where the centre
 * of feature f comes from. Begins with a scale of 1 and without bends. */
icc_status iccp_feature_motion_create(iccp_feature_motion *motion, const icc_domain *source,
                                      const icc_domain *target, const iccp_carrier *carriers,
                                      const iccp_memory *memory);
void iccp_feature_motion_free(iccp_feature_motion *motion);

/* Bends ways so that balls around the features keep apart and stay inside the body, which is the
 * outer surface of the source. Returns the least room left, in the body's local coordinates. This
 * is a guess. Whether waypoints are solids is decided when they are made. */
double iccp_feature_motion_bend(iccp_feature_motion *motion, const icc_domain *body);

/* Makes the solid at a time from 0 to 1 of a stage. At the end of the last stage that is the
 * target. If surfaces meet there, *out is NULL, with ICC_OK. */
icc_status iccp_feature_waypoint(icc_domain **out, iccp_feature_motion *motion,
                                 iccp_motion_stage stage, double time, const iccp_env *env);

#endif
