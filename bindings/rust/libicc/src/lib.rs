//! Moves the inside of a shape along with its boundary, one-to-one.
//!
//! [`Domain`] (a boundary and what it encloses) -> [`Chart`] (coordinates of the inside: a boundary point and a share
//! of the way to the maximum) -> [`Map`] (two charts whose boundaries correspond). If you know only some points, [`Fit`]
//! makes the map from them. [`stages`] has the steps of the method one by one, and [`kernel`] has smooth blending
//! weights for handles.
//!
//! ```
//! use libicc::{flat, rows, Domain, Env, Map, MapOptions};
//! let mut env = Env::new().threads(4);
//! let before = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
//! let after = [[0.0, 0.0], [4.0, 0.0], [6.0, 3.0], [0.0, 4.0]];
//! let map = Map::new(
//!     &Domain::polygon(flat(&before), &mut env)?,
//!     &Domain::polygon(flat(&after), &mut env)?,
//!     &MapOptions::default(),
//!     &mut env,
//! )?;
//! let images = map.apply(flat(&[[1.0, 1.0], [2.0, 3.0]]), &mut env)?;
//! println!("{:?}", rows::<2>(&images.points));
//! # Ok::<(), libicc::Error>(())
//! ```
//!
//! Points are slices of coordinates, `dim` numbers each. [`flat`] and [`rows`] turn arrays into them and back without
//! a copy. Results are `Vec`s; calls that end in `_into` write to slices instead. Calls that compute take an [`Env`],
//! which has the number of threads and callbacks for progress and diagnostics. Callbacks may cancel or panic. Angles
//! are radians.
//!
//! Objects never change. They are `Send` and `Sync`, and keep alive what they were made from. A slice of the wrong
//! length gives an [`Error`] with [`Status::ARGUMENT`], like any wrong argument. Only [`rows`] panics.
//!
//! Information structs and reports are those of C. `libicc-sys` explains their members. Ignore their `size`. (It has
//! nothing to do with ICC colour profiles.)
#![warn(missing_docs, unsafe_op_in_unsafe_fn)]

pub use libicc_sys as sys;

mod binding;
mod chart;
mod coverage;
mod curves;
mod domain;
mod env;
mod error;
mod field;
mod fit;
mod function;
mod grid;
pub mod kernel;
mod map;
mod matching;
mod object;
mod picture;
mod proj;
mod sampling;
mod slices;
pub mod stages;
mod tree;
mod triangulate;
mod weights;

pub use chart::{
    Chart, ChartInfo, ChartOptions, ChartReport, ChartTimings, Codes, Constraints, DiscInfo, FieldInfo,
    FoliationInfo, FunctionKind, GradientInfo, Images, Method, ShellingInfo, Solver, TreeForm,
};
pub use coverage::{
    Coverage, CoverageInfo, CoverageOptions, CoverageRing, Difference, DifferenceKind, LayerRing, Unmatched,
};
pub use domain::{
    boundary_defects, repair_mask, BoundaryPoints, Defect, Domain, DomainInfo, Feature, FeatureInfo, Place,
    SolidFeature,
};
pub use env::Env;
pub use error::{Error, Item, Result, Side, Status};
pub use fit::{Constraint, Fit, FitInfo, FitModel, FitOptions, NearestReport};
pub use map::{
    Certificate, ImproveOptions, ImproveReport, Map, MapInfo, MapKind, MapMesh, MapOptions, MapReport,
    OwnedTie, Slide, Tie,
};
pub use matching::{Between, Match, MatchInfo, MatchOptions, Turning};
pub use object::Borrowed;
pub use field::{certify_field, FieldReport, Grid, Outside};
pub use picture::{Interpolation, Layout, Picture, PictureMut};
pub use slices::{flat, flat_mut, rows};

/// The version of the library that is linked, such as "0.1.0".
pub fn version() -> &'static str {
    // SAFETY: a static string.
    unsafe { std::ffi::CStr::from_ptr(sys::icc_version()) }.to_str().unwrap_or("")
}

/// The version as 10000 major + 100 minor + patch.
pub fn version_number() -> i32 {
    // SAFETY: it takes nothing.
    unsafe { sys::icc_version_number() }
}

/// Compiles and runs what the README shows.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
