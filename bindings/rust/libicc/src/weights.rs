//! Weights of handles everywhere in a shape.
use crate::env::Env;
use crate::error::{check, Error, Result, Status};
use crate::object::object;
use crate::sampling::Sampling;
use crate::slices::{count, exactly, pointer, product};
use crate::sys;
use std::ptr;

pub use crate::sys::icc_weights_info as WeightsInfo;
pub use crate::sys::icc_weights_report as WeightsReport;
pub use crate::sys::icc_weights_timings as WeightsTimings;

object!(
    /// Handles, and the weight of each handle everywhere in a shape. Changes make new weights, which share what has not
    /// changed.
    Weights,
    icc_weights,
    icc_weights_free
);

/// The kernel that interpolates weights between samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum KernelForm {
    /// Wendland's C2 function of radius 3 sigma
    Wendland = sys::ICC_KERNEL_WENDLAND,
    /// exp(-d^2 / (2 sigma^2)), cut off
    Gauss = sys::ICC_KERNEL_GAUSS,
}

/// The weights that the optimisation starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InitialWeights<'a> {
    /// diffusion of an impulse at each handle
    Heat,
    /// diffusion that keeps weights linear along the edges
    Edges,
    /// inverse squared distance to the handles
    Inverse,
    /// n_samples * n_handles numbers, sample after sample
    Given(&'a [f64]),
}

/// What is minimised. In all cases the weights sum to 1. Except biharmonic ones, they are found at each
/// sample by itself and reproduce the sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum WeightsMethod {
    /// least squared change of the initial weights, none negative
    Qp = sys::ICC_WEIGHTS_QP,
    /// least squared change, of any sign
    Equality = sys::ICC_WEIGHTS_EQUALITY,
    /// least sum of absolute changes
    L1 = sys::ICC_WEIGHTS_L1,
    /// bounded biharmonic weights, in the plane: least squared Laplacian, between 0 and 1
    Biharmonic = sys::ICC_WEIGHTS_BIHARMONIC,
}

/// A segment that stays straight, because weights are linear along it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Line {
    /// one end; in 2-D the last number is ignored
    pub from: [f64; 3],
    /// the other end
    pub to: [f64; 3],
    /// an earlier line to stay parallel to
    pub parallel: Option<usize>,
}

/// Options of [`Weights::new`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug)]
pub struct WeightsOptions<'a> {
    /// `None`: Wendland
    pub kernel: Option<KernelForm>,
    /// `None`: edges if there are any, else heat
    pub initial: Option<InitialWeights<'a>>,
    /// `None`: QP
    pub method: Option<WeightsMethod>,
    /// steps of diffusion; 0: 5
    pub steps: i32,
    /// an affine function is added to the kernels, so that sums and reproduction are exact between the samples
    pub affine_tail: bool,
    /// weights diffuse only between samples that see each other inside the shape
    pub within_shape: bool,
    /// width of the kernel; 0: [`SamplingInfo::sigma`](crate::kernel::SamplingInfo)
    pub sigma: f64,
    /// Gauss: radius in units of sigma; 0: 5
    pub cutoff: f64,
    /// edges: pairs of handles
    pub edges: &'a [[u32; 2]],
    /// lines to keep straight
    pub lines: &'a [Line],
}

impl Default for WeightsOptions<'_> {
    fn default() -> Self {
        WeightsOptions {
            kernel: None,
            initial: None,
            method: None,
            steps: 0,
            affine_tail: true,
            within_shape: true,
            sigma: 0.0,
            cutoff: 0.0,
            edges: &[],
            lines: &[],
        }
    }
}

/// The places that carry weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes {
    /// n_nodes * dim coordinates
    pub points: Vec<f64>,
    /// n_nodes * n_handles initial weights
    pub initial: Vec<f64>,
    /// n_nodes * n_handles weights
    pub weights: Vec<f64>,
    /// [`Status::OK`], or [`Status::SOLVER`] where QP was relaxed
    pub status: Vec<Status>,
}

/// Weights at n points.
#[derive(Clone, Debug, PartialEq)]
pub struct WeightValues {
    /// n * n_handles
    pub weights: Vec<f64>,
    /// n * n_handles * dim derivatives, if requested
    pub gradients: Option<Vec<f64>>,
    /// the status of each point
    pub status: Vec<Status>,
    /// number of points without weights
    pub n_failed: usize,
}

