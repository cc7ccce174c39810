//! Coordinates of the inside of a shape.
use crate::domain::{BoundaryPoints, Domain};
use crate::env::Env;
use crate::error::{Result, Status};
use crate::function::Function;
use crate::object::{object, saved, to_bytes, Borrowed};
use crate::slices::{count, exactly, int, pointer, pointer_mut};
use crate::sys;

pub use crate::sys::icc_chart_info as ChartInfo;
pub use crate::sys::icc_chart_report as ChartReport;
pub use crate::sys::icc_chart_timings as ChartTimings;
pub use crate::sys::icc_disc_info as DiscInfo;
pub use crate::sys::icc_field_info as FieldInfo;
pub use crate::sys::icc_foliation_info as FoliationInfo;
pub use crate::sys::icc_gradient_info as GradientInfo;
pub use crate::sys::icc_shelling_info as ShellingInfo;

object!(
    /// Coordinates of the inside of a domain: a boundary point, and a share of the way from there to the maximum.
    ///
    /// ```
    /// use libicc::{Chart, ChartOptions, Domain, Env};
    /// let env = &mut Env::new();
    /// let square = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0], env)?;
    /// let chart = Chart::new(&square, &ChartOptions::default(), env)?;
    /// assert_eq!(chart.info().certified, 1);
    /// let codes = chart.encode(&[1.0, 2.5], env)?;
    /// let back = chart.decode(&codes.start.facet, &codes.start.bary, &codes.t, env)?;
    /// assert!((back.points[0] - 1.0).abs() < 1e-12 && (back.points[1] - 2.5).abs() < 1e-12);
    /// # Ok::<(), libicc::Error>(())
    /// ```
    Chart,
    icc_chart,
    icc_chart_free
);

/// How coordinates are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Method {
    /// Integral Curve Coordinates as published, by a grid, a cousin tree and a function; not one-to-one
    Gradient = sys::ICC_METHOD_GRADIENT,
    /// along leaves that cannot merge; certified
    Foliation = sys::ICC_METHOD_FOLIATION,
    /// along a vector field in which curves cannot merge, on a grid in any dimension
    Field = sys::ICC_METHOD_FIELD,
    /// polar coordinates of the harmonic map to a disc; certified
    Disc = sys::ICC_METHOD_DISC,
}

/// The function whose gradient lines are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum FunctionKind {
    /// 10 at the maximum, times 0.95 from parent to child
    Decay = sys::ICC_FUNCTION_DECAY,
    /// minus the distance in the tree
    Distance = sys::ICC_FUNCTION_DISTANCE,
    /// discretely harmonic
    Laplace = sys::ICC_FUNCTION_LAPLACE,
    /// discretely biharmonic, simply supported
    Bilaplace = sys::ICC_FUNCTION_BILAPLACE,
    /// discretely biharmonic, clamped
    Clamped = sys::ICC_FUNCTION_CLAMPED,
    /// discretely harmonic, 0 on the boundary itself
    Harmonic = sys::ICC_FUNCTION_HARMONIC,
}

/// Whether a function is forced to fall along the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Constraints {
    /// if the function has critical points besides one maximum
    Needed = sys::ICC_CONSTRAINTS_NEEDED,
    /// never
    None = sys::ICC_CONSTRAINTS_NONE,
    /// always
    All = sys::ICC_CONSTRAINTS_ALL,
}

/// How linear systems are solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Solver {
    /// sparse factorisation
    Direct = sys::ICC_SOLVER_DIRECT,
    /// conjugate gradients with a multigrid preconditioner
    Iterative = sys::ICC_SOLVER_ITERATIVE,
}

/// The published forms of the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum TreeForm {
    /// vertices just outside the boundary belong to the tree
    Thesis = sys::ICC_TREE_THESIS,
    /// vertices just outside are children of all their neighbours inside
    Paper = sys::ICC_TREE_PAPER,
}

