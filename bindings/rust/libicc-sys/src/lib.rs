//! Raw bindings of libicc: the C interface as it is, nothing safe about it. The crate `libicc` wraps it.
//!
//! Sections follow the headers `icc/base.h`, `icc/map.h`, `icc/chart.h`, `icc/stages.h` and `icc/kernel.h`, whose rules hold:
//! objects are immutable, creators write to `*out`, `env` and `err` may be null. `Default` of a struct is all
//! zeros, with `size` set. `bindings/rust/check_layout.sh` compares every struct, constant and signature with
//! the headers.
//!
//! (Not related to ICC colour profiles.)
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
/// the call did what it says
pub const ICC_OK: i32 = 0;
/// an argument is missing or out of range
pub const ICC_ERR_ARGUMENT: i32 = 1;
/// an allocation failed
pub const ICC_ERR_MEMORY: i32 = 2;
/// a struct has a member that this library does not know
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
/// this combination is not available
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

/// What went wrong, filled in by the call that failed.
///
/// Owned by the caller, who sets `size` to `sizeof(icc_error)` before the call;
/// members beyond `size` are not touched. Every function that takes one accepts
/// NULL. A call that succeeds leaves the struct alone.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_error {
    /// set by the caller: `sizeof(icc_error)`
    pub size: usize,
    /// the status that the call returned
    pub status: icc_status,
    /// 0: neither; 1: the source; 2: the target
    pub side: i32,
    /// which item is at fault, from 0, or -1
    pub index: i64,
    /// what it is: `ICC_ITEM_*`
    pub item: i32,
    /// one line of English, always terminated
    pub message: [c_char; 252],
}
sized!(icc_error);

/// One unit of work handed to `icc_env.parallel_for`. You may run it in any floating-point environment, and it leaves the
/// environment as it was.
pub type icc_task = Option<unsafe extern "C" fn(argument: *mut c_void, index: usize)>;

/// How a call allocates, reports and runs in parallel.
///
/// Zero-initialise, set `size`, then whatever is wanted; NULL in place of the
/// struct means all defaults. The struct is read during the call and not kept;
/// objects keep `user`, `alloc` and `dealloc`, which must stay valid for as long
/// as the object lives.
///
/// Results are bit-identical for every number of threads and for every
/// implementation of `parallel_for`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_env {
    /// set by the caller: `sizeof(icc_env)`
    pub size: usize,
    /// handed to every callback below
    pub user: *mut c_void,
    /// Memory for any type, or NULL if there is none. Set both or neither; must be
    /// thread-safe when tasks run in parallel, or several threads use the objects that are made
    /// with it. Default: malloc and free.
    pub alloc: Option<unsafe extern "C" fn(user: *mut c_void, size: usize) -> *mut c_void>,
    /// Gives back what `alloc` returned; never called with NULL.
    pub dealloc: Option<unsafe extern "C" fn(user: *mut c_void, memory: *mut c_void)>,
    /// Takes one line of diagnostics, without a line end. Default: none.
    pub log: Option<unsafe extern "C" fn(user: *mut c_void, message: *const c_char)>,
    /// Called on the calling thread now and then during long work, with what is being done and
    /// the share of the whole call that is done: in \[0,1\], never less than before, and 1 in the
    /// last report of a call that succeeds. Shares are guesses; they go by what the parts of a
    /// call usually cost. Non-zero cancels: the call gives up as soon as it can and returns
    /// `ICC_ERR_CANCELLED`. A call that is done at once may report nothing. Default: none.
    ///
    /// `stage` is one of these names (more may come), and may come back later in the call:
    /// - "check": boundaries, masks, meshes and results are checked and measured
    /// - "repair": what is not one-to-one yet is mended
    /// - "mesh": a domain is triangulated
    /// - "grid": a grid is laid over a domain
    /// - "tree": the vertices of a grid are put in order
    /// - "order": the simplices of a mesh are put in order
    /// - "solve": equations are solved
    /// - "trace": points are carried along curves, or looked up
    /// - "improve": a map is made fairer
    /// - "warp": pictures or poses are carried along
    /// - "sample": samples are spread
    /// - "weights": kernel coordinates are computed
    /// - "load": an object is read back
    pub progress: Option<unsafe extern "C" fn(user: *mut c_void, stage: *const c_char, share: f64) -> i32>,
    /// Runs task(argument, i) for every i in \[0, n_tasks), in any order and on any
    /// threads, and returns when all are done. Replaces the library's own threads.
    pub parallel_for: Option<
        unsafe extern "C" fn(user: *mut c_void, n_tasks: usize, task: icc_task, argument: *mut c_void),
    >,
    /// Threads that a call may use, the calling one included; 0 and 1 mean one. Further
    /// threads live only during the call. If one cannot be started, the others do its work; a library
    /// built with ICC_WITH_THREADS off starts none.
    pub threads: i32,
    /// Bytes that loading an object may take beyond 64 for each byte that it is read from; 0 means
    /// 256,000,000. Charts of methods gradient and field, and domains made of masks, are rebuilt
    /// from a few bytes and may need more: loading refuses them with `ICC_ERR_FORMAT` and a
    /// message that names this member, before it asks for the memory. Time is limited
    /// with it: to some ten seconds for the default, and in proportion. UINT64_MAX lifts both
    /// limits, for bytes that are trusted.
    pub load_limit: u64,
}
sized!(icc_env);

extern "C" {
    /// The library's version, such as "0.1.0". Static; never NULL.
    pub fn icc_version() -> *const c_char;

    /// The version as 10000 major + 100 minor + patch.
    pub fn icc_version_number() -> i32;

    /// The name of a status, such as "`ICC_ERR_MEMORY`", or "unknown status". Static.
    pub fn icc_status_name(status: icc_status) -> *const c_char;
}

// icc/map.h: domains

opaque!(
    /// A shape: its boundary, and what lies inside.
    icc_domain
);

// Where a point lies.
/// in the interior
pub const ICC_INSIDE: i32 = 1;
/// on the boundary: up to 1e-14 of the bounding box's longest side, or up to `dim` * 2^-52 of the largest
/// coordinate along each axis, whichever is more
pub const ICC_BOUNDARY: i32 = 2;
/// elsewhere
pub const ICC_OUTSIDE: i32 = 3;

/// What `icc_domain_get_info()` tells.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_domain_info {
    /// set by the caller: `sizeof(icc_domain_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// +1 when the facets are listed as seen from outside: 2-D the ring
    /// counter-clockwise, with y upwards; 3-D each face
    /// counter-clockwise; any n: the determinants of the facets,
    /// seen from within, positive; 1-D the lower end first. Else -1
    pub orientation: i32,
    /// vertices of the boundary and of all features
    pub n_vertices: usize,
    /// facets of the boundary
    pub n_facets: usize,
    /// bounding box
    pub lower: [f64; ICC_MAX_DIM],
    /// bounding box
    pub upper: [f64; ICC_MAX_DIM],
    /// length, area (2-D), volume (3-D) and so on, without holes; may
    /// overflow to HUGE_VAL for coordinates near 1e300
    pub measure: f64,
    /// features inside: see `icc_domain_create_features()`
    pub n_features: usize,
    /// vertices of the mesh of its inside, with those of the boundary; 0: it has none
    pub n_mesh_vertices: usize,
    /// simplices of that
    pub n_mesh_simplices: usize,
}
sized!(icc_domain_info);

/// How `icc_domain_fill()` chooses inner vertices.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_fill_options {
    /// `sizeof(icc_fill_options)`
    pub size: usize,
    /// circumradius over shortest edge from which tetrahedra are refined, at least 1.2; 0: 1.6;
    /// infinite: no vertices but those it takes
    pub ratio: f64,
    /// refinement ends at so many inner vertices; 0: no limit
    pub max_points: u64,
}
sized!(icc_fill_options);

// What `icc_feature.kind` says.
/// a simple polygon whose inside is not part of the domain
pub const ICC_FEATURE_HOLE: i32 = 1;
/// a polyline that does not meet itself, of 2 or more vertices; with two of
/// them, a bone
pub const ICC_FEATURE_LINE: i32 = 2;
/// one vertex
pub const ICC_FEATURE_POINT: i32 = 3;

/// Something inside a domain of the plane that a map takes to the feature of the same number in the
/// other domain, vertex by vertex and edges linearly.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_feature {
    /// set by the caller: `sizeof(icc_feature)`, the same in all of an array
    pub size: usize,
    /// `ICC_FEATURE_*`
    pub kind: i32,
    /// hole: at least 3; line: at least 2; point: 1
    pub n_vertices: usize,
    /// 2 n_vertices coordinates
    pub vertices: *const f64,
    /// of a point with a size: above 0; else 0
    pub radius: f64,
    /// of a surface inside a domain in space; 0 as yet
    pub n_facets: usize,
    /// 3 n_facets vertex indices; NULL as yet
    pub facets: *const u32,
}
sized!(icc_feature);

/// A mesh of triangles in 2-D, of tetrahedra in 3-D, of simplices beyond: a caller's, which is only
/// read, or room for one of the library's. *  To be given a mesh, call `icc_domain_get_mesh()` or
/// `icc_map_get_mesh()` twice: with `vertices` and `cells` NULL for dim and the numbers, then with
/// arrays of that size. Either may stay NULL.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_mesh {
    /// set by the caller: `sizeof(icc_mesh)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// vertices, fewer than 2^26; where a mesh is written, how many `vertices` has room for
    pub n_vertices: usize,
    /// n_vertices * dim coordinates
    pub vertices: *mut f64,
    /// cells, fewer than 2^26; where a mesh is written, how many `cells` has room for
    pub n_cells: usize,
    /// vertex indices of all cells, one cell after the other: n_cells * (dim + 1). A cell may list
    /// its vertices in any order
    pub cells: *mut u32,
    /// NULL: every cell has dim + 1 vertices. Else n_cells + 1 numbers: where in `cells` each cell
    /// begins, and where the last one ends, as VTK has it
    pub offsets: *const usize,
    /// VTK's types of the n_cells cells, or NULL. Only simplices are supported as yet: 5 in 2-D, 10
    /// in 3-D; others are `ICC_ERR_UNSUPPORTED`
    pub types: *const u8,
    /// numbers of n_cells regions; NULL. Nothing reads them as yet: else `ICC_ERR_UNSUPPORTED`
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
    /// of a hole: +1 when it is listed counter-clockwise, with y upwards, -1 clockwise; else 0
    pub orientation: i32,
    /// its vertices have this number among those of the domain and the following ones
    pub first_vertex: usize,
    /// how many there are
    pub n_vertices: usize,
    /// of a hole: the facet from its first vertex to the next; as many follow as it has vertices.
    /// Else 0
    pub first_facet: usize,
}
sized!(icc_feature_info);

// Defects that `icc_boundary_defects()` lists. `a` and `b` are vertex or facet indices.
/// vertex a has a coordinate that is not finite; b = a
pub const ICC_DEFECT_NOT_FINITE: i32 = 1;
/// vertices a \< b coincide
pub const ICC_DEFECT_REPEATED: i32 = 2;
/// at vertex a the boundary runs back over itself; b = a
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

// How coordinates are made. Gradient and field work in 2-D and beyond, foliation in 2-D and on domains with a
// mesh, disc in 2-D.
/// Integral Curve Coordinates as Huynh and Gingold published them: a regular grid, a cousin
/// tree, a function on it, piecewise linear gradient lines; in any dimension, on the simplices of
/// the Kuhn triangulation and their faces. Not one-to-one: lines merge, so that an open share of
/// the area collapses (in 3-D and beyond, most of it), and thin parts of a shape between grid
/// vertices are not reached. `icc_chart_get_report()` tells how much. Beyond 2-D the function may have
/// several maxima, too, and lines that end at them: `icc_gradient_info.n_maxima`. Never certified.
pub const ICC_METHOD_GRADIENT: i32 = 1;
/// Integral Curve Coordinates along leaves that cannot merge: level lines of an angle-valued,
/// discretely harmonic function on a triangle mesh of the domain. A homeomorphism of the closed
/// domain in exact arithmetic whenever its certificate holds, which is checked with integers
/// and exact signs for every chart; otherwise there is no chart (`ICC_ERR_CERTIFICATE`). The
/// coordinates are continuous, piecewise smooth, and in doubles come back to about 1e-15 of the
/// domain's size. A mesh *sampled* from the map can still have inverted triangles.
///
/// On a domain with a mesh, `icc_domain_create_mesh()`, in any dimension: leaves that are straight in
/// every simplex and pass the simplices in an order, a shelling; all end at an inner vertex of the
/// mesh, or at the middle of a simplex if there is none. The certificate looks at that order, and
/// promises the same (beyond 3-D the orientation of simplices is certain, but not exact). Not every
/// mesh has such an order: `ICC_ERR_TOPOLOGY`. A flat simplex makes for long leaves near it.
pub const ICC_METHOD_FOLIATION: i32 = 2;
/// Integral Curve Coordinates along a field that the curves cannot merge in, on a regular grid in any
/// dimension: a vector for every grid vertex that points uphill in all simplices around it, for
/// the discretely harmonic function, and linear interpolation between them. The curves are
/// followed exactly but for rounding. Certified when there is such a vector everywhere, the
/// boundary is crossed inward all over, which is checked vertex by vertex, and no grid vertex inside was
/// given up; if not, there is a chart all the same, and `icc_field_info.n_infeasible`, n_not_inward
/// and n_stray report how much is amiss.
///
/// A map of two certified charts is certified when doubles are enough for it, too, which
/// `icc_map_report.n_lost` and n_flat report: curves come together on their way, and what one chart tells
/// apart may be one and the same to the other, as when a ball goes to a pancake.
pub const ICC_METHOD_FIELD: i32 = 3;
/// Polar coordinates of the harmonic map to a disc (Tutte), piecewise linear. A homeomorphism under
/// the same certificate; the curves are the preimages of radii.
pub const ICC_METHOD_DISC: i32 = 4;

