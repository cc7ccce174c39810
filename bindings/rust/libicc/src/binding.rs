//! Points with their weights, and poses of the handles.
use crate::env::Env;
use crate::error::{check, Error, Result};
use crate::object::{object, saved, to_bytes};
use crate::slices::{count, exactly, int, pointer_mut, product};
use crate::sys;
use crate::weights::Weights;
use std::ptr;

object!(
    /// Points with their weights, for repeated poses. It no longer needs the [`Weights`](crate::kernel::Weights).
    Binding,
    icc_binding,
    icc_binding_free
);

/// Numbers of points and handles of a binding, and its dimension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counts {
    /// points
    pub n_points: usize,
    /// handles
    pub n_handles: usize,
    /// dimension
    pub dim: usize,
}

saved!(Binding);

impl Binding {
    /// Binds points, n * dim coordinates, to handles. With `derivatives` poses have Jacobians.
    ///
    /// # Errors
    /// [`Status::ARGUMENT`](crate::Status::ARGUMENT), with the point that is not finite as `index`.
    pub fn new(weights: &Weights, points: &[f64], derivatives: bool, env: &mut Env<'_>) -> Result<Binding> {
        let n = count(points, weights.info().dim as usize, "points")?;
        Binding::make(env, |out, env, err| {
            let (weights, points, derivatives) = (weights.as_ptr(), points.as_ptr(), i32::from(derivatives));
            // SAFETY: n points.
            unsafe { sys::icc_binding_create(out, weights, n, points, derivatives, env, err) }
        })
    }

    /// Points, handles, dimension.
    pub fn counts(&self) -> Counts {
        let (mut n_points, mut n_handles, mut dim) = (0, 0, 0);
        // SAFETY: three numbers to write to. It cannot fail.
        unsafe { sys::icc_binding_get_counts(self.as_ptr(), &mut n_points, &mut n_handles, &mut dim) };
        Counts { n_points, n_handles, dim: dim as usize }
    }

    /// The handles' positions, n_handles * dim coordinates.
    pub fn handles(&self) -> Result<Vec<f64>> {
        let counts = self.counts();
        let mut handles = vec![0.0; counts.n_handles * counts.dim];
        // SAFETY: there is room for all.
        check(unsafe { sys::icc_binding_get_weights(self.as_ptr(), handles.as_mut_ptr(), ptr::null_mut()) })?;
        Ok(handles)
    }

    /// The weights, n_points * n_handles.
    pub fn weights(&self) -> Result<Vec<f64>> {
        let counts = self.counts();
        let mut weights = vec![0.0; product(&[counts.n_points, counts.n_handles])?];
        // SAFETY: there is room for all.
        check(unsafe { sys::icc_binding_get_weights(self.as_ptr(), ptr::null_mut(), weights.as_mut_ptr()) })?;
        Ok(weights)
    }

    /// Poses the points: n * dim coordinates.
    pub fn pose(&self, pose: &Pose, env: &mut Env<'_>) -> Result<Vec<f64>> {
        let counts = self.counts();
        let mut images = vec![0.0; counts.n_points * counts.dim];
        self.pose_into(pose.transforms(), &mut images, None, env)?;
        Ok(images)
    }

    /// Poses the points, and returns n * dim * dim derivatives of the images by the points as well.
    ///
    /// # Errors
    /// [`Status::UNSUPPORTED`](crate::Status::UNSUPPORTED) when the binding was made without derivatives.
    pub fn pose_with_jacobians(&self, pose: &Pose, env: &mut Env<'_>) -> Result<(Vec<f64>, Vec<f64>)> {
        let counts = self.counts();
        let mut images = vec![0.0; counts.n_points * counts.dim];
        let mut jacobians = vec![0.0; images.len() * counts.dim];
        self.pose_into(pose.transforms(), &mut images, Some(&mut jacobians), env)?;
        Ok((images, jacobians))
    }

    /// Poses the points by your own transforms, per handle the dim rows of (A | b), and writes to slices.
    pub fn pose_into(
        &self,
        transforms: &[f64],
        images: &mut [f64],
        jacobians: Option<&mut [f64]>,
        env: &mut Env<'_>,
    ) -> Result<()> {
        let Counts { n_points, n_handles, dim } = self.counts();
        exactly(transforms, n_handles * dim * (dim + 1), "transforms")?;
        exactly(images, n_points * dim, "images")?;
        if let Some(jacobians) = &jacobians {
            exactly(jacobians, n_points * dim * dim, "jacobians")?;
        }
        let jacobians = pointer_mut(jacobians);
        env.call(|env, _| {
            let (transforms, images) = (transforms.as_ptr(), images.as_mut_ptr());
            // SAFETY: there is room for all points.
            unsafe { sys::icc_binding_pose(self.as_ptr(), transforms, images, jacobians, env) }
        })
    }

