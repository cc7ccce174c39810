//! Raw bindings of libicc: the C interface as it is, all of it unsafe. The crate `libicc` wraps it.
//!
//! Sections follow the headers `icc/base.h`, `icc/map.h`, `icc/chart.h`, `icc/stages.h`, `icc/kernel.h` and
//! `icc/fit.h`, and the comments are those of the headers: `bindings/rust/comments.py` copies them. The rules of
//! `icc/icc.h` apply. Objects are immutable, creators write to `*out`, and `env` and `err` may be null. `Default` of
//! a struct sets `size` and zeroes everything else. `bindings/rust/check_layout.sh` compares every struct, constant
//! and signature with the headers.
//!
//! (It has nothing to do with ICC colour profiles.)
#![allow(non_camel_case_types)]

use std::os::raw::{c_char, c_void};

/// An object of the library: opaque, only ever behind a pointer.
macro_rules! opaque {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[repr(C)]
        pub struct $name {
            _private: [u8; 0],
            _not_send: std::marker::PhantomData<(*mut u8, std::marker::PhantomPinned)>,
        }
    };
}

macro_rules! zeroed {
    ($name:ident) => {
        impl Default for $name {
            fn default() -> Self {
                // SAFETY: numbers, raw pointers and optional functions, for all of which zero is a value.
                unsafe { std::mem::zeroed() }
            }
        }
    };
}

/// Structs that tell the library their size.
macro_rules! sized {
    ($name:ident) => {
        impl Default for $name {
            fn default() -> Self {
                // SAFETY: as in `zeroed!`.
                let mut value: Self = unsafe { std::mem::zeroed() };
                value.size = std::mem::size_of::<Self>();
                value
            }
        }
    };
}

// icc/base.h

/// Result of a call: `ICC_OK` or one of the `ICC_ERR_*` values.
pub type icc_status = i32;

// Status codes. Their numbers never change.
/// the call has run; points may have statuses of their own
pub const ICC_OK: i32 = 0;
/// an argument is missing or out of range
pub const ICC_ERR_ARGUMENT: i32 = 1;
/// an allocation failed
pub const ICC_ERR_MEMORY: i32 = 2;
/// a struct or saved object is from another version
pub const ICC_ERR_VERSION: i32 = 3;
/// the boundary is not that of a simple, solid shape
pub const ICC_ERR_BOUNDARY: i32 = 4;
/// the grid is too coarse, or would be too large
pub const ICC_ERR_RESOLUTION: i32 = 5;
/// the shape or the grid has the wrong topology
pub const ICC_ERR_TOPOLOGY: i32 = 6;
/// a point lies outside the domain
pub const ICC_ERR_OUTSIDE: i32 = 7;
/// a numerical solver did not converge
pub const ICC_ERR_SOLVER: i32 = 8;
/// an integral curve does not reach its end
pub const ICC_ERR_TRACE: i32 = 9;
/// a result could not be certified
pub const ICC_ERR_CERTIFICATE: i32 = 10;
/// the progress callback asked to stop
pub const ICC_ERR_CANCELLED: i32 = 11;
/// this combination is not supported
pub const ICC_ERR_UNSUPPORTED: i32 = 12;
/// input data is malformed
pub const ICC_ERR_FORMAT: i32 = 13;
/// several answers are equally good
pub const ICC_ERR_AMBIGUOUS: i32 = 14;

// Limits and markers.
/// largest dimension of a domain or grid
pub const ICC_MAX_DIM: usize = 6;

// What `icc_error.index` counts.
/// nothing: index is -1
pub const ICC_ITEM_NONE: i32 = 0;
/// vertices of a boundary, a mesh or the curves of a shape
pub const ICC_ITEM_VERTEX: i32 = 1;
/// facets of a boundary; edges of a polygon
pub const ICC_ITEM_FACET: i32 = 2;
/// simplices of a mesh
pub const ICC_ITEM_SIMPLEX: i32 = 3;
/// cells of a mask, the first axis fastest
pub const ICC_ITEM_CELL: i32 = 4;
/// vertices of a grid
pub const ICC_ITEM_GRID_VERTEX: i32 = 5;
/// axes
pub const ICC_ITEM_AXIS: i32 = 6;
/// points of a list
pub const ICC_ITEM_POINT: i32 = 7;
/// regions of a shape
pub const ICC_ITEM_REGION: i32 = 8;
/// segments of a shape's curves
pub const ICC_ITEM_SEGMENT: i32 = 9;
/// samples of a sampling
pub const ICC_ITEM_SAMPLE: i32 = 10;
/// handles
pub const ICC_ITEM_HANDLE: i32 = 11;
/// edges between handles
pub const ICC_ITEM_EDGE: i32 = 12;
/// lines to keep straight
pub const ICC_ITEM_LINE: i32 = 13;
/// entries of a list of nodes
pub const ICC_ITEM_NODE: i32 = 14;
/// features of a domain
pub const ICC_ITEM_FEATURE: i32 = 15;
/// ties of a map
pub const ICC_ITEM_TIE: i32 = 16;

/// What went wrong: filled in by the call that failed.
///
/// You own the struct and set `size` to `sizeof(icc_error)` before the call. Members beyond `size` are not
/// touched. A size of 0, as in `icc_error err = {0}`, stands for the members of version 0.1, so a message is
/// written there as well. (Any other struct without its size is refused with `ICC_ERR_ARGUMENT` and a message
/// that names the struct.) Every function that takes an error accepts NULL. A call that succeeds does not
/// touch it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_error {
    /// set by the caller: `sizeof(icc_error)`
    pub size: usize,
    /// the status that the call returned
    pub status: icc_status,
    /// 0: neither; 1: the source; 2: the target
    pub side: i32,
    /// the item at fault, from 0, or -1
    pub index: i64,
    /// what `index` counts: `ICC_ITEM_*`
    pub item: i32,
    /// one line of English, always terminated; begins with "source: " or "target: " if there is a side
    pub message: [c_char; 252],
}
sized!(icc_error);

/// One unit of work passed to `icc_env.parallel_for`. You may run it in any floating-point environment, and
/// it leaves the environment as it was.
pub type icc_task = Option<unsafe extern "C" fn(argument: *mut c_void, index: usize)>;

/// How a call allocates, reports and runs in parallel.
///
/// Zero-initialise it, set `size`, then whatever you need. NULL instead of the struct means all defaults. The
/// struct is read during the call only. But objects keep `user`, `alloc` and `dealloc`, which must stay valid
/// as long as the object lives. They also serve later calls that use the object, because some of its data is
/// made on first use.
///
/// Results are bit-identical for every number of threads and for every implementation of `parallel_for`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_env {
    /// set by the caller: `sizeof(icc_env)`
    pub size: usize,
    /// passed to every callback below
    pub user: *mut c_void,
    /// Returns memory for any type, or NULL if there is none. Set both `alloc` and `dealloc`, or neither.
    /// They must be thread-safe if tasks run in parallel or if threads share an object made with them,
    /// because some memory is allocated on first use. Default: malloc and free.
    pub alloc: Option<unsafe extern "C" fn(user: *mut c_void, size: usize) -> *mut c_void>,
    /// Frees what `alloc` returned; never called with NULL.
    pub dealloc: Option<unsafe extern "C" fn(user: *mut c_void, memory: *mut c_void)>,
    /// Takes one line of diagnostics, without a line end. Default: none.
    pub log: Option<unsafe extern "C" fn(user: *mut c_void, message: *const c_char)>,
    /// Called on the calling thread from time to time during long work, with the current stage and the share
    /// of the whole call that is done. The share lies in \[0,1\] and never falls. It is 1 in the last report
    /// of a call that succeeds. Shares are estimates, from what the parts of a call usually cost. Return
    /// non-zero to cancel: the call stops as soon as it can and returns `ICC_ERR_CANCELLED`. Until then the
    /// callback may be called again. A quick call may report nothing. Default: none.
    ///
    /// `stage` is one of these names, and may recur later in the call. More names may be added.
    ///
    /// - "check": boundaries, masks, meshes and results are checked and measured
    /// - "repair": simplices that are not yet one-to-one are repaired
    /// - "mesh": a domain is triangulated
    /// - "grid": a grid is laid over a domain
    /// - "tree": the vertices of a grid are ordered
    /// - "order": the simplices of a mesh are ordered
    /// - "solve": equations are solved
    /// - "trace": points are traced along curves, or looked up
    /// - "improve": the distortion of a map is lowered
    /// - "warp": pictures are warped, or points posed
    /// - "sample": samples are spread over a shape
    /// - "weights": kernel coordinates are computed
    /// - "match": outlines are compared
    /// - "load": an object is read back
    pub progress: Option<unsafe extern "C" fn(user: *mut c_void, stage: *const c_char, share: f64) -> i32>,
    /// Runs task(argument, i) for every i in \[0, n_tasks), in any order and on any threads, and returns when
    /// all are done. Replaces the library's own threads. Certificates do not rely on it. A task that it
    /// leaves out is done by the calling thread after it has returned, and a task that it runs twice is done
    /// once. Default: none.
    pub parallel_for: Option<
        unsafe extern "C" fn(user: *mut c_void, n_tasks: usize, task: icc_task, argument: *mut c_void),
    >,
    /// Threads that a call may use, including the calling one; 0 and 1 mean one. The others live only during
    /// the call. If one cannot be started, the others do its work. A library built with ICC_WITH_THREADS off
    /// starts none.
    pub threads: i32,
    /// Bytes of memory that loading an object may take, in addition to 64 for each byte of its data; 0 means
    /// 256,000,000. Charts of methods gradient and field, and domains made from masks, are rebuilt from a few
    /// bytes and may need more. Loading then refuses them with `ICC_ERR_FORMAT` and a message that names this
    /// member, before it allocates the memory. Time is limited in proportion, to about ten seconds for the
    /// default. UINT64_MAX lifts both limits, for data that you trust.
    pub load_limit: u64,
}
sized!(icc_env);

extern "C" {
    /// The library's version, such as "0.1.0". Static; never NULL.
    pub fn icc_version() -> *const c_char;

    /// The version as 10000 major + 100 minor + patch.
    pub fn icc_version_number() -> i32;

    /// The name of a status, such as "ICC_ERR_MEMORY", or "unknown status". Static.
    pub fn icc_status_name(status: icc_status) -> *const c_char;
}

// icc/map.h: domains

opaque!(
    /// A shape: its boundary, and what lies inside.
    icc_domain
);

// Where a point lies: `icc_domain_locate()`.
/// in the interior
pub const ICC_INSIDE: i32 = 1;
/// On the boundary, within a tolerance. The tolerance is 1e-14 of the bounding box's longest side, or `dim` *
/// 2^-52 of the largest coordinate along each axis, whichever is more. So a point of a facet that you compute
/// in doubles from the facet's vertices counts as on the boundary.
pub const ICC_BOUNDARY: i32 = 2;
/// outside, or in a hole
pub const ICC_OUTSIDE: i32 = 3;

/// What `icc_domain_get_info()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_domain_info {
    /// set by the caller: `sizeof(icc_domain_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// +1 if the facets are listed as seen from outside, else -1. Seen from outside means: in 1-D the lower
    /// end comes first; in 2-D the ring runs counter-clockwise (y upwards); in 3-D each face runs
    /// counter-clockwise. In any dimension, the determinants of the facets are positive as seen from an inner
    /// point
    pub orientation: i32,
    /// vertices of the boundary and of all features
    pub n_vertices: usize,
    /// facets of the boundary, of holes and of regions
    pub n_facets: usize,
    /// bounding box, lower corner
    pub lower: [f64; ICC_MAX_DIM],
    /// bounding box, upper corner
    pub upper: [f64; ICC_MAX_DIM],
    /// length, area (2-D) or volume (3-D), without holes. It may overflow to HUGE_VAL if coordinates are near
    /// 1e300
    pub measure: f64,
    /// features: `icc_domain_create_features()`
    pub n_features: usize,
    /// vertices of the mesh of the inside, including those on the boundary; 0: no mesh
    pub n_mesh_vertices: usize,
    /// simplices of that mesh
    pub n_mesh_simplices: usize,
    /// with features: places where 3 or more sides meet. A side is a segment between two vertices of the
    /// outer ring or of features, counted once
    pub n_junctions: usize,
    /// with features: connected pieces of all rings, lines and points
    pub n_pieces: usize,
    /// with features: parts that rings and lines divide the domain into
    pub n_faces: usize,
    /// 3-D: closed surfaces of the boundary besides the outermost one
    pub n_voids: usize,
    /// 3-D: handles of all surfaces of the boundary together
    pub genus: usize,
    /// features of kind `ICC_FEATURE_HOLE`
    pub n_holes: usize,
    /// features of kind `ICC_FEATURE_LINE`, with the circles around points
    pub n_lines: usize,
    /// features of kind `ICC_FEATURE_POINT`
    pub n_points: usize,
    /// features of kind `ICC_FEATURE_REGION`
    pub n_regions: usize,
}
sized!(icc_domain_info);

/// Options of `icc_domain_fill()`: how it chooses inner vertices.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_fill_options {
    /// set by the caller: `sizeof(icc_fill_options)`
    pub size: usize,
    /// tetrahedra are refined until the circumradius is at most this many shortest edges; at least 1.2. 0:
    /// the default. Infinite: no vertices except those that filling needs
    pub ratio: f64,
    /// refinement ends at this number of inner vertices; 0: no limit
    pub max_points: u64,
}
sized!(icc_fill_options);

// Kinds of features: `icc_feature.kind`.
/// a simple polygon whose inside is not part of the domain; in 3-D a void, which is a closed surface of
/// triangles
pub const ICC_FEATURE_HOLE: i32 = 1;
/// a polyline of 2 or more vertices; with two vertices, a bone. In 2-D it is closed if the last vertex
/// repeats the first one
pub const ICC_FEATURE_LINE: i32 = 2;
/// one vertex
pub const ICC_FEATURE_POINT: i32 = 3;
/// a simple polygon whose inside is part of the domain: for example a county, an island in a hole, or a
/// polygon beside the outer ring. In 3-D a closed surface of triangles inside the outer one, with the domain
/// on both sides
pub const ICC_FEATURE_REGION: i32 = 4;

/// A hole, line, point or region of a domain. A map takes it to the feature of the same number in the other
/// domain: vertex to vertex, and edge to edge or triangle to triangle linearly.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_feature {
    /// set by the caller: `sizeof(icc_feature)`, the same for all elements of an array
    pub size: usize,
    /// `ICC_FEATURE_*`
    pub kind: i32,
    /// hole, region: at least 3, in 3-D at least 4; line: at least 2; point: 1
    pub n_vertices: usize,
    /// n_vertices times 2 coordinates, in 3-D times 3
    pub vertices: *const f64,
    /// 2-D, point: its size, if above 0, see `icc_domain_create_features()`. Otherwise 0
    pub radius: f64,
    /// 3-D, hole or region: number of its triangles. Otherwise 0
    pub n_facets: usize,
    /// 3-D, hole or region: 3 n_facets numbers of its own vertices. Otherwise NULL
    pub facets: *const u32,
}
sized!(icc_feature);

/// A mesh of triangles in 2-D, tetrahedra in 3-D, or simplices beyond. It is either yours, and libicc only
/// reads it, or it has room for a mesh that libicc writes.
///
/// To get a mesh, call `icc_domain_get_mesh()` or `icc_map_get_mesh()` twice. The first time, set `vertices`
/// and `cells` to NULL; the call sets the dimension and the counts. The second time, pass arrays of that
/// size. Either array may stay NULL.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_mesh {
    /// set by the caller: `sizeof(icc_mesh)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// number of vertices, fewer than 2^26; when libicc writes the mesh, the capacity of `vertices`
    pub n_vertices: usize,
    /// n_vertices * dim coordinates
    pub vertices: *mut f64,
    /// number of cells, fewer than 2^26; when libicc writes the mesh, the capacity of `cells`
    pub n_cells: usize,
    /// n_cells * (dim + 1) vertex indices, cell after cell. A cell may list its vertices in any order
    pub cells: *mut u32,
    /// NULL if every cell has dim + 1 vertices. Otherwise n_cells + 1 numbers as in VTK: where each cell
    /// begins in `cells`, and where the last one ends
    pub offsets: *const usize,
    /// VTK's types of the n_cells cells, or NULL. Only simplices are supported, 5 in 2-D and 10 in 3-D, and
    /// quadrilaterals, 9, by `icc_fit_create()`. Other types give `ICC_ERR_UNSUPPORTED`
    pub types: *const u8,
    /// For `icc_domain_create_mesh()` in 3-D: a number for each of the n_cells cells. Otherwise NULL, or the
    /// call gives `ICC_ERR_UNSUPPORTED`
    pub regions: *const i32,
}
sized!(icc_mesh);

/// What `icc_domain_get_feature()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_feature_info {
    /// set by the caller: `sizeof(icc_feature_info)`
    pub size: usize,
    /// `ICC_FEATURE_*`
    pub kind: i32,
    /// hole or region: +1 if it is listed counter-clockwise (y upwards; in 3-D as seen from outside it), -1
    /// if clockwise; else 0
    pub orientation: i32,
    /// number of its first vertex in the domain; the others follow
    pub first_vertex: usize,
    /// number of its vertices
    pub n_vertices: usize,
    /// hole or region: number of its first facet; in 2-D the one from its first vertex to the next. Else 0
    pub first_facet: usize,
    /// hole or region: number of its facets. Else 0
    pub n_facets: usize,
    /// 3-D, hole or region: number of its handles. Else 0
    pub genus: usize,
    /// 3-D: the region in which it lies, as `icc_domain_get_regions()` numbers them; else 0
    pub around: usize,
}
sized!(icc_feature_info);

// Defects that `icc_boundary_defects()` lists. Here a and b are indices of vertices or facets.
/// vertex a has a coordinate that is not finite; b = a
pub const ICC_DEFECT_NOT_FINITE: i32 = 1;
/// vertices a \< b coincide
pub const ICC_DEFECT_REPEATED: i32 = 2;
/// at vertex a the boundary turns back over itself; b = a
pub const ICC_DEFECT_SPIKE: i32 = 3;
/// facets a \< b cross
pub const ICC_DEFECT_CROSSING: i32 = 4;
/// facets a \< b touch or overlap without sharing a vertex
pub const ICC_DEFECT_TOUCH: i32 = 5;
/// the shape has no area; a = b = 0
pub const ICC_DEFECT_FLAT: i32 = 6;

// icc/chart.h, and the functions of icc/map.h that take domains and charts

opaque!(
    /// Coordinates of the inside of a domain: a boundary point and a share in \[0,1\].
    icc_chart
);

// How coordinates are made. Methods gradient and field work in 2-D and beyond. Method foliation works in 2-D
// and on domains with a mesh, method disc in 2-D.
/// Integral Curve Coordinates as Huynh and Gingold published them. They use a regular grid, a cousin tree, a
/// function on it, and piecewise linear gradient lines. They work in any dimension, on the simplices of the
/// Kuhn triangulation and their faces.
///
/// These coordinates are not one-to-one, and never certified. Lines merge, so an open part of the area
/// collapses; in 3-D and beyond it is most of it. Thin parts of a shape between grid vertices are not
/// reached. `icc_chart_get_report()` estimates how much is lost. Beyond 2-D the function may also have
/// several maxima where lines end: `icc_gradient_info.n_maxima`.
pub const ICC_METHOD_GRADIENT: i32 = 1;
/// Integral Curve Coordinates along leaves, which are curves that cannot merge. In 2-D they are level lines
/// of an angle-valued, discretely harmonic function on a triangle mesh of the domain. libicc checks a
/// certificate for every chart, with integers and exact signs. If it holds, the chart is a homeomorphism of
/// the closed domain in exact arithmetic: one-to-one and continuous both ways. If it fails there is no chart
/// (`ICC_ERR_CERTIFICATE`). The coordinates are continuous and piecewise smooth. In doubles, a round trip
/// returns to about 1e-15 of the domain's size. A mesh *sampled* from the map can still have inverted
/// triangles.
///
/// On a domain with a mesh (`icc_domain_create_mesh()`) it works in any dimension. Leaves are then straight
/// in every simplex and pass through the simplices in an order, a shelling. They all end at an inner vertex,
/// or at the middle of a simplex if there is none. The certificate checks that order and promises the same.
/// (Beyond 3-D the orientation of simplices is certain, but not computed exactly.) Some meshes have no such
/// order: `ICC_ERR_TOPOLOGY`. Leaves near a flat simplex are long.
pub const ICC_METHOD_FOLIATION: i32 = 2;
/// Integral Curve Coordinates along a vector field in which curves cannot merge, on a regular grid in any
/// dimension. Every grid vertex has a vector that points uphill in all simplices around it, for the
/// discretely harmonic function. Between the vertices the field is linear. Curves are followed exactly,
/// except for rounding.
///
/// The chart is certified if three conditions hold. Every vertex has such a vector. The field crosses the
/// whole boundary inward, which is checked vertex by vertex. No grid vertex inside was given up. Otherwise
/// there is a chart without a certificate, and `icc_field_info.n_infeasible`, n_not_inward and n_stray count
/// what is wrong.
///
/// Two certified charts do not always make a certified map, because doubles may lack the digits:
/// `icc_map_report.n_lost` and n_flat. Curves converge on their way. So points that one chart tells apart may
/// coincide in the other, for example if a ball is mapped to a pancake.
pub const ICC_METHOD_FIELD: i32 = 3;
/// Polar coordinates of the harmonic map to a disc (Tutte), piecewise linear. It is a homeomorphism under the
/// same certificate as foliation. The curves are the preimages of radii. A slit as narrow as about 1e-15 of
/// the shape's size can be too narrow to mesh; the error says so.
pub const ICC_METHOD_DISC: i32 = 4;

// Why a chart or a map is not certified. If there are several reasons, the first is given. The members named
// here count how much is wrong.
/// it is certified
pub const ICC_REASON_NONE: i32 = 0;
/// the curves of method gradient merge
pub const ICC_REASON_GRADIENT: i32 = 1;
/// field: `icc_field_info.n_infeasible`
pub const ICC_REASON_INFEASIBLE: i32 = 2;
/// field: `icc_field_info.n_not_inward`
pub const ICC_REASON_NOT_INWARD: i32 = 3;
/// field: `icc_field_info.n_stray`
pub const ICC_REASON_STRAY: i32 = 4;
/// maps of method field: `icc_map_report.n_lost`
pub const ICC_REASON_LOST: i32 = 5;
/// maps of method field: `icc_map_report.n_flat`
pub const ICC_REASON_FLAT: i32 = 6;

// The function whose gradient lines are followed: `icc_function_create()` explains each of them.
/// thesis (4.1): 10 at the maximum, times 0.95 from parent to child
pub const ICC_FUNCTION_DECAY: i32 = 1;
/// minus the distance in the tree (L1 distance)
pub const ICC_FUNCTION_DISTANCE: i32 = 2;
/// discretely harmonic: 1 at the maximum, 0 outside
pub const ICC_FUNCTION_LAPLACE: i32 = 3;
/// discretely biharmonic, simply supported (Navier)
pub const ICC_FUNCTION_BILAPLACE: i32 = 4;
/// discretely biharmonic, clamped: changes its sign unless constrained
pub const ICC_FUNCTION_CLAMPED: i32 = 5;
/// like Laplace, but 0 where the grid's edges cross the boundary: it follows the shape, not a staircase
pub const ICC_FUNCTION_HARMONIC: i32 = 6;
/// reported of a function that has the caller's values: `icc_function_create_values()`. Not for options
pub const ICC_FUNCTION_VALUES: i32 = 7;

// Whether f(parent) >= (1 + min_fall) f(child) is imposed on the edges of the tree inside. This concerns
// Laplace, harmonic and bi-Laplace functions. Decay and distance satisfy it anyway.
/// Only if the function without constraints has critical points besides one maximum at the root. (In 2-D, the
/// saddles of holes do not count, because no function can avoid them.) Charts first move the root as for
/// `ICC_CONSTRAINTS_NONE`, and impose constraints only if that does not help. If they are imposed, the root
/// stays at its first place
pub const ICC_CONSTRAINTS_NEEDED: i32 = 1;
/// never. A chart of a bi-Laplace function then has its maximum where the function is greatest, which may be
/// beside the requested place: `icc_gradient_info.moved`
pub const ICC_CONSTRAINTS_NONE: i32 = 2;
/// always: the maximum stays at the requested place
pub const ICC_CONSTRAINTS_ALL: i32 = 3;

// How the linear systems of Laplace and bi-Laplace functions are solved.
/// sparse factorisation: each value has a relative error of about 1e-12
pub const ICC_SOLVER_DIRECT: i32 = 1;
/// conjugate gradients with a multigrid preconditioner: for large grids, mainly in 3-D
pub const ICC_SOLVER_ITERATIVE: i32 = 2;

