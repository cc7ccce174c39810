/* A pairing of two outlines' samples that the elastic search tries. */
#ifndef ICCP_ELASTIC_CANDIDATE_H
#define ICCP_ELASTIC_CANDIDATE_H

#include "match/outline/descriptor.h"
#include "match/outline/elastic.h"
#include "match/outline/lattice_path.h"

#include <stdbool.h>

typedef struct iccp_elastic_candidate {
    double score, rotation[2];
    float
        place[ICCP_MATCH_SAMPLES]; /* of each source sample in the target, in samples, unwrapped */
    int32_t i, j;                  /* where the path begins */
    iccp_lattice_path path;
} iccp_elastic_candidate;

/* The samples of both outlines, and memory for the costs of their pairs. */
typedef struct iccp_samples {
    const iccp_outline *source, *target; /* borrowed */
    iccp_descriptor a[ICCP_MATCH_SAMPLES], b[ICCP_MATCH_SAMPLES];
    bool are_fine; /* vertices are closer than samples on both sides */
    float *cost;
    iccp_lattice lattice;
    iccp_lattice_path path; /* scratch */
} iccp_samples;

/* Where the candidate's path takes each sample, from the path and where it begins. */
void iccp_elastic_candidate_place(iccp_elastic_candidate *candidate);

/* Follows a candidate with the directions of tangents, as often as it pays. */
void iccp_elastic_candidate_follow(iccp_elastic_candidate *candidate, iccp_samples *samples);

/* Where it turns by other angles here than there, as bent limbs do: follows it once more, with the
 * rotation round each sample, in two ways, and takes the one that changes widths more evenly. Its
 * score and the rotation of the whole stay as they were. `spare` has room for a path. */
void iccp_elastic_candidate_bend(iccp_elastic_candidate *candidate, iccp_elastic_candidate *spare,
                                 iccp_samples *samples);

#endif