/// Options of [`Chart::new`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct ChartOptions<'a> {
    /// how coordinates are made
    pub method: Option<Method>,
    /// grid or mesh cells along the longest side; 0: 50
    pub cells: usize,
    /// the requested maximum, dim coordinates
    pub maximum: Option<&'a [f64]>,
    /// gradient: the function
    pub function: Option<FunctionKind>,
    /// gradient: the tree
    pub tree: Option<TreeForm>,
    /// gradient: whether the function is constrained
    pub constraints: Option<Constraints>,
    /// gradient: the solver
    pub solver: Option<Solver>,
    /// gradient: least relative fall along tree edges; 0: 1e-6
    pub min_fall: f64,
    /// gradient, constrained bi-Laplace: least value at the leaves; 0: 1e-9
    pub leaf_min: f64,
    /// gradient: the order in which the tree expands along the axes, a permutation of 0..dim; `None`: 0, 1 and so on
    pub axis_order: Option<&'a [i32]>,
}

impl ChartOptions<'_> {
    /// The options in C, for a domain of dimension `dim`. They borrow `maximum` and `axis_order`.
    pub(crate) fn raw(&self, dim: usize) -> Result<sys::icc_chart_options> {
        if let Some(maximum) = self.maximum {
            exactly(maximum, dim, "maximum")?;
        }
        if let Some(order) = self.axis_order {
            exactly(order, dim, "axis_order")?;
        }
        Ok(sys::icc_chart_options {
            method: self.method.map_or(0, |value| value as i32),
            function: self.function.map_or(0, |value| value as i32),
            tree: self.tree.map_or(0, |value| value as i32),
            cells: int(self.cells),
            maximum: pointer(self.maximum),
            constraints: self.constraints.map_or(0, |value| value as i32),
            solver: self.solver.map_or(0, |value| value as i32),
            min_fall: self.min_fall,
            leaf_min: self.leaf_min,
            axis_order: pointer(self.axis_order),
            ..Default::default()
        })
    }
}

/// Integral curve coordinates of n points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Codes {
    /// where the curves start; `u32::MAX` and NaN for points without coordinates
    pub start: BoundaryPoints,
    /// shares of the curves' arc length from the boundary, in \[0,1\]
    pub t: Vec<f64>,
    /// the status of each point
    pub status: Vec<Status>,
    /// number of points without coordinates
    pub n_failed: usize,
}

/// Images of points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Images {
    /// n * dim coordinates; NaN where there is no point
    pub points: Vec<f64>,
    /// the status of each point
    pub status: Vec<Status>,
    /// number of failures
    pub n_failed: usize,
}

impl Images {
    pub(crate) fn new(n: usize, width: usize) -> Images {
        Images { points: vec![0.0; n * width], status: vec![Status::OK; n], n_failed: 0 }
    }
}

saved!(Chart);

impl Chart {
    /// Makes coordinates of a domain.
    ///
    /// # Errors
    /// [`Status::CERTIFICATE`] if the chart could not be proved one-to-one, [`Status::OUTSIDE`] if the maximum is
    /// outside, [`Status::RESOLUTION`], [`Status::UNSUPPORTED`], [`Status::CANCELLED`] and others.
    pub fn new(domain: &Domain, options: &ChartOptions<'_>, env: &mut Env<'_>) -> Result<Chart> {
        let raw = options.raw(domain.dim())?;
        Chart::make(env, |out, env, err| {
            // SAFETY: the options are valid during the call.
            unsafe { sys::icc_chart_create(out, domain.as_ptr(), &raw, env, err) }
        })
    }

    /// Makes a chart of method gradient from a function, whose stages are the library's or yours.
    ///
    /// # Errors
    /// [`Status::UNSUPPORTED`] if the function's grid was not made from a domain, [`Status::ARGUMENT`] if a neighbour
    /// of the root is higher than the root, and others.
    pub fn from_function(function: &Function, env: &mut Env<'_>) -> Result<Chart> {
        Chart::make(env, |out, env, err| {
            // SAFETY: the function is valid during the call.
            unsafe { sys::icc_chart_create_function(out, function.as_ptr(), env, err) }
        })
    }

