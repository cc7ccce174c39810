/* Warps a picture by a map. */
#ifndef PICTURE_WARP_H
#define PICTURE_WARP_H

#include "picture/picture.h"

#include <icc/icc.h>

/* Calls icc_map_warp() on pictures. `to` has the channels and the depth of `from`. */
icc_status picture_warp(const icc_map *map, const picture *from, picture *to, size_t *n_failed,
                        const icc_env *env, icc_error *err);

#endif
