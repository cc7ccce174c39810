/* Drawing paths that do not cross from the edges that they cross. */
#ifndef ICCP_STRANDS_H
#define ICCP_STRANDS_H

#include "map/isotopy/word.h"

/* A polyline for each of some words in one of the scene's two triangulations, ends included: with
 * few bends, and none meets another but at their ends. The words must be those of paths of which
 * that can be said. `line`: one for each, empty at first; the caller frees them in any case. About
 * n log n for n crossings, as long as paths do not run side by side for long. */
icc_status iccp_strands_draw(iccp_polyline *line, const iccp_words *words, const iccp_scene *scene,
                             int side, const iccp_net *net, const iccp_env *env);

#endif
