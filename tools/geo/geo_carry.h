/* A GeoJSON text carried along by a map: coordinates and bounding boxes change, nothing else. */
#ifndef GEO_CARRY_H
#define GEO_CARRY_H

#include "geo/edits.h"
#include "geo/geo_index.h"
#include "geo/noding.h"

/* What becomes of geometries that are not in the cage as a whole. */
typedef enum geo_policy { GEO_KEEP, GEO_NULL, GEO_CLIP, GEO_FAIL } geo_policy;

/* A feature, or a geometry that belongs to none, that is not carried as it was. */
typedef struct geo_fault {
    bool feature;
    uint32_t number;  /* of the feature in its list, from 0 */
    geo_span id;      /* of the feature, in the text */
    size_t line;      /* where it begins */
    size_t n_without; /* positions without image */
    const char *fate; /* "kept", "null", "clipped", "refused" */
} geo_fault;

typedef struct geo_result {
    edits edits;
    size_t n_features;             /* and geometries that belong to none */
    size_t n_positions, n_without; /* positions, and those without image */
    size_t n_jumps; /* lines and rings whose longitudes jump, as at the antimeridian */
    size_t n_faults, room_faults;
    geo_fault *faults;
    bool sequence; /* of texts (GeoJSONSeq) */
} geo_result;

/* Carries text[0..n), with text[n] == '\0'. Lines are off by at most `tolerance`. False: see
 * `wrong`. To be freed in either case. */
bool geo_carry(geo_result *out, const carrier *carries, geo_policy policy, double tolerance,
               const char *text, size_t n, problem *wrong);
void geo_result_free(geo_result *r);

#endif
