//! Shapes: a boundary, and what lies inside.
use crate::env::Env;
use crate::error::{check, Result};
use crate::object::object;
use crate::slices::{count, exactly, int, mesh_of, pointer, product};
use crate::sys;
use std::ptr;

pub use crate::sys::icc_domain_info as DomainInfo;
pub use crate::sys::icc_feature_info as FeatureInfo;

object!(
    /// A shape: its boundary, and what lies inside.
    ///
    /// ```
    /// use libicc::{Domain, Env, Place};
    /// let square = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0], &mut Env::new())?;
    /// assert_eq!(square.info().measure, 16.0);
    /// let places = square.locate(&[1.0, 1.0, 4.0, 2.0, 9.0, 9.0], &mut Env::new())?;
    /// assert_eq!(places, [Place::INSIDE, Place::BOUNDARY, Place::OUTSIDE]);
    /// # Ok::<(), libicc::Error>(())
    /// ```
    Domain,
    icc_domain,
    icc_domain_free
);

/// Where a point lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(transparent)]
pub struct Place(pub i32);

impl Place {
    /// in the interior
    pub const INSIDE: Place = Place(sys::ICC_INSIDE);
    /// on the boundary, within 1e-14 of the bounding box's longest side, or `dim` * 2^-52 of the largest coordinate
    /// along each axis, whichever is more
    pub const BOUNDARY: Place = Place(sys::ICC_BOUNDARY);
    /// outside, or in a hole
    pub const OUTSIDE: Place = Place(sys::ICC_OUTSIDE);
}

/// Points of a boundary.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BoundaryPoints {
    /// n indices of facets
    pub facet: Vec<u32>,
    /// n * dim barycentric coordinates
    pub bary: Vec<f64>,
}

/// A defect that keeps a polygon from being the boundary of a domain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Defect {
    /// `ICC_DEFECT_*` of [`sys`]
    pub kind: i32,
    /// vertices or facets, as the kind says
    pub items: [u32; 2],
}