// The two published forms of Algorithm 2: `icc_tree_create()`.
/// vertices just outside the boundary belong to the tree
pub const ICC_TREE_THESIS: i32 = 1;
/// vertices just outside are children of all their neighbours inside
pub const ICC_TREE_PAPER: i32 = 2;

// What a chart loses at a point, as bits. 0: the point and its coordinates lead to each other. The first bit
// says that they do not. The others say why for charts of method gradient, and come only with the first.
// Curves *merge* where they meet at an edge of the grid's triangulation, or at another lower face, and go on
// as one.
/// The way back does not return. `icc_chart_encode_flags()`: the coordinates belong to another point, or to
/// none. `icc_chart_decode_flags()`: the point has other coordinates. If it is the only bit, curves are so
/// close together that doubles do not tell them apart. In an uncertified chart of method field, the curve may
/// also have left the domain
pub const ICC_LOSS_AWAY: i32 = 1;
/// Encode: the curve merges with others on its way down to the boundary, at an expansion edge (thesis, 6.4).
/// No curve from the boundary reaches the point
pub const ICC_LOSS_UNCOVERED: i32 = 2;
/// Decode: curves have merged between the boundary and the point, at a compression edge. They all lead to
/// this point
pub const ICC_LOSS_COLLAPSED: i32 = 4;
/// Decode: the curve leaves the domain and enters it again below the point, because the cells are too large
/// for the shape. Encode finds the place where it enters
pub const ICC_LOSS_GAP: i32 = 8;

/// Options of `icc_chart_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_options {
    /// set by the caller: `sizeof(icc_chart_options)`
    pub size: usize,
    /// `ICC_METHOD_*`; 0: the best available, which is foliation in 2-D and on domains with a mesh, else
    /// field
    pub method: i32,
    /// gradient: `ICC_FUNCTION_*`; 0: decay
    pub function: i32,
    /// gradient: `ICC_TREE_*`; 0: thesis
    pub tree: i32,
    /// grid or mesh cells along the longest side, 2..16384; 0: 50, as in the papers. For gradient on a mask
    /// see `icc_grid_create()`
    pub cells: i32,
    /// Requested maximum: the nearest vertex inside is taken. NULL: chosen by the method. Gradient and field
    /// take the grassfire's maximum. Foliation takes the deepest vertex, or on your own mesh the deepest
    /// inner vertex. Disc allows NULL only, because its maximum is the point that the harmonic map takes to
    /// the centre. Bi-Laplace functions without constraints may move the maximum: `icc_gradient_info.moved`
    pub maximum: *const f64,
    /// gradient: `ICC_CONSTRAINTS_*`; 0: needed
    pub constraints: i32,
    /// gradient: `ICC_SOLVER_*`; 0: by the predicted work
    pub solver: i32,
    /// gradient: least relative fall along tree edges, in (0, 0.01\]; 0: 1e-6
    pub min_fall: f64,
    /// gradient, constrained bi-Laplace: least value at the leaves of the tree, in (0, 0.01\]; 0: 1e-9
    pub leaf_min: f64,
    /// gradient: the order in which the tree expands along the axes, a permutation of 0..dim-1; NULL: 0, 1, 2
    /// and so on, see `icc_tree_options`
    pub axis_order: *const i32,
}
sized!(icc_chart_options);

/// What `icc_chart_get_info()` reports for every method. Members that only one method has are in
/// `icc_gradient_info`, `icc_field_info`, `icc_foliation_info`, `icc_shelling_info` and `icc_disc_info`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_info {
    /// set by the caller: `sizeof(icc_chart_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_METHOD_*`
    pub method: i32,
    /// 1: proved to be one-to-one, exactly (field: in doubles). 0: not, see `reason`
    pub certified: i32,
    /// `ICC_REASON_*`: why it is not certified; 0 if it is
    pub reason: i32,
    /// cells along the longest side that were used. Method field may take more than requested in thin shapes.
    /// 0 on a domain's mesh
    pub cells: i32,
    /// the point where every curve ends
    pub maximum: [f64; ICC_MAX_DIM],
    /// distance between neighbours in the grid or lattice; 0 on a domain's mesh
    pub spacing: f64,
}
sized!(icc_chart_info);

/// What `icc_chart_get_gradient_info()` reports about charts of method gradient.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_gradient_info {
    /// set by the caller: `sizeof(icc_gradient_info)`
    pub size: usize,
    /// `ICC_FUNCTION_*`
    pub function: i32,
    /// `ICC_TREE_*`
    pub tree: i32,
    /// grid vertices
    pub n_grid: usize,
    /// grid vertices inside the domain
    pub n_inside: usize,
    /// grid vertices in the tree
    pub n_tree: usize,
    /// grid vertices inside that the tree does not reach
    pub n_unreachable: usize,
    /// pairs of neighbours inside that are neither parent and child nor cousins
    pub n_cousin_violations: usize,
    /// maxima of the function inside
    pub n_maxima: usize,
    /// minima of the function inside
    pub n_minima: usize,
    /// saddles of the function inside
    pub n_saddles: usize,
    /// facets (in 2-D: edges) between two simplices that curves pass through, see `icc_function_get_facets()`
    pub n_edges: usize,
    /// facets where curves merge on the way up
    pub n_compression: usize,
    /// facets where curves merge on the way down
    pub n_expansion: usize,
    /// bi-Laplace functions without constraints: distance of `icc_chart_info.maximum` from the requested
    /// vertex, or from the grassfire's. The maximum moves because the function is greatest beside that
    /// vertex. Else 0
    pub moved: f64,
}
sized!(icc_gradient_info);

/// What `icc_chart_get_field_info()` reports about charts of method field. Their function is
/// `ICC_FUNCTION_LAPLACE`, their tree has the form `ICC_TREE_THESIS`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_field_info {
    /// set by the caller: `sizeof(icc_field_info)`
    pub size: usize,
    /// grid vertices
    pub n_grid: usize,
    /// grid vertices inside the domain
    pub n_inside: usize,
    /// grid vertices inside that were given up so that the remaining ones form a ball
    pub n_stray: usize,
    /// grid vertices in the tree
    pub n_tree: usize,
    /// grid vertices inside that the tree does not reach
    pub n_unreachable: usize,
    /// pairs of neighbours inside that are neither parent and child nor cousins
    pub n_cousin_violations: usize,
    /// maxima of the function inside
    pub n_maxima: usize,
    /// minima of the function inside
    pub n_minima: usize,
    /// saddles of the function inside
    pub n_saddles: usize,
    /// grid vertices where no vector points uphill in all simplices
    pub n_infeasible: usize,
    /// pairs of a boundary facet and a grid vertex, where the facet runs through a simplex of that vertex
    pub n_contacts: usize,
    /// contacts where the vector does not point inward
    pub n_not_inward: usize,
}
sized!(icc_field_info);

/// What `icc_chart_get_foliation_info()` reports about charts of method foliation in 2-D, on a mesh that
/// libicc makes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_foliation_info {
    /// set by the caller: `sizeof(icc_foliation_info)`
    pub size: usize,
    /// vertices of the mesh
    pub n_mesh_vertices: usize,
    /// mesh vertices on the boundary
    pub n_mesh_boundary: usize,
    /// triangles of the mesh
    pub n_mesh_simplices: usize,
    /// mesh edges whose two ends have the same label; they are ordered by index
    pub n_ties: usize,
    /// share of the boundary flux that is harmonic
    pub harmonic_share: f64,
}
sized!(icc_foliation_info);

/// What `icc_chart_get_shelling_info()` reports about charts of method foliation on a domain's own mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_shelling_info {
    /// set by the caller: `sizeof(icc_shelling_info)`
    pub size: usize,
    /// vertices of the mesh, plus one if none lies inside
    pub n_mesh_vertices: usize,
    /// mesh vertices on the boundary
    pub n_mesh_boundary: usize,
    /// simplices of the mesh
    pub n_mesh_simplices: usize,
    /// share of the boundary flux that is harmonic
    pub harmonic_share: f64,
    /// 1: the order of the simplices was found from the boundary inwards; 0: from the centre outwards
    pub order_peeled: i32,
    /// number of tried orders that were complete at first; the best of them is used
    pub n_orders: i32,
    /// weight of reversed flux in the order that is used
    pub order_beta: f64,
    /// facets that the harmonic flux crosses against the order
    pub n_reversed: usize,
    /// weighted sum of squared differences between the flux along the leaves and the harmonic flux; 0 is best
    pub flux_energy: f64,
    /// largest share of a simplex's flux that is lost by rounding
    pub flux_divergence: f64,
}
sized!(icc_shelling_info);

/// What `icc_chart_get_disc_info()` reports about charts of method disc.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_disc_info {
    /// set by the caller: `sizeof(icc_disc_info)`
    pub size: usize,
    /// vertices of the mesh
    pub n_mesh_vertices: usize,
    /// mesh vertices on the boundary
    pub n_mesh_boundary: usize,
    /// triangles of the mesh
    pub n_mesh_simplices: usize,
}
sized!(icc_disc_info);

/// What `icc_chart_get_timings()` reports: seconds for each step of making a chart. Steps that the method
/// does not have are 0. A loaded chart has the times of loading it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_timings {
    /// set by the caller: `sizeof(icc_chart_timings)`
    pub size: usize,
    /// gradient, field: the grid and the maximum
    pub grid: f64,
    /// gradient, field: the tree and its check
    pub tree: f64,
    /// gradient, field: the function and its check
    pub function: f64,
    /// foliation, disc: the mesh; on a domain's mesh, preparing the leaves
    pub mesh: f64,
    /// foliation on a domain's mesh: choosing the maximum
    pub centre: f64,
    /// field: the vectors and their check; foliation, disc: the equations
    pub solve: f64,
    /// foliation on a domain's mesh: the order of the simplices
    pub order: f64,
    /// foliation, disc: the certificate
    pub certify: f64,
}
sized!(icc_chart_timings);

/// What `icc_chart_get_report()` estimates from evenly spread points. All shares lie in \[0,1\]. "Area" and
/// "length" are for 2-D; beyond, read volume and area, and so on. For a certified chart all shares and counts
/// are 0, without sampling.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_report {
    /// set by the caller: `sizeof(icc_chart_report)`
    pub size: usize,
    /// points inside that were used
    pub n_points: usize,
    /// points on the boundary that were used
    pub n_boundary: usize,
    /// share of the area from which no curve reaches both the boundary and the maximum
    pub unreachable: f64,
    /// share of the area that no curve from the boundary enters (expansion edges)
    pub uncovered: f64,
    /// share of the coordinates, boundary length times t, whose point lies on a line where curves have merged
    /// (compression edges)
    pub collapsed: f64,
    /// share of the boundary length where the gradient does not point inward
    pub not_inward: f64,
}
sized!(icc_chart_report);

opaque!(
    /// Two domains that do not correspond, and the pairs of points that belong together.
    icc_match
);

// How `icc_match_create()` treats rotations.
/// prefer small rotations: of nearly equal pairings take the one that turns the shape least. People expect
/// this of letters, squares and maps
pub const ICC_TURNING_UPRIGHT: i32 = 1;
/// no preference: any rotation is as good as any other
pub const ICC_TURNING_FREE: i32 = 2;

// How `icc_match_create()` pairs the parts of two outlines between landmarks.
/// by shape: similar parts are paired
pub const ICC_BETWEEN_ELASTIC: i32 = 1;
/// by arc length, for outlines without distinct parts, such as discs. By shape these would be ambiguous.
/// Without landmarks the pairing starts where the two outlines are nearest when laid on one another unturned
pub const ICC_BETWEEN_ARC: i32 = 2;

/// Options of `icc_match_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_match_options {
    /// set by the caller: `sizeof(icc_match_options)`
    pub size: usize,
    /// without landmarks: `ICC_TURNING_*`; 0: upright
    pub turning: i32,
    /// `ICC_BETWEEN_*`; 0: elastic
    pub between: i32,
    /// without landmarks: pairings whose `icc_match_info.sure` is less are refused. 0: 1.06. 1: none is
    /// refused
    pub least_sure: f64,
    /// in the plane: a share of the perimeter, at most 0.01. If the pairing brings a vertex of the source and
    /// one of the target within this distance of each other, they become one common vertex instead of two.
    /// This is not done where an edge next to them would become three times longer or shorter. 0: only
    /// vertices within 0.3 of the shorter edge at them are joined
    pub drop: f64,
    /// in space: how far the common surfaces may be off the given ones, as a share of the diagonal of each
    /// one's bounding box. At most 0.1; 0: 1e-3. A negative value means not at all: the result then has four
    /// to six times as many vertices as both surfaces together and many thin triangles. Even then, vertices
    /// that rounding brings together are joined, up to 1e-3
    pub tolerance: f64,
    /// in space, 1: the source keeps all its vertices and edges. Its edges and triangles get more vertices
    /// where the target would otherwise be too far off. 0: it need not keep them. In the plane the source
    /// always keeps its vertices
    pub keep_source: i32,
}
sized!(icc_match_options);

/// What `icc_match_get_info()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_match_info {
    /// set by the caller: `sizeof(icc_match_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// 1: the target's mirror image fits clearly better, by the same measure as `sure`. Perhaps y points down
    /// in one of the two. This is only a hint, because a map cannot mirror. Without landmarks only
    pub mirrored: i32,
    /// common vertices of the two domains
    pub n_vertices: usize,
    /// common vertices that are landmarks
    pub n_landmarks: usize,
    /// common vertices that are vertices of both given domains
    pub n_joined: usize,
    /// cost of the outlines' pairing, from 0 for similar shapes to 4. HUGE_VAL by arc length and in space. Of
    /// several parts: `cost` to `turn` and `mirrored` are about the one whose pairing by shape is least sure.
    /// If the whole has placed all parts, they are about the one that costs most
    pub cost: f64,
    /// cost of the best pairing that differs from this one by more than 5 % of the perimeter. HUGE_VAL if
    /// none was found, if there were landmarks, or if the whole has placed all parts
    pub second: f64,
    /// (second + 0.05) / (cost + 0.05): confidence in the pairing. 1 means that another pairing is as good.
    /// It is a comparison, not a probability
    pub sure: f64,
    /// degrees by which the source is turned, counter-clockwise, to lie as the target does
    pub turn: f64,
    /// how much the outer ring shrinks where it shrinks most: the edge's share of the target's perimeter over
    /// its share of the source's. In space, the same for triangles and areas
    pub least_slope: f64,
    /// the same where the outer ring grows most
    pub most_slope: f64,
    /// in space: distortion of the common triangles, both surfaces scaled to the same area. It is the mean,
    /// by area of the source, of (s^2 + t^2) (1 + 1 / (s t)^2) for the singular values s and t. 4 means that
    /// no length changes
    pub energy: f64,
    /// in space: largest distance between the common and the given surfaces. It is measured both ways, from
    /// vertices and from middles of edges and triangles, as a share of the diagonal, like
    /// `icc_match_options.tolerance`
    pub off: f64,
    /// in space: smallest angle of the common triangles on either surface, in degrees
    pub least_angle: f64,
    /// in space: common vertices before the surfaces were simplified
    pub n_overlay: usize,
}
sized!(icc_match_info);

opaque!(
    /// A map from one domain to another that agrees with the boundaries.
    icc_map
);

// How a map works.
/// A *curve map* takes each point through the two charts, as the papers do. It works in any dimension.
pub const ICC_MAP_CURVES: i32 = 1;
/// A *mesh map* is piecewise linear on an internal mesh. It is always certified and has the fastest queries:
/// less than 0.1 us a point in 2-D, 1 to 5 us in 3-D. On the boundary it agrees with the given facets up to
/// rounding: images of points on a facet lie on the target's facet to one unit in the last place.
///
/// In 2-D the mesh is made of triangles that fill the source. Every vertex has an image, chosen for low
/// distortion. Every triangle is exactly positive before and after, which means that it keeps its
/// orientation. Both boundaries are exactly simple.
///
/// In 3-D the map needs two closed surfaces. The source is filled unless it brings a mesh. The map is made
/// without charts and uses the source's mesh, with images that are chosen and certified as in 2-D. Where
/// necessary, inner edges of the source's mesh between boundary vertices are cut, or the map is made on the
/// target's mesh.
///
/// In 4-D to 6-D the map is made without charts. Its mesh is that of either domain, or the cells of either
/// mask, or the cone from one inner vertex to all facets. The cone needs a point inside each boundary that
/// sees all of it, or nearly all. Certified then means that every simplex is positive before and after. The
/// signs are certain, but a simplex that is nearly flat counts as inverted. Whether a boundary meets itself
/// is not checked.
pub const ICC_MAP_MESH: i32 = 2;

// Whether vertices of features may slide: `icc_map_options.slide`. A *chain* is a row of edges of rings and
// lines between two places where more or fewer than two edges meet, a line ends, or a point lies. A closed
// chain begins and ends at one of its vertices. The ends of a chain go to their partners. If the chain
// slides, its other vertices need not. The chain as a whole still goes exactly to its partner, edge by edge
// and in order. libicc chooses where vertices go, so that the energy is low. That suits interfaces of
// materials and borders whose vertices mean nothing by themselves. Circles around points do not slide. The
// energy is never higher than without sliding.
/// vertex i goes to vertex i
pub const ICC_SLIDE_NONE: i32 = 0;
/// chains inside the domain slide
pub const ICC_SLIDE_INSIDE: i32 = 1;
/// chains of the boundary slide as well
pub const ICC_SLIDE_ALL: i32 = 2;

/// A path between two vertices of a domain with features, and its path in the target. Ties tell a map on
/// which side one feature passes another. The map takes the first path to one that can be moved to the second
/// with its ends held and without crossing a feature.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_tie {
    /// set by the caller: `sizeof(icc_tie)`, the same for all elements of an array
    pub size: usize,
    /// first and last vertex: numbers of the domain, see `icc_domain_create_features()`
    pub vertex: [u32; 2],
    /// number of its bends in the source
    pub n_source: usize,
    /// 2 n_source coordinates
    pub source: *const f64,
    /// number of its bends in the target, which may differ
    pub n_target: usize,
    /// 2 n_target coordinates
    pub target: *const f64,
}
sized!(icc_tie);

/// Options of `icc_map_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_map_options {
    /// set by the caller: `sizeof(icc_map_options)`
    pub size: usize,
    /// `ICC_MAP_*`: this kind, or `ICC_ERR_CERTIFICATE` if no such map is found. 0: the best that is found,
    /// see `icc_map_info.kind`. That is a mesh map for foliation and disc in 2-D, unless both domains bring
    /// meshes, and for foliation in 3-D. From 3-D on it is also a mesh map if `chart` names neither a method
    /// nor a maximum. It is a curve map in all other cases, or if no mesh map is found
    pub kind: i32,
    /// mesh map: at most this many improvement steps on each level of refinement. 0: as long as they pay off.
    /// -1: no improvement
    pub iterations: i32,
    /// For both charts, or NULL. Its `maximum` is the source's. For a mesh map in 2-D, method 0 means disc
    /// (foliation if a maximum is given), and cells 0 means 20. In 3-D, a map gets charts if a method, a
    /// maximum or kind `ICC_MAP_CURVES` is asked for, and for masks. Method 0 then means foliation, or field
    /// for masks. Beyond 3-D, a mesh map has no charts, so kind `ICC_MAP_MESH` allows neither a method nor a
    /// maximum.
    pub chart: *const icc_chart_options,
    /// the target's maximum; NULL: chosen by the method
    pub target_maximum: *const f64,
    /// with features: in each part of the domain, one less than it has pieces; or 0. A piece is what is
    /// connected by lines and rings, see `icc_domain_info.n_pieces`
    pub n_ties: usize,
    /// with features: paths that join all pieces of each part to a tree. They lie inside both domains and do
    /// not cross. NULL: libicc chooses the way that looks least twisted
    pub ties: *const icc_tie,
    /// with features: `ICC_SLIDE_*`, whether vertices may slide along lines and borders. The map then needs
    /// improvement, so `iterations` must not be -1. Ends of ties stay. Several maps are made in turn, which
    /// may take 5 to 15 times as long. Domains without features and `icc_map_create_from_charts()` refuse to
    /// slide with `ICC_ERR_UNSUPPORTED`
    pub slide: i32,
}
sized!(icc_map_options);

/// What `icc_map_get_info()` reports about a map. It is saved with the map. Members that do not apply to the
/// kind are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_map_info {
    /// set by the caller: `sizeof(icc_map_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_MAP_*`: never 0
    pub kind: i32,
    /// 1: proved to be one-to-one, exactly (field: in doubles, see `icc_map_report.n_lost`). 0: not, see
    /// `reason`
    pub certified: i32,
    /// `ICC_REASON_*`: why it is not certified; 0 if it is
    pub reason: i32,
    /// whose chart is the reason: 1 the source's, 2 the target's; else 0
    pub reason_side: i32,
    /// with features, 1: the map is isotopic to the expected one, so it can be moved there while it stays
    /// one-to-one. After `icc_map_create()` the expected map is the one that the ties describe, or else the
    /// cuts that libicc chose. After `icc_map_retarget()` it is the previous map, carried along while every
    /// vertex of the target moves straight to its new place. 0: not so, or undecided, because rounding or the
    /// paths of the vertices leave it open
    pub class_kept: i32,
    /// mesh map: vertices
    pub n_vertices: usize,
    /// mesh map: triangles, tetrahedra in 3-D, or simplices beyond
    pub n_simplices: usize,
    /// mesh map: its distortion, the mean symmetric Dirichlet energy |J|^2 + |J^-1|^2, where J is the
    /// derivative of the map, with the target scaled to the source's area or volume. The least possible
    /// value, 2 dim, means that no length changes
    pub energy: f64,
    /// features: holes
    pub n_holes: usize,
    /// features: lines
    pub n_lines: usize,
    /// features: points
    pub n_points: usize,
    /// with features: number of ties, see `icc_map_get_tie()`
    pub n_ties: usize,
    /// length of the ties in the target, divided by that of the straight lines between their ends. The map is
    /// twisted if it is much more than 1
    pub detour: f64,
    /// with features: places with a given vertex that does not go to its partner, see `icc_map_options.slide`
    pub n_slid: usize,
}
sized!(icc_map_info);

/// What `icc_map_get_report()` reports about how a map was made. Members that do not apply to the kind are 0.
/// Seconds of the parts are 0 if the map was loaded.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_map_report {
    /// set by the caller: `sizeof(icc_map_report)`
    pub size: usize,
    /// time to make the map, including the charts; or to load it
    pub seconds: f64,
    /// mesh map: of `seconds`, the time for repair, until all simplices keep their orientation
    pub seconds_repair: f64,
    /// mesh map: of `seconds`, the time to improve the map
    pub seconds_improve: f64,
    /// of `seconds`, the time to certify a mesh map or a curve map of method field
    pub seconds_certify: f64,
    /// mesh map: `icc_map_info.energy` before the improvement
    pub energy_start: f64,
    /// mesh map: simplices that were inverted or flat at first
    pub n_inverted: usize,
    /// curve map, if a mesh map was tried first: simplices that stayed inverted; in 3-D by the best of
    /// several ways
    pub n_unrepaired: usize,
    /// mesh map: improvement steps
    pub n_iterations: usize,
    /// mesh map: refinements
    pub n_levels: i32,
    /// with features: number of tried ways to cut them apart that led to a map; 1 with ties
    pub n_trees: i32,
    /// field: evenly spread points that were mapped there and back, half of them in the target. 0 unless both
    /// charts are certified
    pub n_samples: usize,
    /// field: samples that come back more than 1e-9 of the bounding box's diagonal away, or whose derivative
    /// does not match that of the way back. 0 if certified
    pub n_lost: usize,
    /// field: samples around which volume shrinks to less than 1e-6 of its mean. At most 0.2 % if certified
    pub n_flat: usize,
    /// mesh map: simplices that become flat or reversed, on either side, when `icc_map_get_mesh()` rounds
    /// them. 0 unless a shape is about 1e9 times as far from the origin as it is large
    pub n_spoilt: usize,
}
sized!(icc_map_report);

/// What `icc_map_get_tie()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_tie_info {
    /// set by the caller: `sizeof(icc_tie_info)`
    pub size: usize,
    /// first and last vertex, as in `icc_tie`
    pub vertex: [u32; 2],
    /// number of its bends in the source: always 0, because it is an edge of a triangulation of the source's
    /// vertices
    pub n_source: usize,
    /// number of its bends in the target
    pub n_target: usize,
    /// length of the tie in the source, and in the target
    pub length: [f64; 2],
}
sized!(icc_tie_info);