    /// The binding as bytes: the same on every machine, with a checksum.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        to_bytes(|capacity, data, n| {
            // SAFETY: there is room for `capacity` bytes.
            unsafe { sys::icc_binding_save(self.as_ptr(), capacity, data, n) }
        })
    }

    /// Reads a binding back, bit for bit; any bytes are safe to pass.
    ///
    /// # Errors
    /// [`Status::FORMAT`](crate::Status::FORMAT), or [`Status::VERSION`](crate::Status::VERSION) if a later
    /// version wrote the bytes.
    pub fn from_bytes(data: &[u8], env: &mut Env<'_>) -> Result<Binding> {
        Binding::make(env, |out, env, err| {
            // SAFETY: as many bytes.
            unsafe { sys::icc_binding_load(out, data.len(), data.as_ptr().cast(), env, err) }
        })
    }
}

/// A pose: an affine transform for each handle.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    dim: usize,
    handles: Vec<f64>,
    transforms: Vec<f64>,
}

impl Pose {
    /// All handles of a binding at rest.
    pub fn rest(binding: &Binding) -> Result<Pose> {
        Pose::of_handles(binding.counts().dim, binding.handles()?)
    }

    /// Handles at your own positions, n * dim coordinates, at rest.
    pub fn of_handles(dim: usize, handles: Vec<f64>) -> Result<Pose> {
        let n = count(&handles, dim, "handles")?;
        if dim != 2 && dim != 3 {
            return Err(Error::argument(format!("handles in {} dimensions, not 2 or 3", dim)));
        }
        let mut pose = Pose { dim, handles, transforms: vec![0.0; n * dim * (dim + 1)] };
        pose.reset()?;
        Ok(pose)
    }

    /// Back to rest.
    pub fn reset(&mut self) -> Result<()> {
        let n = self.handles.len() / self.dim;
        // SAFETY: n transforms.
        check(unsafe { sys::icc_pose_reset(int(self.dim), n, self.transforms.as_mut_ptr()) })
    }

    /// The transforms: per handle the dim rows of (A | b).
    pub fn transforms(&self) -> &[f64] {
        &self.transforms
    }

    /// Moves a handle by dim numbers.
    pub fn shift(&mut self, handle: usize, offset: &[f64]) -> Result<()> {
        exactly(offset, self.dim, "offset")?;
        let dim = int(self.dim);
        let transform = self.transform(handle)?.as_mut_ptr();
        // SAFETY: a transform and dim numbers.
        check(unsafe { sys::icc_pose_move(dim, transform, offset.as_ptr()) })
    }

    /// Rotates a handle about its present position, by an angle in radians. The direction is counter-clockwise with y
    /// upwards (2-D), or seen from the tip of the axis (3-D).
    pub fn turn(&mut self, handle: usize, axis: Option<[f64; 3]>, angle: f64) -> Result<()> {
        let dim = self.dim;
        let transform = self.transform(handle)?.as_mut_ptr();
        let at = self.handles[handle * dim..].as_ptr();
        let axis = axis.as_ref().map_or(ptr::null(), |axis| axis.as_ptr());
        // SAFETY: a transform, its handle's position, and NULL or three numbers.
        check(unsafe { sys::icc_pose_turn(int(dim), transform, at, axis, angle) })
    }

    /// Gives a handle any transform: the dim rows of (A | b).
    pub fn set(&mut self, handle: usize, transform: &[f64]) -> Result<()> {
        exactly(transform, self.dim * (self.dim + 1), "transform")?;
        self.transform(handle)?.copy_from_slice(transform);
        Ok(())
    }

    fn transform(&mut self, handle: usize) -> Result<&mut [f64]> {
        let size = self.dim * (self.dim + 1);
        let n = self.transforms.len() / size;
        match self.transforms.chunks_exact_mut(size).nth(handle) {
            Some(transform) => Ok(transform),
            None => Err(Error::argument(format!("handle {} of {}", handle, n))),
        }
    }
}