// Why a chart or a map is not certified: of several reasons, the first.
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

// The function whose gradient lines are followed.
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
/// as Laplace, but 0 on the boundary itself
pub const ICC_FUNCTION_HARMONIC: i32 = 6;

// Whether f(parent) >= (1 + min_fall) f(child) is imposed on the edges of the tree inside (Laplace and bi-Laplace;
// decay and distance fulfil it anyway).
/// only when the function without has other critical points than one
/// maximum at the root (and, in 2-D, the saddles of holes, which no
/// function can avoid); in charts, only when that is so after the
/// root has moved, too, as for `ICC_CONSTRAINTS_NONE`. If they are
/// imposed it does not move
pub const ICC_CONSTRAINTS_NEEDED: i32 = 1;
/// never. Charts of bi-Laplace functions have the maximum where the
/// function puts it, which may be beside the place asked for:
/// `icc_gradient_info::moved`
pub const ICC_CONSTRAINTS_NONE: i32 = 2;
/// always: the maximum stays where it is asked for
pub const ICC_CONSTRAINTS_ALL: i32 = 3;

// How the linear systems of Laplace and bi-Laplace are solved.
/// sparse factorisation: each value to about 1e-12 of itself
pub const ICC_SOLVER_DIRECT: i32 = 1;
/// conjugate gradients with a multigrid preconditioner: for large
/// grids, above all in 3-D
pub const ICC_SOLVER_ITERATIVE: i32 = 2;

// The two published forms of Algorithm 2.
/// vertices just outside the boundary belong to the tree
pub const ICC_TREE_THESIS: i32 = 1;
/// vertices just outside are children of all their neighbours inside
pub const ICC_TREE_PAPER: i32 = 2;

/// Options of `icc_chart_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_options {
    /// set by the caller: `sizeof(icc_chart_options)`
    pub size: usize,
    /// `ICC_METHOD_*`; 0: the best that there is: foliation in 2-D and on domains with
    /// a mesh, else field
    pub method: i32,
    /// gradient: `ICC_FUNCTION_*`; 0: decay
    pub function: i32,
    /// gradient: `ICC_TREE_*`; 0: thesis
    pub tree: i32,
    /// grid or mesh cells along the longest side, 2..16384; 0: 50, as in the
    /// papers; gradient on a mask: see `icc_grid_create()`
    pub cells: i32,
    /// where the maximum shall be: the nearest vertex inside is taken. NULL:
    /// the grassfire's (gradient, field), the deepest vertex (foliation; of a
    /// mesh of the caller's, the deepest inside). Disc has its own, the point that goes to the centre: NULL only.
    /// Bi-Laplace functions without constraints may move it: `icc_gradient_info::moved`
    pub maximum: *const f64,
    /// gradient: `ICC_CONSTRAINTS_*`; 0: needed
    pub constraints: i32,
    /// gradient: `ICC_SOLVER_*`; 0: by the predicted work
    pub solver: i32,
    /// gradient: least relative fall along tree edges, in (0, 0.01\]; 0: 1e-6
    pub min_fall: f64,
    /// gradient, constrained bi-Laplace: least value at the leaves, in
    /// (0, 0.01\]; 0: 1e-9
    pub leaf_min: f64,
}
sized!(icc_chart_options);

/// What `icc_chart_get_info()` fills in, for every method. What only one method has is in a struct of its own:
/// `icc_gradient_info`, `icc_field_info`, `icc_foliation_info`, `icc_shelling_info`, `icc_disc_info`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_info {
    /// set by the caller: `sizeof(icc_chart_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_METHOD_*`
    pub method: i32,
    /// 1: proved to be one-to-one, exactly (field: in doubles); 0: not, see `reason`
    pub certified: i32,
    /// `ICC_REASON_*`: why it is not certified; 0 if it is
    pub reason: i32,
    /// cells along the longest side that were used; method field in thin shapes: twice those asked for, where
    /// those do not do, and one more where that saves the certificate; 0 on a domain's mesh
    pub cells: i32,
    /// the point that every curve ends at
    pub maximum: [f64; ICC_MAX_DIM],
    /// distance of grid or lattice neighbours; 0 on a domain's mesh
    pub spacing: f64,
}
sized!(icc_chart_info);

/// What only charts of method gradient have.
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
    /// neighbours inside that are neither parent and child nor cousins
    pub n_cousin_violations: usize,
    /// of the function, inside
    pub n_maxima: usize,
    /// of the function, inside
    pub n_minima: usize,
    /// of the function, inside
    pub n_saddles: usize,
    /// 2-D: edges between two triangles that curves run through
    pub n_edges: usize,
    /// 2-D: edges where curves merge on the way up
    pub n_compression: usize,
    /// 2-D: edges where curves merge on the way down
    pub n_expansion: usize,
    /// bi-Laplace functions without constraints: how far `icc_chart_info.maximum` lies from the vertex that was
    /// asked for (or the grassfire's), because the function is greatest beside it; else 0
    pub moved: f64,
}
sized!(icc_gradient_info);

/// What only charts of method field have. The function is `ICC_FUNCTION_LAPLACE`, the tree's form `ICC_TREE_THESIS`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_field_info {
    /// set by the caller: `sizeof(icc_field_info)`
    pub size: usize,
    /// grid vertices
    pub n_grid: usize,
    /// grid vertices inside the domain
    pub n_inside: usize,
    /// grid vertices inside that were given up, because without them the others form a ball
    pub n_stray: usize,
    /// grid vertices in the tree
    pub n_tree: usize,
    /// grid vertices inside that the tree does not reach
    pub n_unreachable: usize,
    /// neighbours inside that are neither parent and child nor cousins
    pub n_cousin_violations: usize,
    /// of the function, inside
    pub n_maxima: usize,
    /// of the function, inside
    pub n_minima: usize,
    /// of the function, inside
    pub n_saddles: usize,
    /// grid vertices where no vector points uphill in all simplices
    pub n_infeasible: usize,
    /// pairs of a facet and a grid vertex of a simplex that it runs through
    pub n_contacts: usize,
    /// those of them where the vector does not point inward
    pub n_not_inward: usize,
}
sized!(icc_field_info);

/// What only charts of method foliation have in 2-D, on a mesh that the library makes.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_foliation_info {
    /// set by the caller: `sizeof(icc_foliation_info)`
    pub size: usize,
    /// vertices of the mesh
    pub n_mesh_vertices: usize,
    /// of them on the boundary
    pub n_mesh_boundary: usize,
    /// triangles of the mesh
    pub n_mesh_simplices: usize,
    /// mesh edges whose ends have the same label: ordered by index
    pub n_ties: usize,
    /// share of the boundary flux that is harmonic
    pub harmonic_share: f64,
}
sized!(icc_foliation_info);

/// What only charts of method foliation have on a domain's mesh, `icc_domain_create_mesh()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_shelling_info {
    /// set by the caller: `sizeof(icc_shelling_info)`
    pub size: usize,
    /// vertices of the mesh, and one more where none lies inside
    pub n_mesh_vertices: usize,
    /// of them on the boundary
    pub n_mesh_boundary: usize,
    /// simplices of the mesh
    pub n_mesh_simplices: usize,
    /// share of the boundary flux that is harmonic
    pub harmonic_share: f64,
    /// 1: the order of the simplices was found from the boundary inwards, 0: from the centre outwards
    pub order_peeled: i32,
    /// how many of those that are tried were complete at first; the best is used
    pub n_orders: i32,
    /// how much reversed flux weighed in it
    pub order_beta: f64,
    /// facets that the harmonic flux runs through the other way
    pub n_reversed: usize,
    /// how far the flux along the leaves is from the harmonic one: sum of the squared differences, weighted; 0 at
    /// best
    pub flux_energy: f64,
    /// largest share of a simplex's flux that gets lost by rounding
    pub flux_divergence: f64,
}
sized!(icc_shelling_info);

/// What only charts of method disc have.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_disc_info {
    /// set by the caller: `sizeof(icc_disc_info)`
    pub size: usize,
    /// vertices of the mesh
    pub n_mesh_vertices: usize,
    /// of them on the boundary
    pub n_mesh_boundary: usize,
    /// triangles of the mesh
    pub n_mesh_simplices: usize,
}
sized!(icc_disc_info);

/// How long each step of making a chart took, in seconds: what `icc_chart_get_timings()` fills in. A step that the
/// chart's method does not have is 0. A loaded chart has those of loading it.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_timings {
    /// set by the caller: `sizeof(icc_chart_timings)`
    pub size: usize,
    /// gradient, field: the grid, and the maximum
    pub grid: f64,
    /// gradient, field: the tree, and checking it
    pub tree: f64,
    /// gradient, field: the function, and checking it
    pub function: f64,
    /// foliation, disc: the mesh; on a domain's mesh, preparing the leaves
    pub mesh: f64,
    /// foliation on a domain's mesh: choosing the maximum
    pub centre: f64,
    /// field: the vectors, and checking them; foliation, disc: the equations
    pub solve: f64,
    /// foliation on a domain's mesh: the order of the simplices
    pub order: f64,
    /// foliation, disc: the certificate
    pub certify: f64,
}
sized!(icc_chart_timings);

/// Shares that `icc_chart_get_report()` estimates from evenly spread points. All lie in \[0,1\]. Area and length
/// are those of 2-D; beyond, read volume and area, and so on. For a certified chart all are 0 without
/// looking, and so are the counts.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_chart_report {
    /// set by the caller: `sizeof(icc_chart_report)`
    pub size: usize,
    /// points of the area that were used
    pub n_points: usize,
    /// points of the boundary that were used
    pub n_boundary: usize,
    /// area from which no curve reaches both the boundary and the maximum
    pub unreachable: f64,
    /// area that no curve from the boundary enters (expansion edges)
    pub uncovered: f64,
    /// coordinates (boundary length times share of the way) whose point
    /// lies on a line where curves have merged (compression edges)
    pub collapsed: f64,
    /// boundary length where the gradient does not point inward
    pub not_inward: f64,
}
sized!(icc_chart_report);

opaque!(
    /// Two domains that do not correspond, and which points of them go together.
    icc_match
);

// How `icc_match_create()` takes rotations.
/// of pairings that are nearly as good, the one that turns the shape least
pub const ICC_TURNING_UPRIGHT: i32 = 1;
/// any rotation is as good as any other
pub const ICC_TURNING_FREE: i32 = 2;

// How `icc_match_create()` pairs what lies between landmarks.
/// by shape
pub const ICC_BETWEEN_ELASTIC: i32 = 1;
/// by arc length, for outlines without features as discs, which are ambiguous by shape; without
/// landmarks it starts where the outlines, laid on one another unturned, are nearest
pub const ICC_BETWEEN_ARC: i32 = 2;

/// Options of `icc_match_create()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_match_options {
    /// set by the caller: `sizeof(icc_match_options)`
    pub size: usize,
    /// without landmarks: `ICC_TURNING_UPRIGHT` or `ICC_TURNING_FREE`; 0: upright
    pub turning: i32,
    /// `ICC_BETWEEN_ELASTIC` or `ICC_BETWEEN_ARC`; 0: elastic
    pub between: i32,
    /// without landmarks, a pairing with less `icc_match_info.sure` is refused; 0: 1.06; 1: none is
    pub least_sure: f64,
    /// share of the perimeter within which vertices become one pair; at most 0.01
    pub drop: f64,
    /// in space, how far the common surfaces may be off, as a share of the diagonal; 0: 1e-3; < 0: not at all
    pub tolerance: f64,
    /// in space, 1: the source keeps all its vertices and edges
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
    /// 1: the target's mirror image fits at least 1.06 times better: y may point down in one of the two
    pub mirrored: i32,
    /// common vertices of the two domains
    pub n_vertices: usize,
    /// landmarks; they are among these
    pub n_landmarks: usize,
    /// how many are vertices of both
    pub n_joined: usize,
    /// of the pairing: 0 for similar shapes, at most 4
    pub cost: f64,
    /// of the best one that differs from it
    pub second: f64,
    /// (second + 0.05) / (cost + 0.05)
    pub sure: f64,
    /// the source is turned by so many degrees, counter-clockwise
    pub turn: f64,
    /// stretch of the edge that shrinks most, in shares of the perimeters,
    pub least_slope: f64,
    /// and of the one that grows most
    pub most_slope: f64,
    /// in space: how the common triangles are stretched; 4 for an isometry
    pub energy: f64,
    /// in space: the farthest that the common surfaces are off those that were given
    pub off: f64,
    /// in space: of the common triangles, in degrees
    pub least_angle: f64,
    /// in space: common vertices before surfaces were made coarse
    pub n_overlay: usize,
}
sized!(icc_match_info);

opaque!(
    /// A map from one domain to another that agrees with the boundaries.
    icc_map
);

