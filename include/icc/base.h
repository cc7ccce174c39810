/**
 * @file icc/base.h
 * @brief Status codes, errors, the calling environment and the version.
 *
 * libicc keeps no global and no thread-local state, installs no signal handler, prints nothing and
 * never exits the process. (It has nothing to do with ICC colour profiles.)
 *
 * You may call libicc in any rounding mode, with subnormal numbers flushed to zero, and with
 * floating-point exceptions that trap. Results are the same bits. Each call computes in C's default
 * floating-point environment (rounding to nearest, no traps). When it returns, your thread has its
 * own environment back, exception flags included. Callbacks run in the default environment and must
 * leave it as it is. A library built by Microsoft's compiler does none of this: call it in the
 * default environment.
 *
 * SPDX-License-Identifier: MIT
 */
#ifndef ICC_BASE_H
#define ICC_BASE_H

#include <stddef.h>
#include <stdint.h>

#if defined(ICC_STATIC)
#define ICC_API
#elif defined(_WIN32)
#if defined(ICC_BUILDING)
#define ICC_API __declspec(dllexport)
#else
#define ICC_API __declspec(dllimport)
#endif
#elif !defined(__GNUC__)
#define ICC_API
#else
#define ICC_API __attribute__((visibility("default")))
#endif

/**
 * A zeroed struct whose `size` is set, for every public struct that begins with its size:
 *
 *     icc_error err = ICC_INIT(icc_error);
 *     icc_map_options options = ICC_INIT(icc_map_options);
 *
 * In C99 it is a compound literal. Variables at file scope take a brace initialiser instead,
 * `{sizeof(icc_error)}`. In C++ it calls a template, which C++98 has as well. The macro is a
 * convenience: a struct that is zeroed and sized by hand is the same.
 */
#ifdef __cplusplus
extern "C++" {
template <typename type> inline type icc_init()
{
    type value = type();
    value.size = sizeof(type);
    return value;
}
}
#define ICC_INIT(type) icc_init<type>()
#else
#define ICC_INIT(type) ((type){.size = sizeof(type)})
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** Result of a call: ::ICC_OK or one of the `ICC_ERR_*` values. */
typedef int32_t icc_status;

/** Status codes. Their numbers never change. */
enum {
    ICC_OK = 0,               /**< the call has run; points may have statuses of their own */
    ICC_ERR_ARGUMENT = 1,     /**< an argument is missing or out of range */
    ICC_ERR_MEMORY = 2,       /**< an allocation failed */
    ICC_ERR_VERSION = 3,      /**< a struct or saved object is from another version */
    ICC_ERR_BOUNDARY = 4,     /**< the boundary is not that of a simple, solid shape */
    ICC_ERR_RESOLUTION = 5,   /**< the grid is too coarse, or would be too large */
    ICC_ERR_TOPOLOGY = 6,     /**< the shape or the grid has the wrong topology */
    ICC_ERR_OUTSIDE = 7,      /**< a point lies outside the domain */
    ICC_ERR_SOLVER = 8,       /**< a numerical solver did not converge */
    ICC_ERR_TRACE = 9,        /**< an integral curve does not reach its end */
    ICC_ERR_CERTIFICATE = 10, /**< a result could not be certified */
    ICC_ERR_CANCELLED = 11,   /**< the progress callback asked to stop */
    ICC_ERR_UNSUPPORTED = 12, /**< this combination is not supported */
    ICC_ERR_FORMAT = 13,      /**< input data is malformed */
    ICC_ERR_AMBIGUOUS = 14    /**< several answers are equally good */
};

/** Limits and markers. */
enum {
    ICC_MAX_DIM = 6 /**< largest dimension of a domain or grid */
};

/** What icc_error::index counts. */
enum {
    ICC_ITEM_NONE = 0,        /**< nothing: index is -1 */
    ICC_ITEM_VERTEX = 1,      /**< vertices of a boundary, a mesh or the curves of a shape */
    ICC_ITEM_FACET = 2,       /**< facets of a boundary; edges of a polygon */
    ICC_ITEM_SIMPLEX = 3,     /**< simplices of a mesh */
    ICC_ITEM_CELL = 4,        /**< cells of a mask, the first axis fastest */
    ICC_ITEM_GRID_VERTEX = 5, /**< vertices of a grid */
    ICC_ITEM_AXIS = 6,        /**< axes */
    ICC_ITEM_POINT = 7,       /**< points of a list */
    ICC_ITEM_REGION = 8,      /**< regions of a shape */
    ICC_ITEM_SEGMENT = 9,     /**< segments of a shape's curves */
    ICC_ITEM_SAMPLE = 10,     /**< samples of a sampling */
    ICC_ITEM_HANDLE = 11,     /**< handles */
    ICC_ITEM_EDGE = 12,       /**< edges between handles */
    ICC_ITEM_LINE = 13,       /**< lines to keep straight */
    ICC_ITEM_NODE = 14,       /**< entries of a list of nodes */
    ICC_ITEM_FEATURE = 15,    /**< features of a domain */
    ICC_ITEM_TIE = 16         /**< ties of a map */
};

