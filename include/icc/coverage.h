/**
 * @file icc/coverage.h
 * @brief Coverages: two layers of regions that share borders, such as two surveys of one county.
 *
 *     icc_layer (rings with the numbers of their regions), twice
 *       -> icc_coverage (the same regions, with common vertices)
 *         -> icc_map (a one-to-one map that takes each region to itself, and each border to itself)
 *
 * Two layers that show the same regions rarely have the same vertices. Each was drawn by itself,
 * and often each region of a layer was. A coverage finds which borders are the same, and gives
 * both layers common vertices.
 *
 * The rules that hold for all objects are in icc/icc.h.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_COVERAGE_H
#define ICC_COVERAGE_H

#include <icc/map.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Two layers of the same regions, with common vertices. */
typedef struct icc_coverage icc_coverage;

/** A layer of regions. It belongs to the caller and is only read. A region is all rings with its
 *  number: an outer ring for each of its pieces, and its holes. Rings may run either way. */
typedef struct icc_layer {
    size_t size;            /**< set by the caller: `sizeof(icc_layer)` */
    size_t n_rings;         /**< at least 1 */
    const size_t *first;    /**< n_rings + 1 numbers, from 0 on: the vertex that each ring begins
                             *   with, and the number of all vertices. A ring has at least 3 */
    const double *vertices; /**< 2 coordinates for each vertex */
    const int64_t *ids;     /**< n_rings: the number of the region, any number */
    const uint8_t *holes;   /**< n_rings: 1 if the ring is a hole of its region, else 0. NULL: no
                             *   ring is a hole */
} icc_layer;

/** What icc_coverage_create() does with borders that only one of the two layers has. */
enum {
    ICC_UNMATCHED_REFUSE = 1, /**< it fails, and names one of them */
    /** it goes on without the regions at these borders, see icc_coverage_create() */
    ICC_UNMATCHED_LEAVE_OUT = 2
};

/** Options of icc_coverage_create(). */
typedef struct icc_coverage_options {
    size_t size; /**< set by the caller: `sizeof(icc_coverage_options)` */
    /** the weld length of the source and of the target, each in its own coordinates. Vertices
     *  within this length become one, and a vertex within this length of a side becomes part of
     *  it. 0: only places that are exactly equal, and vertices that lie exactly on a side */
    double weld[2];
    int32_t between;   /**< how vertices along a border are paired: `ICC_BETWEEN_*`; 0: elastic */
    int32_t unmatched; /**< `ICC_UNMATCHED_*`; 0: refuse */
    size_t n_left_out; /**< number of regions that are left out of both layers from the start */
    const int64_t *left_out; /**< n_left_out numbers of regions; they need not exist */
} icc_coverage_options;

/** What icc_coverage_get_info() reports. Of two numbers, the first belongs to the source and the
 *  second to the target. */
typedef struct icc_coverage_info {
    size_t size;       /**< set by the caller: `sizeof(icc_coverage_info)` */
    size_t n_regions;  /**< regions of the coverage */
    size_t n_features; /**< its rings: icc_coverage_get_features() */
    size_t n_vertices; /**< its different common vertices */
    size_t n_nodes;    /**< places where more than two borders begin */
    size_t n_sides;    /**< borders from node to node */
    size_t n_islands;  /**< closed borders without a node */
    /** nodes, borders and islands of which several have the same regions around them. They were
     *  paired by their places */
    size_t n_settled;
    size_t n_joined;      /**< common vertices that are vertices of both layers */
    size_t n_differences; /**< what only one layer has: icc_coverage_get_difference() */
    size_t n_left_out;  /**< regions that one layer has and the coverage has not, or only in part */
    size_t n_given[2];  /**< vertices given */
    size_t n_welded[2]; /**< vertices that moved to another one's place */
    size_t n_inserted[2]; /**< vertices put into sides that pass close by */
    /** vertices that stayed apart although each lies within the weld length of one that went
     *  elsewhere: together they would form a chain longer than the weld length. If there are any,
     *  the weld length is too long for this layer, or too short */
    size_t n_chains[2];
    /** x and y of one of these vertices of the source, then of the target, if there are any */
    double chain[4];
    double most_moved[2];     /**< how far a vertex moved at most; no more than the weld length */
    double least_apart[2];    /**< the least distance left between a vertex and another vertex or a
                             *   side that does not end there; HUGE_VAL if there is none */
    double least_apart_at[4]; /**< x and y of the vertex there: source, target */
} icc_coverage_info;

/** Kinds of differences: icc_coverage_difference::kind. */
enum {
    ICC_DIFFERENCE_REGION = 1, /**< a region that one layer does not have */
    ICC_DIFFERENCE_BORDER = 2, /**< a border between nodes */
    ICC_DIFFERENCE_ISLAND = 3  /**< a closed border without a node: an island, a lake */
};