impl Weights {
    /// Makes weights for handles, n * dim coordinates in the shape.
    ///
    /// # Errors
    /// With the handle, edge or line at fault as `index`: [`Status::OUTSIDE`], [`Status::ARGUMENT`];
    /// [`Status::SOLVER`] if sigma is too large.
    pub fn new(
        sampling: &Sampling,
        handles: &[f64],
        options: &WeightsOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Weights> {
        let info = sampling.info();
        let n_handles = count(handles, info.dim as usize, "handles")?;
        if let Some(InitialWeights::Given(weights)) = options.initial {
            exactly(weights, product(&[info.n_samples, n_handles])?, "initial weights")?;
        }
        let lines = options.lines.iter().map(raw_line).collect::<Result<Vec<_>>>()?;
        let raw = options.raw(&lines);
        Weights::make(env, |out, env, err| {
            // SAFETY: the options are valid during the call.
            unsafe {
                sys::icc_weights_create(out, sampling.as_ptr(), n_handles, handles.as_ptr(), &raw, env, err)
            }
        })
    }

    /// Facts about the weights.
    pub fn info(&self) -> WeightsInfo {
        let mut info = WeightsInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_weights_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// Seconds for each step of making the weights.
    pub fn timings(&self) -> WeightsTimings {
        let mut timings = WeightsTimings::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_weights_get_timings(self.as_ptr(), &mut timings) };
        timings
    }

    /// The places that carry weights: the handles first, then those on lines, then samples.
    pub fn nodes(&self) -> Result<Nodes> {
        let info = self.info();
        let n_weights = product(&[info.n_nodes, info.n_handles])?;
        let mut nodes = Nodes {
            points: vec![0.0; info.n_nodes * info.dim as usize],
            initial: vec![0.0; n_weights],
            weights: vec![0.0; n_weights],
            status: vec![Status::OK; info.n_nodes],
        };
        // SAFETY: there is room for all.
        check(unsafe {
            sys::icc_weights_get_nodes(
                self.as_ptr(),
                nodes.points.as_mut_ptr(),
                nodes.initial.as_mut_ptr(),
                nodes.weights.as_mut_ptr(),
                nodes.status.as_mut_ptr().cast(),
            )
        })?;
        Ok(nodes)
    }

    /// Paints: adds `amount` times a smooth brush of the given radius to the weight of one handle around a place, and
    /// optimises there again.
    pub fn paint(
        &self,
        handle: usize,
        centre: &[f64],
        radius: f64,
        amount: f64,
        env: &mut Env<'_>,
    ) -> Result<Weights> {
        exactly(centre, self.info().dim as usize, "centre")?;
        Weights::make(env, |out, env, err| {
            let centre = centre.as_ptr();
            // SAFETY: dim coordinates.
            unsafe { sys::icc_weights_paint(out, self.as_ptr(), handle, centre, radius, amount, env, err) }
        })
    }

    /// Like [`paint`](Self::paint), with weights of your own: node nodes\[i\] starts from row i of `weights`, n_handles
    /// numbers.
    pub fn repaint(&self, nodes: &[u32], weights: &[f64], env: &mut Env<'_>) -> Result<Weights> {
        exactly(weights, product(&[nodes.len(), self.info().n_handles])?, "weights")?;
        Weights::make(env, |out, env, err| {
            let (n, nodes) = (nodes.len(), nodes.as_ptr());
            // SAFETY: n nodes and rows.
            unsafe { sys::icc_weights_repaint(out, self.as_ptr(), n, nodes, weights.as_ptr(), env, err) }
        })
    }

    /// Makes weights with the same nodes and initial weights but another method. Painting and stiffening are lost.
    pub fn with_method(&self, method: WeightsMethod, env: &mut Env<'_>) -> Result<Weights> {
        Weights::make(env, |out, env, err| {
            // SAFETY: a valid object.
            unsafe { sys::icc_weights_with_method(out, self.as_ptr(), method as i32, env, err) }
        })
    }

    /// Makes a part of the shape move as if it were rigid: weights vary there as little as possible. The part is
    /// given by
    /// nodes and the importance of each (`None`: all equal). Also returns half the weighted sum of squared derivatives
    /// there, before and after.
    pub fn stiffen(
        &self,
        nodes: &[u32],
        rigidity: Option<&[f64]>,
        env: &mut Env<'_>,
    ) -> Result<(Weights, [f64; 2])> {
        if let Some(rigidity) = rigidity {
            exactly(rigidity, nodes.len(), "rigidity")?;
        }
        let mut energy = [0.0; 2];
        let weights = Weights::make(env, |out, env, err| {
            // SAFETY: as many nodes as numbers.
            unsafe {
                sys::icc_weights_stiffen(
                    out,
                    self.as_ptr(),
                    nodes.len(),
                    nodes.as_ptr(),
                    pointer(rigidity),
                    energy.as_mut_ptr(),
                    env,
                    err,
                )
            }
        })?;
        Ok((weights, energy))
    }

    /// Weights at points, n * dim coordinates, with derivatives if requested.
    pub fn weights(&self, points: &[f64], gradients: bool, env: &mut Env<'_>) -> Result<WeightValues> {
        let info = self.info();
        let dim = info.dim as usize;
        let n = count(points, dim, "points")?;
        let n_weights = product(&[n, info.n_handles])?;
        let n_gradients = product(&[n_weights, dim])?;
        let mut weights = WeightValues {
            weights: vec![0.0; n_weights],
            gradients: gradients.then(|| vec![0.0; n_gradients]),
            status: vec![Status::OK; n],
            n_failed: 0,
        };
        let gradients = weights.gradients.as_mut().map_or(ptr::null_mut(), |values| values.as_mut_ptr());
        env.call(|env, _| {
            // SAFETY: there is room for n points.
            unsafe {
                sys::icc_weights_evaluate(
                    self.as_ptr(),
                    n,
                    points.as_ptr(),
                    weights.weights.as_mut_ptr(),
                    gradients,
                    weights.status.as_mut_ptr().cast(),
                    &mut weights.n_failed,
                    env,
                )
            }
        })?;
        Ok(weights)
    }

    /// The dual function of a node at points, n * dim coordinates: it is 1 at the node, 0 at all others, and
    /// interpolated as weights are.
    pub fn dual(&self, node: usize, points: &[f64], env: &mut Env<'_>) -> Result<Vec<f64>> {
        let n = count(points, self.info().dim as usize, "points")?;
        let mut values = vec![0.0; n];
        env.call(|env, err| {
            // SAFETY: n points, and room for n values.
            unsafe {
                sys::icc_weights_get_dual(
                    self.as_ptr(),
                    node,
                    n,
                    points.as_ptr(),
                    values.as_mut_ptr(),
                    env,
                    err,
                )
            }
        })?;
        Ok(values)
    }

    /// Measures the weights at points, n * dim coordinates.
    pub fn report(&self, points: &[f64], env: &mut Env<'_>) -> Result<WeightsReport> {
        let n = count(points, self.info().dim as usize, "points")?;
        let mut report = WeightsReport::default();
        env.call(|env, err| {
            // SAFETY: n points; `size` is set.
            unsafe { sys::icc_weights_get_report(self.as_ptr(), n, points.as_ptr(), &mut report, env, err) }
        })?;
        Ok(report)
    }
}

impl WeightsOptions<'_> {
    /// The options in C. They borrow `lines`.
    fn raw(&self, lines: &[sys::icc_line]) -> sys::icc_weights_options {
        let (initial, given) = match self.initial {
            None => (0, ptr::null()),
            Some(InitialWeights::Heat) => (sys::ICC_INITIAL_HEAT, ptr::null()),
            Some(InitialWeights::Edges) => (sys::ICC_INITIAL_EDGES, ptr::null()),
            Some(InitialWeights::Inverse) => (sys::ICC_INITIAL_INVERSE, ptr::null()),
            Some(InitialWeights::Given(weights)) => (sys::ICC_INITIAL_GIVEN, weights.as_ptr()),
        };
        sys::icc_weights_options {
            kernel: self.kernel.map_or(0, |kernel| kernel as i32),
            initial,
            method: self.method.map_or(0, |method| method as i32),
            steps: self.steps,
            affine_tail: if self.affine_tail { 0 } else { -1 },
            within_shape: if self.within_shape { 0 } else { -1 },
            sigma: self.sigma,
            cutoff: self.cutoff,
            n_edges: self.edges.len(),
            edges: self.edges.as_ptr().cast(),
            n_lines: lines.len(),
            lines: lines.as_ptr(),
            initial_weights: given,
            ..Default::default()
        }
    }
}

fn raw_line(line: &Line) -> Result<sys::icc_line> {
    let parallel = match line.parallel {
        None => 0,
        Some(k) => k
            .checked_add(1)
            .and_then(|k| i32::try_from(k).ok())
            .ok_or_else(|| Error::argument("lines: parallel to one that is not there"))?,
    };
    Ok(sys::icc_line { from: line.from, to: line.to, parallel, ..Default::default() })
}