/**
 * What went wrong: filled in by the call that failed.
 *
 * You own the struct and set `size` to `sizeof(icc_error)` before the call. Members beyond `size`
 * are not touched. A size of 0, as in `icc_error err = {0}`, stands for the members of version 0.1,
 * so a message is written there as well. (Any other struct without its size is refused with
 * ::ICC_ERR_ARGUMENT and a message that names the struct.) Every function that takes an error
 * accepts NULL. A call that succeeds does not touch it.
 */
typedef struct icc_error {
    size_t size;       /**< set by the caller: `sizeof(icc_error)` */
    icc_status status; /**< the status that the call returned */
    int32_t side;      /**< 0: neither; 1: the source; 2: the target */
    int64_t index;     /**< the item at fault, from 0, or -1 */
    int32_t item;      /**< what `index` counts: `ICC_ITEM_*` */
    /** one line of English, always terminated; begins with "source: " or "target: " if there is
     *  a side */
    char message[252];
} icc_error;

/** One unit of work passed to icc_env::parallel_for. You may run it in any floating-point
 *  environment, and it leaves the environment as it was. */
typedef void (*icc_task)(void *argument, size_t index);

/**
 * How a call allocates, reports and runs in parallel.
 *
 * Zero-initialise it, set `size`, then whatever you need. NULL instead of the struct means all
 * defaults. The struct is read during the call only. But objects keep `user`, `alloc` and
 * `dealloc`, which must stay valid as long as the object lives. They also serve later calls that
 * use the object, because some of its data is made on first use.
 *
 * Results are bit-identical for every number of threads and for every implementation of
 * `parallel_for`.
 */
typedef struct icc_env {
    size_t size; /**< set by the caller: `sizeof(icc_env)` */
    void *user;  /**< passed to every callback below */
    /** Returns memory for any type, or NULL if there is none. Set both `alloc` and `dealloc`, or
     *  neither. They must be thread-safe if tasks run in parallel or if threads share an object
     *  made with them, because some memory is allocated on first use. Default: malloc and free. */
    void *(*alloc)(void *user, size_t size);
    /** Frees what `alloc` returned; never called with NULL. */
    void (*dealloc)(void *user, void *memory);
    /** Takes one line of diagnostics, without a line end. Default: none. */
    void (*log)(void *user, const char *message);
    /** Called on the calling thread from time to time during long work, with the current stage
     *  and the share of the whole call that is done. The share lies in [0,1] and never falls. It
     *  is 1 in the last report of a call that succeeds. Shares are estimates, from what the
     *  parts of a call usually cost. Return non-zero to cancel: the call stops as soon as it can
     *  and returns ::ICC_ERR_CANCELLED. Until then the callback may be called again. A quick call
     *  may report nothing. Default: none.
     *
     *  `stage` is one of these names, and may recur later in the call. More names may be added.
     *  - "check": boundaries, masks, meshes and results are checked and measured
     *  - "repair": simplices that are not yet one-to-one are repaired
     *  - "mesh": a domain is triangulated
     *  - "grid": a grid is laid over a domain
     *  - "tree": the vertices of a grid are ordered
     *  - "order": the simplices of a mesh are ordered
     *  - "solve": equations are solved
     *  - "trace": points are traced along curves, or looked up
     *  - "improve": the distortion of a map is lowered
     *  - "warp": pictures are warped, or points posed
     *  - "sample": samples are spread over a shape
     *  - "weights": kernel coordinates are computed
     *  - "match": outlines are compared
     *  - "load": an object is read back */
    int32_t (*progress)(void *user, const char *stage, double share);
    /** Runs task(argument, i) for every i in [0, n_tasks), in any order and on any threads, and
     *  returns when all are done. Replaces the library's own threads. Certificates do not rely
     *  on it. A task that it leaves out is done by the calling thread after it has returned, and
     *  a task that it runs twice is done once. Default: none. */
    void (*parallel_for)(void *user, size_t n_tasks, icc_task task, void *argument);
    /** Threads that a call may use, including the calling one; 0 and 1 mean one. The others live
     *  only during the call. If one cannot be started, the others do its work. A library built
     *  with ICC_WITH_THREADS off starts none. */
    int32_t threads;
    /** Bytes of memory that loading an object may take, in addition to 64 for each byte of its
     *  data; 0 means 256,000,000. Charts of methods gradient and field, and domains made from
     *  masks, are rebuilt from a few bytes and may need more. Loading then refuses them with
     *  ::ICC_ERR_FORMAT and a message that names this member, before it allocates the memory.
     *  Time is limited in proportion, to about ten seconds for the default. UINT64_MAX lifts
     *  both limits, for data that you trust. */
    uint64_t load_limit;
} icc_env;

/** The library's version, such as "0.1.0". Static; never NULL. */
ICC_API const char *icc_version(void);

/** The version as 10000 major + 100 minor + patch. */
ICC_API int32_t icc_version_number(void);

/** The name of a status, such as "ICC_ERR_MEMORY", or "unknown status". Static. */
ICC_API const char *icc_status_name(icc_status status);

#ifdef __cplusplus
}
#endif

#endif