/** Something that only one of the two layers has. */
typedef struct icc_coverage_difference {
    size_t size;     /**< set by the caller: `sizeof(icc_coverage_difference)` */
    int32_t kind;    /**< `ICC_DIFFERENCE_*` */
    int32_t side;    /**< 1: only the source has it; 2: only the target */
    int32_t n_ids;   /**< 1 or 2: the number of `ids` */
    int64_t ids[2];  /**< the region, or the regions on both sides of the border */
    double place[2]; /**< a vertex of it, in that layer's coordinates */
} icc_coverage_difference;

/**
 * Gives two layers of the same regions common vertices.
 *
 * 1. *Each layer is cleaned.* Vertices within the weld length of each other become one: a vertex
 *    moves to one that was given, and by no more than the weld length. A vertex within the weld
 *    length of a side is put into it. Sides that run back over themselves vanish, and so do sides
 *    between two pieces of one region. With a weld length of 0 all this happens only where it is
 *    exact.
 * 2. *Nodes are found.* A node is a place where more than two sides meet. Its regions, in their
 *    order around it, tell which node of the other layer it is. If several nodes have the same
 *    regions around them, the pairs are those with the least sum of squared distances, after the
 *    affine map that fits all other nodes best.
 * 3. *Borders are paired* by their two nodes, and by the regions left and right. Closed borders
 *    without a node, such as those of islands, are paired by their regions and their places.
 * 4. *Along each border* the vertices are paired by shape, with both ends held, as
 *    icc_match_create() pairs lines. Each vertex of either layer becomes a common vertex. It lies
 *    on the border's segments in the other layer, up to rounding.
 *
 * With ::ICC_UNMATCHED_LEAVE_OUT, differences do not matter:
 * - A region that only one layer has is left out.
 * - An island or a lake that only one layer has is taken away. Its place becomes what is around it.
 * - On both sides of another border that only one layer has, the piece of the region is left out.
 *   The partner of such a piece in the other layer is left out as well.
 * Where a piece is left out, nothing is covered.
 *
 * The result has one feature for each ring, see icc_coverage_get_features(). The two domains,
 * icc_coverage_source() and icc_coverage_target(), consist of these features. Give them to
 * icc_map_create().
 *
 * @param[out] out the coverage; owned by the caller, see icc_coverage_free()
 * @param source   the first layer
 * @param target   the second layer; it may have other coordinates
 * @param options  may be NULL
 * @param env      may be NULL
 * @param err      may be NULL; `side` tells which layer is at fault. `index` is a ring
 *                 (::ICC_ITEM_LINE), or -1. The message names the regions and the place
 * @return ::ICC_OK, or
 * - ::ICC_ERR_BOUNDARY if regions of one layer overlap or cross
 * - ::ICC_ERR_TOPOLOGY if the layers differ, or nothing is left
 * - ::ICC_ERR_ARGUMENT, ::ICC_ERR_MEMORY, ::ICC_ERR_VERSION or ::ICC_ERR_CANCELLED
 *
 * Cost: O(n log n) time and O(n) memory for n vertices, and O(k^2) to O(k^3) time for k islands of
 * one region.
 */
ICC_API icc_status icc_coverage_create(icc_coverage **out, const icc_layer *source,
                                       const icc_layer *target, const icc_coverage_options *options,
                                       const icc_env *env, icc_error *err);

/** Frees a coverage. */
ICC_API void icc_coverage_free(icc_coverage *coverage);

/** The source with common vertices. It belongs to the coverage. NULL gives NULL. */
ICC_API const icc_domain *icc_coverage_source(const icc_coverage *coverage);

/** The target with common vertices. It belongs to the coverage. NULL gives NULL. */
ICC_API const icc_domain *icc_coverage_target(const icc_coverage *coverage);

/** Tells what was done. */
ICC_API icc_status icc_coverage_get_info(const icc_coverage *coverage, icc_coverage_info *info);

/**
 * The rings of both domains, sorted by region: outer rings (::ICC_FEATURE_REGION) and holes, also
 * those that another region fills. Rings of the same number correspond vertex by vertex. Outer
 * rings run counter-clockwise and holes clockwise. No ring passes through a place twice.
 *
 * @param coverage    the coverage
 * @param[out] source icc_coverage_info::n_features features, which belong to the coverage; may be
 *                    NULL
 * @param[out] target the same for the target; may be NULL
 */
ICC_API icc_status icc_coverage_get_features(const icc_coverage *coverage,
                                             const icc_feature **source,
                                             const icc_feature **target);

/** Writes the region of each feature to `ids`, which has room for icc_coverage_info::n_features
 *  numbers. */
ICC_API icc_status icc_coverage_get_ids(const icc_coverage *coverage, int64_t *ids);

/** Describes difference k, 0 <= k < icc_coverage_info::n_differences. Those of the source come
 *  first. */
ICC_API icc_status icc_coverage_get_difference(const icc_coverage *coverage, size_t k,
                                               icc_coverage_difference *difference);

#ifdef __cplusplus
}
#endif

#endif