/// A hole, line, point or region inside a domain of the plane: x and y of each vertex. See [`Domain::with_features`].
#[derive(Clone, Copy, Debug)]
pub enum Feature<'a> {
    /// A simple polygon that is cut out.
    Hole(&'a [f64]),
    /// A polyline; with two vertices, a bone.
    Line(&'a [f64]),
    /// A simple polygon that belongs to the domain.
    Region(&'a [f64]),
    /// One vertex.
    Point(&'a [f64; 2]),
    /// A point with a size: the circle of this radius around it moves along and may grow or shrink, but does not turn.
    /// The domain represents the circle by a line of 16 vertices, which follows all given features.
    Handle(&'a [f64; 2], f64),
}

impl Feature<'_> {
    fn raw(&self) -> Result<sys::icc_feature> {
        let (kind, vertices): (i32, &[f64]) = match self {
            Feature::Hole(vertices) => (sys::ICC_FEATURE_HOLE, vertices),
            Feature::Region(vertices) => (sys::ICC_FEATURE_REGION, vertices),
            Feature::Line(vertices) => (sys::ICC_FEATURE_LINE, vertices),
            Feature::Point(vertex) | Feature::Handle(vertex, _) => (sys::ICC_FEATURE_POINT, &vertex[..]),
        };
        let radius = if let Feature::Handle(_, radius) = self { *radius } else { 0.0 };
        Ok(sys::icc_feature {
            kind,
            n_vertices: count(vertices, 2, "the vertices of a feature")?,
            vertices: vertices.as_ptr(),
            radius,
            ..Default::default()
        })
    }
}

/// A void, surface, line or point inside a solid: x, y and z of each vertex, and 3 vertices of its own for each triangle.
/// See [`Domain::solid`].
#[derive(Clone, Copy, Debug)]
pub enum SolidFeature<'a> {
    /// A closed surface whose inside is empty.
    Void(&'a [f64], &'a [u32]),
    /// A closed surface with the solid on both sides.
    Surface(&'a [f64], &'a [u32]),
    /// A polyline that does not close.
    Line(&'a [f64]),
    /// One vertex.
    Point(&'a [f64; 3]),
}

impl SolidFeature<'_> {
    fn raw(&self) -> Result<sys::icc_feature> {
        let (kind, vertices, facets): (i32, &[f64], Option<&[u32]>) = match self {
            SolidFeature::Void(vertices, facets) => (sys::ICC_FEATURE_HOLE, vertices, Some(facets)),
            SolidFeature::Surface(vertices, facets) => (sys::ICC_FEATURE_REGION, vertices, Some(facets)),
            SolidFeature::Line(vertices) => (sys::ICC_FEATURE_LINE, vertices, None),
            SolidFeature::Point(vertex) => (sys::ICC_FEATURE_POINT, &vertex[..], None),
        };
        Ok(sys::icc_feature {
            kind,
            n_vertices: count(vertices, 3, "the vertices of a feature")?,
            vertices: vertices.as_ptr(),
            n_facets: facets.map_or(Ok(0), |facets| count(facets, 3, "the facets of a feature"))?,
            facets: pointer(facets),
            ..Default::default()
        })
    }
}

impl Domain {
    /// The inside of a simple polygon: n * 2 coordinates, in either direction; the last vertex joins the first.
    ///
    /// Checked exactly: no edge of length zero, no edges that cross or touch.
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY), with the vertex or facet at fault as `index`.
    pub fn polygon(vertices: &[f64], env: &mut Env<'_>) -> Result<Domain> {
        let n = count(vertices, 2, "vertices")?;
        Domain::make(env, |out, env, err| {
            // SAFETY: n vertices in 2-D.
            unsafe { sys::icc_domain_create(out, 2, n, vertices.as_ptr(), 0, ptr::null(), env, err) }
        })
    }

    /// A simple polygon with holes, regions, lines and points. With a region, `outer` may be empty. A mesh map takes each
    /// feature to the one of the same number, vertex by vertex. Only mesh maps work on such a domain.
    ///
    /// ```
    /// use libicc::{Domain, Env, Feature, Place};
    /// let hole = Feature::Hole(&[1.0, 1.0, 2.0, 1.0, 2.0, 2.0]);
    /// let square = [0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0];
    /// let plate = Domain::with_features(&square, &[hole, Feature::Point(&[3.0, 3.0])], &mut Env::new())?;
    /// assert_eq!(plate.info().measure, 15.5);
    /// assert_eq!(plate.locate(&[1.75, 1.25], &mut Env::new())?, [Place::OUTSIDE]);
    /// # Ok::<(), libicc::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY) or [`Status::OUTSIDE`](crate::Status::OUTSIDE), with the
    /// feature at fault as `index`.
    pub fn with_features(outer: &[f64], features: &[Feature<'_>], env: &mut Env<'_>) -> Result<Domain> {
        let n = count(outer, 2, "outer")?;
        let raw = features.iter().map(Feature::raw).collect::<Result<Vec<_>>>()?;
        Domain::make(env, |out, env, err| {
            // SAFETY: the counts are those of the slices.
            unsafe {
                sys::icc_domain_create_features(out, n, outer.as_ptr(), raw.len(), raw.as_ptr(), env, err)
            }
        })
    }

    /// A solid in 3-D with voids, surfaces, lines and points inside. The outer surface has n * 3 coordinates and m * 3
    /// vertex indices.
    ///
    /// ```
    /// use libicc::{Domain, Env, SolidFeature};
    /// let outer = [0.0, 0.0, 0.0, 8.0, 0.0, 0.0, 0.0, 8.0, 0.0, 0.0, 0.0, 8.0];
    /// let inner = [1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0, 2.0];
    /// let faces = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3];
    /// let features = [SolidFeature::Void(&inner, &faces), SolidFeature::Point(&[3.0, 1.0, 1.0])];
    /// let solid = Domain::solid(&outer, &faces, &features, &mut Env::new())?;
    /// assert_eq!((solid.info().n_voids, solid.info().n_points), (1, 1));
    /// # Ok::<(), libicc::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY), [`Status::OUTSIDE`](crate::Status::OUTSIDE) or
    /// [`Status::TOPOLOGY`](crate::Status::TOPOLOGY), with the feature at fault as `index`.
    pub fn solid(
        vertices: &[f64],
        facets: &[u32],
        features: &[SolidFeature<'_>],
        env: &mut Env<'_>,
    ) -> Result<Domain> {
        let n = count(vertices, 3, "vertices")?;
        let n_facets = count(facets, 3, "facets")?;
        let raw = features.iter().map(SolidFeature::raw).collect::<Result<Vec<_>>>()?;
        Domain::make(env, |out, env, err| {
            // SAFETY: the counts are those of the slices.
            unsafe {
                sys::icc_domain_create_solid(
                    out,
                    n,
                    vertices.as_ptr(),
                    n_facets,
                    facets.as_ptr(),
                    raw.len(),
                    raw.as_ptr(),
                    env,
                    err,
                )
            }
        })
    }

    /// The inside of a closed boundary of facets: edges in 2-D, triangles in 3-D, simplices beyond.
    ///
    /// `vertices` has n * dim coordinates, `facets` as many rows of dim vertex indices.
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY) or [`Status::TOPOLOGY`](crate::Status::TOPOLOGY), with the
    /// vertex or facet at fault as `index`.
    pub fn new(dim: usize, vertices: &[f64], facets: &[u32], env: &mut Env<'_>) -> Result<Domain> {
        let n = count(vertices, dim, "vertices")?;
        let n_facets = count(facets, dim, "facets")?;
        Domain::make(env, |out, env, err| {
            // SAFETY: the counts are those of the slices.
            unsafe {
                sys::icc_domain_create(
                    out,
                    int(dim),
                    n,
                    vertices.as_ptr(),
                    n_facets,
                    facets.as_ptr(),
                    env,
                    err,
                )
            }
        })
    }

    /// The cells of a mask that are not 0, such as pixels or voxels; the first axis is fastest. Cell
    /// (i, j, ..) covers \[i, i + 1\] x \[j, j + 1\] x ..
    ///
    /// # Errors
    /// [`Status::TOPOLOGY`](crate::Status::TOPOLOGY), with a cell at fault as `index`: see [`repair_mask`].
    pub fn from_mask(shape: &[usize], cells: &[u8], env: &mut Env<'_>) -> Result<Domain> {
        exactly(cells, product(shape)?, "cells")?;
        Domain::make(env, |out, env, err| {
            // SAFETY: there are as many cells as `shape` says.
            unsafe {
                sys::icc_domain_create_mask(out, int(shape.len()), shape.as_ptr(), cells.as_ptr(), env, err)
            }
        })
    }

    /// A conforming mesh of the inside: triangles in 2-D, tetrahedra in 3-D, simplices beyond.
    ///
    /// `simplices` has rows of dim + 1 vertex indices. `facets`, rows of dim, is the boundary of the mesh in
    /// any order, or `None`.
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY) or [`Status::TOPOLOGY`](crate::Status::TOPOLOGY), with the
    /// simplex, vertex or facet at fault as `index`.
    pub fn from_mesh(
        dim: usize,
        vertices: &[f64],
        simplices: &[u32],
        facets: Option<&[u32]>,
        env: &mut Env<'_>,
    ) -> Result<Domain> {
        let mesh = mesh_of(dim, vertices, simplices)?;
        let n_facets = facets.map_or(Ok(0), |facets| count(facets, dim, "facets"))?;
        Domain::make(env, |out, env, err| {
            // SAFETY: the counts are those of the slices.
            unsafe { sys::icc_domain_create_mesh(out, &mesh, n_facets, pointer(facets), env, err) }
        })
    }

    /// This surface in 3-D, filled with tetrahedra: the same vertices and facets, and vertices inside.
    ///
    /// # Errors
    /// [`Status::RESOLUTION`](crate::Status::RESOLUTION), with the facet at fault as `index`;
    /// [`Status::UNSUPPORTED`](crate::Status::UNSUPPORTED) in other dimensions, or if it has a mesh.
    pub fn filled(&self, env: &mut Env<'_>) -> Result<Domain> {
        Domain::make(env, |out, env, err| {
            // SAFETY: the surface lives; NULL stands for the default options.
            unsafe { sys::icc_domain_fill(out, self.as_ptr(), std::ptr::null(), env, err) }
        })
    }

    /// The mesh of the inside, if there is one: n_mesh_vertices * dim coordinates, boundary vertices first, and
    /// n_mesh_simplices * (dim + 1) vertex indices.
    pub fn mesh(&self) -> Result<(Vec<f64>, Vec<u32>)> {
        let mut own = sys::icc_mesh::default();
        // SAFETY: `size` is set, and nothing but numbers is filled in.
        check(unsafe { sys::icc_domain_get_mesh(self.as_ptr(), &mut own) })?;
        let dim = own.dim as usize;
        let mut vertices = vec![0.0; own.n_vertices * dim];
        let mut simplices = vec![0; own.n_cells * (dim + 1)];
        (own.vertices, own.cells) = (vertices.as_mut_ptr(), simplices.as_mut_ptr());
        // SAFETY: there is room for all.
        check(unsafe { sys::icc_domain_get_mesh(self.as_ptr(), &mut own) })?;
        Ok((vertices, simplices))
    }

    /// The region of each simplex of [`Domain::mesh`]: 0, or k within the k-th surface of a solid.
    pub fn mesh_regions(&self) -> Result<Vec<u32>> {
        let mut regions = vec![0; self.info().n_mesh_simplices];
        // SAFETY: there is room for all.
        check(unsafe { sys::icc_domain_get_regions(self.as_ptr(), regions.as_mut_ptr()) })?;
        Ok(regions)
    }

    /// Dimension, counts, bounding box, measure.
    pub fn info(&self) -> DomainInfo {
        let mut info = DomainInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_domain_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// The dimension.
    pub fn dim(&self) -> usize {
        self.info().dim as usize
    }

    /// The features inside, in their order; [`Domain::boundary`] has the coordinates.
    pub fn features(&self) -> Vec<FeatureInfo> {
        let mut features = vec![FeatureInfo::default(); self.info().n_features];
        for (number, info) in features.iter_mut().enumerate() {
            // SAFETY: `size` is set, and there is such a feature. It cannot fail.
            unsafe { sys::icc_domain_get_feature(self.as_ptr(), number, info) };
        }
        features
    }

    /// The boundary as it was given, and all features: n_vertices * dim coordinates and n_facets * dim vertex indices.
    pub fn boundary(&self) -> Result<(Vec<f64>, Vec<u32>)> {
        let info = self.info();
        let dim = info.dim as usize;
        let mut vertices = vec![0.0; info.n_vertices * dim];
        let mut facets = vec![0; info.n_facets * dim];
        // SAFETY: there is room for all.
        check(unsafe {
            sys::icc_domain_get_boundary(self.as_ptr(), vertices.as_mut_ptr(), facets.as_mut_ptr())
        })?;
        Ok((vertices, facets))
    }

    /// Reports where points lie: n * dim coordinates.
    pub fn locate(&self, points: &[f64], env: &mut Env<'_>) -> Result<Vec<Place>> {
        Ok(self.search(points, false, env)?.0)
    }

    /// Reports where points lie, and finds the nearest point of the boundary for each.
    pub fn nearest(&self, points: &[f64], env: &mut Env<'_>) -> Result<(Vec<Place>, BoundaryPoints)> {
        self.search(points, true, env)
    }

    fn search(
        &self,
        points: &[f64],
        nearest: bool,
        env: &mut Env<'_>,
    ) -> Result<(Vec<Place>, BoundaryPoints)> {
        let dim = self.dim();
        let n = count(points, dim, "points")?;
        let mut places = vec![Place::OUTSIDE; n];
        let mut found = BoundaryPoints::default();
        if nearest {
            found.facet = vec![0; n];
            found.bary = vec![0.0; n * dim];
        }
        let (facet, bary) = match nearest {
            true => (found.facet.as_mut_ptr(), found.bary.as_mut_ptr()),
            false => (ptr::null_mut(), ptr::null_mut()),
        };
        env.call(|env, _| {
            // SAFETY: there is room for n points.
            unsafe {
                sys::icc_domain_locate(
                    self.as_ptr(),
                    n,
                    points.as_ptr(),
                    places.as_mut_ptr().cast(),
                    facet,
                    bary,
                    env,
                )
            }
        })?;
        Ok((places, found))
    }
}

/// Repairs a mask in which cells touch only along an edge or a corner, which [`Domain::from_mask`] refuses. It fills
/// cells, which become 1, and returns their number.
pub fn repair_mask(shape: &[usize], cells: &mut [u8], env: &mut Env<'_>) -> Result<usize> {
    exactly(cells, product(shape)?, "cells")?;
    let mut n_filled = 0;
    env.call(|env, err| {
        // SAFETY: there are as many cells as `shape` says.
        unsafe {
            sys::icc_mask_repair(
                int(shape.len()),
                shape.as_ptr(),
                cells.as_mut_ptr(),
                &mut n_filled,
                env,
                err,
            )
        }
    })?;
    Ok(n_filled)
}

/// Lists the defects that keep a closed polygon, n * 2 coordinates, from being the boundary of a domain.
///
/// ```
/// use libicc::{boundary_defects, sys, Env};
/// let defects = boundary_defects(&[0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0], &mut Env::new())?;
/// assert_eq!((defects[0].kind, defects[0].items), (sys::ICC_DEFECT_CROSSING, [0, 2]));
/// # Ok::<(), libicc::Error>(())
/// ```
pub fn boundary_defects(vertices: &[f64], env: &mut Env<'_>) -> Result<Vec<Defect>> {
    let n = count(vertices, 2, "vertices")?;
    let mut capacity = 16;
    loop {
        let mut kinds = vec![0; capacity];
        let mut items = vec![[0; 2]; capacity];
        let mut n_defects = 0;
        env.call(|env, err| {
            // SAFETY: there is room for `capacity` defects.
            unsafe {
                sys::icc_boundary_defects(
                    n,
                    vertices.as_ptr(),
                    capacity,
                    kinds.as_mut_ptr(),
                    items.as_mut_ptr().cast(),
                    &mut n_defects,
                    env,
                    err,
                )
            }
        })?;
        if n_defects <= capacity {
            let all = kinds.into_iter().zip(items).take(n_defects);
            return Ok(all.map(|(kind, items)| Defect { kind, items }).collect());
        }
        capacity = n_defects;
    }
}
