//! Maps from what is known only in part.
use crate::domain::Domain;
use crate::env::Env;
use crate::error::{check, Result};
use crate::map::Map;
use crate::object::{object, Borrowed};
use crate::slices::{count, exactly, mesh_of, pointer};
use crate::sys;

pub use crate::sys::icc_fit_info as FitInfo;
pub use crate::sys::icc_nearest_report as NearestReport;

object!(
    /// A map of the plane that is made from what is known of it, such as a few control points or pins.
    ///
    /// ```
    /// use libicc::{Env, Fit, FitOptions};
    /// let env = &mut Env::new();
    /// let points = [0.0, 0.0, 4.0, 0.0, 4.0, 3.0, 0.0, 3.0];
    /// let targets = [1.0, 1.0, 5.0, 2.0, 6.0, 5.0, 1.0, 4.0];
    /// let fit = Fit::new(&points, &targets, &FitOptions::default(), env)?;
    /// let images = fit.map().apply(&points, env)?.points;
    /// assert!(images.iter().zip(&targets).all(|(image, target)| (image - target).abs() < 1e-9));
    /// assert_eq!(fit.map().info().certified, 1);
    /// # Ok::<(), libicc::Error>(())
    /// ```
    Fit,
    icc_fit,
    icc_fit_free
);

/// How a fit carries everything that is not told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum FitModel {
    /// it bends as little as possible: for maps and pictures
    Spline = sys::ICC_FIT_SPLINE,
    /// every small piece keeps its shape and size: for characters, and for meshes whose boundary moves
    Elastic = sys::ICC_FIT_ELASTIC,
}

/// What is known of a map. Points have 2 coordinates each.
#[derive(Clone, Copy, Debug)]
pub enum Constraint<'a> {
    /// points go to their targets
    Points {
        /// the points
        source: &'a [f64],
        /// where they go
        target: &'a [f64],
        /// with the spline: how far each may be off its target; `None`: not at all
        tolerance: Option<&'a [f64]>,
    },
    /// inside a domain, a polyline goes to a polyline, vertex by vertex
    Line {
        /// the polyline
        source: &'a [f64],
        /// where its vertices go
        target: &'a [f64],
    },
    /// vertices of the domain, or of the mesh, go to their targets
    Vertices {
        /// their numbers
        vertices: &'a [u32],
        /// where they go
        target: &'a [f64],
    },
    /// vertices may move along straight lines only
    Sliding {
        /// their numbers
        vertices: &'a [u32],
        /// a direction for each; `None`: that of the boundary, which must be straight there
        direction: Option<&'a [f64]>,
    },
}

impl Constraint<'_> {
    fn raw(&self) -> Result<sys::icc_constraint> {
        let mut raw = sys::icc_constraint::default();
        match *self {
            Constraint::Points { source, target, tolerance } => {
                raw.kind = sys::ICC_CONSTRAINT_POINTS;
                (raw.n, raw.source) = (count(source, 2, "source")?, source.as_ptr());
                exactly(target, source.len(), "target")?;
                if let Some(tolerance) = tolerance {
                    exactly(tolerance, raw.n, "tolerance")?;
                }
                (raw.target, raw.tolerance) = (target.as_ptr(), pointer(tolerance));
            }
            Constraint::Line { source, target } => {
                raw.kind = sys::ICC_CONSTRAINT_LINE;
                (raw.n, raw.source) = (count(source, 2, "source")?, source.as_ptr());
                exactly(target, source.len(), "target")?;
                raw.target = target.as_ptr();
            }
            Constraint::Vertices { vertices, target } => {
                raw.kind = sys::ICC_CONSTRAINT_VERTICES;
                (raw.n, raw.vertices) = (vertices.len(), vertices.as_ptr());
                exactly(target, 2 * raw.n, "target")?;
                raw.target = target.as_ptr();
            }
            Constraint::Sliding { vertices, direction } => {
                raw.kind = sys::ICC_CONSTRAINT_SLIDING;
                (raw.n, raw.vertices) = (vertices.len(), vertices.as_ptr());
                if let Some(direction) = direction {
                    exactly(direction, 2 * raw.n, "direction")?;
                }
                raw.direction = pointer(direction);
            }
        }
        Ok(raw)
    }
}

