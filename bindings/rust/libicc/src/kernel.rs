//! Kernel coordinates: smooth blending weights for handles, without a mesh.
//!
//! [`Shape`] (regions and curves) -> [`Sampling`] (points spread over it) -> [`Weights`] (handles, and a weight of
//! each at every place) -> [`Binding`] (the weights at your points) -> [`Pose`].
//!
//! These deformations are not certified to be one-to-one. [`Weights::report`] measures the quality of weights.
//!
//! ```
//! use libicc::kernel::{Binding, Weights, WeightsOptions, Pose, Sampling, SamplingOptions, Shape};
//! use libicc::{Domain, Env};
//! let env = &mut Env::new();
//! let square = Domain::polygon(&[0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.0, 10.0], env)?;
//! let shape = Shape::of_regions(2, &[&square], env)?;
//! let sampling =
//!     Sampling::new(&shape, &SamplingOptions { spacing: 1.0, ..Default::default() }, env)?;
//! let handles = [2.0, 2.0, 8.0, 2.0, 5.0, 8.0];
//! let weights = Weights::new(&sampling, &handles, &WeightsOptions::default(), env)?;
//! let points = [5.0, 5.0, 2.0, 2.0];
//! let binding = Binding::new(&weights, &points, false, env)?;
//! let mut pose = Pose::rest(&binding)?;
//! pose.shift(0, &[1.0, 0.5])?;
//! let images = binding.pose(&pose, env)?;
//! assert!((images[2] - 3.0).abs() < 1e-9 && (images[3] - 2.5).abs() < 1e-9);
//! # Ok::<(), libicc::Error>(())
//! ```
pub use crate::binding::{Binding, Counts, Pose};
pub use crate::sampling::{Sampling, SamplingInfo, SamplingKind, SamplingOptions, Shape};
pub use crate::weights::{
    InitialWeights, KernelForm, Line, Nodes, WeightValues, Weights, WeightsInfo, WeightsMethod,
    WeightsOptions, WeightsReport, WeightsTimings,
};