/// Options of `icc_map_improve()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_improve_options {
    /// set by the caller: `sizeof(icc_improve_options)`
    pub size: usize,
    /// at most this many steps on each level; 0: as long as they pay off
    pub iterations: i32,
    /// at most this many refinements; 0: as long as they pay off; -1: none
    pub levels: i32,
    /// the last level ends when a step gains less than this share of the energy; 0: the default
    pub tolerance: f64,
}
sized!(icc_improve_options);

/// What `icc_map_improve()` has done.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_improve_report {
    /// set by the caller: `sizeof(icc_improve_report)`
    pub size: usize,
    /// `icc_map_info.energy` before
    pub energy_start: f64,
    /// `icc_map_info.energy` after; never more
    pub energy: f64,
    /// improvement steps
    pub n_iterations: usize,
    /// triangles or tetrahedra at the end
    pub n_simplices: usize,
    /// refinements
    pub n_levels: i32,
    /// 1: the progress callback stopped it early
    pub cancelled: i32,
}
sized!(icc_improve_report);

/// Options of `icc_map_retarget()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_retarget_options {
    /// set by the caller: `sizeof(icc_retarget_options)`
    pub size: usize,
    /// at most this many improvement steps; 0: as many as suit an interactive frame; -1: none
    pub iterations: i32,
}
sized!(icc_retarget_options);

/// What `icc_map_certify()` found out about the image of your mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_certificate {
    /// set by the caller: `sizeof(icc_certificate)`
    pub size: usize,
    /// 1: every simplex keeps its orientation and both boundaries are simple, so the mesh and its image are
    /// one-to-one
    pub certified: i32,
    /// 1: no part of the boundary meets itself or another part, except at common vertices in 2-D, and the
    /// mesh lies on one side of it. The same is true of the image
    pub boundary_simple: i32,
    /// simplices whose image has the opposite orientation
    pub n_inverted: usize,
    /// simplices that have no volume or whose image has none
    pub n_flat: usize,
    /// vertices that have no image
    pub n_no_image: usize,
    /// the first simplex at fault, or -1
    pub first: i64,
    /// why it is not certified, in one line of English; empty if it is certified
    pub message: [c_char; 256],
}
sized!(icc_certificate);

/// the nearest pixel's own samples, never averaged: for classes and labels
pub const ICC_INTERPOLATION_NEAREST: i32 = 1;
/// bilinear
pub const ICC_INTERPOLATION_LINEAR: i32 = 2;
/// bicubic, exact for quadratic functions; may overshoot
pub const ICC_INTERPOLATION_CUBIC: i32 = 3;

/// A picture in memory. Rows run from top to bottom, and the samples of a pixel lie side by side.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_picture {
    /// set by the caller: `sizeof(icc_picture)`
    pub size: usize,
    /// pixels in a row
    pub width: i32,
    /// rows
    pub height: i32,
    /// samples per pixel, 1..64
    pub channels: i32,
    /// bytes per sample, in the machine's order. 1 or 2: unsigned integers that use all values. 4 or 8:
    /// floats
    pub bytes: i32,
    /// 1: the last of two to four channels of 1 or 2 bytes is opacity, and the other channels are not
    /// multiplied by it. 0: no opacity
    pub alpha: i32,
    /// bytes from one row to the next
    pub stride: usize,
    /// the first row, with any alignment; a source is only read
    pub pixels: *mut c_void,
    /// source: `ICC_INTERPOLATION_*`; 0: linear
    pub interpolation: i32,
    /// source, 1: samples equal to `nodata` are missing. Not with alpha
    pub has_nodata: i32,
    /// source: the value of missing samples; may be NaN
    pub nodata: f64,
}
sized!(icc_picture);

// What a sample gets whose place has no image: `icc_map_sample()`.
/// NaN; cells with such a corner are missing
pub const ICC_OUTSIDE_NAN: i32 = 1;
/// the place stays where it is
pub const ICC_OUTSIDE_IDENTITY: i32 = 2;
/// the place moves as the nearest point of the boundary does
pub const ICC_OUTSIDE_NEAREST: i32 = 3;

/// A map that is sampled on a regular grid and read multilinearly between the samples.
///
/// Sample (i, j, k) has the place origin + i step 0 + j step 1 + k step 2. Samples are stored with the first
/// axis fastest, and the components of a sample side by side. A *cell* lies between neighbouring samples. It
/// has 4 corners in 2-D and 8 in 3-D.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_field {
    /// set by the caller: `sizeof(icc_field)`
    pub size: usize,
    /// 2 or 3
    pub dim: i32,
    /// of each value: 4 for float, 8 for double
    pub bytes: i32,
    /// 1: values are added to the place; 0: they are the image itself
    pub displacement: i32,
    /// `ICC_OUTSIDE_*`; 0: NaN. Read by `icc_map_sample()` only
    pub outside: i32,
    /// samples along each axis, at least 2
    pub shape: [usize; 3],
    /// place of the first sample
    pub origin: [f64; 3],
    /// one step along axis k is step\[dim * k\], step\[dim * k + 1\], ..; in any directions
    pub step: [f64; 9],
    /// shape\[0\] * shape\[1\] * .. * dim values with any alignment; `icc_field_certify()` only reads them
    pub values: *mut c_void,
}
sized!(icc_field);

/// What `icc_field_certify()` found about the cells of a field.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_field_report {
    /// set by the caller: `sizeof(icc_field_report)`
    pub size: usize,
    /// 1: the Jacobian determinant is proven positive in every point of every cell
    pub certified: i32,
    /// 1: the field is also proven one-to-one on its whole box. 0: this is not proven
    pub one_to_one: i32,
    /// cells of the grid
    pub n_cells: usize,
    /// cells with a point where the determinant is proven not positive
    pub n_folded: usize,
    /// cells whose sign is not known
    pub n_undecided: usize,
    /// cells with a corner that is not finite; they are not judged
    pub n_missing: usize,
    /// least determinant at a corner of a judged cell, relative to that of the grid; rounded
    pub least: f64,
    /// why it is not certified or not known to be one-to-one, in one line; or empty
    pub message: [c_char; 192],
}
sized!(icc_field_report);

// Why `icc_field_certify()` lists a cell.
/// somewhere in it the determinant is not positive
pub const ICC_CELL_FOLDED: i32 = 1;
/// its sign is not known
pub const ICC_CELL_UNDECIDED: i32 = 2;
/// a corner is not finite
pub const ICC_CELL_MISSING: i32 = 3;

