/* Maps as bytes; see docs/reference/formats.md, icc_map_save() and icc_map_load(). */
#ifndef ICCP_MAP_FILE_H
#define ICCP_MAP_FILE_H

#include "map/map.h"

void iccp_map_save(const icc_map *map, size_t capacity, void *data, size_t *n_bytes);
icc_status iccp_map_load(icc_map **out, size_t n_bytes, const void *data, const iccp_env *env,
                         icc_error *err);

#endif