    /// The chart and its domain as bytes, for other processes. They are the same on every machine and have a
    /// checksum.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        to_bytes(|capacity, data, n| {
            // SAFETY: there is room for `capacity` bytes.
            unsafe { sys::icc_chart_save(self.as_ptr(), capacity, data, n) }
        })
    }

    /// Reads a chart back; any bytes are safe to pass. It gives the same results as the saved one, bit for bit. Charts
    /// on a mesh are certified anew, those on a grid rebuilt from their inputs.
    ///
    /// # Errors
    /// [`Status::FORMAT`]; [`Status::VERSION`] if a later version wrote the bytes, or if a chart on a grid gives other
    /// values here than where it was saved.
    pub fn from_bytes(data: &[u8], env: &mut Env<'_>) -> Result<Chart> {
        Chart::make(env, |out, env, err| {
            // SAFETY: as many bytes.
            unsafe { sys::icc_chart_load(out, data.len(), data.as_ptr().cast(), env, err) }
        })
    }

    /// What charts of every method have, such as whether it is certified and where the curves end.
    pub fn info(&self) -> ChartInfo {
        let mut info = ChartInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_chart_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// Seconds for each step of making the chart.
    pub fn timings(&self) -> ChartTimings {
        let mut timings = ChartTimings::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_chart_get_timings(self.as_ptr(), &mut timings) };
        timings
    }

    /// What only charts of method gradient have; `None` for others.
    pub fn gradient_info(&self) -> Option<GradientInfo> {
        let mut info = GradientInfo::default();
        // SAFETY: `size` is set.
        let status = unsafe { sys::icc_chart_get_gradient_info(self.as_ptr(), &mut info) };
        (status == sys::ICC_OK).then_some(info)
    }

    /// What only charts of method field have; `None` for others.
    pub fn field_info(&self) -> Option<FieldInfo> {
        let mut info = FieldInfo::default();
        // SAFETY: `size` is set.
        let status = unsafe { sys::icc_chart_get_field_info(self.as_ptr(), &mut info) };
        (status == sys::ICC_OK).then_some(info)
    }

    /// What only charts of method foliation in the plane have, on a mesh that libicc makes; `None` for others.
    pub fn foliation_info(&self) -> Option<FoliationInfo> {
        let mut info = FoliationInfo::default();
        // SAFETY: `size` is set.
        let status = unsafe { sys::icc_chart_get_foliation_info(self.as_ptr(), &mut info) };
        (status == sys::ICC_OK).then_some(info)
    }

    /// What only charts of method foliation on a domain's mesh have; `None` for others.
    pub fn shelling_info(&self) -> Option<ShellingInfo> {
        let mut info = ShellingInfo::default();
        // SAFETY: `size` is set.
        let status = unsafe { sys::icc_chart_get_shelling_info(self.as_ptr(), &mut info) };
        (status == sys::ICC_OK).then_some(info)
    }

    /// What only charts of method disc have; `None` for others.
    pub fn disc_info(&self) -> Option<DiscInfo> {
        let mut info = DiscInfo::default();
        // SAFETY: `size` is set.
        let status = unsafe { sys::icc_chart_get_disc_info(self.as_ptr(), &mut info) };
        (status == sys::ICC_OK).then_some(info)
    }

    /// The dimension.
    pub fn dim(&self) -> usize {
        self.info().dim as usize
    }

    /// The domain that the chart was made on.
    pub fn domain(&self) -> Borrowed<'_, Domain> {
        // SAFETY: the chart keeps its domain, of which it always has one.
        unsafe {
            let raw = sys::icc_chart_domain(self.as_ptr());
            Borrowed::new(Domain::found(raw).expect("libicc: a chart without a domain"))
        }
    }

    /// The function of a chart of method gradient or field, `None` for others.
    pub fn function(&self) -> Option<Borrowed<'_, Function>> {
        // SAFETY: the chart keeps its field.
        unsafe { Function::found(sys::icc_chart_function(self.as_ptr())).map(|field| Borrowed::new(field)) }
    }

    /// Estimates what the coordinates miss from `n_points` evenly spread points; 0: 4096.
    pub fn report(&self, n_points: usize, env: &mut Env<'_>) -> Result<ChartReport> {
        let mut measures = ChartReport::default();
        env.call(|env, err| {
            // SAFETY: `size` is set.
            unsafe { sys::icc_chart_get_report(self.as_ptr(), n_points, &mut measures, env, err) }
        })?;
        Ok(measures)
    }

    /// Computes the coordinates of points, n * dim numbers.
    ///
    /// The call does not fail if single points have no coordinates: check [`Codes::status`].
    pub fn encode(&self, points: &[f64], env: &mut Env<'_>) -> Result<Codes> {
        let dim = self.dim();
        let n = count(points, dim, "points")?;
        let mut codes = Codes {
            start: BoundaryPoints { facet: vec![0; n], bary: vec![0.0; n * dim] },
            t: vec![0.0; n],
            status: vec![Status::OK; n],
            n_failed: 0,
        };
        let start = &mut codes.start;
        codes.n_failed = self.encode_into(
            points,
            &mut start.facet,
            &mut start.bary,
            &mut codes.t,
            Some(&mut codes.status),
            env,
        )?;
        Ok(codes)
    }

    /// Like [`encode`](Self::encode), but writes to slices of n, n * dim, n and n values. Returns the number of points
    /// without coordinates.
    pub fn encode_into(
        &self,
        points: &[f64],
        facet: &mut [u32],
        bary: &mut [f64],
        t: &mut [f64],
        status: Option<&mut [Status]>,
        env: &mut Env<'_>,
    ) -> Result<usize> {
        let n = count(points, self.dim(), "points")?;
        exactly(facet, n, "facet")?;
        exactly(bary, points.len(), "bary")?;
        exactly(t, n, "t")?;
        let status = statuses(status, n)?;
        let mut n_failed = 0;
        env.call(|env, _| {
            // SAFETY: every slice has room for n points.
            unsafe {
                sys::icc_chart_encode(
                    self.as_ptr(),
                    n,
                    points.as_ptr(),
                    facet.as_mut_ptr(),
                    bary.as_mut_ptr(),
                    t.as_mut_ptr(),
                    status,
                    &mut n_failed,
                    env,
                )
            }
        })?;
        Ok(n_failed)
    }

    /// Like [`encode`](Self::encode), and tells for each point whether [`decode`](Self::decode) brings it back: 0, or
    /// a sum of `sys::ICC_LOSS_*`. Takes twice the time.
    pub fn encode_flags(&self, points: &[f64], env: &mut Env<'_>) -> Result<(Codes, Vec<i32>)> {
        let dim = self.dim();
        let n = count(points, dim, "points")?;
        let mut codes = Codes {
            start: BoundaryPoints { facet: vec![0; n], bary: vec![0.0; n * dim] },
            t: vec![0.0; n],
            status: vec![Status::OK; n],
            n_failed: 0,
        };
        let mut flags = vec![0; n];
        let status = statuses(Some(&mut codes.status), n)?;
        env.call(|env, _| {
            // SAFETY: every vector has room for n points.
            unsafe {
                sys::icc_chart_encode_flags(
                    self.as_ptr(),
                    n,
                    points.as_ptr(),
                    codes.start.facet.as_mut_ptr(),
                    codes.start.bary.as_mut_ptr(),
                    codes.t.as_mut_ptr(),
                    status,
                    flags.as_mut_ptr(),
                    &mut codes.n_failed,
                    env,
                )
            }
        })?;
        Ok((codes, flags))
    }

    /// Computes points from n facets, n * dim barycentric coordinates and n shares.
    pub fn decode(&self, facet: &[u32], bary: &[f64], t: &[f64], env: &mut Env<'_>) -> Result<Images> {
        let mut images = Images::new(t.len(), self.dim());
        images.n_failed =
            self.decode_into(facet, bary, t, &mut images.points, Some(&mut images.status), env)?;
        Ok(images)
    }

    /// Like [`decode`](Self::decode), but writes to slices of n * dim and n values. Returns how many coordinates have
    /// no point.
    pub fn decode_into(
        &self,
        facet: &[u32],
        bary: &[f64],
        t: &[f64],
        points: &mut [f64],
        status: Option<&mut [Status]>,
        env: &mut Env<'_>,
    ) -> Result<usize> {
        let n = t.len();
        exactly(facet, n, "facet")?;
        exactly(bary, n * self.dim(), "bary")?;
        exactly(points, n * self.dim(), "points")?;
        let status = statuses(status, n)?;
        let mut n_failed = 0;
        env.call(|env, _| {
            // SAFETY: every slice has n entries.
            unsafe {
                sys::icc_chart_decode(
                    self.as_ptr(),
                    n,
                    facet.as_ptr(),
                    bary.as_ptr(),
                    t.as_ptr(),
                    points.as_mut_ptr(),
                    status,
                    &mut n_failed,
                    env,
                )
            }
        })?;
        Ok(n_failed)
    }

    /// Like [`decode`](Self::decode), and tells for each whether [`encode`](Self::encode) returns the coordinates: 0, or
    /// a sum of `sys::ICC_LOSS_*`. Takes twice the time.
    pub fn decode_flags(
        &self,
        facet: &[u32],
        bary: &[f64],
        t: &[f64],
        env: &mut Env<'_>,
    ) -> Result<(Images, Vec<i32>)> {
        let n = t.len();
        exactly(facet, n, "facet")?;
        exactly(bary, n * self.dim(), "bary")?;
        let mut images = Images::new(n, self.dim());
        let mut flags = vec![0; n];
        let status = statuses(Some(&mut images.status), n)?;
        env.call(|env, _| {
            // SAFETY: every slice and vector has n entries.
            unsafe {
                sys::icc_chart_decode_flags(
                    self.as_ptr(),
                    n,
                    facet.as_ptr(),
                    bary.as_ptr(),
                    t.as_ptr(),
                    images.points.as_mut_ptr(),
                    status,
                    flags.as_mut_ptr(),
                    &mut images.n_failed,
                    env,
                )
            }
        })?;
        Ok((images, flags))
    }

    /// The whole curve through a point, from the boundary to the maximum: rows of dim coordinates.
    ///
    /// # Errors
    /// [`Status::OUTSIDE`], or [`Status::TRACE`] if the curve does not reach both ends.
    pub fn trace(&self, point: &[f64], env: &mut Env<'_>) -> Result<Vec<f64>> {
        let dim = self.dim();
        exactly(point, dim, "point")?;
        let mut capacity = 256;
        loop {
            let mut curve = vec![0.0; capacity * dim];
            let mut n = 0;
            env.call(|env, err| {
                // SAFETY: there is room for `capacity` points.
                unsafe {
                    sys::icc_chart_trace(
                        self.as_ptr(),
                        point.as_ptr(),
                        capacity,
                        curve.as_mut_ptr(),
                        &mut n,
                        env,
                        err,
                    )
                }
            })?;
            if n <= capacity {
                curve.truncate(n * dim);
                return Ok(curve);
            }
            capacity = n;
        }
    }
}

/// Where the library may write n statuses.
pub(crate) fn statuses(status: Option<&mut [Status]>, n: usize) -> Result<*mut sys::icc_status> {
    if let Some(status) = &status {
        exactly(status, n, "status")?;
    }
    Ok(pointer_mut(status).cast())
}