// How a map works.
/// point by point through the two charts, as the papers do; any dimension
pub const ICC_MAP_CURVES: i32 = 1;
/// An internal piecewise linear map. In 2-D: a triangle mesh of the source with an image for every
/// vertex, started from the charts, repaired until every triangle is positive, made fair, and
/// certified: every triangle exactly positive before and after, both boundaries exactly simple. In 3-D,
/// between surfaces, filled unless they bring a mesh: the source's mesh with images that start from the charts,
/// repaired, made fair and certified likewise; the target's mesh serves its chart only. The
/// fastest queries. On the boundary it agrees with the cages up to rounding (samples of a side lie
/// on it to one unit in the last place).
pub const ICC_MAP_MESH: i32 = 2;

/// A path between two vertices of a domain with features, and where a map takes it: the map's image
/// of the one can be moved to the other with its ends held and without crossing a feature.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_tie {
    /// set by the caller: `sizeof(icc_tie)`, the same in all of an array
    pub size: usize,
    /// where it begins and ends: vertices of the domain (see `icc_domain_create_features()`)
    pub vertex: [u32; 2],
    /// its bends in the source
    pub n_source: usize,
    /// 2 n_source coordinates
    pub source: *const f64,
    /// its bends in the target, which may be more or fewer
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
    /// `ICC_MAP_*`; 0: mesh for foliation and disc in 2-D, unless both domains have caller-supplied
    /// meshes, and for foliation in 3-D; else curves
    pub kind: i32,
    /// mesh: at most so many improvement steps on each level of refinement; 0: as long as they pay
    /// off; -1: no improvement
    pub iterations: i32,
    /// for both charts, or NULL; its `maximum` is the source's. For kind mesh in 2-D method 0 means
    /// disc (foliation when a maximum is given), and cells 0 means 20. In 3-D method 0 means
    /// foliation, but field for masks.
    pub chart: *const icc_chart_options,
    /// the target's maximum, or NULL: as the method chooses
    pub target_maximum: *const f64,
    /// with features: as many as there are features; or 0
    pub n_ties: usize,
    /// which way round one another the features go: paths that join all of them and the outer ring
    /// to a tree, inside both domains and without crossing; or NULL: as seems least twisted
    pub ties: *const icc_tie,
}
sized!(icc_map_options);

/// What `icc_map_get_info()` reports: what the map is. It is saved with the map. Members that do not
/// apply to the kind are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_map_info {
    /// set by the caller: `sizeof(icc_map_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_MAP_*`: never 0
    pub kind: i32,
    /// 1: proved to be one-to-one, exactly (field: in doubles, see `icc_map_report.n_lost`); 0:
    /// not, see `reason`
    pub certified: i32,
    /// `ICC_REASON_*`: why it is not certified; 0 if it is
    pub reason: i32,
    /// 1: because the source's chart is not, 2: the target's; else 0
    pub reason_side: i32,
    /// with features, 1: the map can be moved, while it stays one-to-one, to what its ties, or the
    /// cuts chosen for it, said; and after `icc_map_retarget()` to what became of the map before
    /// while every vertex of the target went straight to its new place. 0: not so, or rounding or
    /// the way of the vertices leaves it open
    pub class_kept: i32,
    /// mesh: vertices
    pub n_vertices: usize,
    /// mesh: triangles, or in 3-D tetrahedra
    pub n_simplices: usize,
    /// mesh: mean symmetric Dirichlet energy |J|^2 + |J^-1|^2, the target scaled to the source's
    /// area or volume; 4 for an isometry, in 3-D 6
    pub energy: f64,
    /// features inside: holes,
    pub n_holes: usize,
    /// lines
    pub n_lines: usize,
    /// and points
    pub n_points: usize,
    /// with features: as many ties, see `icc_map_get_tie()`
    pub n_ties: usize,
    /// lengths of these in the target over those of the straight lines between their ends: what is
    /// much more than 1 is twisted
    pub detour: f64,
}
sized!(icc_map_info);

/// What `icc_map_get_report()` reports: how the map was made. Members that do not apply to the kind are
/// 0, and seconds are 0 where the map was loaded.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_map_report {
    /// set by the caller: `sizeof(icc_map_report)`
    pub size: usize,
    /// time to make the map, including the charts; or to load it
    pub seconds: f64,
    /// mesh: of that, time to make all simplices positive
    pub seconds_repair: f64,
    /// of that, time to improve it
    pub seconds_improve: f64,
    /// of that, time to certify it; kind curves of method field likewise
    pub seconds_certify: f64,
    /// mesh: `icc_map_info.energy` before the improvement
    pub energy_start: f64,
    /// mesh: simplices that were not positive at first
    pub n_inverted: usize,
    /// in 3-D, kind curves although kind mesh was tried: the fewest tetrahedra that a way of it has
    /// left inverted
    pub n_unrepaired: usize,
    /// mesh: steps of improvement
    pub n_iterations: usize,
    /// mesh: refinements
    pub n_levels: i32,
    /// with features: ways to cut them apart that were tried and led to a map; 1 with ties
    pub n_trees: i32,
    /// field: evenly spread points, half of them in the target, that were mapped there and back; 0
    /// unless both charts are certified
    pub n_samples: usize,
    /// field: of these, points that come back more than 1e-9 of the bounding box's diagonal away,
    /// or whose derivative does not match that of the way back. None if certified
    pub n_lost: usize,
    /// field: of these, points around which volume shrinks to less than 1e-6 of its mean. At most
    /// 0.2 % if certified
    pub n_flat: usize,
    /// mesh: simplices that rounding makes flat or reversed, on either side, when
    /// `icc_map_get_mesh()` hands them out; 0 unless a shape is about 1e9 times as far from the
    /// origin as it is large
    pub n_spoilt: usize,
}
sized!(icc_map_report);

/// What `icc_map_get_tie()` reports.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_tie_info {
    /// set by the caller: `sizeof(icc_tie_info)`
    pub size: usize,
    /// as in `icc_tie`
    pub vertex: [u32; 2],
    /// its bends in the source: none as yet
    pub n_source: usize,
    /// and in the target
    pub n_target: usize,
    /// of the tie in the source, and in the target
    pub length: [f64; 2],
}
sized!(icc_tie_info);

/// Options of `icc_map_improve()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_improve_options {
    /// set by the caller: `sizeof(icc_improve_options)`
    pub size: usize,
    /// steps at most on each level; 0: 60
    pub iterations: i32,
    /// refinements at most; 0: 4; -1: none
    pub levels: i32,
    /// a level ends with a step that gains less than this share of the energy; 0:
    /// 1e-4
    pub tolerance: f64,
}
sized!(icc_improve_options);

/// What `icc_map_improve()` did.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_improve_report {
    /// set by the caller: `sizeof(icc_improve_report)`
    pub size: usize,
    /// as `icc_map_info.energy`, before
    pub energy_start: f64,
    /// and after; never more
    pub energy: f64,
    /// steps
    pub n_iterations: usize,
    /// triangles or tetrahedra in the end
    pub n_simplices: usize,
    /// refinements
    pub n_levels: i32,
    /// 1: the progress callback ended it early
    pub cancelled: i32,
}
sized!(icc_improve_report);

/// Options of `icc_map_retarget()`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_retarget_options {
    /// set by the caller: `sizeof(icc_retarget_options)`
    pub size: usize,
    /// at most so many improvement steps; 0: what a frame has time for; -1: none
    pub iterations: i32,
}
sized!(icc_retarget_options);

/// What `icc_map_certify()` found out about the image of a caller's mesh.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_certificate {
    /// set by the caller: `sizeof(icc_certificate)`
    pub size: usize,
    /// 1: every simplex keeps its orientation and both boundaries are simple,
    /// so the mesh and its image are one-to-one
    pub certified: i32,
    /// 1: no part of the boundary meets itself or another part, and the mesh lies
    /// on one side of it; the same is true of the images
    pub boundary_simple: i32,
    /// simplices whose image has the other orientation
    pub n_inverted: usize,
    /// simplices whose image, or which themselves, have no volume
    pub n_flat: usize,
    /// vertices that have no image
    pub n_no_image: usize,
    /// the first simplex at fault, or -1
    pub first: i64,
    /// why it is not certified, one line of English; empty if it is
    pub message: [c_char; 256],
}
sized!(icc_certificate);

/// The pixel's own samples, for classes and labels; no means.
pub const ICC_INTERPOLATION_NEAREST: i32 = 1;
/// Bilinear.
pub const ICC_INTERPOLATION_LINEAR: i32 = 2;
/// Bicubic, exact for quadratic functions; may overshoot.
pub const ICC_INTERPOLATION_CUBIC: i32 = 3;

/// A picture in memory: rows from top to bottom, samples of a pixel side by side.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_picture {
    /// set by the caller: `sizeof(icc_picture)`
    pub size: usize,
    /// pixels in a row
    pub width: i32,
    /// rows
    pub height: i32,
    /// samples of a pixel, 1..64
    pub channels: i32,
    /// of a sample, in the machine's order: 1 or 2, unsigned, all values used;
    /// 4 or 8: floats
    pub bytes: i32,
    /// 1: the last of two to four channels of 1 or 2 bytes is opacity, and the
    /// others are not multiplied by it; 0: there is none
    pub alpha: i32,
    /// bytes from a row to the next
    pub stride: usize,
    /// the first row; any alignment. Only read in a source.
    pub pixels: *mut c_void,
    /// of a source: `ICC_INTERPOLATION_*`; 0: linear
    pub interpolation: i32,
    /// of a source: 1: samples that are `nodata` are missing; without alpha
    pub has_nodata: i32,
    /// may be NaN
    pub nodata: f64,
}
sized!(icc_picture);

