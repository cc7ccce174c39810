/* A pairing of two outlines' samples that the elastic search tries. */
#ifndef ICCP_ELASTIC_CANDIDATE_H
#define ICCP_ELASTIC_CANDIDATE_H

#include "match/outline/descriptor.h"
#include "match/outline/elastic.h"
#include "match/outline/lattice_path.h"

#include <stdbool.h>

typedef struct iccp_elastic_candidate {
    double score, rotation[2];
    float place[ICCP_MATCH_SAMPLES]; /* of each source sample: its place in the target, in samples,
                                      unwrapped */
    int32_t i, j;                    /* where the path begins */
    iccp_lattice_path path;
} iccp_elastic_candidate;

/* The samples of both outlines, and memory for the costs of their pairs. */
typedef struct iccp_samples {
    const iccp_outline *source, *target; /* borrowed */
    iccp_descriptor a[ICCP_MATCH_SAMPLES], b[ICCP_MATCH_SAMPLES];
    bool are_fine; /* on both sides, vertices are closer than samples */
    float *cost;
    iccp_lattice lattice;
    iccp_lattice_path path; /* scratch */
} iccp_samples;

/* Computes where the candidate's path takes each sample. */
void iccp_elastic_candidate_place(iccp_elastic_candidate *candidate);

/* Refines a candidate with the directions of tangents, as often as this helps. */
void iccp_elastic_candidate_follow(iccp_elastic_candidate *candidate, iccp_samples *samples);

/* Refines a candidate that turns by different angles in different places, as bent limbs do. It uses
 * the rotation around each sample, in two ways, and keeps the result with more even widths. The
 * candidate's score and its whole rotation do not change. `spare` has room for a path. */
void iccp_elastic_candidate_bend(iccp_elastic_candidate *candidate, iccp_elastic_candidate *spare,
                                 iccp_samples *samples);

#endif
