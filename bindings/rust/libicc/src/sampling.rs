//! Shapes to be deformed, and points spread over them.
use crate::domain::Domain;
use crate::env::Env;
use crate::error::{check, Result};
use crate::object::{object, saved, to_bytes};
use crate::slices::{count, int, pointer};
use crate::sys;

pub use crate::sys::icc_sampling_info as SamplingInfo;

object!(ShapeObject, icc_shape, icc_shape_free);

/// A shape to be deformed: filled regions and curves, in 2-D or 3-D.
#[derive(Debug)]
pub struct Shape {
    object: ShapeObject,
    dim: usize,
}

object!(
    /// Points spread over a shape.
    Sampling,
    icc_sampling,
    icc_sampling_free
);

/// How samples are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum SamplingKind {
    /// a regular grid
    Grid = sys::ICC_SAMPLING_GRID,
    /// blue noise: random but evenly spaced, also on boundaries and curves
    Blue = sys::ICC_SAMPLING_BLUE,
}

/// Options of [`Sampling::new`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct SamplingOptions<'a> {
    /// `None`: blue
    pub kind: Option<SamplingKind>,
    /// blue: steps of relaxation; 0: 60; -1: none
    pub steps: i32,
    /// distance between neighbours; 0: 1/100 of the longest side, in 3-D 1/20
    pub spacing: f64,
    /// grid: how far it extends beyond the regions, in spacings
    pub margin: f64,
    /// blue: seed of the random numbers
    pub seed: u64,
    /// blue: points that must be samples, n * dim coordinates
    pub fixed: Option<&'a [f64]>,
}

impl Shape {
    /// Makes a shape from regions of dimension `dim` and curves, which may be mixed. Curves are segments: rows of two
    /// indices into `vertices`, n * dim coordinates. The shape keeps the regions alive.
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY) when boundaries meet;
    /// [`Status::ARGUMENT`](crate::Status::ARGUMENT), with the region, vertex or segment at fault as `index`.
    pub fn new(
        dim: usize,
        regions: &[&Domain],
        vertices: &[f64],
        segments: &[u32],
        env: &mut Env<'_>,
    ) -> Result<Shape> {
        let n_vertices = count(vertices, dim, "vertices")?;
        let n_segments = count(segments, 2, "segments")?;
        let regions: Vec<_> = regions.iter().map(|region| region.as_ptr()).collect();
        let object = ShapeObject::make(env, |out, env, err| {
            // SAFETY: the counts are those of the slices.
            unsafe {
                sys::icc_shape_create(
                    out,
                    int(dim),
                    regions.len(),
                    regions.as_ptr(),
                    n_vertices,
                    vertices.as_ptr(),
                    n_segments,
                    segments.as_ptr(),
                    env,
                    err,
                )
            }
        })?;
        Ok(Shape { object, dim })
    }

    /// A shape without curves.
    pub fn of_regions(dim: usize, regions: &[&Domain], env: &mut Env<'_>) -> Result<Shape> {
        Shape::new(dim, regions, &[], &[], env)
    }

    /// The dimension.
    pub fn dim(&self) -> usize {
        self.dim
    }

    /// The raw object for calls of `libicc-sys`. Valid as long as `self`.
    pub fn as_ptr(&self) -> *const sys::icc_shape {
        self.object.as_ptr()
    }
}

saved!(Sampling);

impl Sampling {
    /// Spreads samples over a shape. Equal seeds give equal samplings.
    ///
    /// # Errors
    /// [`Status::RESOLUTION`](crate::Status::RESOLUTION) when a region has no sample, or there would be too many;
    /// [`Status::OUTSIDE`](crate::Status::OUTSIDE) when a fixed point is in no region.
    pub fn new(shape: &Shape, options: &SamplingOptions<'_>, env: &mut Env<'_>) -> Result<Sampling> {
        let n_fixed = options.fixed.map_or(Ok(0), |fixed| count(fixed, shape.dim, "fixed"))?;
        let raw = sys::icc_sampling_options {
            kind: options.kind.map_or(0, |kind| kind as i32),
            steps: options.steps,
            spacing: options.spacing,
            margin: options.margin,
            seed: options.seed,
            n_fixed,
            fixed: pointer(options.fixed),
            ..Default::default()
        };
        Sampling::make(env, |out, env, err| {
            // SAFETY: the options are valid during the call.
            unsafe { sys::icc_sampling_create(out, shape.as_ptr(), &raw, env, err) }
        })
    }

    /// A sampling from your own points, n * dim coordinates, which keep their order.
    pub fn from_points(shape: &Shape, points: &[f64], env: &mut Env<'_>) -> Result<Sampling> {
        let n = count(points, shape.dim, "points")?;
        Sampling::make(env, |out, env, err| {
            // SAFETY: n points.
            unsafe { sys::icc_sampling_create_from_points(out, shape.as_ptr(), n, points.as_ptr(), env, err) }
        })
    }

    /// Counts, spacing, and a suggested width for the kernel.
    pub fn info(&self) -> SamplingInfo {
        let mut info = SamplingInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_sampling_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// The samples: n_samples * dim coordinates.
    pub fn points(&self) -> Result<Vec<f64>> {
        let info = self.info();
        let mut points = vec![0.0; info.n_samples * info.dim as usize];
        // SAFETY: there is room for all.
        check(unsafe { sys::icc_sampling_get_points(self.as_ptr(), points.as_mut_ptr()) })?;
        Ok(points)
    }

    /// The sampling as bytes, its shape included: the same on every machine, with a checksum.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        to_bytes(|capacity, data, n| {
            // SAFETY: there is room for `capacity` bytes.
            unsafe { sys::icc_sampling_save(self.as_ptr(), capacity, data, n) }
        })
    }

    /// Reads a sampling back, bit for bit; any bytes are safe to pass.
    ///
    /// # Errors
    /// [`Status::FORMAT`](crate::Status::FORMAT), or [`Status::VERSION`](crate::Status::VERSION) if a later
    /// version wrote the bytes.
    pub fn from_bytes(data: &[u8], env: &mut Env<'_>) -> Result<Sampling> {
        Sampling::make(env, |out, env, err| {
            // SAFETY: as many bytes.
            unsafe { sys::icc_sampling_load(out, data.len(), data.as_ptr().cast(), env, err) }
        })
    }
}