extern "C" {
    /// Makes a domain from its boundary. Either orientation is accepted and remembered.
    ///
    /// *2-D*: a simple polygon, which does not touch itself. If `facets` is NULL, facet i joins the vertices
    /// i and i + 1, and the last facet leads back to vertex 0. Otherwise each facet is two vertex indices.
    /// The facets must form one closed ring through all vertices, in any order but all in the same direction.
    /// Vertices on a straight line are fine. libicc checks exactly that
    ///
    /// - no edge has length zero,
    /// - no vertex is repeated,
    /// - no edges cross, touch or run back over each other.
    ///
    /// *3-D*: a closed surface of triangles, three vertex indices each, in any order. Coplanar faces are
    /// fine. libicc checks exactly that
    ///
    /// - no face has area 0,
    /// - each edge belongs to two faces, which run along it in opposite directions,
    /// - the faces at each vertex form one cycle,
    /// - the surface does not meet itself: two faces share only their common vertices and edges.
    ///
    /// The surface may have handles, and the solid may have voids. A void is a closed surface inside the
    /// outer one that is turned the other way. libicc checks exactly that there is one outer surface, and
    /// that nothing lies in a void. Handles and voids are counted in `icc_domain_info.genus` and
    /// `icc_domain_info.n_voids`. Charts, grids, kernels and matches need a ball, without either.
    ///
    /// *4-D to 6-D*: a closed boundary of simplices, dim vertex indices each. libicc checks that
    ///
    /// - each ridge (dim - 1 vertices) belongs to two facets, which run along it in opposite directions,
    /// - the facets at each vertex are connected, and the boundary is one piece,
    /// - no facet is flat (exact in 4-D, up to rounding of 4e-13 beyond),
    /// - the volume is not 0, up to rounding.
    ///
    /// Beyond 3-D it does NOT check whether the boundary meets itself, nor its topology.
    ///
    /// *1-D*: an interval, which has two facets of one vertex each.
    ///
    /// All checks use the coordinates as given. The shape may lie anywhere and have any size, such as an
    /// offset of 1e9 or coordinates of 1e300. Internally it is shifted and scaled by exact operations. A
    /// coordinate is refused if it is not 0 and at most 2^-200 times the largest one. Except in 2-D, vertices
    /// that belong to no facet are kept but ignored.
    ///
    /// - `out` (out): the domain; owned by the caller, see `icc_domain_free()`
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `n_vertices`: at least dim + 1
    /// - `vertices`: n_vertices * dim coordinates
    /// - `n_facets`: number of facets; ignored if `facets` is NULL
    /// - `facets`: n_facets * dim vertex indices; NULL in 2-D only
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is the vertex or facet at fault. If there are two, the message names
    ///   both
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_BOUNDARY` if the shape is not valid
    /// - `ICC_ERR_TOPOLOGY` if it has several pieces, or something lies in a void
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n log n) time and O(n) memory for ordinary shapes, about 50 ns a vertex in 2-D and 1 us a
    /// triangle in 3-D.
    pub fn icc_domain_create(
        out: *mut *mut icc_domain,
        dim: i32,
        n_vertices: usize,
        vertices: *const f64,
        n_facets: usize,
        facets: *const u32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a domain of the plane with features inside: holes, lines, points and regions. You choose where a
    /// map takes them.
    ///
    /// The vertices of the domain are those of the outer ring, followed by those of the features in their
    /// order. Its facets are the edges of the outer ring, followed by the edges of the holes and then by
    /// those of the regions.
    ///
    /// *Where the domain is.* A place belongs to the domain if it lies in more of the outer ring and the
    /// regions than of the holes. So a region inside the outer ring divides the domain, a region in a hole is
    /// an island, and a region outside adds to the domain. With regions, `n_outer` may be 0. A region with
    /// holes is a region and holes.
    ///
    /// *Features may share vertices*, whose coordinates must be exactly equal: with each other, with the
    /// outer ring and with themselves. They may run along the same edges, so regions can share borders, and
    /// lines can end on the boundary. The other domain of a map must share the same vertices, and around each
    /// of them the edges must leave in the same order. libicc checks exactly, with the coordinates as given,
    /// that
    ///
    /// - edges meet only at common vertices; no vertex lies inside another edge
    /// - no line repeats a vertex at once or runs along an edge twice
    /// - each ring is a simple polygon; rings may run either way
    /// - two rings share no edge, unless one of them is a region
    /// - nothing lies outside the domain.
    ///
    /// A point with a radius is a handle with a size. The circle around it moves along and may grow or
    /// shrink, but does not turn. The domain represents the circle by a line of 16 vertices, a regular
    /// polygon that lacks one edge. These lines become further features. They follow all given features, in
    /// the order of their points. In the other domain the same points must have a radius.
    ///
    /// For `icc_domain_locate()`, points in a hole are outside. Points on a line, at a point feature or on a
    /// border between regions are inside. Only mesh maps (`ICC_MAP_MESH`) work on a domain with features.
    /// Other functions that take a domain refuse it with `ICC_ERR_UNSUPPORTED`. Without features the result
    /// is that of `icc_domain_create()`.
    ///
    /// - `out` (out): the domain; owned by the caller, see `icc_domain_free()`
    /// - `n_outer`: vertices of the outer ring, at least 3; with regions it may be 0
    /// - `outer`: 2 n_outer coordinates; NULL if n_outer is 0
    /// - `n_features`: number of features
    /// - `features`: n_features of them; they are copied
    /// - `env`: may be NULL
    /// - `err`: may be NULL. If the outer ring is at fault, `index` is its vertex or edge. Otherwise `index`
    ///   is the feature (`ICC_ITEM_FEATURE`), and the message names its vertex and any other feature
    ///   involved. Circles are numbered from n_features
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_OUTSIDE` if a feature lies outside the domain, or crosses or touches the outer ring
    ///   elsewhere than at a common vertex
    /// - `ICC_ERR_BOUNDARY` if features meet themselves or one another elsewhere than at a common vertex
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n log n) time and O(n) memory for n vertices in all.
    pub fn icc_domain_create_features(
        out: *mut *mut icc_domain,
        n_outer: usize,
        outer: *const f64,
        n_features: usize,
        features: *const icc_feature,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a solid in 3-D with features inside: voids, inner surfaces, lines and points. You choose where a
    /// map takes them.
    ///
    /// The outer surface is that of `icc_domain_create()`. It may have handles, and voids of its own. Each
    /// feature of kind `ICC_FEATURE_HOLE` or `ICC_FEATURE_REGION` is one closed surface, which may have
    /// handles and may be turned either way. A hole is a void: its inside is not part of the domain. A region
    /// divides the domain. Regions may contain voids and other regions. Voids are empty. A line is a polyline
    /// that does not close.
    ///
    /// The vertices of the domain are those of the outer surface, followed by those of the features in their
    /// order. Its facets are the triangles of the outer surface, then those of the holes, then those of the
    /// regions.
    ///
    /// libicc checks exactly, with the coordinates as given, that
    ///
    /// - every surface passes the checks of `icc_domain_create()`, and every vertex is used
    /// - features touch neither themselves, nor one another, nor the outer surface
    /// - everything lies inside the outer surface, and nothing lies in a void.
    ///
    /// For `icc_domain_locate()`, points in a void are outside. Points on an inner surface, on a line or at a
    /// point are inside. Without features the result is that of `icc_domain_create()`.
    ///
    /// - `out` (out): the domain; owned by the caller, see `icc_domain_free()`
    /// - `n_vertices`: vertices of the outer surface, at least 4
    /// - `vertices`: 3 n_vertices coordinates
    /// - `n_facets`: triangles of the outer surface, at least 4
    /// - `facets`: 3 n_facets vertex numbers
    /// - `n_features`: number of features
    /// - `features`: n_features of them; they are copied
    /// - `env`: may be NULL
    /// - `err`: may be NULL. If the outer surface is at fault, `index` is its vertex or facet. Otherwise
    ///   `index` is the feature (`ICC_ITEM_FEATURE`), and the message names its vertex or face and any other
    ///   feature involved, in their own numbers
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_OUTSIDE` if a feature lies outside the outer surface or in a void, or touches the outer
    ///   surface
    /// - `ICC_ERR_BOUNDARY` if a surface is not valid, or features meet themselves or one another
    /// - `ICC_ERR_TOPOLOGY` if the outer surface has several pieces side by side or something in its voids,
    ///   or a feature has several pieces
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n log n) time and O(n) memory for n vertices in all.
    pub fn icc_domain_create_solid(
        out: *mut *mut icc_domain,
        n_vertices: usize,
        vertices: *const f64,
        n_facets: usize,
        facets: *const u32,
        n_features: usize,
        features: *const icc_feature,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a domain from a mask of cells, such as pixels or voxels. Cell (i_0, i_1, ..) covers \[i_0, i_0 +
    /// 1\] x \[i_1, i_1 + 1\] x .. in coordinates 0, 1, 2 and so on. (`icc_grid_create_mask()` takes a mask
    /// of grid vertices instead.)
    ///
    /// The mask must be solid and without holes:
    ///
    /// - The cells form one piece, joined by faces. So does the outside.
    /// - No two cells touch only along an edge or a corner. The same holds for gaps.
    /// - The Euler characteristic is 1.
    ///
    /// In 2-D and 3-D this makes the mask a disc or a ball. In higher dimensions, holes of different
    /// dimensions may cancel out and pass; then `icc_tree_grow()` fails on the grid of the mask.
    ///
    /// Each cell is cut in two along each axis. Each boundary face of the pieces is cut into (dim - 1)!
    /// simplices, as in Kuhn's triangulation. The grid that `icc_grid_create()` makes is cut in the same way.
    /// `icc_domain_get_boundary()` returns these facets and their vertices. The vertices are sorted with the
    /// first axis fastest, except that a 2-D domain is a counter-clockwise polygon. The target of a map from
    /// a mask is a domain with the same facets and moved vertices.
    ///
    /// - `out` (out): the domain; owned by the caller
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `shape`: cells along each axis, dim numbers
    /// - `cells`: one byte per cell, the first axis fastest: 0 is outside, anything else inside
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a cell at fault
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_TOPOLOGY` if the mask is not as described
    /// - `ICC_ERR_RESOLUTION` if its grid would have more than 2^28 vertices, or too many facets
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: at most O(cells * 4^dim) time, 0.15 us a cell in 3-D, in addition to `icc_domain_create()`.
    pub fn icc_domain_create_mask(
        out: *mut *mut icc_domain,
        dim: i32,
        shape: *const usize,
        cells: *const u8,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a domain from a conforming mesh of its inside: triangles in 2-D, tetrahedra in 3-D, simplices
    /// beyond. On such a domain `ICC_METHOD_FOLIATION` works in every dimension. Everything else works as on
    /// a domain made from its boundary alone.
    ///
    /// The vertices of the domain are the boundary vertices of the mesh, in the order of the mesh. Two
    /// domains correspond, as `icc_map_create()` requires, if they have the same number of boundary vertices
    /// and the same facets. Their meshes may differ inside.
    ///
    /// You may pass the facets yourself, for example in the order of the surface that was meshed. Otherwise
    /// libicc sorts them by their vertices, the smallest index first, and orients them as seen from outside.
    ///
    /// libicc checks the following, exactly up to 3-D and up to rounding beyond:
    ///
    /// - The boundary passes the checks of `icc_domain_create()`.
    /// - Every simplex has a volume.
    /// - A facet belongs to at most two simplices, which lie on opposite sides of it.
    /// - The mesh is connected. In 2-D and beyond 3-D its Euler characteristic is 1. In 3-D it may have
    ///   handles and voids, as for `icc_domain_create()`.
    ///
    /// So the simplices fill the domain and do not overlap. Vertices that belong to no simplex are ignored.
    ///
    /// *Regions.* If `icc_mesh.regions` gives the cells different numbers, the facets between cells of
    /// different numbers become features of kind `ICC_FEATURE_REGION`, and a map keeps them. Each connected
    /// part of a number but the outermost one is the inside of a region. The regions come in the order of
    /// their numbers. `icc_domain_get_regions()` then has the numbers of the features, and
    /// `icc_domain_get_mesh()` has the cells in your order. The surfaces must be closed and touch neither one
    /// another nor the boundary.
    ///
    /// - `out` (out): the domain; owned by the caller
    /// - `mesh`: the mesh, of dimension 2..`ICC_MAX_DIM`
    /// - `n_facets`: number of facets of the boundary; ignored if `facets` is NULL
    /// - `facets`: n_facets * dim vertex indices of the mesh's boundary, all seen from the same side; or NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is the simplex, vertex or given facet at fault. If the boundary is
    ///   refused, vertices and facets are those of the domain
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_BOUNDARY` if a simplex is flat or lists a vertex twice or one that does not exist; if three
    ///   simplices share a facet, or two lie on one side of it; if `facets` are not the boundary; or if a
    ///   surface between regions touches another one or the boundary
    /// - `ICC_ERR_TOPOLOGY` if the mesh has several pieces, or holes other than in 3-D
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n) time and memory in addition to `icc_domain_create()`, 0.5 us a tetrahedron.
    pub fn icc_domain_create_mesh(
        out: *mut *mut icc_domain,
        mesh: *const icc_mesh,
        n_facets: usize,
        facets: *const u32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Fills a domain in 3-D with tetrahedra, which leave out its voids. The result is a domain with a mesh,
    /// as `icc_domain_create_mesh()` makes it. Its vertices and facets are those of the surface, bit for bit.
    /// New vertices are added inside only. Vertices that belong to no facet are left out.
    ///
    /// The mesh keeps what `icc_domain_create_solid()` put inside. Points are vertices, inner surfaces
    /// consist of faces, and lines of edges, with new vertices on the lines where they need some.
    /// `icc_domain_get_regions()` tells the part of each tetrahedron.
    ///
    /// Every decision about the mesh is exact, and the result passes the checks of
    /// `icc_domain_create_mesh()`. It has the same bits on every machine. There is no guarantee that every
    /// surface can be filled. There is none for angles either: tetrahedra next to the surface may be very
    /// flat. docs/theory/solid-maps.md says what is tried.
    ///
    /// - `out` (out): the filled domain, owned by the caller
    /// - `surface`: a domain in 3-D without a mesh
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_UNSUPPORTED` if `surface` is not in 3-D or has a mesh
    /// - `ICC_ERR_RESOLUTION` if a facet cannot be told apart from its surroundings; `icc_error.index` names
    ///   it
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: about 10 us and 200 bytes per tetrahedron; several times as long if filling fails.
    pub fn icc_domain_fill(
        out: *mut *mut icc_domain,
        surface: *const icc_domain,
        options: *const icc_fill_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Repairs a mask in which cells, or gaps, touch only along an edge or a corner.
    /// `icc_domain_create_mask()` refuses such masks. The function fills cells one at a time, each time the
    /// one that leaves the fewest such contacts around it. Contacts that filling cannot remove stay, and so
    /// does every other defect.
    ///
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `shape`: cells along each axis
    /// - `cells` (in and out): as for `icc_domain_create_mask()`; filled cells become 1
    /// - `n_filled` (out): number of filled cells, or NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`; on `ICC_ERR_RESOLUTION`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    /// the cells are unchanged
    pub fn icc_mask_repair(
        dim: i32,
        shape: *const usize,
        cells: *mut u8,
        n_filled: *mut usize,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a domain.
    pub fn icc_domain_free(domain: *mut icc_domain);

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_domain_get_info(domain: *const icc_domain, info: *mut icc_domain_info) -> icc_status;

    /// Reports a feature of a domain. Its coordinates are among those that `icc_domain_get_boundary()`
    /// copies.
    ///
    /// - `domain`: the domain
    /// - `feature`: its number, less than `icc_domain_info.n_features`
    /// - `info` (in and out): set its `size`; the rest is filled in
    ///
    /// Returns `ICC_OK` or `ICC_ERR_ARGUMENT`
    pub fn icc_domain_get_feature(
        domain: *const icc_domain,
        feature: usize,
        info: *mut icc_feature_info,
    ) -> icc_status;

    /// Copies the region of each cell of the mesh, for a solid that `icc_domain_fill()` filled, or a mesh
    /// that came with `icc_mesh.regions`. Regions are numbered like the features of kind
    /// `ICC_FEATURE_REGION`, starting at 1. Cells of region k lie within the k-th such surface, but not
    /// within a region inside it. Cells within no such surface have number 0. The files that the command
    /// `libicc` writes count from 1 instead, as libicc-files(5) explains.
    ///
    /// - `domain`: a domain with a mesh: `icc_domain_info.n_mesh_simplices` is not 0
    /// - `regions` (out): room for n_mesh_simplices numbers
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if `domain` or `regions` is NULL
    /// - `ICC_ERR_UNSUPPORTED` if the domain has no mesh
    pub fn icc_domain_get_regions(domain: *const icc_domain, regions: *mut u32) -> icc_status;

    /// Copies the boundary as it was given. If the domain has features, the vertices include those of all
    /// features, and the facets include those of the holes and regions. With regions, some facets may lie
    /// inside the domain.
    ///
    /// - `domain`: the domain
    /// - `vertices` (out): room for n_vertices * dim doubles, or NULL
    /// - `facets` (out): room for n_facets * dim indices, or NULL
    pub fn icc_domain_get_boundary(
        domain: *const icc_domain,
        vertices: *mut f64,
        facets: *mut u32,
    ) -> icc_status;

    /// Copies the mesh of the inside, if the domain comes from `icc_domain_create_mesh()` or
    /// `icc_domain_fill()`. Boundary vertices come first, in the order of `icc_domain_get_boundary()`; inner
    /// vertices follow. Each cell has a positive determinant.
    ///
    /// - `domain`: a domain with a mesh: `icc_domain_info.n_mesh_vertices` is not 0
    /// - `mesh` (in and out): the arrays that you provide are filled; then the dimension and the counts are
    ///   set
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if `domain` or `mesh` is NULL, or the arrays are too small
    /// - `ICC_ERR_UNSUPPORTED` if the domain has no mesh
    pub fn icc_domain_get_mesh(domain: *const icc_domain, mesh: *mut icc_mesh) -> icc_status;

    /// Reports where points lie, and the nearest point of the boundary to each.
    ///
    /// Up to 3-D the answer is exact, up to the tolerance of `ICC_BOUNDARY`. Beyond 3-D, points within about
    /// 1e-13 of the bounding box's longest side from the boundary may be misplaced. If a boundary beyond 3-D
    /// meets itself, a point is inside if an odd number of layers separates it from infinity.
    ///
    /// - `domain`: the domain
    /// - `n`: number of points
    /// - `points`: n * dim coordinates; a point that is not finite is outside
    /// - `where` (out): n values `ICC_INSIDE`, `ICC_BOUNDARY` or `ICC_OUTSIDE`
    /// - `facet` (out): n indices of the nearest facet, or NULL
    /// - `bary` (out): n * dim barycentric coordinates of the nearest point on that facet, or NULL
    /// - `env`: may be NULL
    ///
    /// Cost: O(log n) a point for ordinary shapes; in 3-D with 27,000 faces 1 us, or 5 to 10 us with the
    /// nearest facet.
    pub fn icc_domain_locate(
        domain: *const icc_domain,
        n: usize,
        points: *const f64,
        place: *mut i32,
        facet: *mut u32,
        bary: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// Lists the defects that keep a closed polygon from being the boundary of a domain. They are sorted by
    /// a, then by b. Vertices that are not finite are listed and otherwise ignored.
    ///
    /// - `n_vertices`: vertices of the ring
    /// - `vertices`: n_vertices * 2 coordinates; facet i joins vertices i and i + 1
    /// - `capacity`: number of defects that the two arrays have room for
    /// - `kinds` (out): `capacity` kinds, `ICC_DEFECT_*`
    /// - `items` (out): `capacity` pairs (a, b), see `ICC_DEFECT_*`
    /// - `n_defects` (out): number of defects, which may exceed `capacity`. The search ends at 10,000 + 4
    ///   n_vertices defects
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Cost: O((n + k) log n) for k pairs of facets whose boxes overlap.
    pub fn icc_boundary_defects(
        n_vertices: usize,
        vertices: *const f64,
        capacity: usize,
        kinds: *mut i32,
        items: *mut u32,
        n_defects: *mut usize,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a chart: coordinates of the inside of a domain.
    ///
    /// - `out` (out): the chart; owned by the caller, see `icc_chart_free()`. It keeps the domain alive
    /// - `domain`: the domain
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_RESOLUTION` if no grid vertex lies inside the domain, or the grid would have more than 2^28
    ///   vertices
    /// - `ICC_ERR_OUTSIDE` if `maximum` is outside
    /// - `ICC_ERR_CERTIFICATE` if the chart could not be proved one-to-one; `err` has the reason
    /// - `ICC_ERR_TOPOLOGY` if the domain's mesh has no order for method foliation
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_UNSUPPORTED`, `ICC_ERR_VERSION` or
    ///   `ICC_ERR_CANCELLED`
    ///
    /// Cost with n boundary vertices and N cells along the longest side:
    ///
    /// - gradient and field in 2-D: O(N^2 + n N) time and memory, about 1 ms at N = 50
    /// - gradient and field beyond 2-D: O(N^dim), in 3-D at N = 64 some tenths of a second
    /// - foliation and disc in 2-D: a sparse factorisation of at most 2 n + 4 N^2 vertices, about 1 ms at N =
    ///   50
    /// - foliation on a domain's mesh in 3-D: about 10 us a tetrahedron
    pub fn icc_chart_create(
        out: *mut *mut icc_chart,
        domain: *const icc_domain,
        options: *const icc_chart_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a chart of method gradient from a function. The function, its tree and its grid may be the
    /// library's or your own: icc/stages.h.
    ///
    /// `icc_chart_create()` makes the same chart, bit for bit, from the same stages: `icc_grid_create()`,
    /// `icc_grid_find_maximum()` or `icc_grid_find_nearest()`, `icc_tree_create()` and
    /// `icc_function_create()`. For bilaplace and clamped it also moves the root, see
    /// `icc_function_create()`.
    ///
    /// The chart has a copy of the function. Beyond 2-D this copy has values at more vertices outside. Where
    /// the tree does not reach, points have no coordinates.
    ///
    /// - `out` (out): the chart; owned by the caller, see `icc_chart_free()`. It keeps the domain alive that
    ///   the grid was made from
    /// - `function`: the function; you may free it
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a vertex beside the root that is higher
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_UNSUPPORTED` if the grid was not made from a domain: it comes from a mask of vertices or
    ///   from `icc_grid_refine()`
    /// - `ICC_ERR_ARGUMENT` if a neighbour of the root is higher than the root, so that no curve ends there
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED` or `ICC_ERR_VERSION`
    ///
    /// Cost: O(vertices) time; 8 to 20 bytes a vertex for the copy, and the boundary's cells.
    pub fn icc_chart_create_function(
        out: *mut *mut icc_chart,
        function: *const icc_function,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a chart.
    pub fn icc_chart_free(chart: *mut icc_chart);

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_chart_get_info(chart: *const icc_chart, info: *mut icc_chart_info) -> icc_status;

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, or
    /// `ICC_ERR_UNSUPPORTED` if the chart is not of method gradient.
    pub fn icc_chart_get_gradient_info(chart: *const icc_chart, info: *mut icc_gradient_info) -> icc_status;

    /// Like `icc_chart_get_gradient_info()`, for method field.
    pub fn icc_chart_get_field_info(chart: *const icc_chart, info: *mut icc_field_info) -> icc_status;

    /// Like `icc_chart_get_gradient_info()`, for method foliation in 2-D unless the domain brings a mesh.
    pub fn icc_chart_get_foliation_info(chart: *const icc_chart, info: *mut icc_foliation_info)
        -> icc_status;

    /// Like `icc_chart_get_gradient_info()`, for method foliation on a domain's own mesh.
    pub fn icc_chart_get_shelling_info(chart: *const icc_chart, info: *mut icc_shelling_info) -> icc_status;

    /// Like `icc_chart_get_gradient_info()`, for method disc.
    pub fn icc_chart_get_disc_info(chart: *const icc_chart, info: *mut icc_disc_info) -> icc_status;

    /// Fills in `timings`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_chart_get_timings(chart: *const icc_chart, timings: *mut icc_chart_timings) -> icc_status;

    /// The domain that the chart was made on; borrowed.
    pub fn icc_chart_domain(chart: *const icc_chart) -> *const icc_domain;

    /// Estimates which part of the domain the coordinates miss. Deterministic.
    ///
    /// - `chart`: the chart
    /// - `n_points`: number of points inside, and as many on the boundary; 0: 4096
    /// - `measures` (out): its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    pub fn icc_chart_get_report(
        chart: *const icc_chart,
        n_points: usize,
        measures: *mut icc_chart_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Computes the coordinates of points in a chart. Returns `ICC_OK` even if every point failed: check
    /// `status` or `n_failed`.
    ///
    /// A point on the boundary has t = 0. The maximum has t = 1, facet 0 and the facet's midpoint. A point
    /// without coordinates gets NaN in `bary` and `t`, UINT32_MAX in `facet` and its own status. Other points
    /// are not affected.
    ///
    /// - `chart`: the chart
    /// - `n`: number of points
    /// - `points`: n * dim coordinates
    /// - `facet` (out): n indices of the boundary facet where the curve starts
    /// - `bary` (out): n * dim barycentric coordinates on that facet: not negative, with sum 1
    /// - `t` (out): n shares of the curve's arc length from the boundary, in \[0,1\]
    /// - `status` (out): n statuses, or NULL. `ICC_OK`; `ICC_ERR_OUTSIDE`; `ICC_ERR_TRACE` if the curve does
    ///   not reach both the boundary and the maximum; `ICC_ERR_ARGUMENT` if the point is not finite
    /// - `n_failed` (out): number of points without coordinates, or NULL
    /// - `env`: may be NULL
    ///
    /// Returns `ICC_OK` if the call has run, however many points failed, or
    ///
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`; the outputs are then
    ///   undefined
    ///
    /// Cost: some microseconds a point for charts; for the first call in each direction on a plane mesh, also
    /// time and memory proportional to the mesh. That memory comes from the object's own `icc_env.alloc`,
    /// whatever `env` is. If there is none the call fails, and the next call tries again.
    pub fn icc_chart_encode(
        chart: *const icc_chart,
        n: usize,
        points: *const f64,
        facet: *mut u32,
        bary: *mut f64,
        t: *mut f64,
        status: *mut icc_status,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Computes the points that have given coordinates. This is the inverse of `icc_chart_encode()`, and like
    /// it returns `ICC_OK` even if every point failed.
    ///
    /// - `chart`: the chart
    /// - `n`: number of points
    /// - `facet`: n facet indices
    /// - `bary`: n * dim barycentric coordinates: not negative, with sum 1 up to 1e-9
    /// - `t`: n shares in \[0,1\]; 0 is the boundary point, 1 the maximum
    /// - `points` (out): n * dim coordinates; NaN if there is no point
    /// - `status` (out): n statuses, or NULL. `ICC_OK`; `ICC_ERR_TRACE` if the curve does not reach the
    ///   maximum or has left the domain there; `ICC_ERR_ARGUMENT`
    /// - `n_failed` (out): number of coordinates without a point, or NULL
    /// - `env`: may be NULL
    ///
    /// Returns as `icc_chart_encode()`
    pub fn icc_chart_decode(
        chart: *const icc_chart,
        n: usize,
        facet: *const u32,
        bary: *const f64,
        t: *const f64,
        points: *mut f64,
        status: *mut icc_status,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Computes coordinates like `icc_chart_encode()`, and tells for each point whether `icc_chart_decode()`
    /// brings it back.
    ///
    /// A point comes back if it is decoded to within 1e-6 of the longest side of the domain's bounding box.
    /// Every point is decoded to find out. Charts of method gradient lose many points: some percent in 2-D,
    /// and up to half of them beyond.
    ///
    /// - `chart`: the chart
    /// - `n`: number of points
    /// - `points`: n * dim coordinates
    /// - `facet` (out): as for `icc_chart_encode()`, like `bary` and `t`
    /// - `bary` (out): n * dim numbers
    /// - `t` (out): n numbers
    /// - `status` (out): n statuses, or NULL
    /// - `flags` (out): n sums of `ICC_LOSS_*`, or NULL; 0 for points without coordinates
    /// - `n_failed` (out): number of points without coordinates, or NULL
    /// - `env`: may be NULL
    ///
    /// Returns as `icc_chart_encode()`
    ///
    /// Cost: about twice that of `icc_chart_encode()`, and three times for points that do not come back.
    pub fn icc_chart_encode_flags(
        chart: *const icc_chart,
        n: usize,
        points: *const f64,
        facet: *mut u32,
        bary: *mut f64,
        t: *mut f64,
        status: *mut icc_status,
        flags: *mut i32,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Computes points like `icc_chart_decode()`, and tells for each whether `icc_chart_encode()` returns its
    /// coordinates.
    ///
    /// Coordinates come back if the boundary point does to within 1e-6 of the longest side of the domain's
    /// bounding box, and t to within 1e-6. With t = 1 every boundary point is as good.
    ///
    /// - `chart`: the chart
    /// - `n`: number of points
    /// - `facet`: as for `icc_chart_decode()`, like `bary` and `t`
    /// - `bary`: n * dim numbers
    /// - `t`: n numbers
    /// - `points` (out): n * dim coordinates; NaN if there is no point
    /// - `status` (out): n statuses, or NULL
    /// - `flags` (out): n sums of `ICC_LOSS_*`, or NULL; 0 for coordinates without a point
    /// - `n_failed` (out): number of coordinates without a point, or NULL
    /// - `env`: may be NULL
    ///
    /// Returns as `icc_chart_decode()`
    ///
    /// Cost: about twice that of `icc_chart_decode()`, and four times for coordinates that do not come back.
    pub fn icc_chart_decode_flags(
        chart: *const icc_chart,
        n: usize,
        facet: *const u32,
        bary: *const f64,
        t: *const f64,
        points: *mut f64,
        status: *mut icc_status,
        flags: *mut i32,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Computes the whole curve through a point, from the boundary to the maximum, as a polyline.
    ///
    /// - `chart`: the chart
    /// - `point`: dim coordinates
    /// - `capacity`: number of points that `curve` has room for
    /// - `curve` (out): capacity * dim coordinates; may be NULL if capacity is 0
    /// - `n_curve` (out): number of points of the curve, which may exceed `capacity`
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_OUTSIDE`, `ICC_ERR_TRACE`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or
    /// `ICC_ERR_VERSION`
    pub fn icc_chart_trace(
        chart: *const icc_chart,
        point: *const f64,
        capacity: usize,
        curve: *mut f64,
        n_curve: *mut usize,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Writes a chart and its domain to memory, for other processes and machines. Call it twice: with
    /// capacity 0 for the number of bytes, then with a buffer of that size. The format
    /// (docs/reference/formats.md) is versioned, the same on every machine, and has a checksum.
    ///
    /// - `chart`: the chart
    /// - `capacity`: number of bytes that `data` has room for
    /// - `data` (out): NULL if capacity is 0
    /// - `n_bytes` (out): number of bytes needed. If it exceeds `capacity`, nothing useful is written
    ///
    /// Returns `ICC_OK` or `ICC_ERR_ARGUMENT`
    pub fn icc_chart_save(
        chart: *const icc_chart,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a chart back. It gives the same results as the saved one, bit for bit, for any number of
    /// threads. Its info is the same.
    ///
    /// Charts on a mesh (foliation, disc) are stored in full and certified anew, so bytes that do not pass
    /// are refused wherever they come from. Charts on a grid (gradient, field) are rebuilt from their inputs
    /// and compared with a checksum of the original's numbers. The inputs of a chart from a function are
    /// those of its stages, with your own parents and values. Any bytes are safe to pass.
    ///
    /// - `out` (out): the chart; owned by the caller
    /// - `n_bytes`: number of bytes of `data`
    /// - `data`: any bytes
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_FORMAT` for bytes that `icc_chart_save()` did not write, or that need more than
    ///   `icc_env.load_limit` allows
    /// - `ICC_ERR_VERSION` for bytes that a later version wrote, and for a chart on a grid that gives other
    ///   values here than where it was saved
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED` or `ICC_ERR_ARGUMENT`
    ///
    /// Cost: O(n log n) time and O(n) memory in the number of bytes for charts on a mesh; for charts on a
    /// grid, that of `icc_chart_create()` with the stored options.
    pub fn icc_chart_load(
        out: *mut *mut icc_chart,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Pairs the boundaries of two domains that do not correspond, and gives them common vertices. The two
    /// new domains have the given shapes and are ready for `icc_map_create()`. The given ones may differ in
    /// number of vertices, in first vertex and in direction.
    ///
    /// *Outlines.* Without landmarks libicc compares all starting points by how the outlines turn at several
    /// scales. It then tries rotations and follows the best pairing. This is a heuristic. It guarantees that
    /// the pairing is monotone and passes through all landmarks, but not that it is the one you mean.
    ///
    /// Every vertex of the two domains is in the result, bit for bit and in its order. The vertices that one
    /// outline lacks are added on its edges, rounded. The result begins with the source's vertex 0 and runs
    /// in the source's direction. It passes the checks of `icc_domain_create()`. If two outlines have the
    /// same number of vertices, and vertex i clearly belongs to vertex i + k for some k, they are paired
    /// vertex by vertex (not by arc length). So the result of a match passes through another match unchanged.
    ///
    /// *Several outlines.* A domain may have several parts: regions beside one another, or an island in a
    /// hole. Both domains must have as many. Parts are paired by their places in the bounding box of the
    /// whole, by the roots of their shares of the area, and by twice their numbers of holes, at the least sum
    /// of squares. Then outlines are paired part by part. A part whose shape is ambiguous, such as the round
    /// dot of an i, is placed by the affine map that fits the other outlines and its own centre best. So is
    /// any other part that then fits clearly better. The whole should lie upright in both domains, or
    /// landmarks should tell which parts belong together.
    ///
    /// *Features.* Each hole, line and point is paired with one of its kind in the partner of its part. The
    /// pairing of the outline around it predicts where it should lie in the target, by mean value
    /// coordinates. The assignment minimises the sum of squared distances to these places. Holes, closed
    /// lines and regions inside others are then paired along themselves from where they lie nearest, lines
    /// from end to end. The result has the source's features, in its order and directions, and their partners
    /// in the target. Features that meet one another or the outer ring are refused.
    ///
    /// *Surfaces.* In space the two surfaces get common triangles. Both are drawn on the sphere, one-to-one,
    /// and cut by one another there. Both are then simplified together up to `icc_match_options.tolerance`,
    /// except where a surface would meet itself. Exact signs prove that the drawings are one-to-one and are
    /// cut into the same pieces, before positions are rounded. libicc checks on each result that neither
    /// surface meets itself, and measures `icc_match_info.off`.
    ///
    /// It does not guarantee that similar parts are paired. Without landmarks this works for surfaces that
    /// are nearly the same up to a motion, or that bend moderately. It does not work for bodies with limbs in
    /// other poses, as `icc_match_info.energy` shows. With landmarks, each at a vertex, the parts between the
    /// same landmarks are paired. Landmarks become common vertices, wherever they lie. Vertices that remain
    /// keep their bits. Facets are listed as seen from outside.
    ///
    /// *`icc_match_options.keep_source`.* In space, the source's surface then stays as it is. Common vertices
    /// begin with those of the source that have facets, in their order. Others are added on its edges and
    /// inside its facets, rounded. No common facet is part of two facets of the source. The target is as
    /// close as without this option. Thin triangles of the source stay thin.
    ///
    /// - `out` (out): the match; owned by the caller, see `icc_match_free()`
    /// - `source`: a domain of the plane, possibly with features, or a surface in space without a mesh
    /// - `target`: likewise, of the same dimension. It has as many parts, holes, regions inside others,
    ///   lines, closed lines, points, and points with a radius
    /// - `n_landmarks`: number of pairs of points that are known, at most 1000; in space 128
    /// - `landmarks`: n_landmarks * 2 dim coordinates: a point of the source, followed by its partner in the
    ///   target. Or NULL if there are none. In the plane a point on the boundary is taken as it is. Any other
    ///   point stands for the nearest vertex within 0.5 % of the shape's diameter, or else for the nearest
    ///   boundary point. Here the boundary includes point features, holes and lines, so such a landmark also
    ///   says which features belong together. In space a point stands for the nearest vertex
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is the landmark at fault, or as stated below
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_AMBIGUOUS` if another pairing is nearly as good: give a landmark, or ask for arc length.
    ///   Also if two features or parts could change places: `index` is one of the source's, and a landmark on
    ///   it decides
    /// - `ICC_ERR_ARGUMENT` if a landmark is more than 2 % of the diameter off an outline, coincides with
    ///   another one, comes in a different order on the two outlines, or pairs features of different kinds
    /// - `ICC_ERR_UNSUPPORTED` for another dimension, a domain with a mesh, or features that meet
    /// - `ICC_ERR_BOUNDARY` if the numbers of parts or features differ; or if common vertices cannot be told
    ///   apart in doubles, where `index` is one of them
    /// - `ICC_ERR_RESOLUTION` if the triangles of a surface differ too much in size to be drawn on the sphere
    ///   in doubles. Also if landmarks differ so much in position that paths between them take too many
    ///   vertices
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: in 2-D some tenths of a second for each part, and parts are paired in parallel. Plus O(m^3) at
    /// worst for m features of a kind. In space about 1 s for 4,700 vertices. Deterministic. The map between
    /// the two new domains takes longer to make than one between outlines that correspond.
    pub fn icc_match_create(
        out: *mut *mut icc_match,
        source: *const icc_domain,
        target: *const icc_domain,
        n_landmarks: usize,
        landmarks: *const f64,
        options: *const icc_match_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a match.
    pub fn icc_match_free(r#match: *mut icc_match);

    /// The source with the common vertices; borrowed.
    pub fn icc_match_source(r#match: *const icc_match) -> *const icc_domain;

    /// The target with the common vertices; borrowed.
    pub fn icc_match_target(r#match: *const icc_match) -> *const icc_domain;

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_match_get_info(r#match: *const icc_match, info: *mut icc_match_info) -> icc_status;

    /// Reports where the common vertices come from.
    ///
    /// - `match`: the match
    /// - `source` (out): for each common vertex (`icc_match_info.n_vertices`) its number in the given source,
    ///   or UINT32_MAX if it was added; or NULL
    /// - `target` (out): likewise for the given target
    ///
    /// Returns `ICC_OK` or `ICC_ERR_ARGUMENT`
    pub fn icc_match_get_origins(r#match: *const icc_match, source: *mut u32, target: *mut u32)
        -> icc_status;

    /// Takes points of the source's boundary to the target's boundary.
    ///
    /// A point first moves to the nearest place on the boundary of `icc_match_source()`: on the outer ring, a
    /// hole, a line or a point; in space on the surface. From there it goes to the same place of
    /// `icc_match_target()`. All common vertices go to their partners bit for bit, including those of lines,
    /// points and landmarks. Between them each edge or facet is mapped one-to-one. Points of a given surface
    /// are at most `icc_match_info.off` away from the common one.
    ///
    /// To transfer data that is known at the corners of the given facets, such as texture coordinates, call
    /// `icc_domain_locate()` on the given domain. For each vertex of `icc_match_source()`, or any other
    /// point, it returns the facet and the weights of its corners.
    ///
    /// - `match`: the match
    /// - `n`: number of points
    /// - `points`: n * dim coordinates
    /// - `images` (out): n * dim coordinates; NaN for a point that is not finite. May be the same array as
    ///   `points`
    /// - `off` (out): distance of each point from that nearest place; NaN for a point that is not finite. May
    ///   be NULL
    /// - `env`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: that of `icc_domain_locate()` with the nearest facet.
    pub fn icc_match_apply(
        r#match: *const icc_match,
        n: usize,
        points: *const f64,
        images: *mut f64,
        off: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// Takes points of the target's boundary to the source's; otherwise like `icc_match_apply()`.
    pub fn icc_match_apply_inverse(
        r#match: *const icc_match,
        n: usize,
        points: *const f64,
        images: *mut f64,
        off: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// Writes a match and both its domains to memory, as `icc_chart_save()` does a chart.
    pub fn icc_match_save(
        r#match: *const icc_match,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a match back, as `icc_chart_load()` does a chart. Its domains are checked as they were when they
    /// were made, and must correspond. The contents of `icc_match_info` and `icc_match_get_origins()` come
    /// from the bytes.
    pub fn icc_match_load(
        out: *mut *mut icc_match,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes the map between two domains whose boundaries correspond. Facet i goes to facet i, with the same
    /// barycentric coordinates.
    ///
    /// If the boundary moves by an affine map, up to rounding, a mesh map moves the inside by the same affine
    /// map, up to rounding. Vertices still go exactly to their partners. This does not hold with `iterations`
    /// -1, or with features whose ties ask for another isotopy class.
    ///
    /// Both charts are built together, and their maxima are paired.
    ///
    /// In 3-D, a source without a mesh is filled by `icc_domain_fill()` without options, unless the method is
    /// gradient or field. Method field needs no mesh. A target without a mesh is filled for a chart. A mesh
    /// map is found for most pairs in 3-D, but not for all. docs/theory/solid-maps.md says what is tried. For
    /// 4-D to 6-D docs/theory/higher-maps.md does.
    ///
    /// - `out` (out): the map; owned by the caller, see `icc_map_free()`
    /// - `source`: the domain before
    /// - `target`: the domain after. It has the same dimension, number of vertices and facets, and features
    ///   of the same kinds with as many vertices. In 2-D its rings, including the holes, have the same
    ///   orientation
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `side` is 1 for the source, 2 for the target
    ///
    /// Returns as `icc_chart_create()`, or
    ///
    /// - `ICC_ERR_BOUNDARY` if the domains do not correspond
    /// - `ICC_ERR_RESOLUTION` if a surface cannot be filled; `err` names the side and the facet
    /// - `ICC_ERR_CERTIFICATE` if the options ask for a mesh map and none was found
    ///
    /// Cost of a mesh map: two charts and a limited amount of improvement; in 2-D 4 ms for a few dozen
    /// vertices, 0.3 s for 15,000. If the limit ended the improvement, `icc_map_improve()` continues it.
    /// Deterministic: work is counted, and no clock is read.
    pub fn icc_map_create(
        out: *mut *mut icc_map,
        source: *const icc_domain,
        target: *const icc_domain,
        options: *const icc_map_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes the map between two polygons whose vertices correspond. It calls `icc_domain_create()` for both,
    /// then `icc_map_create()` without options.
    ///
    /// - `out` (out): the map; owned by the caller, see `icc_map_free()`
    /// - `n`: number of vertices of each polygon, at least 3
    /// - `before`: 2 n coordinates x, y
    /// - `after`: 2 n coordinates x, y, in the same direction
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `side` is 1 for `before` and 2 for `after`; `index` is the vertex at fault
    ///
    /// Returns as `icc_domain_create()` and `icc_map_create()`
    ///
    /// Cost: that of these calls.
    pub fn icc_map_create_polygons(
        out: *mut *mut icc_map,
        n: usize,
        before: *const f64,
        after: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a map from two charts of the same method. Their domains must correspond as `icc_map_create()`
    /// requires. A mesh map uses the source chart's mesh. Of the options only `kind` and `iterations` are
    /// used. The map keeps the charts alive.
    pub fn icc_map_create_from_charts(
        out: *mut *mut icc_map,
        source: *const icc_chart,
        target: *const icc_chart,
        options: *const icc_map_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a map of lower distortion from a mesh map. The given map does not change.
    ///
    /// The energy never rises, and every intermediate map is certified. So you may stop early: if the
    /// progress callback asks to stop, the call succeeds with the map reached by then. The report says so.
    ///
    /// Steps and refinements end when they do not pay off. If all options are 0, the work and the number of
    /// triangles are also limited in proportion to the given map; another call continues from there. If any
    /// option is set, neither is limited.
    ///
    /// In 3-D a refinement cuts edges in the middle, and replaces tetrahedra by others that fill the same
    /// space, before and after. So the map's mesh (`icc_map_get_mesh()`) is no longer the source's own mesh.
    /// Its surface stays as it is, and every tetrahedron is exactly positive before and after. Beyond 3-D
    /// there are no refinements.
    ///
    /// - `out` (out): the map; owned by the caller
    /// - `map`: a mesh map, else `ICC_ERR_UNSUPPORTED`
    /// - `options`: may be NULL
    /// - `report` (out): may be NULL; its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns as `icc_map_create()`
    ///
    /// Cost: about 1 us for each step and triangle, 1.5 us for each step and tetrahedron.
    pub fn icc_map_improve(
        out: *mut *mut icc_map,
        map: *const icc_map,
        options: *const icc_improve_options,
        report: *mut icc_improve_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes the map to a target that has moved. Use it to drag an outline or a surface, where each frame
    /// continues from the one before. The source stays. The new map starts from the mesh and the images of
    /// `map`, moves them along and improves them by a few steps. Without features it keeps the mesh. Frames
    /// with the same mesh and allocator share data about it.
    ///
    /// Without features, any target in the plane is reached, however far away. The mesh may change on the
    /// way.
    ///
    /// Features move straight to their new places. On the way they pass one another on the same sides as
    /// before (`icc_map_info.class_kept`). Vertices that have slid (`icc_map_options.slide`) keep the edge
    /// and the share of it to which they go. The mesh changes as needed, and the first frame may refine it,
    /// also if `iterations` is -1. If features would meet on the way, the call fails with
    /// `ICC_ERR_CERTIFICATE`; take another way, in several calls. If the target has a very different size or
    /// is far away, the features first move along with the whole shape.
    ///
    /// A *face* is a part of the domain between lines. With `iterations` 0 or -1, a face changes only if a
    /// vertex on its boundary has a new place. Everything else keeps its places exactly. All faces change if
    /// the way is blocked, because the map is then made anew. They also change if the target's box shrinks or
    /// grows so far that libicc scales its coordinates anew.
    ///
    /// In 3-D, tetrahedra that block the way are replaced or cut. As a last resort the map is made anew by
    /// `icc_map_create()`, which fills a target without a mesh; `icc_env.log` then says so. There is no
    /// guarantee that a target is reached, but every map that is returned is certified. Beyond 3-D inner
    /// vertices are moved, or the map is made anew.
    ///
    /// - `out` (out): the map; owned by the caller. It has no charts: `icc_map_source_chart()` returns NULL
    /// - `map`: a mesh map, else `ICC_ERR_UNSUPPORTED`. It does not change
    /// - `target`: the new target, which must correspond as `icc_map_create()` requires. In 3-D it may be a
    ///   surface or have a mesh, which is used only if the map is made anew
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; in 3-D it names a surface vertex where the way is blocked
    ///
    /// Returns as `icc_map_create()`, and `ICC_ERR_CERTIFICATE` if the target cannot be reached
    ///
    /// Cost, if the target is reached at once: a third to a half of `icc_map_create()` in the plane, and a
    /// tenth in space, see docs/performance.md. With features the first frame of a small map may take longer
    /// than `icc_map_create()`.
    pub fn icc_map_retarget(
        out: *mut *mut icc_map,
        map: *const icc_map,
        target: *const icc_domain,
        options: *const icc_retarget_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Copies the mesh of a mesh map, in your coordinates. They are rounded once, whereas the certificate is
    /// about the unrounded numbers inside. `icc_map_report.n_spoilt` counts the simplices that rounding makes
    /// flat or reversed.
    ///
    /// - `map`: the map
    /// - `mesh` (in and out): the mesh on the source: the arrays that you provide are filled, then the
    ///   dimension and the counts are set. Triangles run counter-clockwise, tetrahedra have positive
    ///   determinants
    /// - `images` (out): room for `icc_map_info.n_vertices` * dim coordinates in the target, or NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if `map` or `mesh` is NULL, or the arrays are too small
    /// - `ICC_ERR_UNSUPPORTED` if it is not a mesh map
    pub fn icc_map_get_mesh(map: *const icc_map, mesh: *mut icc_mesh, images: *mut f64) -> icc_status;

    /// Copies the region of each cell of the mesh that `icc_map_get_mesh()` copies. Regions are numbered as
    /// in `icc_domain_get_regions()`, in 2-D as well: region k lies within the k-th feature of kind
    /// `ICC_FEATURE_REGION` of the source, but not within a region inside it, and 0 is the rest. If two
    /// regions of the plane overlap and neither lies in the other, the number is one of theirs.
    ///
    /// - `map`: the map
    /// - `regions` (out): room for `icc_map_info.n_simplices` numbers. All are 0 if the source has no regions
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if `map` or `regions` is NULL
    /// - `ICC_ERR_UNSUPPORTED` if it is not a mesh map
    /// - `ICC_ERR_MEMORY`
    pub fn icc_map_get_regions(map: *const icc_map, regions: *mut u32, err: *mut icc_error) -> icc_status;

    /// Maps the vertices of your mesh of triangles (2-D) or tetrahedra (3-D), and checks exactly whether the
    /// image is a valid mesh too. Even a one-to-one map can fail this test, because the simplices are
    /// straight where the map bends.
    ///
    /// The mesh may have holes, voids and handles, and several pieces. Each facet belongs to one simplex or
    /// two. In 3-D no vertex or edge belongs to two parts of the boundary.
    ///
    /// - `map`: a map in 2-D or 3-D, else `ICC_ERR_UNSUPPORTED`
    /// - `mesh`: a mesh of the map's dimension, with its vertices in the source
    /// - `images` (out): the images of its vertices: n_vertices * dim coordinates, or NULL
    /// - `certificate` (out): its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK` once the check has run, whatever it found, or
    ///
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_UNSUPPORTED` or `ICC_ERR_CANCELLED`
    pub fn icc_map_certify(
        map: *const icc_map,
        mesh: *const icc_mesh,
        images: *mut f64,
        certificate: *mut icc_certificate,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Maps your mesh of triangles (2-D) or tetrahedra (3-D) so that no simplex inverts. It maps the
    /// vertices, then moves the images of inner vertices until every simplex keeps its orientation. Inner
    /// vertices without an image get one.
    ///
    /// The simplices and the images of boundary vertices do not change. So repair cannot always succeed: a
    /// simplex with all its corners on the boundary stays as the map makes it. Check `certificate`. On
    /// failure the images are the best that were found. A mesh is not repaired if it is not valid itself, or
    /// if a boundary vertex has no image.
    ///
    /// - `map`: a map in 2-D or 3-D, else `ICC_ERR_UNSUPPORTED`
    /// - `mesh`: a mesh of the map's dimension, with its vertices in the source
    /// - `images` (out): the images of its vertices: n_vertices * dim coordinates
    /// - `certificate` (out): about the returned images; its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns as `icc_map_certify()`
    ///
    /// Cost: proportional to the number of inverted simplices; at worst a fixed number of passes over the
    /// mesh. Deterministic: iterations are limited, and no clock is read.
    pub fn icc_map_repair(
        map: *const icc_map,
        mesh: *const icc_mesh,
        images: *mut f64,
        certificate: *mut icc_certificate,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a map.
    pub fn icc_map_free(map: *mut icc_map);

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_map_get_info(map: *const icc_map, info: *mut icc_map_info) -> icc_status;

    /// Fills in `report`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`. Counting
    /// n_spoilt takes a pass over the mesh if its coordinates have to be rounded.
    pub fn icc_map_get_report(map: *const icc_map, report: *mut icc_map_report) -> icc_status;

    /// Reports a tie of a map between domains with features. All ties together tell on which side each
    /// feature passes the others. Passed as `icc_map_options.ties` they make a map that is isotopic to this
    /// one: it can be moved to this one while it stays one-to-one. If `icc_map_info.detour` is large, they
    /// may be too entangled for double precision and are then refused with `ICC_ERR_RESOLUTION`.
    ///
    /// The ties follow from the map alone. In the source they are a shortest tree of straight lines between
    /// vertices, which may differ from the ties that the map was made with. In the target they are drawn with
    /// few bends and do not cross.
    ///
    /// - `map`: the map
    /// - `tie`: its number, less than `icc_map_info.n_ties`
    /// - `info` (out): `size` is set by the caller
    /// - `source` (out): 2 * n_source coordinates of bends, or NULL
    /// - `target` (out): 2 * n_target coordinates of bends, or NULL
    ///
    /// Returns `ICC_OK`, or `ICC_ERR_ARGUMENT` if `map` or `info` is NULL or there is no such tie. Also
    /// `ICC_ERR_UNSUPPORTED` if an end of the tie has slid (`icc_map_options.slide`), so that it is a vertex
    /// of one domain only
    pub fn icc_map_get_tie(
        map: *const icc_map,
        tie: usize,
        info: *mut icc_tie_info,
        source: *mut f64,
        target: *mut f64,
    ) -> icc_status;

    /// The chart of the source; borrowed. NULL for a map made by `icc_map_retarget()`, for a mesh map beyond
    /// 3-D, and for one in 3-D unless a method or a maximum was asked for.
    pub fn icc_map_source_chart(map: *const icc_map) -> *const icc_chart;

    /// The chart of the target; borrowed. NULL like `icc_map_source_chart()`.
    pub fn icc_map_target_chart(map: *const icc_map) -> *const icc_chart;

    /// Maps points from the source to the target. Returns `ICC_OK` even if every point failed: check `status`
    /// or `n_failed`. A certified curve map of method field reports `ICC_ERR_TRACE` for a point that would
    /// not come back to within 1e-6 of the bounding box's diagonal.
    ///
    /// - `map`: the map
    /// - `n`: number of points
    /// - `points`: n * dim coordinates in the source
    /// - `images` (out): n * dim coordinates; NaN for a point without an image. May be the same array as
    ///   `points`
    /// - `status` (out): n statuses: `ICC_OK`, `ICC_ERR_OUTSIDE`, `ICC_ERR_TRACE` or `ICC_ERR_ARGUMENT`; or
    ///   NULL
    /// - `n_failed` (out): number of points without an image, or NULL
    /// - `env`: may be NULL
    ///
    /// Returns as `icc_chart_encode()`
    pub fn icc_map_apply(
        map: *const icc_map,
        n: usize,
        points: *const f64,
        images: *mut f64,
        status: *mut icc_status,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Maps points from the target to the source; otherwise like `icc_map_apply()`.
    pub fn icc_map_apply_inverse(
        map: *const icc_map,
        n: usize,
        points: *const f64,
        images: *mut f64,
        status: *mut icc_status,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Computes the derivative of the map at points of the source. It is exact for the piecewise map, up to
    /// rounding. At a kink it is one-sided. If the map is certified, the determinant is positive. Method
    /// field reports no derivative where rounding would make it otherwise, or where the point does not come
    /// back. Returns `ICC_OK` even if every point failed.
    ///
    /// - `map`: the map
    /// - `n`: number of points
    /// - `points`: n * dim coordinates in the source's interior. On the boundary and at the maximum there is
    ///   no derivative (`ICC_ERR_TRACE`)
    /// - `jacobians` (out): n * dim * dim numbers: row i, column j is the derivative of image coordinate i by
    ///   point coordinate j. NaN where there is none
    /// - `status` (out): n statuses, or NULL
    /// - `n_failed` (out): number of points without a derivative, or NULL
    /// - `env`: may be NULL
    ///
    /// Returns as `icc_chart_encode()`
    pub fn icc_map_jacobian(
        map: *const icc_map,
        n: usize,
        points: *const f64,
        jacobians: *mut f64,
        status: *mut icc_status,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Writes a map with its domains and charts to memory, in two calls as `icc_chart_save()` does.
    pub fn icc_map_save(
        map: *const icc_map,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a map back, as `icc_chart_load()` does a chart. The mesh of a mesh map is stored in full and
    /// certified anew.
    pub fn icc_map_load(
        out: *mut *mut icc_map,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Warps a picture. Every target pixel whose centre lies in the target domain or on its boundary gets the
    /// colour of the place in the source that is mapped there. All other pixels stay as they are. Pixel (i,
    /// j), in column i and row j, covers \[i, i+1\] x \[j, j+1\] in the coordinates of the domains.
    ///
    /// Colours between pixels are interpolated bilinearly, weighted by opacity. Where the map shrinks the
    /// picture, up to 16 x 16 samples are averaged to avoid aliasing. Beyond its edge the source continues
    /// with the colour of the edge. The identity copies pixels exactly.
    ///
    /// Pictures of floats, with more than four channels, with missing samples or with another interpolation
    /// are computed pixel by pixel, each channel separately. A target pixel is missing (it gets `nodata`) if
    /// the source's pixel at its place is missing. Next to missing samples, the known ones are interpolated
    /// linearly. Averages are taken over known samples only.
    ///
    /// - `map`: a map in 2-D; mesh maps are the fastest
    /// - `source`: the picture to read
    /// - `target`: the picture to write, of any width and height, with the source's channels, bytes and
    ///   alpha. Its pixels must not overlap the source's
    /// - `n_failed` (out): number of pixels inside without an image, which are left as they are; or NULL.
    ///   Always 0 for mesh maps
    /// - `env`: may be NULL; results are the same for every number of threads
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION`, or `ICC_ERR_CANCELLED`
    /// (then some pixels have been written)
    ///
    /// Cost with a mesh map: nanoseconds a pixel, or tenths of a microsecond if computed pixel by pixel.
    pub fn icc_map_warp(
        map: *const icc_map,
        source: *const icc_picture,
        target: *const icc_picture,
        n_failed: *mut usize,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Samples a map on a grid. The sampled field can fold although the map does not, because it is
    /// multilinear between the samples. `icc_field_certify()` tells. If it folds, sample more finely.
    ///
    /// - `map`: a map in 2-D or 3-D, else `ICC_ERR_UNSUPPORTED`
    /// - `inverse`: 1: sample the inverse map, with places in the target, as programs want that resample
    ///   images; 0: the map
    /// - `field`: the grid, with room for the values, which are written. Values are rounded once to the type
    ///   that they are stored in
    /// - `n_outside` (out): samples whose place has no image, or NULL. `outside` says what they get
    /// - `env`: may be NULL; results are the same for every number of threads
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION`, `ICC_ERR_UNSUPPORTED`, or
    /// `ICC_ERR_CANCELLED` (then some values have been written)
    ///
    /// Cost: that of `icc_map_apply()` for each sample.
    pub fn icc_map_sample(
        map: *const icc_map,
        inverse: i32,
        field: *const icc_field,
        n_outside: *mut usize,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Proves that a sampled field does not fold, or lists the cells where it does. The field may come from
    /// any program, such as a registration. The proof is about the stored values, whatever their type, and
    /// about exact multilinear interpolation. A program that rounds while it interpolates may still reverse
    /// points that are closer together than its rounding errors.
    ///
    /// *What is proven.* Signs are exact. In 2-D the determinant is bilinear, so its signs at the corners
    /// decide. In 3-D it is a polynomial of degree 2 in each variable. A cell is proven if all Bernstein
    /// coefficients are positive, after subdivision if necessary, and disproven by a corner of a part where
    /// the determinant is not positive. Subdivision is bounded. The rest is undecided, which needs a
    /// determinant that is nearly 0 inside the cell, or numbers beyond 2^-200 and 2^200.
    ///
    /// A field whose cells are all proven keeps the orientation and is one-to-one near each point. It is
    /// one-to-one on the whole box if the image of the box's boundary is also simple. This is proven if all
    /// samples on the boundary have the same displacement. In 2-D the image of the boundary is a polygon,
    /// which is checked exactly if its vertices are representable. On a grid along the coordinate axes, the
    /// field is also one-to-one if the displacements of any two places differ by less than the places do,
    /// which is proven by bounds of the derivatives. Otherwise `one_to_one` is 0, which does not mean that
    /// two places meet.
    ///
    /// - `field`: the grid and its values
    /// - `capacity`: room for listed cells, or 0
    /// - `cells` (out): the first cells that are not proven, in ascending order. The first axis is the
    ///   fastest, with shape\[k\] - 1 cells along axis k. NULL if capacity is 0
    /// - `kinds` (out): `ICC_CELL_*` of each listed cell. NULL if capacity is 0
    /// - `report` (out): its `size` is set by the caller. All such cells are n_folded + n_undecided +
    ///   n_missing
    /// - `env`: may be NULL; results are the same for every number of threads
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK` once the check has run, whatever it found, or `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`,
    /// `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: about 1 us a cell in 3-D, and 1 byte of memory.
    pub fn icc_field_certify(
        field: *const icc_field,
        capacity: usize,
        cells: *mut u32,
        kinds: *mut i32,
        report: *mut icc_field_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;
}

// icc/stages.h

opaque!(
    /// A regular grid of vertices, each inside or outside a shape. Vertex (i_0, i_1, ..) has the index i_0 +
    /// shape\[0\] * (i_1 + shape\[1\] * (..)) and the position origin + spacing * i.
    icc_grid
);

/// What `icc_grid_get_info()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_grid_info {
    /// set by the caller: `sizeof(icc_grid_info)`
    pub size: usize,
    /// dimension, 1..`ICC_MAX_DIM`
    pub dim: i32,
    /// vertices along each axis
    pub shape: [usize; ICC_MAX_DIM],
    /// position of vertex 0
    pub origin: [f64; ICC_MAX_DIM],
    /// distance between neighbours, the same along every axis
    pub spacing: f64,
    /// product of `shape`
    pub n_vertices: usize,
    /// vertices inside
    pub n_inside: usize,
    /// vertices inside the boundary that count as outside: pieces other than the largest, see
    /// `icc_grid_create()`, and vertices removed by `icc_grid_restrict()`
    pub n_stray: usize,
    /// grid cells along the longest side of the domain; 0 for a grid from a mask of vertices
    pub cells: i32,
}
sized!(icc_grid_info);

opaque!(
    /// A breadth-first tree over a grid. In a *cousin tree*, which libicc builds where the shape allows it,
    /// any two neighbouring vertices are parent and child or cousins. *Cousins* have parents that are
    /// neighbours too.
    icc_tree
);

/// Options of `icc_tree_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_tree_options {
    /// set by the caller: `sizeof(icc_tree_options)`
    pub size: usize,
    /// `ICC_TREE_*`; 0: thesis
    pub form: i32,
    /// the order in which a generation expands along the axes, a permutation of 0..dim-1; NULL: 0, 1, 2 and
    /// so on
    pub axis_order: *const i32,
}
sized!(icc_tree_options);

/// What `icc_tree_get_report()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_tree_report {
    /// set by the caller: `sizeof(icc_tree_report)`
    pub size: usize,
    /// vertices inside that the tree reaches
    pub n_inside: usize,
    /// vertices outside that belong to the tree
    pub n_outside: usize,
    /// vertices inside that it does not reach
    pub n_unreachable: usize,
    /// pairs of neighbouring vertices, both inside and reached
    pub n_pairs: usize,
    /// pairs that are neither parent and child nor cousins
    pub n_cousin_violations: usize,
    /// the first such pair in index order, or UINT32_MAX
    pub violation: [u32; 2],
}
sized!(icc_tree_report);

opaque!(
    /// A function on the vertices of a tree that falls from parent to child: icc/stages.h.
    icc_function
);

opaque!(
    /// Integral curves of a function through given points, uphill or downhill. The function is linear in
    /// every simplex of the grid's Kuhn triangulation, so each curve is a polyline.
    icc_curves
);

/// Options of `icc_function_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_function_options {
    /// set by the caller: `sizeof(icc_function_options)`
    pub size: usize,
    /// `ICC_FUNCTION_*`; 0: decay
    pub function: i32,
    /// `ICC_CONSTRAINTS_*`; 0: needed
    pub constraints: i32,
    /// `ICC_SOLVER_*`; 0: by the predicted work of a factorisation. Clamped, harmonic and constrained
    /// bi-Laplace are always factorised. Laplace is solved iteratively where a factorisation would lose small
    /// values, as in long thin rings
    pub solver: i32,
    /// least relative fall from parent to child, in (0, 0.01\]; 0: 1e-6
    pub min_fall: f64,
    /// constrained bi-Laplace: least value at vertices without children, in (0, 0.01\]; 0: 1e-9
    pub leaf_min: f64,
}
sized!(icc_function_options);

/// What `icc_function_get_info()` reports. Members that do not apply to the function are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_function_info {
    /// set by the caller: `sizeof(icc_function_info)`
    pub size: usize,
    /// `ICC_FUNCTION_*`
    pub function: i32,
    /// 1: the tree's inequalities were imposed
    pub constrained: i32,
    /// `ICC_SOLVER_*`
    pub solver: i32,
    /// 1: the function is greatest at `highest` and not at the root, where curves should end. Only seen for
    /// bilaplace and clamped without inequalities. `icc_chart_create()` then moves the root
    pub beside: i32,
    /// vertices inside that the tree reaches, except the root
    pub n_unknowns: usize,
    /// tree edges where the function without constraints breaks the inequality; if constraints were not
    /// imposed, where this function does
    pub n_violated: usize,
    /// inequalities that hold with equality
    pub n_active: usize,
    /// KKT residual: the largest |min(slack, multiplier)| of an inequality, or |row of the equation| if there
    /// are no inequalities. The function is 1 at the root
    pub residual: f64,
    /// smallest value of `icc_function_logs()` inside; 0 if there are none
    pub least_log: f64,
    /// how much greater the function is at `highest`, as a share of its value at the root; 0 if that is the
    /// root
    pub excess: f64,
    /// the vertex inside with the greatest value
    pub highest: u32,
}
sized!(icc_function_info);

/// What `icc_function_get_solver_report()` reports: how the function was computed. Members that do not apply
/// are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_solver_report {
    /// set by the caller: `sizeof(icc_solver_report)`
    pub size: usize,
    /// iterations of the active set or interior point method; 0 without constraints
    pub n_iterations: usize,
    /// iterations of conjugate gradients, in total
    pub n_inner: usize,
    /// multiplications of the largest factorisation
    pub work: f64,
    /// `icc_function_info.residual` before the final sweep from the root to the leaves
    pub residual_before: f64,
    /// time to number the unknowns and build the matrices
    pub seconds_setup: f64,
    /// time for orderings and symbolic factorisations
    pub seconds_order: f64,
    /// time for factorisations
    pub seconds_factor: f64,
    /// time for triangular solves and conjugate gradients
    pub seconds_solve: f64,
    /// time to count critical points, sweep and find the residuals
    pub seconds_verify: f64,
}
sized!(icc_solver_report);

/// What `icc_function_get_report()` reports: critical points of a function on the vertices inside. They are
/// found from the links of the vertices in the Kuhn triangulation.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_function_report {
    /// set by the caller: `sizeof(icc_function_report)`
    pub size: usize,
    /// vertices with no higher neighbour
    pub n_maxima: usize,
    /// vertices with no lower neighbour
    pub n_minima: usize,
    /// other vertices where the higher or the lower neighbours do not form a contractible set. Exact up to
    /// 3-D. Beyond 3-D a vertex counts as a saddle if neither set can be reduced to a point by strong
    /// collapses
    pub n_saddles: usize,
    /// the first critical vertex in index order except the root, or UINT32_MAX
    pub critical: u32,
}
sized!(icc_function_report);

// Kinds of edges that `icc_function_get_edges()` lists, and of facets that `icc_function_get_facets()` lists.
/// the gradients on both sides point to the edge
pub const ICC_EDGE_COMPRESSION: i32 = 1;
/// the gradients on both sides point away from it
pub const ICC_EDGE_EXPANSION: i32 = 2;

/// What `icc_function_get_facets()` counts.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_facet_report {
    /// set by the caller: `sizeof(icc_facet_report)`
    pub size: usize,
    /// facets examined
    pub n_tested: usize,
    /// facets where curves merge on the way up
    pub n_compression: usize,
    /// facets where curves merge on the way down
    pub n_expansion: usize,
}
sized!(icc_facet_report);

// The two ways along a curve: `icc_curves_create()`.
/// uphill, to a maximum
pub const ICC_WAY_UP: i32 = 1;
/// downhill, to the boundary
pub const ICC_WAY_DOWN: i32 = 2;

// How a curve ends: `icc_curves_get_ends()`.
/// no curve: the point lies outside, or where there are no values
pub const ICC_END_NONE: i32 = 0;
/// at the root of the tree
pub const ICC_END_MAXIMUM: i32 = 1;
/// on the boundary of the domain that the grid was made from
pub const ICC_END_BOUNDARY: i32 = 2;
/// at a vertex other than the root that has no higher neighbour, or downhill no lower one
pub const ICC_END_CRITICAL: i32 = 3;
/// where the values end. This is usual downhill on a grid from a mask of vertices, which has no boundary
pub const ICC_END_VALUES: i32 = 4;

/// What `icc_curves_get_info()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_curves_info {
    /// set by the caller: `sizeof(icc_curves_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_WAY_*`
    pub way: i32,
    /// as many as there were points
    pub n_curves: usize,
    /// vertices of all curves
    pub n_vertices: usize,
    /// curves that others join, see `icc_curves_get_ends()`
    pub n_merged: usize,
}
sized!(icc_curves_info);

// How `icc_tree_grow()` found an order.
/// the given order is regular
pub const ICC_GROW_AS_GIVEN: i32 = 1;
/// some vertices had to wait for others
pub const ICC_GROW_GROWN: i32 = 2;
/// growth got stuck; instead the vertices were removed one by one, and that order was reversed
pub const ICC_GROW_THINNED: i32 = 3;

/// What `icc_tree_grow()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_grow_report {
    /// set by the caller: `sizeof(icc_grow_report)`
    pub size: usize,
    /// `ICC_GROW_*`
    pub method: i32,
    /// the first vertex in the given order that growth could not place, or UINT32_MAX
    pub vertex: u32,
    /// vertices inside that the tree reaches
    pub n_vertices: usize,
    /// vertices that had to wait while growing
    pub n_deferred: usize,
    /// vertices left when growth got stuck
    pub n_unplaced: usize,
    /// vertices left, except the root, if thinning got stuck too
    pub n_remaining: usize,
    /// edges of the Kuhn triangulation whose two ends changed order
    pub n_reversed: usize,
    /// links that were tested: less than 2^(dim+3) a vertex
    pub n_tests: usize,
}
sized!(icc_grow_report);

extern "C" {
    /// Covers a domain with a grid that is at least two vertices wider than the domain on every side.
    ///
    /// A vertex is inside if it lies strictly inside the boundary. Where a domain is thinner than the grid,
    /// the vertices inside may fall into several pieces. Beyond 2-D only the largest piece is kept. The
    /// vertices of the other pieces count as outside: `icc_grid_info.n_stray`.
    ///
    /// If the domain comes from a mask (`icc_domain_create_mask()`), the grid includes the boundary's
    /// vertices. Each cell of the mask is cut into an even number of parts along each axis: 2, or as many
    /// more as `cells` requires.
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `domain`: the domain
    /// - `cells`: cells along the longest side of the bounding box, 2..16384; 0: 50. For masks: at least that
    ///   many; 0: two for each cell of the mask
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_RESOLUTION` if no vertex is inside, or there would be more than 2^28 vertices
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    pub fn icc_grid_create(
        out: *mut *mut icc_grid,
        domain: *const icc_domain,
        cells: i32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a grid from a mask of its vertices, with origin 0 and spacing 1. (`icc_domain_create_mask()`
    /// takes a mask of cells instead.)
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `shape`: vertices along each axis, dim numbers; the first axis is fastest
    /// - `inside`: one byte per vertex: 0 is outside, anything else inside
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    pub fn icc_grid_create_mask(
        out: *mut *mut icc_grid,
        dim: i32,
        shape: *const usize,
        inside: *const u8,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a grid of half the spacing with the same inside. Each simplex of the Kuhn triangulation is cut
    /// into 2^dim. A new vertex halves an edge, and is inside if both ends of the edge are inside. Walls that
    /// are one vertex thick stay one vertex thick. For a grid that follows its domain more closely, make one
    /// with twice `icc_grid_info.cells` instead.
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `grid`: the grid
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_RESOLUTION` if there would be more than 2^28 vertices
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    pub fn icc_grid_refine(
        out: *mut *mut icc_grid,
        grid: *const icc_grid,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Copies a grid and moves some vertices to the outside.
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `grid`: the grid
    /// - `keep`: one byte per vertex: 0 moves it to the outside, counted by `icc_grid_info.n_stray`
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    pub fn icc_grid_restrict(
        out: *mut *mut icc_grid,
        grid: *const icc_grid,
        keep: *const u8,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a grid.
    pub fn icc_grid_free(grid: *mut icc_grid);

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_grid_get_info(grid: *const icc_grid, info: *mut icc_grid_info) -> icc_status;

    /// Copies the positions of grid vertices.
    ///
    /// - `grid`: the grid
    /// - `n`: number of vertices
    /// - `vertices`: n vertex numbers, or NULL for the vertices 0 to n - 1
    /// - `points` (out): room for n * dim coordinates
    ///
    /// Returns `ICC_OK`; `ICC_ERR_ARGUMENT` if a number is not that of a vertex
    pub fn icc_grid_get_points(
        grid: *const icc_grid,
        n: usize,
        vertices: *const u32,
        points: *mut f64,
    ) -> icc_status;

    /// One byte per vertex, 1 inside and 0 outside; borrowed.
    pub fn icc_grid_inside(grid: *const icc_grid) -> *const u8;

    /// Finds the maximum: the vertex farthest from the outside in the grassfire transform (Algorithm 1). Of
    /// several such vertices it takes the one nearest to their mean, then the smallest index.
    ///
    /// - `grid`: the grid
    /// - `vertex` (out): the maximum
    /// - `rounds` (out): number of rounds that the fire burnt before it reached the vertex, 0 for a vertex
    ///   next to the outside; or NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Cost: O(vertices) time and memory.
    pub fn icc_grid_find_maximum(
        grid: *const icc_grid,
        vertex: *mut u32,
        rounds: *mut u32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Finds the vertex inside that is nearest to a point; of several, the smallest index. O(vertices).
    pub fn icc_grid_find_nearest(grid: *const icc_grid, point: *const f64, vertex: *mut u32) -> icc_status;

    /// Grows the tree of Algorithm 2 from a vertex inside.
    ///
    /// Vertices outside that neighbour the inside also have a generation: one more than the smallest among
    /// their neighbours inside. The two forms treat them differently. In the thesis' form they have a parent
    /// and belong to the tree, as do the vertices that they expand into. In the paper's form their parent is
    /// UINT32_MAX, which stands for all their neighbours inside. A grid made by `icc_grid_create()` is wide
    /// enough for both layers. A mask may end at its last vertex and then lacks the layers beyond.
    ///
    /// The paper's Theorem 2 says that the result is a cousin tree. It held in every 2-D case tried, but is
    /// false in 3-D and beyond. The library does not rely on it. `icc_tree_get_report()` checks it, and
    /// `icc_tree_grow()` finds an order that can be used instead.
    ///
    /// - `out` (out): the tree; owned by the caller. It keeps the grid alive
    /// - `grid`: the grid
    /// - `root`: the maximum: a vertex inside
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Cost: O(vertices * dim) time, 12 bytes a vertex.
    pub fn icc_tree_create(
        out: *mut *mut icc_tree,
        grid: *const icc_grid,
        root: u32,
        options: *const icc_tree_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a tree from the caller's parents.
    ///
    /// The caller gives parents to the vertices inside. The layers outside follow as in `icc_tree_create()`.
    /// The tree need not be a cousin tree: `icc_tree_get_report()` says whether it is. The parents of a tree
    /// from `icc_tree_create()` give the same tree again.
    ///
    /// - `out` (out): the tree; owned by the caller; keeps the grid alive
    /// - `grid`: the grid
    /// - `root`: the maximum: a vertex inside
    /// - `parents`: one number per grid vertex: a neighbour inside; UINT32_MAX for the root and for vertices
    ///   that the tree leaves out. Numbers of vertices outside are ignored
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a vertex whose parents do not lead to the root
    ///
    /// Returns `ICC_OK`; `ICC_ERR_ARGUMENT` if the parents of a vertex do not lead to the root, or one of
    /// them is not a neighbour inside; `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED`, `ICC_ERR_VERSION`
    ///
    /// Cost: O(vertices * dim) time, 12 bytes a vertex.
    pub fn icc_tree_create_parents(
        out: *mut *mut icc_tree,
        grid: *const icc_grid,
        root: u32,
        parents: *const u32,
        options: *const icc_tree_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a tree.
    pub fn icc_tree_free(tree: *mut icc_tree);

    /// The parent of each vertex: UINT32_MAX for the root and for vertices without one; borrowed.
    pub fn icc_tree_parents(tree: *const icc_tree) -> *const u32;

    /// The generation of each vertex: 0 for the root, -1 for unreached vertices; borrowed.
    pub fn icc_tree_generations(tree: *const icc_tree) -> *const i32;

    /// Checks the cousin rule (Definition 2) on every pair of neighbours inside. O(vertices * dim).
    pub fn icc_tree_get_report(
        tree: *const icc_tree,
        report: *mut icc_tree_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a function: a value for every vertex of a tree.
    ///
    /// - *decay*: 10 at the root, times 0.95 with each generation (thesis, equation 4.1). From about
    ///   generation 13,850 on that would underflow, and the values are -1, -2 and so on.
    /// - *distance*: minus the generation.
    /// - *laplace*: 1 at the root, 0 at the vertices outside that neighbour the inside, and the mean of its
    ///   neighbours at every other vertex. It has the least Dirichlet energy. Beyond those zeros its value is
    ///   minus that of two steps back.
    /// - *harmonic*: like laplace, but 0 where the grid's edges cross the boundary of the domain that the
    ///   grid was made from. The cut edges have weights of their own (F. Gibou, R. P. Fedkiw, L.-T. Cheng, M.
    ///   Kang, 2002). Values at the vertices outside continue from there.
    /// - *bilaplace*: least sum of squared Laplacians over the vertices inside. This is f = c L^-2 e_root
    ///   (simply supported, Navier).
    /// - *clamped*: least sum of squared Laplacians over the vertices inside and those outside next to them.
    ///
    /// Decay and distance depend on the generation alone. Laplace is 0 on a staircase of vertices, which
    /// leaves part of the area uncovered at any resolution. With harmonic that part shrinks as the grid gets
    /// finer. On the grid of a mask, whose boundary consists of vertices, both are the same.
    ///
    /// Laplace, harmonic and bilaplace are positive inside, however far from the root. Clamped changes its
    /// sign unless it is constrained. With constraints, the function has the least energy among those that
    /// fall by `min_fall` along every tree edge inside. Bilaplace and clamped are then also at least
    /// `leaf_min` at the leaves.
    ///
    /// Bilaplace and clamped are shapes of a plate that is loaded at the root. An off-centre load does not
    /// make a plate highest right under it. So without constraints the maximum may be another vertex:
    /// `icc_function_info.highest` and `icc_function_info.beside`. A tree grown from there has a different
    /// function. `icc_chart_create()` moves the root until the two agree.
    ///
    /// The library assumes nothing about critical points: `icc_function_get_report()` counts them. On a tree
    /// that is not a cousin tree, as in 3-D, the inequalities do not rule out critical points besides the
    /// maximum.
    ///
    /// - `out` (out): the function; owned by the caller. It keeps the tree alive
    /// - `tree`: the tree
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_RESOLUTION` if the root is the only vertex inside (laplace, bilaplace, clamped, harmonic)
    /// - `ICC_ERR_UNSUPPORTED` for harmonic on a refined grid, or on one that was not made from a domain
    /// - `ICC_ERR_SOLVER` if a solver did not converge, see below
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED` or `ICC_ERR_VERSION`
    ///
    /// `ICC_ERR_SOLVER` has been seen in two cases only. One is constrained bilaplace or clamped, if the
    /// inequalities ask for more than 1 at the root, as they do on deep trees, or if `leaf_min` is 1e-2. The
    /// other is harmonic, where laplace would be solved iteratively.
    pub fn icc_function_create(
        out: *mut *mut icc_function,
        tree: *const icc_tree,
        options: *const icc_function_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a function from the caller's values.
    ///
    /// The values may be any: `icc_function_get_report()` counts their critical points, and
    /// `icc_function_info.n_violated` is the number of tree edges along which the function does not fall.
    ///
    /// Values at vertices outside decide where curves meet the boundary. A NaN there is replaced. Beside a
    /// vertex inside, the function then falls by as much as from the parent of that vertex to it. (Of several
    /// such vertices, the lowest counts.) In the layer behind, it goes on linearly.
    ///
    /// - `out` (out): the function; owned by the caller; keeps the tree alive. Its
    ///   `icc_function_info.function` is `ICC_FUNCTION_VALUES`
    /// - `tree`: the tree
    /// - `values`: one per grid vertex, at most 2^900 in size; NaN is allowed outside. Values at vertices
    ///   that the tree does not reach are ignored
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a vertex whose value is refused
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED`, `ICC_ERR_VERSION`
    ///
    /// Cost: O(vertices) time, 8 bytes a vertex.
    pub fn icc_function_create_values(
        out: *mut *mut icc_function,
        tree: *const icc_tree,
        values: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a function from the logarithms of its values. Doubles cannot hold the values of long limbs,
    /// which fall below 2^-1022. At the vertices outside, the function is that of `ICC_FUNCTION_LAPLACE`: 0
    /// beside the inside, and negative behind.
    ///
    /// - `out` (out): as for `icc_function_create_values()`
    /// - `tree`: the tree
    /// - `logs`: one natural logarithm per grid vertex, at most 2^28 in size at the vertices inside that the
    ///   tree reaches; others are ignored
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a vertex inside whose logarithm is not finite
    ///
    /// Returns as for `icc_function_create_values()`
    pub fn icc_function_create_logs(
        out: *mut *mut icc_function,
        tree: *const icc_tree,
        logs: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Solves an equation with the caller's fixed values and right-hand side.
    ///
    /// (L f)(v) is the sum of f(v) - f(u) over the 2 dim neighbours u of v along the axes, whatever the
    /// spacing. The equation holds at every vertex inside that the tree reaches and that is not fixed:
    ///
    /// - laplace: L f = right_side. This f has the least Dirichlet energy minus the sum of right_side f.
    /// - bilaplace: L (L f) = right_side, where L f is 0 at the vertices outside (simply supported).
    ///
    /// At vertices outside that neighbour the inside, f is the fixed value, or 0 if that is NaN. The root is
    /// free unless you fix it. Fixed to 1, and with nothing else, it gives the function of
    /// `icc_function_create()` without constraints. Values may have any sign, and critical points anywhere:
    /// `icc_function_get_report()`. `icc_function_info.n_unknowns` counts the free vertices, and
    /// `icc_function_info.residual` is the largest error of the equation at these.
    ///
    /// - `out` (out): the function; owned by the caller; keeps the tree alive
    /// - `tree`: the tree
    /// - `options`: function: laplace, or 0 for the same, or bilaplace. Constraints: none, or 0 for the same.
    ///   Solver: direct, or 0 for the same. NULL: laplace
    /// - `fixed`: one value per grid vertex, at most 2^900 in size, or NaN where it is free; NULL: no vertex
    ///   is fixed
    /// - `right_side`: one finite number per grid vertex; only those of free vertices count; NULL: 0
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a vertex whose value is too large, or whose right-hand side is not
    ///   finite
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_UNSUPPORTED` for other functions, constraints needed or all, and solver iterative
    /// - `ICC_ERR_SOLVER` if a value exceeds 2^900 in size, or rounding spoils six digits
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED` or `ICC_ERR_VERSION`
    ///
    /// Cost: one factorisation, as for `icc_function_create()` with a direct solver. About 300 bytes a vertex
    /// inside in 2-D besides the factor.
    pub fn icc_function_create_solve(
        out: *mut *mut icc_function,
        tree: *const icc_tree,
        options: *const icc_function_options,
        fixed: *const f64,
        right_side: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// The function of a chart of method gradient or field, or NULL for other charts; borrowed, like the tree
    /// and the grid that belong to it.
    pub fn icc_chart_function(chart: *const icc_chart) -> *const icc_function;

    /// The tree that a function was made on; borrowed.
    pub fn icc_function_tree(field: *const icc_function) -> *const icc_tree;

    /// The grid that a tree was grown on; borrowed.
    pub fn icc_tree_grid(tree: *const icc_tree) -> *const icc_grid;

    /// The vertex that a tree was grown from; UINT32_MAX for NULL.
    pub fn icc_tree_root(tree: *const icc_tree) -> u32;

    /// Frees a function.
    pub fn icc_function_free(field: *mut icc_function);

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_function_get_info(field: *const icc_function, info: *mut icc_function_info) -> icc_status;

    /// Fills in `report`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_function_get_solver_report(
        function: *const icc_function,
        report: *mut icc_solver_report,
    ) -> icc_status;

    /// One value per grid vertex; NaN where the tree does not reach; borrowed. Beyond 2-D the function of a
    /// gradient chart extends to some vertices outside. Laplace and bilaplace decay exponentially in long
    /// limbs. Values below 2^-1022 are 0 here, and those above 2^1024 infinite, but `icc_function_logs()` has
    /// them.
    pub fn icc_function_values(field: *const icc_function) -> *const f64;

    /// The natural logarithm of every value, accurate even where the values underflow. It is -HUGE_VAL
    /// outside and NaN where the tree does not reach; borrowed. NULL for decay and distance, and if some
    /// value inside is not positive.
    ///
    /// The logarithms of a chart's function are computed on first use, by any thread, with 8 bytes a vertex.
    /// The result is also NULL if there is no memory for them then.
    pub fn icc_function_logs(field: *const icc_function) -> *const f64;

    /// Counts critical points. Vertices outside or without a value count as lower than all others. Equal
    /// values are ordered by vertex index. Cost: about 10 ns a vertex in 2-D and 3-D, up to 10 us in 6-D.
    pub fn icc_function_get_report(
        field: *const icc_function,
        report: *mut icc_function_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Lists compression and expansion edges in 2-D (thesis, sections 5 and 6.4). It looks at edges between
    /// two triangles that have a value at every corner, with at least one corner inside.
    ///
    /// - `function`: the function
    /// - `capacity`: number of edges that the arrays have room for
    /// - `edges` (out): `capacity` pairs of vertices
    /// - `kinds` (out): `capacity` kinds, `ICC_EDGE_*`
    /// - `n_edges` (out): number of edges found, which may exceed `capacity`
    /// - `n_tested` (out): number of edges examined, or NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, or `ICC_ERR_UNSUPPORTED` if it is not 2-D
    pub fn icc_function_get_edges(
        field: *const icc_function,
        capacity: usize,
        edges: *mut u32,
        kinds: *mut i32,
        n_edges: *mut usize,
        n_tested: *mut usize,
    ) -> icc_status;

    /// Lists compression and expansion facets in any dimension. In 2-D these are the edges of
    /// `icc_function_get_edges()`, in the same order.
    ///
    /// A facet is shared by two simplices of the Kuhn triangulation. It is examined if both have a value at
    /// every corner and at least one corner is inside. Exact signs of differences decide to which side of it
    /// each gradient points, as they do for curves. A gradient parallel to the facet counts for neither kind.
    /// Curves from the other side may merge there, too.
    ///
    /// Curves also run along lower faces (edges in 3-D, for example). These are not listed.
    ///
    /// - `function`: the function
    /// - `capacity`: number of facets that the arrays have room for; 0: only count
    /// - `facets` (out): `capacity` times dim vertices, or NULL if `capacity` is 0
    /// - `kinds` (out): `capacity` kinds, `ICC_EDGE_*`, or NULL if `capacity` is 0
    /// - `report` (out): its `size` is set by the caller. n_compression + n_expansion is the number of facets
    ///   found, which may exceed `capacity`
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED` or `ICC_ERR_VERSION`
    ///
    /// Cost: dim! (dim + 1) / 2 facets a vertex. 60 ns a vertex in 2-D, 0.2 us in 3-D, 0.7 us in 4-D, and up
    /// to 15 us in 6-D.
    pub fn icc_function_get_facets(
        function: *const icc_function,
        capacity: usize,
        facets: *mut u32,
        kinds: *mut i32,
        report: *mut icc_facet_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Traces the curves through points (Algorithms 3 to 5). The signs of differences of f decide exactly
    /// which simplex comes next. Doubles give the place where the curve enters it.
    ///
    /// - `out` (out): the curves; owned by the caller; they do not need the function any more
    /// - `function`: the function
    /// - `n`: number of points
    /// - `points`: n * dim coordinates
    /// - `way`: `ICC_WAY_*`
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a point that is not finite
    ///
    /// Returns `ICC_OK`, also if some points have no curve; `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`,
    /// `ICC_ERR_CANCELLED`, `ICC_ERR_VERSION`
    ///
    /// Cost: some 50 ns a vertex in 2-D, 150 ns in 3-D; the curves take 8 * dim bytes a vertex.
    pub fn icc_curves_create(
        out: *mut *mut icc_curves,
        function: *const icc_function,
        n: usize,
        points: *const f64,
        way: i32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees curves.
    pub fn icc_curves_free(curves: *mut icc_curves);

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_curves_get_info(curves: *const icc_curves, info: *mut icc_curves_info) -> icc_status;

    /// Copies the vertices of the curves. Both arrays may be NULL.
    ///
    /// - `curves`: the curves
    /// - `first` (out): room for n_curves + 1 numbers. The vertices of curve i are first\[i\] to first\[i +
    ///   1\] - 1. The first one is its point
    /// - `vertices` (out): room for n_vertices * dim coordinates
    ///
    /// Returns `ICC_OK` or `ICC_ERR_ARGUMENT`
    pub fn icc_curves_get_vertices(
        curves: *const icc_curves,
        first: *mut usize,
        vertices: *mut f64,
    ) -> icc_status;

    /// Copies how the curves end. Every array may be NULL. The others have room for one entry a curve.
    ///
    /// - `curves`: the curves
    /// - `ends` (out): `ICC_END_*`
    /// - `lengths` (out): arc length
    /// - `alone` (out): arc length up to the first vertex, edge or other lower face that the curve follows,
    ///   where other curves join it; the whole length if there is none. Uphill, points share the rest of
    ///   their curve (compression). Downhill, no curve from the boundary reaches the point (expansion;
    ///   thesis, 6.4)
    /// - `facets` (out): the facet of the boundary where the curve ends, or UINT32_MAX
    /// - `bary` (out): n_curves * dim barycentric coordinates on that facet, or 0
    ///
    /// Returns `ICC_OK` or `ICC_ERR_ARGUMENT`
    pub fn icc_curves_get_ends(
        curves: *const icc_curves,
        ends: *mut i32,
        lengths: *mut f64,
        alone: *mut f64,
        facets: *mut u32,
        bary: *mut f64,
    ) -> icc_status;

    /// Orders the vertices inside so that the root is the only critical one. A function that falls with the
    /// rank then has one critical point, the maximum, in any dimension.
    ///
    /// In 2-D the tree's own order had this property in every case tried. Beyond 2-D it often does not, see
    /// `icc_tree_create()`. Here a set grows from the root, in the given order. It takes each vertex whose
    /// neighbours in the set form a contractible part of its link. Other vertices wait until theirs do. (The
    /// links are those of the Kuhn triangulation, and are tested as for `icc_function_report.n_saddles`.) If
    /// growth gets stuck, the set of all vertices is thinned down to the root instead.
    ///
    /// Both fail for some shapes, such as Bing's house with two rooms. A finer grid may help. Nothing helps
    /// if the vertices inside do not form a ball, which may happen where parts of a surface come close to
    /// each other. Growth then leaves out the few vertices where it would close a ring.
    ///
    /// - `tree`: the tree
    /// - `values`: the preferred order, as one value per grid vertex, the largest first; equal values in the
    ///   order of the tree. NULL: the order of the tree
    /// - `rank` (out): room for one number per grid vertex: 0 for the root, then 1, 2 and so on. UINT32_MAX
    ///   for vertices outside or not reached. Undefined after a failure other than `ICC_ERR_TOPOLOGY`
    /// - `report` (out): what was done, or NULL; also after `ICC_ERR_TOPOLOGY`
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is the vertex where growth got stuck
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_TOPOLOGY` if both got stuck. The vertices that growth has placed have their ranks, the
    ///   others UINT32_MAX. Remove these with `icc_grid_restrict()`, and the order has one critical vertex
    /// - `ICC_ERR_ARGUMENT`, for example if a value inside is NaN
    /// - `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: less than 2^(dim+3) tests a vertex, in practice about one: 0.1 us in 2-D, 0.3 us in 3-D. Memory:
    /// 6 bytes a grid vertex, and 8 a vertex inside for `values`.
    pub fn icc_tree_grow(
        tree: *const icc_tree,
        values: *const f64,
        rank: *mut u32,
        report: *mut icc_grow_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Counts the critical vertices of any order of the vertices inside, as `icc_function_get_report()` does
    /// for functions. It tests every link, wherever the order comes from. Only vertices that the tree reaches
    /// count.
    ///
    /// - `tree`: the tree
    /// - `rank`: one number per grid vertex, smaller for higher vertices; equal numbers count as in
    ///   `icc_function_get_report()`. Numbers of other vertices are ignored
    /// - `report` (out): its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    pub fn icc_tree_get_rank_report(
        tree: *const icc_tree,
        rank: *const u32,
        report: *mut icc_function_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Computes the constrained Delaunay triangulation of a simple polygon with points inside (2-D).
    ///
    /// All decisions are exact. Triangles are counter-clockwise (y upwards). No vertex is added, so a polygon
    /// of b vertices with p points inside always has b + 2 p - 2 triangles.
    ///
    /// - `n_boundary`: number of vertices of the polygon, in either orientation; they come first
    /// - `n_points`: number of all vertices, including those of the polygon
    /// - `points`: n_points * 2 coordinates
    /// - `triangles` (out): room for 3 * (2 * n_points - n_boundary - 2) vertex indices
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is a point that is not strictly inside the polygon, or that repeats
    ///   another
    ///
    /// Returns `ICC_OK`, `ICC_ERR_BOUNDARY`, `ICC_ERR_OUTSIDE`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY` or
    /// `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n log n) in practice, about 1 us and 100 bytes a vertex.
    pub fn icc_triangulate(
        n_boundary: usize,
        n_points: usize,
        points: *const f64,
        triangles: *mut u32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;
}

// icc/kernel.h

opaque!(
    /// The shape to be deformed: filled regions and curves.
    icc_shape
);

opaque!(
    /// Points spread over a shape.
    icc_sampling
);

// How samples are spread.
/// a regular grid that starts at the lower corner of the regions' box, the first axis fastest
pub const ICC_SAMPLING_GRID: i32 = 1;
/// blue noise: random but evenly spaced, also on boundaries and curves
pub const ICC_SAMPLING_BLUE: i32 = 2;
/// your own points: `icc_sampling_create_from_points()` only
pub const ICC_SAMPLING_POINTS: i32 = 3;

/// Options of `icc_sampling_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_sampling_options {
    /// set by the caller: `sizeof(icc_sampling_options)`
    pub size: usize,
    /// `ICC_SAMPLING_*`; 0: blue
    pub kind: i32,
    /// blue: steps of relaxation (inverse mean shift); 0: 60; -1: none
    pub steps: i32,
    /// T, the distance between neighbours. 0: 1/100 of the longest side, in 3-D 1/20. In 3-D half the spacing
    /// costs 60 times as much
    pub spacing: f64,
    /// grid: how far it extends beyond the regions, in spacings; 0: not at all
    pub margin: f64,
    /// blue: seed of the random numbers; equal seeds give equal samplings
    pub seed: u64,
    /// number of points that must be samples
    pub n_fixed: usize,
    /// blue: n_fixed * dim coordinates, or NULL
    pub fixed: *const f64,
}
sized!(icc_sampling_options);

/// What `icc_sampling_get_info()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_sampling_info {
    /// set by the caller: `sizeof(icc_sampling_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_SAMPLING_*`
    pub kind: i32,
    /// number of samples
    pub n_samples: usize,
    /// samples on boundaries and curves; with blue noise these come first
    pub n_edge: usize,
    /// T as requested; for your own points the mean distance of nearest neighbours
    pub spacing: f64,
    /// smallest distance between two samples, divided by T
    pub nearest: f64,
    /// suggested width of the kernel, from the samples' spectrum (figure 6.10). For a grid (3.28) and for
    /// your own points it is 3 T / pi
    pub sigma: f64,
}
sized!(icc_sampling_info);

opaque!(
    /// Handles, and the weight of each handle everywhere in a shape.
    icc_weights
);

// The kernel that interpolates weights between samples.
/// Wendland's C2 function of radius 3 sigma: smooth, and positive definite for any width
pub const ICC_KERNEL_WENDLAND: i32 = 1;
/// the thesis's kernel exp(-d^2 / (2 sigma^2)), cut off at `cutoff` sigma, where it jumps. Not always
/// positive definite
pub const ICC_KERNEL_GAUSS: i32 = 2;

// The weights that the optimisation starts from.
/// diffusion of an impulse at each handle (4.11, 4.12)
pub const ICC_INITIAL_HEAT: i32 = 1;
/// diffusion that keeps weights linear along the edges (4.7, 4.13)
pub const ICC_INITIAL_EDGES: i32 = 2;
/// inverse squared distance to the handles (4.10), where p is a tenth of their extent
pub const ICC_INITIAL_INVERSE: i32 = 3;
/// your own: `icc_weights_options.initial_weights`
pub const ICC_INITIAL_GIVEN: i32 = 4;

// How weights are found. They always sum to 1. All methods except biharmonic treat each sample by itself, and
// their weights reproduce the sample.
/// least squared change of the initial weights, none negative (4.1)
pub const ICC_WEIGHTS_QP: i32 = 1;
/// least squared change, of any sign (4.2 to 4.6)
pub const ICC_WEIGHTS_EQUALITY: i32 = 2;
/// least sum of absolute changes (4.8). Of several solutions, the one with the least sum of squared changes
pub const ICC_WEIGHTS_L1: i32 = 3;
/// Bounded biharmonic weights (Jacobson et al. 2011), for comparison. In the plane only, where every handle
/// and sample lies in a region, and every region that encloses none has a handle. No two walls may be so
/// close that rounded points on them touch.
///
/// The weight of each handle lies between 0 and 1 and has the least integral of squared Laplacians, by finite
/// elements on a mesh of the nodes. Enclosed regions come first, and the region around continues their
/// weights. Then the weights of each node are divided by their sum.
///
/// These weights do not reproduce points: if handles are translated to the places that an affine map gives
/// them, the shape does not follow that map. Initial weights have no influence, but `ICC_INITIAL_EDGES` keeps
/// edges linear. After painting, negative weights become 0 and the weights are divided by their sum.
///
/// Cost: some 25 sparse factorisations for each handle, more for finer samplings
pub const ICC_WEIGHTS_BIHARMONIC: i32 = 4;

/// A segment that stays straight, because weights are linear along it (5.6). It has nodes at both ends and
/// between them, at most one spacing apart. Nodes beside the line follow it, nearer ones more closely. For
/// the best spacing, make the sampling with these places as fixed points.
///
/// An end may be a handle, or an end of an earlier line. Lines should not cross. Where a line comes near a
/// handle or an earlier line, the handle or the earlier line prevails. The weights of a parallel line follow
/// from those of the other line and can be negative. Nodes beside a parallel line keep their weights, so
/// between its nodes it is straight only to a few hundredths.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_line {
    /// one end, in the shape, at least half a spacing away from the other
    pub from: [f64; 3],
    /// the other end
    pub to: [f64; 3],
    /// 0, or k to stay parallel to the earlier line k - 1 (5.11). The two must be parallel to within 1e-9 of
    /// their length, and `to` must be neither a handle nor on an earlier line
    pub parallel: i32,
}
zeroed!(icc_line);

/// Options of `icc_weights_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_weights_options {
    /// set by the caller: `sizeof(icc_weights_options)`
    pub size: usize,
    /// `ICC_KERNEL_*`; 0: Wendland
    pub kernel: i32,
    /// `ICC_INITIAL_*`; 0: edges if there are any, else heat
    pub initial: i32,
    /// `ICC_WEIGHTS_*`; 0: QP
    pub method: i32,
    /// steps of diffusion; 0: 5
    pub steps: i32,
    /// 0 or 1: add an affine function to the kernels, so that sums and reproduction are exact between the
    /// samples. -1: do not, as in the thesis
    pub affine_tail: i32,
    /// 0 or 1: weights diffuse only between samples that see each other inside the shape. -1: also through
    /// walls, as in the thesis
    pub within_shape: i32,
    /// width of the kernel; 0: `icc_sampling_info.sigma`
    pub sigma: f64,
    /// Gauss: radius in units of sigma; 0: 5
    pub cutoff: f64,
    /// number of edges between handles
    pub n_edges: usize,
    /// n_edges * 2 handle indices, or NULL
    pub edges: *const u32,
    /// number of lines to keep straight
    pub n_lines: usize,
    /// n_lines lines, or NULL
    pub lines: *const icc_line,
    /// for `ICC_INITIAL_GIVEN`: n_samples * n_handles weights, sample after sample
    pub initial_weights: *const f64,
}
sized!(icc_weights_options);

/// What `icc_weights_get_info()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_weights_info {
    /// set by the caller: `sizeof(icc_weights_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_KERNEL_*`
    pub kernel: i32,
    /// `ICC_INITIAL_*`
    pub initial: i32,
    /// `ICC_WEIGHTS_*`
    pub method: i32,
    /// number of handles
    pub n_handles: usize,
    /// places that carry weights: the handles, then places on lines, then the samples. Samples within half a
    /// spacing of a handle or of a line's node are left out
    pub n_nodes: usize,
    /// QP: nodes outside the handles' convex hull, which no non-negative weights reproduce. There QP is
    /// relaxed, but weights still sum to 1
    pub n_infeasible: usize,
    /// kernel values in the matrix: one triangle with the diagonal
    pub n_entries: usize,
    /// width of the kernel
    pub sigma: f64,
    /// smallest pivot of the matrix over the greatest: near 0 it almost loses positive definiteness
    pub definiteness: f64,
    /// Weights from `icc_weights_stiffen()`: how far they are from the optimum. It is the step that is still
    /// possible down the energy's projected gradient, divided by the one at the start. Biharmonic weights:
    /// the largest change of a single weight that would lower the energy, before weights are divided by their
    /// sum. Else 0
    pub residual: f64,
}
sized!(icc_weights_info);

/// What `icc_weights_get_timings()` reports: seconds for each step of making weights. For weights that were
/// made from others, steps that were not repeated keep the earlier times.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_weights_timings {
    /// set by the caller: `sizeof(icc_weights_timings)`
    pub size: usize,
    /// placing the nodes, and factorising the matrix
    pub factor: f64,
    /// the initial weights
    pub initial: f64,
    /// the optimisation
    pub optimise: f64,
}
sized!(icc_weights_timings);

/// What `icc_weights_get_report()` reports: the quality of weights, measured at your points.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_weights_report {
    /// set by the caller: `sizeof(icc_weights_report)`
    pub size: usize,
    /// `icc_weights_info.n_infeasible`
    pub n_infeasible: usize,
    /// points where a weight is below -1e-9
    pub n_negative: usize,
    /// largest deviation of the sum of weights from 1
    pub unity: f64,
    /// largest distance between a point and the weighted mean of the handles
    pub reproduction: f64,
    /// mean of these distances
    pub reproduction_mean: f64,
    /// largest deviation from 1 and 0 at the handles
    pub lagrange: f64,
    /// largest deviation from linear weights along the edges
    pub linearity: f64,
    /// smallest weight
    pub least_weight: f64,
    /// `icc_weights_info.definiteness`
    pub definiteness: f64,
}
sized!(icc_weights_report);

opaque!(
    /// Points with their weights, and derivatives if requested. Use it to pose the same points repeatedly.
    icc_binding
);

extern "C" {
    /// Makes a shape from regions and curves, which may be mixed.
    ///
    /// *Regions* are domains. Their boundaries must not meet, which is checked exactly. One region may lie
    /// within another. A point belongs to the innermost region around it, and a point on a boundary belongs
    /// to the region that the boundary encloses. For example, a star in a square makes two regions: the star
    /// and its surroundings.
    ///
    /// Boundaries are walls. Weights spread across a wall only outward, from the enclosed region to its
    /// surroundings. So they take no short cut through the surroundings from one limb to another.
    ///
    /// *Curves* are segments between vertices. They may lie anywhere and are not walls. A sheet in space is
    /// given by the edges of its triangles, each about as long as the spacing of the samples.
    ///
    /// - `out` (out): the shape; owned by the caller. It keeps the regions alive
    /// - `dim`: 2 or 3
    /// - `n_regions`: number of regions; 0 for curves alone
    /// - `regions`: n_regions domains of dimension `dim`
    /// - `n_vertices`: number of vertices of the curves
    /// - `vertices`: n_vertices * dim coordinates
    /// - `n_segments`: number of segments of the curves
    /// - `segments`: n_segments * 2 vertex indices
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is the region, vertex or segment at fault
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if there is no region and no segment, a vertex is not finite or does not exist,
    ///   or a segment has no length
    /// - `ICC_ERR_BOUNDARY` if boundaries meet
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    pub fn icc_shape_create(
        out: *mut *mut icc_shape,
        dim: i32,
        n_regions: usize,
        regions: *const *const icc_domain,
        n_vertices: usize,
        vertices: *const f64,
        n_segments: usize,
        segments: *const u32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a shape.
    pub fn icc_shape_free(shape: *mut icc_shape);

    /// Spreads samples over a shape. No sample ends up on the wrong side of a wall.
    ///
    /// With blue noise, boundaries and curves first get fixed samples about T apart, starting with their
    /// ends, forks and corners. The other samples start from a jittered lattice and are relaxed (6.4), but
    /// stay at least 0.4 T away from boundaries. Fixed points stay where they are, and samples on boundaries
    /// make room for them.
    ///
    /// - `out` (out): the sampling; owned by the caller. It keeps the shape alive
    /// - `shape`: the shape
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_RESOLUTION` if no sample lies inside some region, which `err` names, or there would be more
    ///   than 2^24 samples
    /// - `ICC_ERR_OUTSIDE` if a fixed point is in no region
    /// - `ICC_ERR_ARGUMENT`, for example for a grid on curves alone or a fixed point that is not finite
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(steps * n) time and O(n) memory; 10,000 samples take less than a second.
    pub fn icc_sampling_create(
        out: *mut *mut icc_sampling,
        shape: *const icc_shape,
        options: *const icc_sampling_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a sampling from your own points, which keep their order. The suggested width follows from their
    /// mean spacing.
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_OUTSIDE` if a point, given by `index`, lies in no region and on no curve
    /// - `ICC_ERR_ARGUMENT` if a point is not finite or two points coincide
    /// - `ICC_ERR_MEMORY`
    pub fn icc_sampling_create_from_points(
        out: *mut *mut icc_sampling,
        shape: *const icc_shape,
        n: usize,
        points: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a sampling.
    pub fn icc_sampling_free(sampling: *mut icc_sampling);

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_sampling_get_info(sampling: *const icc_sampling, info: *mut icc_sampling_info) -> icc_status;

    /// Copies the samples; `points` has room for n_samples * dim doubles. Returns `ICC_OK` or
    /// `ICC_ERR_ARGUMENT`.
    pub fn icc_sampling_get_points(sampling: *const icc_sampling, points: *mut f64) -> icc_status;

    /// Writes a sampling and its shape to memory. Call it twice: with capacity 0 for the number of bytes,
    /// then with a buffer of that size. The format (docs/reference/formats.md) is versioned, the same on
    /// every machine, and has a checksum.
    ///
    /// - `sampling`: the sampling
    /// - `capacity`: number of bytes that `data` has room for
    /// - `data` (out): NULL if capacity is 0
    /// - `n_bytes` (out): number of bytes needed. If it exceeds `capacity`, nothing useful is written
    pub fn icc_sampling_save(
        sampling: *const icc_sampling,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a sampling back, bit for bit. Returns `ICC_ERR_FORMAT` for bytes that `icc_sampling_save()` did
    /// not write, and `ICC_ERR_VERSION` for bytes that a later version wrote. Any bytes are safe to pass.
    pub fn icc_sampling_load(
        out: *mut *mut icc_sampling,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes weights for handles.
    ///
    /// - `out` (out): the weights; owned by the caller. They keep the sampling alive
    /// - `sampling`: the samples
    /// - `n_handles`: number of handles, at least dim + 1
    /// - `handles`: n_handles * dim coordinates in the shape, not all in one plane (2-D: on one line)
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` is the handle, edge or line at fault
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_OUTSIDE` if a handle or line is outside the shape
    /// - `ICC_ERR_ARGUMENT`, for example if two handles coincide, the handles cannot reproduce points, or
    ///   weights are not finite
    /// - `ICC_ERR_SOLVER` if sigma is too large for a positive definite matrix, or biharmonic weights are not
    ///   found on a mesh with very thin triangles
    /// - `ICC_ERR_UNSUPPORTED`, `ICC_ERR_ARGUMENT` or `ICC_ERR_RESOLUTION` if biharmonic weights do not exist
    ///   for the shape, see `ICC_WEIGHTS_BIHARMONIC`
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost for n nodes, m handles and k neighbours within the kernel's reach: O(steps n k m) and a sparse
    /// factorisation, O(n^1.5) in 2-D.
    pub fn icc_weights_create(
        out: *mut *mut icc_weights,
        sampling: *const icc_sampling,
        n_handles: usize,
        handles: *const f64,
        options: *const icc_weights_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees weights.
    pub fn icc_weights_free(weights: *mut icc_weights);

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_weights_get_info(weights: *const icc_weights, info: *mut icc_weights_info) -> icc_status;

    /// Fills in `timings`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_weights_get_timings(
        weights: *const icc_weights,
        timings: *mut icc_weights_timings,
    ) -> icc_status;

    /// Copies the nodes and their weights.
    ///
    /// - `weights`: the weights
    /// - `points` (out): n_nodes * dim coordinates, or NULL
    /// - `initial` (out): n_nodes * n_handles initial weights, or NULL
    /// - `values` (out): n_nodes * n_handles weights, or NULL
    /// - `status` (out): n_nodes statuses, or NULL: `ICC_OK`, or `ICC_ERR_SOLVER` where QP was relaxed
    pub fn icc_weights_get_nodes(
        weights: *const icc_weights,
        points: *mut f64,
        initial: *mut f64,
        values: *mut f64,
        status: *mut icc_status,
    ) -> icc_status;

    /// Paints weights. The brush falls smoothly from 1 at the centre to 0 at the radius. Amount * brush is
    /// added to the weight of one handle at the nodes around a place, and these nodes are optimised again
    /// from there. Handles, nodes on lines and nodes on edges keep their weights.
    ///
    /// - `out` (out): new weights at the same nodes; owned by the caller. The old ones do not change
    /// - `weights`: the weights to change
    /// - `handle`: the handle whose weight is painted
    /// - `centre`: dim coordinates
    /// - `radius`: positive
    /// - `amount`: positive or negative
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Cost: one optimisation for each node within the radius, and one solve with the existing factor.
    pub fn icc_weights_paint(
        out: *mut *mut icc_weights,
        weights: *const icc_weights,
        handle: usize,
        centre: *const f64,
        radius: f64,
        amount: f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Like `icc_weights_paint()`, with weights of your own: node nodes\[i\] starts from values\[i *
    /// n_handles ...\] and is optimised again. No node may be named twice.
    pub fn icc_weights_repaint(
        out: *mut *mut icc_weights,
        weights: *const icc_weights,
        n: usize,
        nodes: *const u32,
        values: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes weights with the same nodes and initial weights but another method (`ICC_WEIGHTS_*`). Painting
    /// and stiffening are lost, as in the thesis (6.3.1). Fails if `icc_weights_create()` would.
    pub fn icc_weights_with_method(
        out: *mut *mut icc_weights,
        weights: *const icc_weights,
        method: i32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a part of the shape move as if it were rigid: weights vary there as little as possible (5.12 to
    /// 5.35, with the sign of 5.35a corrected).
    ///
    /// This is one quadratic program for the weights at the part's nodes and at the nodes around it, within
    /// the kernel's reach. Its value is half the sum of squared derivatives at the part's nodes, weighted by
    /// `rigidity`. Derivatives of the change around the part count with a tenth of the mean rigidity.
    ///
    /// Weights still sum to 1 and reproduce points. Handles, nodes on edges and lines, and all nodes further
    /// away keep their weights. With QP, no weight becomes negative at a node where none was. There are no
    /// other conditions. The residual of the optimality conditions (`icc_weights_info.residual`) is at most
    /// 1e-8, and the program's value is within 1e-6 of its minimum.
    ///
    /// - `out` (out): new weights; owned by the caller
    /// - `weights`: the weights to change
    /// - `n`: number of nodes of the part
    /// - `nodes`: their indices
    /// - `rigidity`: n positive numbers, the importance of each node; NULL: all equal
    /// - `energy`: half the weighted sum of squared derivatives at the part's nodes, before and after; or
    ///   NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if a node does not exist or is named twice, or a rigidity is not positive
    /// - `ICC_ERR_SOLVER` if it was not solved within the limit of steps
    /// - `ICC_ERR_UNSUPPORTED` for biharmonic weights
    /// - `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: some hundred steps, each a product with a matrix of these nodes or two partial solves; memory in
    /// proportion to the weights of these nodes and to the pairs of nodes within the kernel's reach.
    pub fn icc_weights_stiffen(
        out: *mut *mut icc_weights,
        weights: *const icc_weights,
        n: usize,
        nodes: *const u32,
        rigidity: *const f64,
        energy: *mut f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Evaluates weights at points. Returns `ICC_OK` even if every point failed: check `status` or
    /// `n_failed`.
    ///
    /// - `weights`: the weights
    /// - `n`: number of points
    /// - `points`: n * dim coordinates. Any finite point has weights. Far from all nodes they are those of
    ///   the affine tail, or 0 without it
    /// - `values` (out): n * n_handles weights
    /// - `gradients` (out): n * n_handles * dim derivatives, or NULL (3.44)
    /// - `status` (out): n statuses, or NULL: `ICC_OK`, or `ICC_ERR_ARGUMENT` for a point that is not finite,
    ///   whose values are NaN
    /// - `n_failed` (out): number of points without weights, or NULL
    /// - `env`: may be NULL
    pub fn icc_weights_evaluate(
        weights: *const icc_weights,
        n: usize,
        points: *const f64,
        values: *mut f64,
        gradients: *mut f64,
        status: *mut icc_status,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// Evaluates the dual function of a node (3.2): the interpolant that is 1 at this node and 0 at all other
    /// nodes. Weights are the sum of these functions, each times the weights at its node. With the affine
    /// tail these functions sum to 1 and reproduce points.
    ///
    /// - `weights`: any weights on the nodes: only nodes, kernel and tail matter
    /// - `node`: its number, as in `icc_weights_get_nodes()`
    /// - `n`: number of points
    /// - `points`: n * dim coordinates
    /// - `values` (out): n numbers
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if the node does not exist or a point is not finite
    /// - `ICC_ERR_MEMORY` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: one solve with the existing factor, and an evaluation for each point.
    pub fn icc_weights_get_dual(
        weights: *const icc_weights,
        node: usize,
        n: usize,
        points: *const f64,
        values: *mut f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Measures the weights at n points (n * dim coordinates). Set the `size` of the report first.
    pub fn icc_weights_get_report(
        weights: *const icc_weights,
        n: usize,
        points: *const f64,
        report: *mut icc_weights_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Binds points to handles.
    ///
    /// - `out` (out): the binding; owned by the caller. It no longer needs the weights
    /// - `weights`: the weights
    /// - `n`: number of points
    /// - `points`: n * dim coordinates, finite
    /// - `derivatives`: 1: poses have Jacobians, which takes dim * n_handles more doubles a point; else 0
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    pub fn icc_binding_create(
        out: *mut *mut icc_binding,
        weights: *const icc_weights,
        n: usize,
        points: *const f64,
        derivatives: i32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a binding.
    pub fn icc_binding_free(binding: *mut icc_binding);

    /// Reports the numbers of points, handles and dimensions; each pointer may be NULL.
    pub fn icc_binding_get_counts(
        binding: *const icc_binding,
        n_points: *mut usize,
        n_handles: *mut usize,
        dim: *mut i32,
    ) -> icc_status;

    /// Copies the handles' positions, n_handles * dim, and the weights, n_points * n_handles; each pointer
    /// may be NULL.
    pub fn icc_binding_get_weights(
        binding: *const icc_binding,
        handles: *mut f64,
        weights: *mut f64,
    ) -> icc_status;

    /// Poses the points: x -> sum of w_j(x) (A_j x + b_j) (3.37). It is computed as x + sum of w_j(x) (A_j x
    /// + b_j - x), which is the same where weights sum to 1. So the rest pose is exact.
    ///
    /// - `binding`: the binding
    /// - `transforms`: n_handles * dim * (dim + 1) numbers: for each handle the rows of (A | b)
    /// - `images` (out): n * dim coordinates
    /// - `jacobians` (out): n * dim * dim derivatives of the images by the points; NULL if not needed. The
    ///   binding must have derivatives
    /// - `env`: may be NULL
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if a transform is not finite
    /// - `ICC_ERR_UNSUPPORTED` if the binding has no derivatives
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    pub fn icc_binding_pose(
        binding: *const icc_binding,
        transforms: *const f64,
        images: *mut f64,
        jacobians: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// Writes a binding to memory, as `icc_sampling_save()` does a sampling.
    pub fn icc_binding_save(
        binding: *const icc_binding,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a binding back, as `icc_sampling_load()` does a sampling.
    pub fn icc_binding_load(
        out: *mut *mut icc_binding,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Writes the rest pose to `transforms`: n_handles identities, see `icc_binding_pose()`.
    pub fn icc_pose_reset(dim: i32, n_handles: usize, transforms: *mut f64) -> icc_status;

    /// Moves one handle: adds `offset`, dim numbers, to its transform.
    pub fn icc_pose_move(dim: i32, transform: *mut f64, offset: *const f64) -> icc_status;

    /// Rotates a handle about its posed position, where its transform has taken it.
    ///
    /// - `dim`: 2 or 3
    /// - `transform`: the handle's transform, dim * (dim + 1) numbers
    /// - `handle`: the handle's position at rest, dim coordinates
    /// - `axis`: 3-D: 3 numbers, not all 0; ignored in 2-D
    /// - `angle`: radians, counter-clockwise (2-D: y upwards; 3-D: seen from the axis' tip)
    pub fn icc_pose_turn(
        dim: i32,
        transform: *mut f64,
        handle: *const f64,
        axis: *const f64,
        angle: f64,
    ) -> icc_status;
}

// icc/fit.h

/// Options of `icc_map_create_nearest()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_nearest_options {
    /// set by the caller: `sizeof(icc_nearest_options)`
    pub size: usize,
    /// number of vertices whose images must stay as given
    pub n_held: usize,
    /// n_held vertices of the mesh, or NULL
    pub held: *const u32,
}
sized!(icc_nearest_options);

// How a folded map became one-to-one.
/// it was one-to-one: nothing was changed
pub const ICC_REPAIR_NONE: i32 = 0;
/// folded patches were mapped anew. Features pass one another as they do outside of the patches
pub const ICC_REPAIR_PATCHES: i32 = 1;
/// everything was mapped anew, because the folded patches could not be told apart. The map may turn around
/// some features in another way than the given one
pub const ICC_REPAIR_WHOLE: i32 = 2;

/// What `icc_map_create_nearest()` has done.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_nearest_report {
    /// set by the caller: `sizeof(icc_nearest_report)`
    pub size: usize,
    /// `ICC_REPAIR_*`
    pub repair: i32,
    /// cells of the given mesh whose image is flat or reversed
    pub n_folded: usize,
    /// patches that were mapped anew
    pub n_patches: usize,
    /// their share of the source's area
    pub changed: f64,
    /// root mean square distance of the given vertices from their given images, over all of them
    pub moved: f64,
    /// largest such distance
    pub most_moved: f64,
    /// Newton steps
    pub n_iterations: usize,
}
sized!(icc_nearest_report);

opaque!(
    /// A map that is made from constraints.
    icc_fit
);

// Kinds of constraints: `icc_constraint.kind`.
/// points go to their targets. They may lie anywhere
pub const ICC_CONSTRAINT_POINTS: i32 = 1;
/// a polyline goes to a polyline: vertex to vertex, and edge to edge linearly. In a mesh it runs along edges.
/// Without a domain and mesh, lines may begin, end and meet at vertices that they have in common, and they
/// are exact
pub const ICC_CONSTRAINT_LINE: i32 = 2;
/// vertices of the domain, or of the mesh, go to their targets. An edge of the boundary goes along linearly
/// if both its ends are told
pub const ICC_CONSTRAINT_VERTICES: i32 = 3;
/// vertices of the domain or of the mesh may move along a straight line only
pub const ICC_CONSTRAINT_SLIDING: i32 = 4;

/// A part of what you know about a map: where some points, a line or some vertices go.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_constraint {
    /// set by the caller: `sizeof(icc_constraint)`, the same for all elements of an array
    pub size: usize,
    /// `ICC_CONSTRAINT_*`
    pub kind: i32,
    /// number of its points or vertices; of a line at least 2
    pub n: usize,
    /// points and lines: 2 n coordinates. Otherwise NULL
    pub source: *const f64,
    /// vertices and sliding: n numbers. Otherwise NULL
    pub vertices: *const u32,
    /// 2 n coordinates. Sliding: a point of each line, or NULL for the vertex itself
    pub target: *const f64,
    /// sliding: 2 n coordinates, the direction of each line in the target. NULL: the direction of the
    /// boundary at the vertex, which must be straight there. Otherwise NULL
    pub direction: *const f64,
    /// points, with the spline: how far each may be off its target, such as the standard deviation of its
    /// measurement; 0: not at all. NULL: all are exact
    pub tolerance: *const f64,
}
sized!(icc_constraint);

// How a fit carries everything that is not told: `icc_fit_options.model`.
/// as smoothly as possible: of all functions through the points the one that bends the least inside the
/// region. Affine functions do not bend, so three points give their affine map. For maps and pictures. It
/// takes points and lines, and neither a domain nor a mesh
pub const ICC_FIT_SPLINE: i32 = 1;
/// as rigidly as possible: every small piece keeps its shape and size. For characters, and for meshes whose
/// boundary moves
pub const ICC_FIT_ELASTIC: i32 = 2;

/// Options of `icc_fit_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_fit_options {
    /// set by the caller: `sizeof(icc_fit_options)`
    pub size: usize,
    /// `ICC_FIT_*`; 0: the spline without a domain and mesh, else elastic
    pub model: i32,
    /// without a domain and mesh: the box that the map covers at least, lower and upper corner; NULL: the
    /// bounding box of the points
    pub r#box: *const f64,
    /// without a domain and mesh: how far the map reaches beyond the box, as a share of its longest side, at
    /// most 1000. Near: distortions of the whole, as of an old map. Far: local ones. 0: chosen by leaving
    /// each point out in turn
    pub margin: f64,
    /// spline: 0: points with a tolerance are smoothed as leaving each point out in turn suggests. Above 0: a
    /// factor, larger for smoother. Negative: all points are exact
    pub smoothing: f64,
    /// elastic: a length in the source: how far a point carries its surroundings along. 0: as far as the mesh
    /// makes it, so a single point pulls a spike
    pub reach: f64,
    /// elastic: cells are stiffer by their area to the power of minus this number, from 0 to 3. 0: all alike.
    /// 1.5: thin layers of cells along a wall move as if glued to it
    pub stiffness: f64,
    /// elastic, with a mesh: a further factor above 0 for each cell; or NULL
    pub cell_stiffness: *const f64,
    /// elastic, with a domain: the longest edge of the mesh that libicc makes, as a length in the source; 0:
    /// chosen
    pub cell: f64,
    /// elastic, 1: parts of the free outline may come to lie on each other. Then the result is refused if
    /// they do. 0: they push each other away
    pub no_contact: i32,
}
sized!(icc_fit_options);

/// What `icc_fit_get_info()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_fit_info {
    /// set by the caller: `sizeof(icc_fit_info)`
    pub size: usize,
    /// `ICC_FIT_*`: never 0
    pub model: i32,
    /// points and vertices of all constraints
    pub n_items: usize,
    /// spline: as used
    pub margin: f64,
    /// spline: as used; 0: all points are exact
    pub smoothing: f64,
    /// root mean square distance of the images of points from their targets
    pub residual: f64,
    /// spline: root mean square distance of the targets from where the other points alone would take them. An
    /// honest estimate of the accuracy between points. NaN if not known
    pub left_out: f64,
    /// spline: like `residual`, of the best affine map alone
    pub affine_residual: f64,
    /// elastic: number of exact and sliding items that were not reached, because the shape would have
    /// overlapped or folded on the way
    pub n_off: usize,
    /// elastic: the largest distance of such an item from its target or line
    pub most_off: f64,
    /// spline: `ICC_REPAIR_*`
    pub repair: i32,
    /// spline: triangles of the model that are flat or reversed
    pub n_folded: usize,
    /// spline: patches that were mapped anew
    pub n_patches: usize,
    /// spline: their share of the area
    pub changed: f64,
    /// Newton steps
    pub n_iterations: usize,
}
sized!(icc_fit_info);

extern "C" {
    /// Makes the one-to-one map that is nearest to any given warp: a thin plate, a polynomial, a displacement
    /// field, a neural field or a pose, sampled at the vertices of a mesh.
    ///
    /// If every triangle keeps its orientation and the image of the boundary is simple, the map is the given
    /// one, bit for bit. So this is also the way to make an `icc_map` of a mesh map from another program.
    /// Otherwise the folded triangles and their surroundings are cut out and mapped anew. From there, the map
    /// goes back towards the given images as far as triangles stay positive. "Near" is measured by the
    /// squared difference of the derivatives, with a small share of the symmetric Dirichlet energy, which
    /// keeps triangles from collapsing.
    ///
    /// A collar around the patches gives way a little. Beyond it, the images do not change at all. All
    /// vertices stay where they are in the source and keep their numbers. Patches may get new vertices, with
    /// higher numbers, and other triangles.
    ///
    /// The images of the boundary's vertices and of held ones do not change. So the image of the boundary
    /// must be simple already, and held images must lie inside it. Holes are allowed. Held vertices inside
    /// become point features of the map.
    ///
    /// - `out` (out): the map; owned by the caller. It has no charts
    /// - `mesh`: a conforming mesh of triangles in one piece. It may have holes
    /// - `images`: 2 n_vertices coordinates
    /// - `options`: may be NULL
    /// - `report` (out): may be NULL; its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `side` is 1 if the mesh is at fault and 2 if its images are
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_BOUNDARY` if the mesh is not valid, or if the image of its boundary meets itself
    /// - `ICC_ERR_TOPOLOGY` if the mesh has several pieces
    /// - `ICC_ERR_ARGUMENT`, also if the images are a mirror image: change the sign of one coordinate
    /// - `ICC_ERR_CERTIFICATE` if no one-to-one map was found
    /// - `ICC_ERR_RESOLUTION` if a coordinate is too small beside the others for exact signs
    /// - `ICC_ERR_UNSUPPORTED` if the mesh is not in the plane
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: below 1 us a triangle if nothing folds. Otherwise about 20 us for each triangle in and around
    /// the patches. Deterministic.
    pub fn icc_map_create_nearest(
        out: *mut *mut icc_map,
        mesh: *const icc_mesh,
        images: *const f64,
        options: *const icc_nearest_options,
        report: *mut icc_nearest_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a map from what is known of it. Pass a domain, a mesh or neither.
    ///
    /// *Neither*: the map covers a box around the points and lines. This is the way to use control points on
    /// a map or a picture, and rivers or roads that are known on both sides. One point gives a shift, and two
    /// points give a similarity.
    ///
    /// *A domain*: its outline is free except where constraints tell it. It may have holes, but no lines and
    /// points. libicc makes the mesh. This is the way to pose a figure by pins.
    ///
    /// *A mesh*: it is kept, vertex for vertex and cell for cell. It may have holes. Its cells are triangles
    /// or, with offsets, convex quadrilaterals, which stay convex. In the map each quadrilateral is two
    /// triangles. This is the way to move a wall in a mesh.
    ///
    /// Exact items end exactly at their targets. If an elastic shape cannot get there without folding or
    /// overlapping, the result is the map as far as it got: check `icc_fit_info.n_off`.
    ///
    /// - `out` (out): the fit; owned by the caller, see `icc_fit_free()`
    /// - `domain`: a domain of the plane, or NULL
    /// - `mesh`: a mesh of triangles and quadrilaterals in the plane, or NULL
    /// - `n_constraints`: at least 1
    /// - `constraints`: n_constraints of them; they are copied
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; if an item is at fault, `index` counts it over all constraints
    ///   (`ICC_ITEM_POINT`). `side` is 1 for the source, and 2 for the target
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_ARGUMENT` if two items coincide and have different targets, if a number is not finite or
    ///   too small beside the others, or if an option does not suit the model. For control points also if
    ///   different exact ones have the same target, if a part of a line has no length, or if the targets
    ///   mirror the points or lie on a line
    /// - `ICC_ERR_OUTSIDE` if a point is not inside the domain
    /// - `ICC_ERR_BOUNDARY` if the mesh is not valid
    /// - `ICC_ERR_TOPOLOGY` if the mesh has several pieces
    /// - `ICC_ERR_RESOLUTION` if points are too close together beside the box, or if the cell is so small
    ///   that there would be more than four million triangles
    /// - `ICC_ERR_CERTIFICATE` if no one-to-one map was found, or if lines meet one another, a point or the
    ///   outline
    /// - `ICC_ERR_UNSUPPORTED` if the domain or mesh is not in the plane, if the domain is a mask or has
    ///   lines or points, or for vertices without a domain and mesh
    /// - `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: control points some 30 ms up to 100 and 0.6 s for 3,000, several times as much if they fold.
    /// Figures and meshes 5 to 20 us for each triangle, several times as much where they turn far or touch.
    /// Deterministic.
    pub fn icc_fit_create(
        out: *mut *mut icc_fit,
        domain: *const icc_domain,
        mesh: *const icc_mesh,
        n_constraints: usize,
        constraints: *const icc_constraint,
        options: *const icc_fit_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes the fit to targets that have moved, starting from `fit`. Use it while something is dragged. An
    /// elastic fit keeps its mesh and continues from its present shape. A spline keeps its margin, its
    /// smoothing and its factorised system, so that it only has to be solved, and repaired where it folds.
    /// Where the spline needs a finer mesh, its triangles may change.
    ///
    /// - `out` (out): the fit; owned by the caller
    /// - `fit`: the fit before. It does not change
    /// - `targets`: 2 n_items coordinates: the targets of all items, constraint after constraint
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns as `icc_fit_create()`
    pub fn icc_fit_move(
        out: *mut *mut icc_fit,
        fit: *const icc_fit,
        targets: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a fit and its map.
    pub fn icc_fit_free(fit: *mut icc_fit);

    /// The map; borrowed.
    pub fn icc_fit_map(fit: *const icc_fit) -> *const icc_map;

    /// Fills in `info`, whose `size` you have set. Returns `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_fit_get_info(fit: *const icc_fit, info: *mut icc_fit_info) -> icc_status;

    /// Copies how far each item is off.
    ///
    /// - `fit`: the fit
    /// - `residuals` (out): 2 n_items coordinates: the image of each item minus its target; or NULL. Sliding
    ///   vertices: minus the nearest point of their line
    /// - `left_out` (out): 2 n_items coordinates: where the other points alone would take each point, minus
    ///   its target. NaN where that is not known: for items that are no points, and for the elastic model. Or
    ///   NULL
    ///
    /// Returns `ICC_OK` or `ICC_ERR_ARGUMENT`
    pub fn icc_fit_get_residuals(fit: *const icc_fit, residuals: *mut f64, left_out: *mut f64) -> icc_status;
}

// icc/coverage.h

opaque!(
    /// Two layers of the same regions, with common vertices.
    icc_coverage
);

// What `icc_coverage_create()` does with borders that only one of the two layers has.
/// it fails, and names one of them
pub const ICC_UNMATCHED_REFUSE: i32 = 1;
/// it goes on without the regions at these borders, see `icc_coverage_create()`
pub const ICC_UNMATCHED_LEAVE_OUT: i32 = 2;

/// A layer of regions. It belongs to the caller and is only read. A region is all rings with its number: an
/// outer ring for each of its pieces, and its holes. Rings may run either way.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_layer {
    /// set by the caller: `sizeof(icc_layer)`
    pub size: usize,
    /// at least 1
    pub n_rings: usize,
    /// n_rings + 1 numbers, from 0 on: the vertex that each ring begins with, and the number of all vertices.
    /// A ring has at least 3
    pub first: *const usize,
    /// 2 coordinates for each vertex
    pub vertices: *const f64,
    /// n_rings: the number of the region, any number
    pub ids: *const i64,
    /// n_rings: 1 if the ring is a hole of its region, else 0. NULL: no ring is a hole
    pub holes: *const u8,
}
sized!(icc_layer);

/// Options of `icc_coverage_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_coverage_options {
    /// set by the caller: `sizeof(icc_coverage_options)`
    pub size: usize,
    /// the weld length of the source and of the target, each in its own coordinates. Vertices within this
    /// length become one, and a vertex within this length of a side becomes part of it. 0: only places that
    /// are exactly equal, and vertices that lie exactly on a side
    pub weld: [f64; 2],
    /// how vertices along a border are paired: `ICC_BETWEEN_*`; 0: elastic
    pub between: i32,
    /// `ICC_UNMATCHED_*`; 0: refuse
    pub unmatched: i32,
    /// number of regions that are left out of both layers from the start
    pub n_left_out: usize,
    /// n_left_out numbers of regions; they need not exist
    pub left_out: *const i64,
}
sized!(icc_coverage_options);

/// What `icc_coverage_get_info()` reports. Of two numbers, the first belongs to the source and the second to
/// the target.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_coverage_info {
    /// set by the caller: `sizeof(icc_coverage_info)`
    pub size: usize,
    /// regions of the coverage
    pub n_regions: usize,
    /// its rings: `icc_coverage_get_features()`
    pub n_features: usize,
    /// its different common vertices
    pub n_vertices: usize,
    /// places where more than two borders begin
    pub n_nodes: usize,
    /// borders from node to node
    pub n_sides: usize,
    /// closed borders without a node
    pub n_islands: usize,
    /// nodes, borders and islands of which several have the same regions around them. They were paired by
    /// their places
    pub n_settled: usize,
    /// common vertices that are vertices of both layers
    pub n_joined: usize,
    /// what only one layer has: `icc_coverage_get_difference()`
    pub n_differences: usize,
    /// regions that one layer has and the coverage has not, or only in part
    pub n_left_out: usize,
    /// vertices given
    pub n_given: [usize; 2],
    /// vertices that moved to another one's place
    pub n_welded: [usize; 2],
    /// vertices put into sides that pass close by
    pub n_inserted: [usize; 2],
    /// vertices that stayed apart although each lies within the weld length of one that went elsewhere:
    /// together they would form a chain longer than the weld length. If there are any, the weld length is too
    /// long for this layer, or too short
    pub n_chains: [usize; 2],
    /// x and y of one of these vertices of the source, then of the target, if there are any
    pub chain: [f64; 4],
    /// how far a vertex moved at most; no more than the weld length
    pub most_moved: [f64; 2],
    /// the least distance left between a vertex and another vertex or a side that does not end there;
    /// HUGE_VAL if there is none
    pub least_apart: [f64; 2],
    /// x and y of the vertex there: source, target
    pub least_apart_at: [f64; 4],
}
sized!(icc_coverage_info);

// Kinds of differences: `icc_coverage_difference.kind`.
/// a region that one layer does not have
pub const ICC_DIFFERENCE_REGION: i32 = 1;
/// a border between nodes
pub const ICC_DIFFERENCE_BORDER: i32 = 2;
/// a closed border without a node: an island, a lake
pub const ICC_DIFFERENCE_ISLAND: i32 = 3;

/// Something that only one of the two layers has.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_coverage_difference {
    /// set by the caller: `sizeof(icc_coverage_difference)`
    pub size: usize,
    /// `ICC_DIFFERENCE_*`
    pub kind: i32,
    /// 1: only the source has it; 2: only the target
    pub side: i32,
    /// 1 or 2: the number of `ids`
    pub n_ids: i32,
    /// the region, or the regions on both sides of the border
    pub ids: [i64; 2],
    /// a vertex of it, in that layer's coordinates
    pub place: [f64; 2],
}
sized!(icc_coverage_difference);

extern "C" {
    /// Gives two layers of the same regions common vertices.
    ///
    /// 1. *Each layer is cleaned.* Vertices within the weld length of each other become one: a vertex moves
    /// to one that was given, and by no more than the weld length. A vertex within the weld length of a side
    /// is put into it. Sides that run back over themselves vanish, and so do sides between two pieces of one
    /// region. With a weld length of 0 all this happens only where it is exact. 2. *Nodes are found.* A node
    /// is a place where more than two sides meet. Its regions, in their order around it, tell which node of
    /// the other layer it is. If several nodes have the same regions around them, the pairs are those with
    /// the least sum of squared distances, after the affine map that fits all other nodes best. 3. *Borders
    /// are paired* by their two nodes, and by the regions left and right. Closed borders without a node, such
    /// as those of islands, are paired by their regions and their places. 4. *Along each border* the vertices
    /// are paired by shape, with both ends held, as `icc_match_create()` pairs lines. Each vertex of either
    /// layer becomes a common vertex. It lies on the border's segments in the other layer, up to rounding.
    ///
    /// With `ICC_UNMATCHED_LEAVE_OUT`, differences do not matter:
    ///
    /// - A region that only one layer has is left out.
    /// - An island or a lake that only one layer has is taken away. Its place becomes what is around it.
    /// - On both sides of another border that only one layer has, the piece of the region is left out. The
    ///   partner of such a piece in the other layer is left out as well. Where a piece is left out, nothing
    ///   is covered.
    ///
    /// The result has one feature for each ring, see `icc_coverage_get_features()`. The two domains,
    /// `icc_coverage_source()` and `icc_coverage_target()`, consist of these features. Give them to
    /// `icc_map_create()`.
    ///
    /// - `out` (out): the coverage; owned by the caller, see `icc_coverage_free()`
    /// - `source`: the first layer
    /// - `target`: the second layer; it may have other coordinates
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `side` tells which layer is at fault. `index` is a ring (`ICC_ITEM_LINE`), or
    ///   -1. The message names the regions and the place
    ///
    /// Returns `ICC_OK`, or
    ///
    /// - `ICC_ERR_BOUNDARY` if regions of one layer overlap or cross
    /// - `ICC_ERR_TOPOLOGY` if the layers differ, or nothing is left
    /// - `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n log n) time and O(n) memory for n vertices, and O(k^2) to O(k^3) time for k islands of one
    /// region.
    pub fn icc_coverage_create(
        out: *mut *mut icc_coverage,
        source: *const icc_layer,
        target: *const icc_layer,
        options: *const icc_coverage_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a coverage.
    pub fn icc_coverage_free(coverage: *mut icc_coverage);

    /// The source with common vertices. It belongs to the coverage. NULL gives NULL.
    pub fn icc_coverage_source(coverage: *const icc_coverage) -> *const icc_domain;

    /// The target with common vertices. It belongs to the coverage. NULL gives NULL.
    pub fn icc_coverage_target(coverage: *const icc_coverage) -> *const icc_domain;

    /// Tells what was done.
    pub fn icc_coverage_get_info(coverage: *const icc_coverage, info: *mut icc_coverage_info) -> icc_status;

    /// The rings of both domains, sorted by region: outer rings (`ICC_FEATURE_REGION`) and holes, also those
    /// that another region fills. Rings of the same number correspond vertex by vertex. Outer rings run
    /// counter-clockwise and holes clockwise. No ring passes through a place twice.
    ///
    /// - `coverage`: the coverage
    /// - `source` (out): `icc_coverage_info.n_features` features, which belong to the coverage; may be NULL
    /// - `target` (out): the same for the target; may be NULL
    pub fn icc_coverage_get_features(
        coverage: *const icc_coverage,
        source: *mut *const icc_feature,
        target: *mut *const icc_feature,
    ) -> icc_status;

    /// Writes the region of each feature to `ids`, which has room for `icc_coverage_info.n_features` numbers.
    pub fn icc_coverage_get_ids(coverage: *const icc_coverage, ids: *mut i64) -> icc_status;

    /// Describes difference k, 0 \<= k \< `icc_coverage_info.n_differences`. Those of the source come first.
    pub fn icc_coverage_get_difference(
        coverage: *const icc_coverage,
        k: usize,
        difference: *mut icc_coverage_difference,
    ) -> icc_status;
}