/// Options of a [`Fit`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct FitOptions<'a> {
    /// `None`: the spline without a domain and mesh, else elastic
    pub model: Option<FitModel>,
    /// without a domain and mesh: the box that the map covers at least, lower and upper corner; `None`: that of the
    /// points
    pub bounds: Option<[f64; 4]>,
    /// without a domain and mesh: how far the map reaches beyond the box, as a share of its longest side; 0: chosen by
    /// leaving each point out in turn
    pub margin: f64,
    /// spline: 0: points with a tolerance are smoothed as leaving each point out in turn suggests; above 0: a factor,
    /// larger for smoother; negative: all points are exact
    pub smoothing: f64,
    /// elastic: how far a point carries its surroundings along, a length in the source; 0: as far as the mesh makes it,
    /// so a single point pulls a spike
    pub reach: f64,
    /// elastic: cells are stiffer by their area to the power of minus this number, from 0 to 3. With 1.5 thin layers of
    /// cells move as if glued to their wall
    pub stiffness: f64,
    /// elastic, with a mesh: a further factor above 0 for each cell
    pub cell_stiffness: Option<&'a [f64]>,
    /// elastic: the longest edge of the mesh that libicc makes, a length in the source; 0: chosen
    pub cell: f64,
    /// elastic: parts of the free outline do not push each other away. The result is refused if they overlap
    pub no_contact: bool,
}

impl FitOptions<'_> {
    fn raw(&self, n_cells: usize) -> Result<sys::icc_fit_options> {
        if let Some(factors) = self.cell_stiffness {
            exactly(factors, n_cells, "cell_stiffness")?;
        }
        Ok(sys::icc_fit_options {
            model: self.model.map_or(0, |model| model as i32),
            r#box: pointer(self.bounds.as_ref().map(|bounds| &bounds[..])),
            margin: self.margin,
            smoothing: self.smoothing,
            reach: self.reach,
            stiffness: self.stiffness,
            cell_stiffness: pointer(self.cell_stiffness),
            cell: self.cell,
            no_contact: self.no_contact.into(),
            ..Default::default()
        })
    }
}

impl Fit {
    /// Makes the map of control points: 2 coordinates for each point and for its target. It covers a box around the
    /// points.
    ///
    /// # Errors
    /// [`Status::ARGUMENT`](crate::Status::ARGUMENT) if two points coincide and have different targets, or if the
    /// targets mirror the points; [`Status::CERTIFICATE`](crate::Status::CERTIFICATE) if no one-to-one map was found.
    pub fn new(points: &[f64], targets: &[f64], options: &FitOptions<'_>, env: &mut Env<'_>) -> Result<Fit> {
        let known = [Constraint::Points { source: points, target: targets, tolerance: None }];
        Fit::create(None, None, &known, options, env)
    }

