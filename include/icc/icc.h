/**
 * @file icc/icc.h
 * @brief All of libicc: move the inside of a shape along with its boundary.
 *
 * This header includes all others. Each of them can also be included alone:
 * - icc/map.h: domains, maps, matches and pictures. Most programs need only this one.
 * - icc/chart.h: charts, the coordinates that maps are made from.
 * - icc/stages.h: the steps of the papers one by one.
 * - icc/coverage.h: two layers of regions that share borders.
 * - icc/fit.h: maps from what is known only in part, such as control points and pins.
 * - icc/kernel.h: kernel coordinates, for handles instead of a boundary.
 * - icc/base.h: status codes, errors, memory, threads and progress. The others include it.
 *
 * Objects are opaque and immutable. Any number of threads may use one object at the same time
 * without locks. An object keeps alive whatever it was made from: you may free a domain while a
 * chart on it is in use. Every `icc_*_free` accepts NULL.
 *
 * Creators write the new object to `*out`, or NULL on failure. `env` and `err` may always be NULL.
 * Points are stored one after the other, `dim` doubles each. In option structs zero means the
 * default.
 *
 * What may surprise you:
 * - A call on many points (encode, decode, apply, jacobian) returns ::ICC_OK once it has run, even
 *   if every point failed. Check `n_failed`, or the status of each point.
 * - These calls have no `err`, because the statuses say what happened to each point.
 * - A chart or a map may exist without a certificate. `reason` in icc_chart_info and icc_map_info
 *   says why. For method field, the counts n_infeasible, n_not_inward and n_stray of
 *   icc_field_info tell more.
 * - Saving takes two calls: with a capacity of 0 for the number of bytes, then for the bytes.
 * - icc_domain_create_mask() takes a mask of cells, icc_grid_create_mask() a mask of grid vertices.
 *
 * SPDX-License-Identifier: MIT */
#ifndef ICC_ICC_H
#define ICC_ICC_H

#include <icc/base.h>
#include <icc/chart.h>
#include <icc/coverage.h>
#include <icc/fit.h>
#include <icc/kernel.h>
#include <icc/map.h>
#include <icc/stages.h>

#endif
