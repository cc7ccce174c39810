/* The facts about a map. icc_map_info and icc_map_report are filled in from them. */
#ifndef ICCP_MAP_FACTS_H
#define ICCP_MAP_FACTS_H

#include "icc/map.h"

typedef struct iccp_map_facts {
    /* What the map is. */
    int32_t dim, kind, certified, reason, reason_side, class_kept;
    size_t n_vertices, n_simplices;
    double energy;
    size_t n_ties;
    double detour;
    size_t n_slid;
    /* How it was made. */
    double seconds, seconds_repair, seconds_improve, seconds_certify;
    double energy_start;
    size_t n_inverted, n_unrepaired, n_iterations;
    int32_t n_levels, n_trees;
    size_t n_samples, n_lost, n_flat;
} iccp_map_facts;

#endif