    /// Makes a map from everything that is known. It covers a box around the points.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_constraints(
        constraints: &[Constraint<'_>],
        options: &FitOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Fit> {
        Fit::create(None, None, constraints, options, env)
    }

    /// Makes a map of a domain, whose outline is free where the constraints do not tell it.
    ///
    /// If a shape cannot reach its targets without folding or overlapping, the result is the map as far as it got:
    /// check [`FitInfo::n_off`](crate::FitInfo).
    ///
    /// # Errors
    /// As [`new`](Self::new); [`Status::OUTSIDE`](crate::Status::OUTSIDE) for a point outside the domain;
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY) if told parts of the boundary cross.
    pub fn in_domain(
        domain: &Domain,
        constraints: &[Constraint<'_>],
        options: &FitOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Fit> {
        Fit::create(Some(domain), None, constraints, options, env)
    }

    /// Makes a map of a mesh of triangles, which is kept as it is; otherwise like [`in_domain`](Self::in_domain).
    ///
    /// # Errors
    /// As [`in_domain`](Self::in_domain).
    pub fn on_mesh(
        vertices: &[f64],
        triangles: &[u32],
        constraints: &[Constraint<'_>],
        options: &FitOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Fit> {
        let mesh = mesh_of(2, vertices, triangles)?;
        Fit::create(None, Some(&mesh), constraints, options, env)
    }

    fn create(
        domain: Option<&Domain>,
        mesh: Option<&sys::icc_mesh>,
        constraints: &[Constraint<'_>],
        options: &FitOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Fit> {
        let all = constraints.iter().map(Constraint::raw).collect::<Result<Vec<_>>>()?;
        let raw = options.raw(mesh.map_or(0, |mesh| mesh.n_cells))?;
        let domain = domain.map_or(std::ptr::null(), Domain::as_ptr);
        let mesh = mesh.map_or(std::ptr::null(), |mesh| mesh as *const _);
        Fit::make(env, |out, env, err| {
            // SAFETY: everything that these point to is valid during the call, and has as many numbers.
            unsafe { sys::icc_fit_create(out, domain, mesh, all.len(), all.as_ptr(), &raw, env, err) }
        })
    }

    /// Makes the fit to targets that have moved: 2 coordinates for each item, constraint after constraint. It starts
    /// from this fit. Use it for dragging.
    ///
    /// # Errors
    /// As those of the call that made this fit.
    pub fn moved(&self, targets: &[f64], env: &mut Env<'_>) -> Result<Fit> {
        exactly(targets, 2 * self.info().n_items, "targets")?;
        Fit::make(env, |out, env, err| {
            // SAFETY: as many targets as items.
            unsafe { sys::icc_fit_move(out, self.as_ptr(), targets.as_ptr(), env, err) }
        })
    }

    /// The map.
    pub fn map(&self) -> Borrowed<'_, Map> {
        // SAFETY: the fit keeps its map.
        unsafe {
            Borrowed::new(Map::found(sys::icc_fit_map(self.as_ptr())).expect("libicc: a fit has a map"))
        }
    }

    /// How well it fits.
    pub fn info(&self) -> FitInfo {
        let mut info = FitInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_fit_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// The image of each item minus its target, 2 numbers each.
    pub fn residuals(&self) -> Result<Vec<f64>> {
        let mut residuals = vec![0.0; 2 * self.info().n_items];
        // SAFETY: 2 numbers for each item.
        check(unsafe {
            sys::icc_fit_get_residuals(self.as_ptr(), residuals.as_mut_ptr(), std::ptr::null_mut())
        })?;
        Ok(residuals)
    }

    /// Where the other points alone would take each point, minus its target, 2 numbers each; NaN where that is not
    /// known. This is an honest estimate of the accuracy between points.
    pub fn left_out(&self) -> Result<Vec<f64>> {
        let mut left_out = vec![0.0; 2 * self.info().n_items];
        // SAFETY: 2 numbers for each item.
        check(unsafe {
            sys::icc_fit_get_residuals(self.as_ptr(), std::ptr::null_mut(), left_out.as_mut_ptr())
        })?;
        Ok(left_out)
    }
}

impl Map {
    /// Makes the one-to-one map that is nearest to any warp of a mesh of triangles in the plane, given by the images of
    /// its vertices. Where the warp does not fold, it stays as it is. The images of the boundary and of the vertices
    /// `held` do not change.
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY) if the mesh is not valid, or if the image of its boundary meets
    /// itself; [`Status::ARGUMENT`](crate::Status::ARGUMENT) if the images are a mirror image;
    /// [`Status::CERTIFICATE`](crate::Status::CERTIFICATE) if no one-to-one map was found.
    pub fn nearest(
        vertices: &[f64],
        triangles: &[u32],
        images: &[f64],
        held: &[u32],
        env: &mut Env<'_>,
    ) -> Result<(Map, NearestReport)> {
        let mesh = mesh_of(2, vertices, triangles)?;
        exactly(images, vertices.len(), "images")?;
        let raw = sys::icc_nearest_options { n_held: held.len(), held: held.as_ptr(), ..Default::default() };
        let mut report = NearestReport::default();
        let map = Map::make(env, |out, env, err| {
            // SAFETY: as many images as vertices, and both sizes are set.
            unsafe { sys::icc_map_create_nearest(out, &mesh, images.as_ptr(), &raw, &mut report, env, err) }
        })?;
        Ok((map, report))
    }
}
