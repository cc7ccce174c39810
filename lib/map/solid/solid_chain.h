/* A strategy for solids with features that go far. */
#ifndef ICCP_SOLID_CHAIN_H
#define ICCP_SOLID_CHAIN_H

#include "map/solid/solid_ways.h"

/* Follows a motion of the features from the source to the target, step by step. It needs a map of
 * the outer surfaces alone. Every step is certified, and the result is one map of one mesh. It does
 * not apply to solids without features. On failure the map is not changed. */
iccp_solid_strategy iccp_solid_chain;

#endif