extern "C" {
    /// Makes a domain from its boundary. Either orientation is accepted and remembered.
    ///
    /// 2-D: a simple polygon. `facets` may be NULL: facet i then joins vertex i and vertex i + 1, the
    /// last one back to vertex 0. Otherwise the facets, two vertex indices each, must form one closed
    /// ring through all vertices, in any order but all in the same direction. Collinear vertices are
    /// fine. Checked exactly: no edge of length zero, no repeated vertex, no edges that cross, touch or
    /// run back over each other.
    ///
    /// 3-D: a closed surface of triangles, three vertex indices each, in any order. Checked exactly: no
    /// face with area 0; each edge belongs to two faces, which run along it in opposite directions; the
    /// faces at each vertex form one cycle; one component, so no inner voids; genus 0; the surface does
    /// not meet itself, which is to say that two faces have nothing in common but the vertices and edges
    /// that they share. Coplanar faces are fine.
    ///
    /// 4-D to 6-D: a closed boundary of simplices, dim vertex indices each. Checked: each ridge (dim - 1
    /// vertices) belongs to two facets, which run along it in opposite directions; the facets at each
    /// vertex hang together; one component; and, exactly in 4-D and to rounding (1e-13) beyond, no flat
    /// facet; to rounding, a volume other than 0. Self-intersection is NOT checked beyond 3-D, nor is
    /// the topology of the boundary.
    ///
    /// 1-D: an interval: two facets of one vertex each.
    ///
    /// All checks are made on the coordinates as given. Inside the library the shape is shifted and
    /// scaled by exact operations, so any position and size will do (an offset of 1e9, coordinates of
    /// 1e300). A coordinate other than 0 that is smaller than 2^-200 of the largest one is refused.
    /// Except in 2-D, vertices that belong to no facet are kept and otherwise ignored.
    ///
    /// - `out` (out): the domain; owned by the caller, see `icc_domain_free()`
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `n_vertices`: at least dim + 1
    /// - `vertices`: n_vertices * dim coordinates
    /// - `n_facets`: number of facets; ignored when `facets` is NULL
    /// - `facets`: n_facets * dim vertex indices; NULL in 2-D only
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names the vertex or facet at fault; where two are, the
    ///   message names both
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_BOUNDARY` (what is wrong with the
    /// shape), `ICC_ERR_TOPOLOGY` (several components, an inner void, handles),
    /// `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n log n) time, O(n) memory for ordinary shapes; in 3-D 1 to 3 us and 70 bytes a triangle
    /// (110 while it is made). All pairs of triangles whose boxes meet are looked at: n^2 / 2 pairs, 0.04
    /// us each, where n triangles meet at one vertex or are long, thin and close.
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

    /// Makes a domain of the plane with features inside: holes, lines and points, whose images a map
    /// prescribes.
    ///
    /// The vertices of the domain are those of the outer ring, then those of the features in their
    /// order; its facets are the edges of the outer ring, then those of the holes, which bound it as
    /// well. Features must lie strictly inside the outer ring and outside all holes, and may not meet
    /// themselves or one another. All of this is checked exactly, with the coordinates as given. Rings
    /// may run either way. A hole that touches the outer ring in a point is refused, since the domain
    /// would be pinched there: merge the rings. So is a point on the boundary: make it a vertex of the
    /// ring.
    ///
    /// To `icc_domain_locate()` what lies in a hole is outside; lines and points are inside, as what is
    /// around them. Only maps of kind mesh work on such a domain. What else takes domains refuses it
    /// with `ICC_ERR_UNSUPPORTED`. Without features the result is that of `icc_domain_create()`.
    ///
    /// - `out` (out): the domain; owned by the caller, see `icc_domain_free()`
    /// - `n_outer`: vertices of the outer ring, at least 3
    /// - `outer`: 2 n_outer coordinates
    /// - `n_features`: how many features there are
    /// - `features`: n_features of them; they are copied
    /// - `env`: may be NULL
    /// - `err`: may be NULL. For a defect of the outer ring `index` is its vertex or edge; else it is
    ///   the feature at fault (`ICC_ITEM_FEATURE`), and the message names the vertex, and the other
    ///   feature where there are two
    ///
    /// Returns `ICC_OK`; `ICC_ERR_OUTSIDE` (a feature is not strictly inside the outer ring, or lies in
    /// a hole); `ICC_ERR_BOUNDARY` (a ring or line meets itself, two features meet, two points are the
    /// same); `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION`, `ICC_ERR_CANCELLED`
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

    /// Makes a domain from the cells of a mask, such as the voxels of a picture: cell (i_0, i_1, ..) covers
    /// \[i_0, i_0 + 1\] x \[i_1, i_1 + 1\] x .. in coordinates 0, 1, ..
    ///
    /// The mask must be a solid without holes: one piece, where cells are joined by faces; no cells that
    /// touch only along an edge or a corner, nor gaps that do; the outside one piece; Euler characteristic 1.
    /// In 2-D and 3-D this makes it a disc or a ball. In higher dimensions holes of different
    /// dimensions may cancel out and pass: `icc_tree_grow()` on its grid fails on them.
    ///
    /// Each cell is cut in two along each axis, and each face of the pieces on the boundary into (dim - 1)!
    /// simplices (Kuhn's), as the grid that `icc_grid_create()` makes is. `icc_domain_get_boundary()` hands
    /// them out, with the vertices in the caller's order of axes, the first axis fastest; in 2-D as a
    /// counter-clockwise polygon. The image of a mask is a domain with the same facets and moved vertices.
    ///
    /// - `out` (out): the domain; owned by the caller
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `shape`: cells along each axis, dim numbers
    /// - `cells`: one byte per cell, the first axis runs fastest: 0 outside, anything else inside
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names a cell at fault
    ///
    /// Returns `ICC_OK`, `ICC_ERR_TOPOLOGY` (what is wrong with the mask), `ICC_ERR_RESOLUTION` (its grid
    /// would have more than 2^28 vertices, or too many facets), `ICC_ERR_ARGUMENT`, ...
    ///
    /// Cost: O(cells * 4^dim) time at most, 0.15 us a cell in 3-D, besides that of `icc_domain_create()`.
    pub fn icc_domain_create_mask(
        out: *mut *mut icc_domain,
        dim: i32,
        shape: *const usize,
        cells: *const u8,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a domain from a conforming mesh of its inside: triangles in 2-D, tetrahedra in 3-D, simplices
    /// beyond. On such a domain `ICC_METHOD_FOLIATION` works in every dimension, with leaves that are straight
    /// in every simplex; everything else works as on a domain made of the boundary alone.
    ///
    /// The vertices of the domain are those of the mesh that lie on its boundary, in the order of the mesh.
    /// Two domains whose meshes differ inside correspond, as `icc_map_create()` asks, if these and the facets are
    /// the same. The facets may be given in an order of the caller's, such as that of the surface that the mesh
    /// was made for; if not, they are sorted by their vertices (the smallest index first, and so on) and
    /// listed as seen from outside.
    ///
    /// Checked exactly up to 3-D, to rounding beyond: what `icc_domain_create()` checks of the boundary; no
    /// simplex without volume; a facet belongs to at most two simplices, which lie on opposite sides of it;
    /// the mesh hangs together; its Euler characteristic is 1. So the simplices fill the domain and do not
    /// overlap. In which order a simplex lists its vertices does not matter. Vertices that no simplex has are
    /// ignored.
    ///
    /// - `out` (out): the domain; owned by the caller
    /// - `mesh`: the mesh, of dimension 2..`ICC_MAX_DIM`
    /// - `n_facets`: facets of the boundary; ignored when `facets` is NULL
    /// - `facets`: n_facets * dim vertex indices: the boundary of the mesh, in the caller's order and all
    ///   seen from the same side; or NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names the simplex, the vertex or one of the `facets` at fault. When
    ///   it is the boundary that is refused, vertices and facets are those of the domain
    ///
    /// Returns `ICC_OK`; `ICC_ERR_BOUNDARY` (a simplex is flat or lists a vertex twice or one that is not there,
    /// a facet has three simplices or two on one side, `facets` are not the mesh's); `ICC_ERR_TOPOLOGY`
    /// (several pieces, holes); `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(n) time and memory besides those of `icc_domain_create()`: 0.5 us a tetrahedron.
    pub fn icc_domain_create_mesh(
        out: *mut *mut icc_domain,
        mesh: *const icc_mesh,
        n_facets: usize,
        facets: *const u32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Fills a closed surface in 3-D with tetrahedra: makes the domain that `icc_domain_create_mesh()`
    /// makes of a mesh of its inside. Its vertices and facets are those of the surface, bit by bit;
    /// vertices are added inside only. Vertices that no facet has are left out.
    ///
    /// - `out` (out): the domain; owned by the caller
    /// - `surface`: a domain in 3-D without a mesh
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names the facet or vertex at fault
    ///
    /// Returns `ICC_OK`; `ICC_ERR_UNSUPPORTED` unless `surface` is in 3-D and has no mesh;
    /// `ICC_ERR_RESOLUTION` if a facet cannot be told from what is next to it; `ICC_ERR_ARGUMENT`,
    /// `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED`
    pub fn icc_domain_fill(
        out: *mut *mut icc_domain,
        surface: *const icc_domain,
        options: *const icc_fill_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Fills cells of a mask where others, or gaps, touch only along an edge or a corner, which
    /// `icc_domain_create_mask()` refuses: one after the other, each time the one that leaves the fewest such
    /// places around it. Whatever cannot be mended so, and all else that may be wrong, is left as it is.
    ///
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `shape`: cells along each axis
    /// - `cells` (in and out): as for `icc_domain_create_mask()`; those that are filled become 1
    /// - `n_filled` (out): how many, or NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_RESOLUTION`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED`;
    /// the cells are as they were unless it is `ICC_OK`
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

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_domain_get_info(domain: *const icc_domain, info: *mut icc_domain_info) -> icc_status;

    /// Reports a feature of a domain; `icc_domain_get_boundary()` has the coordinates.
    ///
    /// - `domain`: the domain
    /// - `feature`: its number, less than `icc_domain_info.n_features`
    /// - `info` (in and out): `size` has been set; the rest is filled in
    ///
    /// Returns `ICC_OK` or `ICC_ERR_ARGUMENT`
    pub fn icc_domain_get_feature(
        domain: *const icc_domain,
        feature: usize,
        info: *mut icc_feature_info,
    ) -> icc_status;

    /// Copies the boundary as it was given: of a domain with features, the vertices of the outer ring
    /// and of all features, and the facets of the outer ring and of the holes.
    ///
    /// - `domain`: the domain
    /// - `vertices` (out): room for n_vertices * dim doubles, or NULL
    /// - `facets` (out): room for n_facets * dim indices, or NULL
    pub fn icc_domain_get_boundary(
        domain: *const icc_domain,
        vertices: *mut f64,
        facets: *mut u32,
    ) -> icc_status;

    /// Copies the mesh of the inside: `icc_domain_create_mesh()`, `icc_domain_fill()`.
    ///
    /// - `domain`: a domain with a mesh: `icc_domain_info.n_mesh_vertices` is not 0
    /// - `mesh` (in, out): what it has room for is filled: the vertices of the boundary first, in its order.
    ///   Then its dimension and its numbers are set
    ///
    /// Returns `ICC_OK`; `ICC_ERR_ARGUMENT` if there is too little room; `ICC_ERR_UNSUPPORTED` without a mesh
    pub fn icc_domain_get_mesh(domain: *const icc_domain, mesh: *mut icc_mesh) -> icc_status;

    /// Says where points lie, exactly up to the tolerance of `ICC_BOUNDARY`, and finds the nearest
    /// boundary point. Beyond 3-D it is not exact: points within about 1e-13 of the bounding box's longest
    /// side of the boundary may be misplaced; and where a boundary meets itself, inside is what an odd
    /// number of layers separates from infinity.
    ///
    /// - `domain`: the domain
    /// - `n`: number of points
    /// - `points`: n * dim coordinates; a point that is not finite is outside
    /// - `where` (out): n values `ICC_INSIDE`, `ICC_BOUNDARY` or `ICC_OUTSIDE`
    /// - `facet` (out): n indices of the nearest facet, or NULL
    /// - `bary` (out): n * dim barycentric coordinates of the nearest point on it, or NULL
    /// - `env`: may be NULL
    ///
    /// Cost: O(log n) a point for ordinary shapes: in 3-D with 27,000 faces 0.5 to 2 us to place a point,
    /// 5 to 10 us to find the nearest facet.
    pub fn icc_domain_locate(
        domain: *const icc_domain,
        n: usize,
        points: *const f64,
        place: *mut i32,
        facet: *mut u32,
        bary: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// Lists everything that keeps a closed polygon from being the boundary of a domain.
    ///
    /// - `n_vertices`: vertices of the ring
    /// - `vertices`: n_vertices * 2 coordinates; facet i joins vertices i and i + 1
    /// - `capacity`: how many defects the two arrays have room for
    /// - `kinds` (out): `capacity` kinds, `ICC_DEFECT_*`
    /// - `items` (out): `capacity` pairs (a, b); see there
    /// - `n_defects` (out): how many there are in all, also beyond `capacity`
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Sorted by a, then b. Vertices that are not finite are listed and otherwise left out.
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

    /// Makes coordinates of a domain.
    ///
    /// - `out` (out): the chart; owned by the caller, see `icc_chart_free()`. It keeps the domain alive.
    /// - `domain`: the domain
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`; `ICC_ERR_RESOLUTION` when no grid vertex lies inside the domain or the grid would
    /// have more than 2^28 vertices; `ICC_ERR_OUTSIDE` when `maximum` is outside;
    /// `ICC_ERR_CERTIFICATE` when the chart could not be proved one-to-one, with the reason;
    /// `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_UNSUPPORTED`, `ICC_ERR_VERSION`,
    /// `ICC_ERR_CANCELLED`
    ///
    /// Cost with n vertices and N cells along the longest side: gradient O(N^2 + n N) time and memory at
    /// most in 2-D, about 1 ms at N = 50, and O(N^dim) beyond: in 3-D at N = 64 from 0.1 s, and 15 us a point
    /// and way. Field the same: in 3-D at N = 64 0.05 to 0.5 s, 20 us a point and way; at most 40 bytes a grid
    /// vertex, and 70 and 150 for each of `icc_field_info.n_contacts` while it is made. Foliation and disc mesh
    /// the domain with at most 2 n + 4 N^2 vertices (far fewer in practice) and factorise its Laplacian:
    /// about 1 ms at N = 50 and n \< 100, 0.06 s at n = 15,000; 500 bytes a vertex. Foliation on a domain with a
    /// mesh: in 3-D about 25 us a tetrahedron, 40 us from 80,000 on, of which the certificate takes 2 %, then 1 to 2 us
    /// a point and way at 20,000 tetrahedra, 3 to 4 us at 80,000; 130 bytes a tetrahedron, 1.4 kB while it is made.
    pub fn icc_chart_create(
        out: *mut *mut icc_chart,
        domain: *const icc_domain,
        options: *const icc_chart_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Frees a chart.
    pub fn icc_chart_free(chart: *mut icc_chart);

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_chart_get_info(chart: *const icc_chart, info: *mut icc_chart_info) -> icc_status;

    /// Fills in what only charts of method gradient have; `size` as there. `ICC_OK`, `ICC_ERR_UNSUPPORTED` for charts
    /// that are made otherwise, or `ICC_ERR_ARGUMENT`.
    pub fn icc_chart_get_gradient_info(chart: *const icc_chart, info: *mut icc_gradient_info) -> icc_status;

    /// The same for method field.
    pub fn icc_chart_get_field_info(chart: *const icc_chart, info: *mut icc_field_info) -> icc_status;

    /// The same for method foliation in 2-D, unless the domain brings a mesh.
    pub fn icc_chart_get_foliation_info(chart: *const icc_chart, info: *mut icc_foliation_info)
        -> icc_status;

    /// The same for method foliation on a domain's mesh.
    pub fn icc_chart_get_shelling_info(chart: *const icc_chart, info: *mut icc_shelling_info) -> icc_status;

    /// The same for method disc.
    pub fn icc_chart_get_disc_info(chart: *const icc_chart, info: *mut icc_disc_info) -> icc_status;

    /// Fills in `timings`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_chart_get_timings(chart: *const icc_chart, timings: *mut icc_chart_timings) -> icc_status;

    /// The domain that the chart was made on; borrowed.
    pub fn icc_chart_domain(chart: *const icc_chart) -> *const icc_domain;

    /// Estimates what the coordinates miss. Deterministic.
    ///
    /// - `chart`: the chart
    /// - `n_points`: points to use, for the area and for the boundary each; 0: 4096
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

    /// Cartesian -> integral curve coordinates.
    ///
    /// A point on the boundary has t = 0. The maximum has t = 1, facet 0 and the facet's midpoint.
    /// A point that has no coordinates gets NaN in `bary` and `t`, UINT32_MAX in `facet` and its own
    /// status; the others are not affected.
    ///
    /// - `chart`: the chart
    /// - `n`: number of points
    /// - `points`: n * dim coordinates
    /// - `facet` (out): n indices of the boundary facet where the curve starts
    /// - `bary` (out): n * dim barycentric coordinates there: not negative, sum 1
    /// - `t` (out): n shares of the curve's arc length from the boundary, in \[0,1\]
    /// - `status` (out): n statuses: `ICC_OK`, `ICC_ERR_OUTSIDE`, `ICC_ERR_TRACE` (the curve does not
    ///   reach the boundary and the maximum), `ICC_ERR_ARGUMENT` (not finite); or NULL
    /// - `n_failed` (out): how many points have no coordinates, or NULL
    /// - `env`: may be NULL
    ///
    /// Returns `ICC_OK` when the call ran, however many points failed; `ICC_ERR_ARGUMENT`,
    /// `ICC_ERR_MEMORY`, `ICC_ERR_VERSION` or `ICC_ERR_CANCELLED` (the outputs are then undefined)
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

    /// Integral curve coordinates -> Cartesian; the inverse of `icc_chart_encode()`.
    ///
    /// - `chart`: the chart
    /// - `n`: number of points
    /// - `facet`: n facet indices
    /// - `bary`: n * dim barycentric coordinates, not negative, sum 1 (up to 1e-9)
    /// - `t`: n shares in \[0,1\]; t = 0 gives the boundary point, t = 1 the maximum
    /// - `points` (out): n * dim coordinates; NaN where there is no point
    /// - `status` (out): n statuses: `ICC_OK`, `ICC_ERR_TRACE` (the curve does not reach the maximum, or
    ///   has left the domain there), `ICC_ERR_ARGUMENT`; or NULL
    /// - `n_failed` (out): how many coordinates have no point, or NULL
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

    /// The whole curve through a point, from the boundary to the maximum, as a polyline.
    ///
    /// - `chart`: the chart
    /// - `point`: dim coordinates
    /// - `capacity`: how many points `curve` has room for
    /// - `curve` (out): capacity * dim coordinates; may be NULL when capacity is 0
    /// - `n_curve` (out): how many points the curve has, also beyond `capacity`
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_OUTSIDE`, `ICC_ERR_TRACE`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`,
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

    /// Writes a chart to memory, its domain included, so that other processes and machines can use it. The format
    /// is described in docs/reference/formats.md: versioned, the same on every machine, with a checksum.
    ///
    /// - `chart`: the chart
    /// - `capacity`: bytes that `data` has room for
    /// - `data` (out): NULL when capacity is 0
    /// - `n_bytes` (out): bytes that are needed, also beyond `capacity`: nothing useful is written then
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`
    pub fn icc_chart_save(
        chart: *const icc_chart,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a chart back: it answers as the one that was saved does, bit for bit, with any number of threads. Its
    /// info is the same but for the seconds.
    ///
    /// Charts on a mesh (foliation, disc) are read with all their numbers, and certified anew: bytes that do not
    /// pass are refused, whoever made them. Charts on a grid (gradient, field) are made again from what they
    /// were made of, and compared with a checksum of the numbers of the first.
    ///
    /// - `out` (out): the chart; owned by the caller
    /// - `n_bytes`: bytes of `data`
    /// - `data`: any bytes
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`; `ICC_ERR_FORMAT` for anything that `icc_chart_save()` did not write; `ICC_ERR_VERSION` for
    /// what a later version wrote, and for a chart on a grid that comes out otherwise here than where it was
    /// saved; `ICC_ERR_MEMORY`, `ICC_ERR_CANCELLED`, `ICC_ERR_ARGUMENT`
    ///
    /// Cost: O(n log n) time and O(n) memory in the number of bytes for charts on a mesh; that of
    /// `icc_chart_create()` for charts on a grid, up to `icc_env.load_limit`.
    pub fn icc_chart_load(
        out: *mut *mut icc_chart,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Pairs the boundaries of two domains that need not have the same number of vertices, the same first vertex
    /// or the same sense, and makes two domains of the same shapes with common vertices, ready for
    /// `icc_map_create()`. A heuristic without landmarks: `ICC_ERR_AMBIGUOUS` where another pairing is nearly as
    /// good. `landmarks`: n_landmarks * 2 dim coordinates, a point of the source, then one of the target.
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

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_match_get_info(r#match: *const icc_match, info: *mut icc_match_info) -> icc_status;

    /// Reports where the common vertices come from: n_vertices numbers each, `u32::MAX` for one that was added.
    pub fn icc_match_get_origins(r#match: *const icc_match, source: *mut u32, target: *mut u32)
        -> icc_status;

    /// Takes points of the source to the target: each to the nearest place on the rings, lines and points of
    /// `icc_match_source()`, and from there to the same place of the target. Common vertices go to their partners
    /// bit by bit.
    pub fn icc_match_apply(
        r#match: *const icc_match,
        n: usize,
        points: *const f64,
        images: *mut f64,
        off: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// Target -> source; otherwise as `icc_match_apply()`.
    pub fn icc_match_apply_inverse(
        r#match: *const icc_match,
        n: usize,
        points: *const f64,
        images: *mut f64,
        off: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// Writes a match as bytes, as `icc_chart_save()` does a chart: with both domains.
    pub fn icc_match_save(
        r#match: *const icc_match,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a match back, as `icc_chart_load()` does a chart: its domains are checked as they were when they were
    /// made, and have to correspond.
    pub fn icc_match_load(
        out: *mut *mut icc_match,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes the map between two domains whose boundaries correspond: facet i goes to facet i, with the
    /// same barycentric coordinates. Builds both charts together: foliation and disc cut both boundaries
    /// alike, and foliation pairs the maxima (the target's is where the disc maps take the source's), as
    /// field does (by the affine map that fits the boundary best, the nearer the better). On domains with meshes
    /// foliation takes a vertex of the source that is deep inside both domains, before and after a harmonic map,
    /// and the vertex of the target nearest to its image.
    ///
    /// - `out` (out): the map; owned by the caller, see `icc_map_free()`
    /// - `source`: domain before
    /// - `target`: domain after: same dimension, same number of vertices, same facets, and in 2-D the
    ///   same orientation, else `ICC_ERR_BOUNDARY`
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `side` tells source (1) from target (2)
    ///
    /// Returns as `icc_chart_create()`, or `ICC_ERR_BOUNDARY`
    ///
    /// Cost of kind mesh: that of two charts, then Newton steps on the mesh: from 4 ms for cages of some tens
    /// of vertices to 0.3 s for 15,000, and never more than a stated amount of work. Deterministic: work is
    /// counted, clocks are not read.
    pub fn icc_map_create(
        out: *mut *mut icc_map,
        source: *const icc_domain,
        target: *const icc_domain,
        options: *const icc_map_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes the map between two polygons whose vertices correspond: `icc_domain_create()` of both, then
    /// `icc_map_create()` without options. `before` and `after` have 2 n coordinates.
    pub fn icc_map_create_polygons(
        out: *mut *mut icc_map,
        n: usize,
        before: *const f64,
        after: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a map from two charts, which must use the same method and domains that correspond as
    /// `icc_map_create()` asks. Kind mesh takes the source chart's mesh. Of the options `kind` and
    /// `iterations` are used. The map keeps the charts alive.
    pub fn icc_map_create_from_charts(
        out: *mut *mut icc_map,
        source: *const icc_chart,
        target: *const icc_chart,
        options: *const icc_map_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a fairer map from one of kind mesh; the given map is not changed. The energy never rises and
    /// every intermediate map is certified, so stopping early loses nothing: when the progress callback asks
    /// to stop, the call succeeds with what it has and says so in the report. In 3-D refinements change the
    /// mesh inside by flips and by cutting edges; the surface stays as it is.
    ///
    /// - `out` (out): the map; owned by the caller
    /// - `map`: a map of kind mesh, else `ICC_ERR_UNSUPPORTED`
    /// - `options`: may be NULL
    /// - `report` (out): may be NULL; its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    pub fn icc_map_improve(
        out: *mut *mut icc_map,
        map: *const icc_map,
        options: *const icc_improve_options,
        report: *mut icc_improve_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// The map to a target that has moved: the source stays, the mesh and where its inside went are taken
    /// over from `map`, repaired, and improved by a few steps. For dragging a cage, where each frame goes on
    /// from the one before; the mesh is not refined further.
    ///
    /// - `out` (out): the map; owned by the caller. It has no charts: `icc_map_source_chart()` gives NULL.
    /// - `map`: a map of kind mesh in 2-D, else `ICC_ERR_UNSUPPORTED`
    /// - `target`: the new target, which must correspond as `icc_map_create()` asks
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns as `icc_map_create()`; `ICC_ERR_CERTIFICATE` when the target cannot be reached
    pub fn icc_map_retarget(
        out: *mut *mut icc_map,
        map: *const icc_map,
        target: *const icc_domain,
        options: *const icc_retarget_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// The mesh of a map of kind mesh, in the caller's coordinates (rounded once; the certificate is about
    /// the numbers inside).
    ///
    /// - `map`: the map
    /// - `mesh` (in, out): what it has room for is filled, in the source: triangles are counter-clockwise,
    ///   tetrahedra have positive determinants. Then its dimension and its numbers are set
    /// - `images` (out): room for n_vertices * dim coordinates in the target, or NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_UNSUPPORTED` (not of kind mesh)
    pub fn icc_map_get_mesh(map: *const icc_map, mesh: *mut icc_mesh, images: *mut f64) -> icc_status;

    /// Maps the vertices of a caller's mesh of triangles (2-D) or tetrahedra (3-D) and checks, exactly, whether the
    /// image is a mesh too. A mesh sampled from a one-to-one map need not be: its simplices are straight where
    /// the map is not.
    ///
    /// - `map`: a map in 2-D or 3-D, else `ICC_ERR_UNSUPPORTED`
    /// - `mesh`: of the dimension of the map; its vertices are in the source
    /// - `images` (out): n_vertices * dim coordinates, or NULL
    /// - `certificate` (out): its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK` when the check ran, whatever it found; `ICC_ERR_ARGUMENT`, ...
    pub fn icc_map_certify(
        map: *const icc_map,
        mesh: *const icc_mesh,
        images: *mut f64,
        certificate: *mut icc_certificate,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Carries a caller's mesh of triangles (2-D) or tetrahedra (3-D) along so that no simplex inverts: maps the
    /// vertices, then moves the images of inner ones until every simplex keeps its orientation. Inner vertices
    /// that have no image get one. Simplices and the images of boundary vertices stay, so it cannot always
    /// succeed (a simplex with all its corners on the boundary is as the map makes it); the certificate tells.
    /// Where it does not, the images are the best that there are. A mesh that could not be certified itself, or a
    /// vertex of whose boundary has no image, is not repaired.
    ///
    /// - `map`: a map in 2-D or 3-D, else `ICC_ERR_UNSUPPORTED`
    /// - `mesh`: of the dimension of the map; its vertices are in the source
    /// - `images` (out): n_vertices * dim coordinates
    /// - `certificate` (out): of the images returned; its `size` is set by the caller
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns as `icc_map_certify()`
    ///
    /// Cost: proportional to what is inverted; where patches do not suffice, some hundred passes over the mesh.
    /// Deterministic: iterations are capped, clocks are not read.
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

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_map_get_info(map: *const icc_map, info: *mut icc_map_info) -> icc_status;

    /// The same for `report`. If the mesh's coordinates have to be rounded, counting n_spoilt takes a pass
    /// over the mesh.
    pub fn icc_map_get_report(map: *const icc_map, report: *mut icc_map_report) -> icc_status;

    /// Reports a tie of a map of domains with features, less than `icc_map_info.n_ties`: all of them, as
    /// `icc_map_options.ties`, make another map that can be moved to this one while it stays one-to-one.
    /// - `source` (out): 2 * n_source coordinates of bends, or NULL
    /// - `target` (out): 2 * n_target coordinates of bends, or NULL
    ///
    /// Returns `ICC_OK`; `ICC_ERR_ARGUMENT` (`map` or `info` is NULL, or there is no such tie).
    pub fn icc_map_get_tie(
        map: *const icc_map,
        tie: usize,
        info: *mut icc_tie_info,
        source: *mut f64,
        target: *mut f64,
    ) -> icc_status;

    /// The chart of the source; borrowed. NULL for maps made by `icc_map_retarget()`.
    pub fn icc_map_source_chart(map: *const icc_map) -> *const icc_chart;

    /// The chart of the target; borrowed. NULL for maps made by `icc_map_retarget()`.
    pub fn icc_map_target_chart(map: *const icc_map) -> *const icc_chart;

    /// Source -> target.
    ///
    /// - `map`: the map
    /// - `n`: number of points
    /// - `points`: n * dim coordinates in the source
    /// - `images` (out): n * dim coordinates; NaN for a point that has no image. May be `points`.
    /// - `status` (out): n statuses: `ICC_OK`, `ICC_ERR_OUTSIDE`, `ICC_ERR_TRACE`, `ICC_ERR_ARGUMENT`; or
    ///   NULL
    /// - `n_failed` (out): how many points have no image, or NULL
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

    /// Target -> source; otherwise as `icc_map_apply()`.
    pub fn icc_map_apply_inverse(
        map: *const icc_map,
        n: usize,
        points: *const f64,
        images: *mut f64,
        status: *mut icc_status,
        n_failed: *mut usize,
        env: *const icc_env,
    ) -> icc_status;

    /// The derivative of the map at points of the source, exact for the piecewise map up to rounding;
    /// one-sided where it has a kink.
    ///
    /// - `map`: the map
    /// - `n`: number of points
    /// - `points`: n * dim coordinates in the source's interior; on the boundary and at the
    ///   maximum there is no derivative (`ICC_ERR_TRACE`)
    /// - `jacobians` (out): n * dim * dim: row i, column j is the derivative of image coordinate i by
    ///   point coordinate j; NaN where there is none
    /// - `status` (out): n statuses, or NULL
    /// - `n_failed` (out): how many points have none, or NULL
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

    /// Writes a map to memory, with its domains and charts; otherwise as `icc_chart_save()`.
    pub fn icc_map_save(
        map: *const icc_map,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a map back, as `icc_chart_load()` does a chart. The mesh of a map of kind mesh is read with all its
    /// numbers, and certified anew.
    pub fn icc_map_load(
        out: *mut *mut icc_map,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Carries a picture along: every pixel of the target whose centre lies in the target domain or on its
    /// boundary gets the colour of the place in the source that goes there; all others are left alone. Pixel
    /// (i, j), column i of row j, covers \[i, i+1\] x \[j, j+1\] in the coordinates of the domains.
    ///
    /// Colours between pixels are bilinear, and weighted by opacity. Where the map shrinks the picture they
    /// are means of up to 16 x 16 samples, so that it does not alias. Beyond its rim the source goes on with
    /// the colour of the rim. A map that is the identity copies exactly.
    ///
    /// - `map`: the map, 2-D; kind mesh is the fast one
    /// - `source`: read
    /// - `target`: the same channels, bytes and alpha as the source, any width and height. Its pixels
    ///   must not overlap the source's.
    /// - `n_failed` (out): pixels inside that have no image, which are left alone, or NULL; always 0 for kind
    ///   mesh
    /// - `env`: may be NULL; results are the same for every number of threads
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, `ICC_ERR_VERSION`, `ICC_ERR_CANCELLED` (some
    /// pixels have been written)
    ///
    /// Cost of kind mesh: nanoseconds a pixel.
    pub fn icc_map_warp(
        map: *const icc_map,
        source: *const icc_picture,
        target: *const icc_picture,
        n_failed: *mut usize,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;
}

// icc/stages.h

opaque!(
    /// A regular grid of vertices, each inside or outside of a shape. Vertex (i_0, i_1, ..) has the
    /// index i_0 + shape\[0\] * (i_1 + shape\[1\] * (..)) and the position origin + spacing * i.
    icc_grid
);

/// What `icc_grid_get_info()` tells.
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
    /// distance of neighbours, the same along every axis
    pub spacing: f64,
    /// product of `shape`
    pub n_vertices: usize,
    /// vertices inside
    pub n_inside: usize,
    /// vertices that lie inside the boundary, but were taken outside: pieces
    /// beside the largest (see `icc_grid_create()`), and what
    /// `icc_grid_restrict()` took
    pub n_stray: usize,
    /// grid cells along the longest side of the domain; 0 for a grid from
    /// a mask of vertices
    pub cells: i32,
}
sized!(icc_grid_info);

opaque!(
    /// A breadth-first tree over a grid; a cousin tree where the shape allows it.
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
    /// the order in which a generation expands along the axes, a
    /// permutation of 0..dim-1; NULL: 0, 1, ..
    pub axis_order: *const i32,
}
sized!(icc_tree_options);

/// What `icc_tree_get_report()` found.
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
    /// neighbouring vertices, both inside and reached
    pub n_pairs: usize,
    /// pairs that are neither parent and child nor cousins
    pub n_cousin_violations: usize,
    /// the first such pair in index order, or UINT32_MAX
    pub violation: [u32; 2],
}
sized!(icc_tree_report);

opaque!(
    /// A function on the vertices of a tree that falls from parent to child.
    icc_function
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
    /// `ICC_SOLVER_*`; 0: by the predicted work of a factorisation. Clamped and
    /// constrained bi-Laplace are always factorised; Laplace is iterated
    /// where a factorisation loses small values, as in long thin rings
    pub solver: i32,
    /// least relative fall from parent to child, in (0, 0.01\]; 0: 1e-6
    pub min_fall: f64,
    /// constrained bi-Laplace: least value at vertices without children, in
    /// (0, 0.01\]; 0: 1e-9
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
    /// 1: `highest` is not the root, where curves should end. Only seen for bilaplace and clamped
    /// without inequalities; `icc_chart_create()` then moves the root
    pub beside: i32,
    /// vertices inside that the tree reaches, except the root
    pub n_unknowns: usize,
    /// tree edges where the function without constraints breaks the inequality; where this function
    /// does, if it was not constrained
    pub n_violated: usize,
    /// inequalities that hold with equality
    pub n_active: usize,
    /// KKT residual: the largest |min(slack, multiplier)| of an inequality, or |row of the
    /// equation| if there are none; f is 1 at the root
    pub residual: f64,
    /// the smallest of `icc_function_logs()` inside; 0 if there are none
    pub least_log: f64,
    /// by what share of its value at the root the function is greater at `highest`; 0 if that is
    /// the root
    pub excess: f64,
    /// the vertex inside with the greatest value
    pub highest: u32,
}
sized!(icc_function_info);

/// What `icc_function_get_solver_report()` reports: how the function was computed. Members that do not
/// apply are 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_solver_report {
    /// set by the caller: `sizeof(icc_solver_report)`
    pub size: usize,
    /// iterations of the active set or the interior point method; 0 without constraints
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

/// Critical points of a function on the vertices inside, by the links of the Kuhn triangulation.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_function_report {
    /// set by the caller: `sizeof(icc_function_report)`
    pub size: usize,
    /// vertices with no higher neighbour
    pub n_maxima: usize,
    /// vertices with no lower neighbour
    pub n_minima: usize,
    /// other vertices where the higher or the lower neighbours do not form a
    /// contractible set. Exact up to 3-D; beyond, this is decided by strong
    /// collapses, and a vertex where neither set collapses counts.
    pub n_saddles: usize,
    /// the first critical vertex in index order other than the root, or
    /// UINT32_MAX
    pub critical: u32,
}
sized!(icc_function_report);

// Kinds of edges in `icc_function_get_edges()`.
/// the gradients on both sides point to the edge
pub const ICC_EDGE_COMPRESSION: i32 = 1;
/// the gradients on both sides point away from it
pub const ICC_EDGE_EXPANSION: i32 = 2;

// How `icc_tree_grow()` found an order.
/// the order wished for is regular
pub const ICC_GROW_AS_GIVEN: i32 = 1;
/// some vertices had to wait for others
pub const ICC_GROW_GROWN: i32 = 2;
/// growth got stuck; the vertices were removed one by one instead, and the
/// order read backwards
pub const ICC_GROW_THINNED: i32 = 3;

/// What `icc_tree_grow()` found.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_grow_report {
    /// set by the caller: `sizeof(icc_grow_report)`
    pub size: usize,
    /// `ICC_GROW_*`
    pub method: i32,
    /// the first vertex in the order wished for that growth could not place, or
    /// UINT32_MAX
    pub vertex: u32,
    /// vertices inside that the tree reaches
    pub n_vertices: usize,
    /// vertices that had to wait while growing
    pub n_deferred: usize,
    /// vertices left when growth got stuck
    pub n_unplaced: usize,
    /// vertices left, but for the root, when thinning got stuck, too
    pub n_remaining: usize,
    /// edges of the Kuhn triangulation along which the order is not as wished
    pub n_reversed: usize,
    /// links that were looked at: less than 2^(dim+3) a vertex
    pub n_tests: usize,
}
sized!(icc_grow_report);

extern "C" {
    /// Covers a domain with a grid, at least two vertices wider than the domain on every side.
    ///
    /// A vertex is inside when it lies strictly inside the boundary. Where a domain is thinner than the grid,
    /// the vertices inside may fall into pieces; beyond 2-D only the largest of them is kept, and the
    /// others are counted (`icc_grid_info.n_stray`).
    ///
    /// The grid of a mask (`icc_domain_create_mask()`) has the boundary's vertices among its own: each cell of
    /// the mask is cut in an even number of parts along each axis, 2 or as many more as `cells` asks for.
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `domain`: the domain
    /// - `cells`: cells along the longest side of the bounding box, 2..16384; 0: 50. For masks: at
    ///   least so many; 0: two for each cell of the mask
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_RESOLUTION` (no vertex inside, or more than 2^28 vertices), ...
    pub fn icc_grid_create(
        out: *mut *mut icc_grid,
        domain: *const icc_domain,
        cells: i32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes a grid from a mask of its vertices: origin 0, spacing 1.
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `dim`: 1..`ICC_MAX_DIM`
    /// - `shape`: vertices along each axis, dim numbers; the first axis runs fastest
    /// - `inside`: one byte per vertex: 0 outside, anything else inside
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

    /// Makes a grid of half the spacing with the same inside: each simplex of the Kuhn triangulation is cut
    /// into 2^dim, and a new vertex is inside when both ends of the edge that it halves are. Walls one
    /// vertex thick stay so; for a grid that follows its domain more closely, make one with twice
    /// `icc_grid_info.cells`.
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `grid`: the grid
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_RESOLUTION` (more than 2^28 vertices), ...
    pub fn icc_grid_refine(
        out: *mut *mut icc_grid,
        grid: *const icc_grid,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Copies a grid and takes some vertices outside.
    ///
    /// - `out` (out): the grid; owned by the caller
    /// - `grid`: the grid
    /// - `keep`: one byte per vertex: 0 takes it outside, which `icc_grid_info.n_stray` counts
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

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_grid_get_info(grid: *const icc_grid, info: *mut icc_grid_info) -> icc_status;

    /// One byte per vertex, 1 inside and 0 outside; borrowed.
    pub fn icc_grid_inside(grid: *const icc_grid) -> *const u8;

    /// The vertex farthest from the outside in the grassfire transform (Algorithm 1). Of several, the one
    /// nearest to their mean is taken, then the one with the smallest index.
    ///
    /// - `grid`: the grid
    /// - `vertex` (out): the maximum
    /// - `rounds` (out): how often the fire burnt before it reached the vertex (0 next to the
    ///   outside), or NULL
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

    /// The inside vertex nearest to a point (the smallest index of several). O(vertices).
    pub fn icc_grid_find_nearest(grid: *const icc_grid, point: *const f64, vertex: *mut u32) -> icc_status;

    /// Grows the tree of Algorithm 2 from a vertex inside.
    ///
    /// In both forms the vertices outside that neighbour the inside have a generation: one more than the
    /// smallest among their neighbours inside. In the thesis' form they and the vertices that they expand
    /// into belong to the tree and have a parent; in the paper's form their parent is UINT32_MAX, standing
    /// for all their neighbours inside. A grid made by `icc_grid_create()` is wide enough for both layers; a
    /// mask may end at its last vertex, and layers beyond it are then absent.
    ///
    /// Theorem 2 of the paper (the result is a cousin tree) held in every 2-D case tried; it is false in
    /// 3-D and beyond. Nothing is assumed here: see `icc_tree_get_report()`, and `icc_tree_grow()` for an order
    /// that serves the purpose there.
    ///
    /// - `out` (out): the tree; owned by the caller; keeps the grid alive
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

    /// Frees a tree.
    pub fn icc_tree_free(tree: *mut icc_tree);

    /// The parent of each vertex: UINT32_MAX for the root and for vertices without one; borrowed.
    pub fn icc_tree_parents(tree: *const icc_tree) -> *const u32;

    /// The generation of each vertex: 0 for the root, -1 for vertices that are not reached; borrowed.
    pub fn icc_tree_generations(tree: *const icc_tree) -> *const i32;

    /// Checks the cousin rule (Definition 2) on every pair of neighbours inside. O(vertices * dim).
    pub fn icc_tree_get_report(
        tree: *const icc_tree,
        report: *mut icc_tree_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Gives values to the vertices of a tree.
    ///
    /// decay: 10 at the root, times 0.95 with each generation (thesis, equation 4.1), and -1, -2, .. for the
    /// generations where that would underflow, from about 13,850 on. distance: minus the generation. Both
    /// depend on the generation alone.
    ///
    /// laplace: 1 at the root, 0 at the vertices outside that neighbour the inside, and at every other vertex
    /// the mean of its neighbours: the function with the least Dirichlet energy. (Beyond those zeros, minus
    /// the value two steps back.) bilaplace: that with the least sum of squared Laplacians over the vertices
    /// inside, which is f = c L^-2 e_root (simply supported, Navier); clamped: over the vertices next to them
    /// outside, too. Laplace and bilaplace are positive inside, however far from the root; clamped changes its
    /// sign unless it is constrained. With constraints, the least energy among the functions that fall by
    /// `min_fall` along every tree edge inside and, for bilaplace and clamped, are at least `leaf_min` at the leaves.
    ///
    /// Bilaplace and clamped are shapes of a plate that is loaded at the root, and a plate is highest beside
    /// a load that is not in its middle: without constraints the maximum may be another vertex, see
    /// `icc_function_info::highest` and `icc_function_info::beside`. (On a tree that grows from there the function is
    /// another one; `icc_chart_create()` moves the root until the two agree.)
    ///
    /// Nothing is assumed about critical points: see `icc_function_get_report()`. Inequalities on a tree that is not a
    /// cousin tree, as in 3-D, do not rule out others than the maximum.
    ///
    /// - `out` (out): the field; owned by the caller; keeps the tree alive
    /// - `tree`: the tree
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`; `ICC_ERR_SOLVER` when a solver did not converge, which has only been seen with
    /// inequalities on bilaplace and clamped, where they ask for more than 1 at the root (as `leaf_min` and `min_fall` do of
    /// deep trees) or `leaf_min` is 1e-2; `ICC_ERR_RESOLUTION` when the root is
    /// the only vertex inside (laplace, bilaplace, clamped); `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`,
    /// `ICC_ERR_CANCELLED`, `ICC_ERR_VERSION`
    pub fn icc_function_create(
        out: *mut *mut icc_function,
        tree: *const icc_tree,
        options: *const icc_function_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// The function of a gradient chart, or NULL for other charts; borrowed, as is what hangs on it.
    pub fn icc_chart_function(chart: *const icc_chart) -> *const icc_function;

    /// The tree that a field was made on; borrowed.
    pub fn icc_function_tree(field: *const icc_function) -> *const icc_tree;

    /// The grid that a tree was grown on; borrowed.
    pub fn icc_tree_grid(tree: *const icc_tree) -> *const icc_grid;

    /// The vertex that a tree was grown from; UINT32_MAX for NULL.
    pub fn icc_tree_root(tree: *const icc_tree) -> u32;

    /// Frees a field.
    pub fn icc_function_free(field: *mut icc_function);

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_function_get_info(field: *const icc_function, info: *mut icc_function_info) -> icc_status;

    /// The same for `report`.
    pub fn icc_function_get_solver_report(
        function: *const icc_function,
        report: *mut icc_solver_report,
    ) -> icc_status;

    /// One value per grid vertex; NaN where the tree does not reach; borrowed. (Beyond 2-D the function of a
    /// gradient chart goes on to some vertices outside.) Laplace and bilaplace decay exponentially in long
    /// limbs: values below 2^-1022 are 0 here, see `icc_function_logs()`.
    pub fn icc_function_values(field: *const icc_function) -> *const f64;

    /// The natural logarithm of every value, accurate also where the values underflow; -HUGE_VAL outside, NaN
    /// where the tree does not reach; borrowed. NULL for decay and distance, and when some value
    /// inside is not positive.
    pub fn icc_function_logs(field: *const icc_function) -> *const f64;

    /// Counts critical points. Vertices outside or without a value count as lower than all others, equal
    /// values are ordered by vertex index. About 10 ns a vertex in 2-D and 3-D; up to 1, 4 and 10 us in
    /// 4-D, 5-D and 6-D.
    pub fn icc_function_get_report(
        field: *const icc_function,
        report: *mut icc_function_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Lists compression and expansion edges (2-D): edges between two triangles with a value at every
    /// corner, at least one of whose corners is inside (thesis, sections 5 and 6.4).
    ///
    /// - `field`: the field
    /// - `capacity`: how many edges the arrays have room for
    /// - `edges` (out): `capacity` pairs of vertices
    /// - `kinds` (out): `capacity` kinds, `ICC_EDGE_*`
    /// - `n_edges` (out): how many there are in all, also beyond `capacity`
    /// - `n_tested` (out): how many edges were looked at, or NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT`, `ICC_ERR_UNSUPPORTED` (not 2-D)
    pub fn icc_function_get_edges(
        field: *const icc_function,
        capacity: usize,
        edges: *mut u32,
        kinds: *mut i32,
        n_edges: *mut usize,
        n_tested: *mut usize,
    ) -> icc_status;

    /// Orders the vertices inside so that the root is the only critical one.
    ///
    /// In 2-D the tree's own order has been so in every case tried; beyond, it is often not (see
    /// `icc_tree_create()`). Here a set grows from the root and takes, in the order wished for, each vertex
    /// whose neighbours in the set are a contractible part of its link; others wait until they are. (Links
    /// are those of the Kuhn triangulation, decided as for `icc_function_report.n_saddles`.) If growth gets
    /// stuck, the set of all vertices is thinned down to the root instead. A function that falls with the
    /// rank has one critical point, the maximum, in any dimension. There are shapes where both fail, such as
    /// Bing's house with two rooms: a finer grid may help. Nothing helps a shape that is not a ball, as the
    /// vertices inside a surface may be where parts of it come near each other; growth then leaves the few
    /// vertices where it would close a ring.
    ///
    /// - `tree`: the tree
    /// - `values`: the order wished for, one value per grid vertex, the largest first; equal ones
    ///   in the order of the tree. NULL: the order of the tree.
    /// - `rank` (out): room for one number per grid vertex: 0 for the root, then 1, 2, ..; UINT32_MAX
    ///   for vertices outside or not reached. After `ICC_ERR_TOPOLOGY` the vertices that
    ///   growth has placed have their ranks, the others UINT32_MAX: without these, as
    ///   `icc_grid_restrict()` makes the grid, the order has one critical vertex. After
    ///   another failure undefined.
    /// - `report` (out): what was done, or NULL; also after `ICC_ERR_TOPOLOGY`
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names the vertex where growth got stuck
    ///
    /// Returns `ICC_OK`, `ICC_ERR_TOPOLOGY` (stuck), `ICC_ERR_ARGUMENT` (a value inside is NaN), ...
    ///
    /// Cost: less than 2^(dim+3) tests a vertex, in practice about one: 0.1 us in 2-D, 0.13 to 0.3 us in 3-D,
    /// 0.5 us in 4-D, 2 us in 5-D. 6 bytes a grid vertex, and 8 a vertex inside for `values`.
    pub fn icc_tree_grow(
        tree: *const icc_tree,
        values: *const f64,
        rank: *mut u32,
        report: *mut icc_grow_report,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Counts the critical vertices of any order of the vertices inside that the tree reaches, as
    /// `icc_function_get_report()` does for functions: by looking at every link, whatever the order comes from.
    ///
    /// - `tree`: the tree
    /// - `rank`: one number per grid vertex, smaller for higher vertices; equal ones count as
    ///   `icc_function_get_report()` says. Those of other vertices do not matter.
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

    /// Constrained Delaunay triangulation of a simple polygon with points inside (2-D).
    ///
    /// All decisions are exact. Triangles are counter-clockwise (with y upwards). A polygon of b vertices
    /// with p points inside has b + 2 p - 2 triangles, always; no vertex is added.
    ///
    /// - `n_boundary`: vertices of the polygon, either orientation; they come first
    /// - `n_points`: all vertices, those of the polygon included
    /// - `points`: n_points * 2 coordinates
    /// - `triangles` (out): room for 3 * (2 * n_points - n_boundary - 2) vertex indices
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names a point that is not strictly inside the polygon,
    ///   or that repeats another
    ///
    /// Returns `ICC_OK`, `ICC_ERR_BOUNDARY`, `ICC_ERR_OUTSIDE`, `ICC_ERR_ARGUMENT`, `ICC_ERR_MEMORY`, ...
    ///
    /// Cost: O(n log n) in practice, about 1 us a vertex; 100 bytes a vertex.
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
    /// What is to be deformed: filled regions and curves.
    icc_shape
);

opaque!(
    /// Points spread over a shape.
    icc_sampling
);

// How samples are spread.
/// a regular grid from the lower corner of the regions' box, the first axis fastest
pub const ICC_SAMPLING_GRID: i32 = 1;
/// blue noise: random, yet evenly spaced; on the boundaries and curves, too
pub const ICC_SAMPLING_BLUE: i32 = 2;
/// the caller's points: `icc_sampling_create_from_points()` only
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
    /// T, the distance of neighbours; 0: 1/100 of the longest side
    pub spacing: f64,
    /// grid: how far from the regions it goes, in spacings; 0: not beyond them
    pub margin: f64,
    /// blue: of the random numbers; equal seeds give equal samplings
    pub seed: u64,
    /// points that shall be samples
    pub n_fixed: usize,
    /// n_fixed * dim coordinates, or NULL. Blue only.
    pub fixed: *const f64,
}
sized!(icc_sampling_options);

/// What `icc_sampling_get_info()` tells.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_sampling_info {
    /// set by the caller: `sizeof(icc_sampling_info)`
    pub size: usize,
    /// dimension
    pub dim: i32,
    /// `ICC_SAMPLING_*`
    pub kind: i32,
    /// samples
    pub n_samples: usize,
    /// of them on boundaries and curves; with blue noise the first ones
    pub n_edge: usize,
    /// T as asked for; of the caller's points the mean distance of nearest neighbours
    pub spacing: f64,
    /// the least distance of two samples, over T
    pub nearest: f64,
    /// suggested width of the kernel: from the samples' spectrum (figure 6.10); 3 T / pi
    /// for a grid (3.28) and the caller's points
    pub sigma: f64,
}
sized!(icc_sampling_info);

opaque!(
    /// Handles, and the weight of each at every place of a shape.
    icc_weights
);

// The kernel that is summed up.
/// Wendland's C2 function of radius 3 sigma: smooth, and positive definite at
/// any width
pub const ICC_KERNEL_WENDLAND: i32 = 1;
/// the thesis': exp(-d^2 / (2 sigma^2)), cut off at `cutoff` sigma, where it
/// jumps; not always positive definite
pub const ICC_KERNEL_GAUSS: i32 = 2;

// Where the weights start from.
/// diffusion of an impulse at each handle (4.11, 4.12)
pub const ICC_INITIAL_HEAT: i32 = 1;
/// diffusion, with weights that are linear along the edges held (4.7, 4.13)
pub const ICC_INITIAL_EDGES: i32 = 2;
/// inverse squared distance to the handles (4.10), p a tenth of their extent
pub const ICC_INITIAL_INVERSE: i32 = 3;
/// the caller's
pub const ICC_INITIAL_GIVEN: i32 = 4;

// What is optimised at each sample, under the conditions that weights sum to 1 and reproduce the sample.
/// least change of the initial weights, none negative (4.1)
pub const ICC_WEIGHTS_QP: i32 = 1;
/// least change, of any sign (4.2 to 4.6)
pub const ICC_WEIGHTS_EQUALITY: i32 = 2;
/// least sum of absolute changes (4.8); of several solutions the one with the
/// least sum of squared changes
pub const ICC_WEIGHTS_L1: i32 = 3;

/// A segment along which weights are linear: what lies on it stays straight (5.6). It has nodes at both ends and
/// between them, one spacing apart or a little less; nodes beside it follow it, the nearer the more. Spread the
/// samples with those places fixed for the best spacing.
///
/// An end may be a handle, or an end of an earlier line. Lines should not cross: where they come near each other, or a
/// handle, the earlier one and the handle prevail.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_line {
    /// an end of it, in the shape; at least half a spacing away from the other
    pub from: [f64; 3],
    /// the other
    pub to: [f64; 3],
    /// 0, or k to stay parallel to line k - 1, an earlier one (5.11), which it must be to
    /// 1e-9 of its length; `to` must then be neither a handle nor on an earlier line
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
    /// of diffusion; 0: 5
    pub steps: i32,
    /// an affine function beside the kernels, which makes sums and reproduction
    /// exact between the samples: 0 or 1 with, -1 without (the thesis)
    pub affine_tail: i32,
    /// diffusion between samples that see each other inside the shape: 0 or 1; -1
    /// through walls, too (the thesis)
    pub within_shape: i32,
    /// width of the kernel; 0: `icc_sampling_info.sigma`
    pub sigma: f64,
    /// Gauss: in sigma; 0: 5
    pub cutoff: f64,
    /// edges between handles
    pub n_edges: usize,
    /// n_edges * 2 handle indices, or NULL
    pub edges: *const u32,
    /// lines to keep straight
    pub n_lines: usize,
    /// or NULL
    pub lines: *const icc_line,
    /// n_samples * n_handles, sample after sample; for initial given
    pub initial_weights: *const f64,
}
sized!(icc_weights_options);

/// What `icc_weights_get_info()` tells.
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
    /// handles
    pub n_handles: usize,
    /// places that carry weights: the handles first, then those on lines, then the
    /// samples, but for those within half a spacing of a handle or a line's node
    pub n_nodes: usize,
    /// QP: nodes where no weights that are not negative reproduce the point (outside
    /// the handles' convex hull): QP is relaxed there, the sums still hold
    pub n_infeasible: usize,
    /// kernel values of the matrix, diagonal included, one triangle
    pub n_entries: usize,
    /// width of the kernel
    pub sigma: f64,
    /// how far the matrix is from losing positive definiteness: its least pivot over
    /// the greatest
    pub definiteness: f64,
    /// of `icc_weights_stiffen()`, if that made these weights: how far they are from its program's
    /// optimality conditions, as the step that is still possible down the energy's projected
    /// gradient, over the one at the start; else 0
    pub residual: f64,
}
sized!(icc_weights_info);

/// How long each step of making weights took, in seconds: what `icc_weights_get_timings()` fills in. Weights that were
/// made from others have the steps that were done again; the other members are those of the weights before.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_weights_timings {
    /// set by the caller: `sizeof(icc_weights_timings)`
    pub size: usize,
    /// placing the nodes, and the factorisation
    pub factor: f64,
    /// the initial weights
    pub initial: f64,
    /// the optimisation
    pub optimise: f64,
}
sized!(icc_weights_timings);

/// How well weights do what they should, at points of the caller's choice.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct icc_weights_report {
    /// set by the caller: `sizeof(icc_weights_report)`
    pub size: usize,
    /// see `icc_weights_info.n_infeasible`
    pub n_infeasible: usize,
    /// points where a weight is below -1e-9
    pub n_negative: usize,
    /// the greatest deviation of the sum of weights from 1
    pub unity: f64,
    /// the greatest distance of a point from what its weights make of the handles
    pub reproduction: f64,
    /// the mean of these
    pub reproduction_mean: f64,
    /// the greatest deviation from 1 and 0 at the handles
    pub lagrange: f64,
    /// the greatest deviation from linear weights along the edges
    pub linearity: f64,
    /// the least weight
    pub least_weight: f64,
    /// see `icc_weights_info.definiteness`
    pub definiteness: f64,
}
sized!(icc_weights_report);

opaque!(
    /// Points with their weights, and the derivatives if asked for: for posing again and again.
    icc_binding
);

extern "C" {
    /// Makes a shape from regions and curves, which may be mixed.
    ///
    /// Regions are domains. Their boundaries must not meet, which is checked exactly. One may lie within another: the
    /// boundaries are walls between them, and a point belongs to the innermost region around it, a point on a boundary
    /// to what that encloses. So a star in a square is a star and its surroundings. Curves are segments between
    /// vertices; they may lie anywhere, and are no walls. Weights spread over a boundary outward only, from what it
    /// encloses to what is around it: so they do not take the way through the surroundings from one limb to another.
    ///
    /// - `out` (out): the shape; owned by the caller. It keeps the regions alive.
    /// - `dim`: 2 or 3
    /// - `n_regions`: regions; 0 for curves alone
    /// - `regions`: n_regions domains of dimension `dim`
    /// - `n_vertices`: vertices of the curves
    /// - `vertices`: n_vertices * dim coordinates
    /// - `n_segments`: segments of the curves
    /// - `segments`: n_segments * 2 vertex indices
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names the region, vertex or segment at fault
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT` (no region and no segment, a vertex that is not finite or not there, a
    /// segment without length), `ICC_ERR_MEMORY`, `ICC_ERR_BOUNDARY` (boundaries meet),
    /// `ICC_ERR_VERSION`, `ICC_ERR_CANCELLED`
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

    /// Spreads samples over a shape. No sample comes to lie on the wrong side of a wall.
    ///
    /// Blue noise: boundaries and curves get samples about T apart, at their ends, forks and corners first, and keep
    /// them. The rest starts from a shaken lattice and is relaxed (6.4), no nearer to a boundary than 0.4 T. Fixed
    /// points stay where they are; samples on boundaries make room for them.
    ///
    /// - `out` (out): the sampling; owned by the caller. It keeps the shape alive.
    /// - `shape`: the shape
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_RESOLUTION` (no sample lies inside some region, named, or there would be more
    /// than 2^24), `ICC_ERR_OUTSIDE` (a fixed point is in no region), `ICC_ERR_ARGUMENT` (a grid for curves
    /// alone, a fixed point that is not finite, ...), `ICC_ERR_MEMORY`, `ICC_ERR_VERSION`,
    /// `ICC_ERR_CANCELLED`
    ///
    /// Cost: O(steps * n) time and O(n) memory: 10,000 samples take less than a second.
    pub fn icc_sampling_create(
        out: *mut *mut icc_sampling,
        shape: *const icc_shape,
        options: *const icc_sampling_options,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// A sampling from the caller's points, which keep their order. The suggested width follows from their mean
    /// spacing.
    ///
    /// Returns `ICC_OK`, `ICC_ERR_OUTSIDE` (a point lies in no region and on no curve; `index` names it),
    /// `ICC_ERR_ARGUMENT` (not finite, or two points are the same), `ICC_ERR_MEMORY`
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

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_sampling_get_info(sampling: *const icc_sampling, info: *mut icc_sampling_info) -> icc_status;

    /// Copies the samples: room for n_samples * dim doubles. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_sampling_get_points(sampling: *const icc_sampling, points: *mut f64) -> icc_status;

    /// Writes a sampling to memory, its shape included. The format is described in docs/reference/formats.md: versioned, the
    /// same on every machine, with a checksum.
    ///
    /// - `sampling`: the sampling
    /// - `capacity`: bytes that `data` has room for
    /// - `data` (out): NULL when capacity is 0
    /// - `n_bytes` (out): bytes that are needed, also beyond `capacity`: nothing useful is written then
    pub fn icc_sampling_save(
        sampling: *const icc_sampling,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// Reads a sampling back, bit for bit. `ICC_ERR_FORMAT` for anything that `icc_sampling_save()` did not write,
    /// `ICC_ERR_VERSION` for what a later version did; any bytes are safe to try.
    pub fn icc_sampling_load(
        out: *mut *mut icc_sampling,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes weights for handles.
    ///
    /// - `out` (out): the weights; owned by the caller. They keep the sampling alive.
    /// - `sampling`: the samples
    /// - `n_handles`: handles, at least dim + 1
    /// - `handles`: n_handles * dim coordinates, in the shape, not all in one plane (2-D: line)
    /// - `options`: may be NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL; `index` names the handle, edge or line at fault
    ///
    /// Returns `ICC_OK`; `ICC_ERR_OUTSIDE` (a handle or line outside the shape); `ICC_ERR_ARGUMENT` (two handles at
    /// one place, handles that cannot reproduce points, weights that are not finite, ...);
    /// `ICC_ERR_SOLVER` (sigma is too large for a positive definite matrix); `ICC_ERR_MEMORY`,
    /// `ICC_ERR_VERSION`, `ICC_ERR_CANCELLED`
    ///
    /// Cost with n nodes, m handles and k neighbours within the kernel's reach: O(steps n k m) for diffusion,
    /// O(n m) for the weights, and a sparse factorisation, O(n^1.5) in 2-D.
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

    /// Fills in `info`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_weights_get_info(weights: *const icc_weights, info: *mut icc_weights_info) -> icc_status;

    /// Fills in `timings`, whose `size` the caller has set. `ICC_OK` or `ICC_ERR_ARGUMENT`.
    pub fn icc_weights_get_timings(weights: *const icc_weights, timings: *mut icc_weights_timings) -> icc_status;

    /// Copies the nodes.
    ///
    /// - `weights`: the weights
    /// - `points` (out): n_nodes * dim coordinates, or NULL
    /// - `initial` (out): n_nodes * n_handles initial weights, or NULL
    /// - `values` (out): n_nodes * n_handles weights, or NULL
    /// - `status` (out): n_nodes statuses: `ICC_OK`, or `ICC_ERR_SOLVER` where QP was relaxed; or NULL
    pub fn icc_weights_get_nodes(
        weights: *const icc_weights,
        points: *mut f64,
        initial: *mut f64,
        values: *mut f64,
        status: *mut icc_status,
    ) -> icc_status;

    /// Paints: adds amount * brush to the weight of one handle at the nodes around a place, and optimises them
    /// again from there. The brush falls smoothly from 1 at the centre to 0 at the radius. Handles, nodes on lines and
    /// nodes on edges that are held stay as they are.
    ///
    /// - `out` (out): new weights at the same nodes; owned by the caller. The old ones do not change.
    /// - `weights`: the weights to change
    /// - `handle`: whose weight
    /// - `centre`: dim coordinates
    /// - `radius`: positive
    /// - `amount`: positive or negative
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    ///
    /// Cost: as many weights are optimised as there are nodes within the radius, and one solution with the
    /// factor that there is.
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

    /// The same with given weights: at node nodes\[i\] they start from
    /// values\[i * n_handles ...\] and are optimised again. No node may be named twice.
    pub fn icc_weights_repaint(
        out: *mut *mut icc_weights,
        weights: *const icc_weights,
        n: usize,
        nodes: *const u32,
        values: *const f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// The same nodes and initial weights with another method (`ICC_WEIGHTS_*`): what was painted or stiffened is
    /// gone, as in the thesis (6.3.1).
    pub fn icc_weights_with_method(
        out: *mut *mut icc_weights,
        weights: *const icc_weights,
        method: i32,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Makes weights vary as little as may be over a part of the shape, so that it moves as if it were rigid
    /// (5.12 to 5.35, with the sign of 5.35a mended). One quadratic program for the weights at the part's nodes and
    /// at those around it, within the kernel's reach: least is half the sum of squared derivatives at the part's
    /// nodes, weighted by `rigidity`, and of a tenth (times the mean rigidity) of those of the change around it. Sums
    /// and reproduction hold; handles, nodes on edges and on lines, and all nodes further away keep their weights;
    /// with QP no weight becomes negative at a node where none was. The residual of the optimality conditions is at
    /// most 1e-8 (`icc_weights_info::residual`), the program's value within 1e-6 of its least.
    ///
    /// - `out` (out): new weights; owned by the caller
    /// - `weights`: the weights to change
    /// - `n`: nodes of the part
    /// - `nodes`: their indices
    /// - `rigidity`: n positive numbers, how much each matters; NULL: all the same
    /// - `energy`: half the weighted sum of squared derivatives at the part's nodes, before and after; or NULL
    /// - `env`: may be NULL
    /// - `err`: may be NULL
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

    /// Weights at points.
    ///
    /// - `weights`: the weights
    /// - `n`: number of points
    /// - `points`: n * dim coordinates. Any finite point has weights; far from all nodes they are
    ///   those of the affine tail, or 0 without.
    /// - `values` (out): n * n_handles weights
    /// - `gradients` (out): n * n_handles * dim derivatives, or NULL (3.44)
    /// - `status` (out): n statuses: `ICC_OK`, `ICC_ERR_ARGUMENT` (not finite; its values are NaN); or NULL
    /// - `n_failed` (out): how many points have none, or NULL
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

    /// The dual function of a node (3.2): the interpolant that is 1 there and 0 at all other nodes. Weights are the
    /// sum of these functions, each times the weights at its node. With the affine tail they sum to 1 and reproduce
    /// points.
    ///
    /// - `weights`: any weights on the nodes: only nodes, kernel and tail count
    /// - `node`: which, as in `icc_weights_get_nodes`
    /// - `n`: number of points
    /// - `points`: n * dim coordinates
    /// - `values` (out): n numbers
    /// - `env`: may be NULL
    /// - `err`: may be NULL
    pub fn icc_weights_get_dual(
        weights: *const icc_weights,
        node: usize,
        n: usize,
        points: *const f64,
        values: *mut f64,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Measures the weights at n points (n * dim coordinates). The report's `size` is set by the caller.
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
    /// - `out` (out): the binding; owned by the caller. It does not need the weights any more.
    /// - `weights`: the weights
    /// - `n`: number of points
    /// - `points`: n * dim coordinates, finite
    /// - `derivatives`: 1: poses have Jacobians, at dim * n_handles doubles a point more
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

    /// The binding's numbers: points, handles, dimension; each may be NULL.
    pub fn icc_binding_get_counts(
        binding: *const icc_binding,
        n_points: *mut usize,
        n_handles: *mut usize,
        dim: *mut i32,
    ) -> icc_status;

    /// Copies the handles' positions, n_handles * dim, and the weights, n_points * n_handles; each may be NULL.
    pub fn icc_binding_get_weights(
        binding: *const icc_binding,
        handles: *mut f64,
        weights: *mut f64,
    ) -> icc_status;

    /// Poses the points: x -> sum of w_j(x) (A_j x + b_j) (3.37), computed as x + sum of w_j(x) (A_j x + b_j - x): the
    /// same where weights sum to 1, and the rest pose is exact.
    ///
    /// - `binding`: the binding
    /// - `transforms`: n_handles * dim * (dim + 1): per handle the rows of (A | b)
    /// - `images` (out): n * dim coordinates
    /// - `jacobians` (out): n * dim * dim derivatives of the images by the points, or NULL; otherwise the binding
    ///   must have derivatives
    /// - `env`: may be NULL
    ///
    /// Returns `ICC_OK`, `ICC_ERR_ARGUMENT` (a transform is not finite), `ICC_ERR_UNSUPPORTED` (no derivatives), ...
    pub fn icc_binding_pose(
        binding: *const icc_binding,
        transforms: *const f64,
        images: *mut f64,
        jacobians: *mut f64,
        env: *const icc_env,
    ) -> icc_status;

    /// As `icc_sampling_save()`.
    pub fn icc_binding_save(
        binding: *const icc_binding,
        capacity: usize,
        data: *mut c_void,
        n_bytes: *mut usize,
    ) -> icc_status;

    /// As `icc_sampling_load()`.
    pub fn icc_binding_load(
        out: *mut *mut icc_binding,
        n_bytes: usize,
        data: *const c_void,
        env: *const icc_env,
        err: *mut icc_error,
    ) -> icc_status;

    /// Rest pose: writes n_handles identities to `transforms` (see `icc_binding_pose()`).
    pub fn icc_pose_reset(dim: i32, n_handles: usize, transforms: *mut f64) -> icc_status;

    /// Moves one handle: adds `offset`, dim numbers, to its transform.
    pub fn icc_pose_move(dim: i32, transform: *mut f64, offset: *const f64) -> icc_status;

    /// Turns a handle about where its transform has taken it.
    ///
    /// - `dim`: 2 or 3
    /// - `transform`: of the handle, dim * (dim + 1)
    /// - `handle`: the handle's position at rest, dim coordinates
    /// - `axis`: 3-D: 3 numbers, not all 0; 2-D: ignored
    /// - `angle`: in radians, counter-clockwise (y upwards; 3-D: seen from the axis' tip)
    pub fn icc_pose_turn(
        dim: i32,
        transform: *mut f64,
        handle: *const f64,
        axis: *const f64,
        angle: f64,
    ) -> icc_status;
}
