//! Maps from one shape to another.
use crate::chart::{statuses, Chart, ChartOptions, Images};
use crate::domain::Domain;
use crate::env::Env;
use crate::error::{check, Result, Status};
use crate::object::{object, saved, to_bytes, Borrowed};
use crate::picture::{Picture, PictureMut};
use crate::slices::{count, exactly, mesh_of, pointer};
use crate::sys;

pub use crate::sys::icc_certificate as Certificate;
pub use crate::sys::icc_improve_report as ImproveReport;
pub use crate::sys::icc_map_info as MapInfo;
pub use crate::sys::icc_map_report as MapReport;

object!(
    /// A map from one domain to another that agrees with the boundaries.
    ///
    /// ```
    /// use libicc::{Domain, Env, Map, MapOptions};
    /// let env = &mut Env::new();
    /// let before = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0], env)?;
    /// let after = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 6.0, 3.0, 0.0, 4.0], env)?;
    /// let map = Map::new(&before, &after, &MapOptions::default(), env)?;
    /// assert_eq!(map.info().certified, 1);
    /// let images = map.apply(&[1.0, 1.0, 2.0, 3.0, 9.0, 9.0], env)?;
    /// assert_eq!(images.n_failed, 1);
    /// assert_eq!(images.status[2], libicc::Status::OUTSIDE);
    /// # Ok::<(), libicc::Error>(())
    /// ```
    Map,
    icc_map,
    icc_map_free
);

/// How a map works.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum MapKind {
    /// a curve map: point by point through two charts, in any dimension
    Curves = sys::ICC_MAP_CURVES,
    /// a mesh map: piecewise linear, of low distortion, with the fastest queries
    Mesh = sys::ICC_MAP_MESH,
}

/// Which vertices of features may slide: [`MapOptions::slide`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Slide {
    /// those of lines and borders inside the domain
    Inside = sys::ICC_SLIDE_INSIDE,
    /// those of the boundary as well
    All = sys::ICC_SLIDE_ALL,
}

/// Options of [`Map::new`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct MapOptions<'a> {
    /// how the map works
    pub kind: Option<MapKind>,
    /// mesh map: at most this many improvement steps on each level; 0: as long as they pay off; -1: none
    pub iterations: i32,
    /// for both charts; its maximum is the source's
    pub chart: ChartOptions<'a>,
    /// the target's maximum, dim coordinates
    pub target_maximum: Option<&'a [f64]>,
    /// with features: in each part of the domain, one less than it has pieces; or none
    pub ties: &'a [Tie<'a>],
    /// with features: vertices slide along lines and borders if that distorts the map less. Ends, and places where
    /// three or more edges meet, stay partners
    pub slide: Option<Slide>,
}

/// A path between two vertices of a domain with features, and its path in the target. It tells on which side features
/// pass one another.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tie<'a> {
    /// its first and last vertex
    pub vertices: [u32; 2],
    /// its bends in the source, 2 coordinates each
    pub source: &'a [f64],
    /// its bends in the target, whose number may differ
    pub target: &'a [f64],
}

/// A tie of a map: see [`Map::ties`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OwnedTie {
    /// its first and last vertex
    pub vertices: [u32; 2],
    /// its bends in the source, 2 coordinates each
    pub source: Vec<f64>,
    /// its bends in the target
    pub target: Vec<f64>,
}

impl OwnedTie {
    /// The same tie for [`MapOptions`].
    pub fn borrow(&self) -> Tie<'_> {
        Tie { vertices: self.vertices, source: &self.source, target: &self.target }
    }
}

impl Tie<'_> {
    fn raw(&self) -> sys::icc_tie {
        sys::icc_tie {
            vertex: self.vertices,
            n_source: self.source.len() / 2,
            source: self.source.as_ptr(),
            n_target: self.target.len() / 2,
            target: self.target.as_ptr(),
            ..Default::default()
        }
    }
}

impl MapOptions<'_> {
    /// The options in C. They borrow `chart` and `ties`.
    fn raw(&self, chart: &sys::icc_chart_options, ties: &[sys::icc_tie]) -> sys::icc_map_options {
        sys::icc_map_options {
            n_ties: ties.len(),
            ties: pointer((!ties.is_empty()).then_some(ties)),
            kind: self.kind.map_or(0, |kind| kind as i32),
            iterations: self.iterations,
            chart,
            target_maximum: pointer(self.target_maximum),
            slide: self.slide.map_or(sys::ICC_SLIDE_NONE, |slide| slide as i32),
            ..Default::default()
        }
    }
}

/// Options of [`Map::improve`]. 0 means the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct ImproveOptions {
    /// at most this many steps on each level; 0: as long as they pay off
    pub iterations: i32,
    /// at most this many refinements; 0: as long as they pay off; -1: none
    pub levels: i32,
    /// the last level ends when a step gains less than this share of the energy; 0: the default
    pub tolerance: f64,
}

/// The mesh of a mesh map.
#[derive(Clone, Debug, PartialEq)]
pub struct MapMesh {
    /// n_vertices * dim coordinates
    pub vertices: Vec<f64>,
    /// their images, n_vertices * dim coordinates
    pub images: Vec<f64>,
    /// rows of dim + 1 vertex indices, positively oriented
    pub simplices: Vec<u32>,
}

type Transform = unsafe extern "C" fn(
    *const sys::icc_map,
    usize,
    *const f64,
    *mut f64,
    *mut sys::icc_status,
    *mut usize,
    *const sys::icc_env,
) -> sys::icc_status;

type CarryMesh = unsafe extern "C" fn(
    *const sys::icc_map,
    *const sys::icc_mesh,
    *mut f64,
    *mut sys::icc_certificate,
    *const sys::icc_env,
    *mut sys::icc_error,
) -> sys::icc_status;

saved!(Map);

impl Map {
    /// Makes the map between two domains whose boundaries correspond, facet by facet.
    ///
    /// # Errors
    /// Those of [`Chart::new`]; [`Status::BOUNDARY`] when the domains do not correspond.
    /// [`Error::side`](crate::Error::side) says which of the two is at fault.
    pub fn new(source: &Domain, target: &Domain, options: &MapOptions<'_>, env: &mut Env<'_>) -> Result<Map> {
        let chart = options.chart.raw(source.dim())?;
        if let Some(maximum) = options.target_maximum {
            exactly(maximum, target.dim(), "target_maximum")?;
        }
        let ties: Vec<_> = options.ties.iter().map(Tie::raw).collect();
        let raw = options.raw(&chart, &ties);
        Map::make(env, |out, env, err| {
            // SAFETY: the options are valid during the call.
            unsafe { sys::icc_map_create(out, source.as_ptr(), target.as_ptr(), &raw, env, err) }
        })
    }

    /// Makes a map from two charts of the same method. Of the options only `kind` and `iterations` are used.
    pub fn from_charts(
        source: &Chart,
        target: &Chart,
        options: &MapOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Map> {
        let chart = sys::icc_chart_options::default();
        let raw = MapOptions { target_maximum: None, ..*options }.raw(&chart, &[]);
        Map::make(env, |out, env, err| {
            // SAFETY: the options are valid during the call.
            unsafe { sys::icc_map_create_from_charts(out, source.as_ptr(), target.as_ptr(), &raw, env, err) }
        })
    }

    /// Makes a map of lower distortion from a mesh map. If you cancel, it ends early with the map reached by then.
    pub fn improve(&self, options: &ImproveOptions, env: &mut Env<'_>) -> Result<(Map, ImproveReport)> {
        let raw = sys::icc_improve_options {
            iterations: options.iterations,
            levels: options.levels,
            tolerance: options.tolerance,
            ..Default::default()
        };
        let mut report = ImproveReport::default();
        let map = Map::make(env, |out, env, err| {
            // SAFETY: `size` is set.
            unsafe { sys::icc_map_improve(out, self.as_ptr(), &raw, &mut report, env, err) }
        })?;
        Ok((map, report))
    }

    /// Makes the map to a target that has moved. It starts from this map and improves it by at most `iterations` steps
    /// (0: as many as suit an interactive frame; -1: none). Use it for dragging, in the plane and in space.
    ///
    /// # Errors
    /// [`Status::CERTIFICATE`] if the target cannot be reached.
    pub fn retarget(&self, target: &Domain, iterations: i32, env: &mut Env<'_>) -> Result<Map> {
        let raw = sys::icc_retarget_options { iterations, ..Default::default() };
        Map::make(env, |out, env, err| {
            // SAFETY: valid objects, and `size` is set.
            unsafe { sys::icc_map_retarget(out, self.as_ptr(), target.as_ptr(), &raw, env, err) }
        })
    }

    /// The map with its domains and charts as bytes, for other processes. They are the same on every machine and have a
    /// checksum.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        to_bytes(|capacity, data, n| {
            // SAFETY: there is room for `capacity` bytes.
            unsafe { sys::icc_map_save(self.as_ptr(), capacity, data, n) }
        })
    }

    /// Reads a map back, as [`Chart::from_bytes`] does a chart. A mesh is certified anew.
    ///
    /// # Errors
    /// [`Status::FORMAT`]; [`Status::VERSION`] if a later version wrote the bytes, or if a chart on a grid gives other
    /// values here than where it was saved.
    pub fn from_bytes(data: &[u8], env: &mut Env<'_>) -> Result<Map> {
        Map::make(env, |out, env, err| {
            // SAFETY: as many bytes.
            unsafe { sys::icc_map_load(out, data.len(), data.as_ptr().cast(), env, err) }
        })
    }

    /// Facts about the map, such as whether it is certified.
    pub fn info(&self) -> MapInfo {
        let mut info = MapInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_map_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// How the map was made: counts and seconds.
    pub fn report(&self) -> MapReport {
        let mut report = MapReport::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_map_get_report(self.as_ptr(), &mut report) };
        report
    }

    /// The ties of the map, which tell on which side features pass one another. Passed to [`MapOptions`] they make a
    /// map that can be moved to this one while it stays one-to-one. Without features there are none. Ties whose ends
    /// have slid ([`MapOptions::slide`]) are left out.
    pub fn ties(&self) -> Vec<OwnedTie> {
        (0..self.info().n_ties).filter_map(|tie| self.tie(tie)).collect()
    }

    fn tie(&self, tie: usize) -> Option<OwnedTie> {
        let (mut info, nothing) = (sys::icc_tie_info::default(), std::ptr::null_mut());
        // SAFETY: `size` is set, and there is such a tie.
        let status = unsafe { sys::icc_map_get_tie(self.as_ptr(), tie, &mut info, nothing, nothing) };
        if status != sys::ICC_OK {
            return None;
        }
        let (mut source, mut target) = (vec![0.0; 2 * info.n_source], vec![0.0; 2 * info.n_target]);
        // SAFETY: there is room for all bends.
        unsafe {
            sys::icc_map_get_tie(self.as_ptr(), tie, &mut info, source.as_mut_ptr(), target.as_mut_ptr())
        };
        Some(OwnedTie { vertices: info.vertex, source, target })
    }

    /// The dimension.
    pub fn dim(&self) -> usize {
        self.info().dim as usize
    }

    /// The chart of the source; `None` for maps made by [`retarget`](Self::retarget).
    pub fn source_chart(&self) -> Option<Borrowed<'_, Chart>> {
        // SAFETY: the map keeps its charts.
        unsafe { Chart::found(sys::icc_map_source_chart(self.as_ptr())).map(|chart| Borrowed::new(chart)) }
    }

    /// The chart of the target; `None` for maps made by [`retarget`](Self::retarget).
    pub fn target_chart(&self) -> Option<Borrowed<'_, Chart>> {
        // SAFETY: the map keeps its charts.
        unsafe { Chart::found(sys::icc_map_target_chart(self.as_ptr())).map(|chart| Borrowed::new(chart)) }
    }

    /// The mesh of a mesh map.
    ///
    /// # Errors
    /// [`Status::UNSUPPORTED`] for other maps.
    pub fn mesh(&self) -> Result<MapMesh> {
        let mut own = sys::icc_mesh::default();
        // SAFETY: `size` is set, and nothing but numbers is filled in.
        check(unsafe { sys::icc_map_get_mesh(self.as_ptr(), &mut own, std::ptr::null_mut()) })?;
        let dim = own.dim as usize;
        let mut mesh = MapMesh {
            vertices: vec![0.0; own.n_vertices * dim],
            images: vec![0.0; own.n_vertices * dim],
            simplices: vec![0; own.n_cells * (dim + 1)],
        };
        (own.vertices, own.cells) = (mesh.vertices.as_mut_ptr(), mesh.simplices.as_mut_ptr());
        // SAFETY: there is room for all.
        check(unsafe { sys::icc_map_get_mesh(self.as_ptr(), &mut own, mesh.images.as_mut_ptr()) })?;
        Ok(mesh)
    }

    /// The region of each simplex of [`mesh`](Self::mesh): k within the k-th region of the source, but not within a
    /// region inside it, and 0 elsewhere.
    ///
    /// # Errors
    /// [`Status::UNSUPPORTED`] for other maps.
    pub fn mesh_regions(&self) -> Result<Vec<u32>> {
        let mut regions = vec![0; self.info().n_simplices];
        // SAFETY: there is room for all.
        Env::default()
            .call(|_, err| unsafe { sys::icc_map_get_regions(self.as_ptr(), regions.as_mut_ptr(), err) })?;
        Ok(regions)
    }

    /// Maps points from the source to the target: n * dim coordinates. The call does not fail if single points have no
    /// image: check [`Images::n_failed`].
    pub fn apply(&self, points: &[f64], env: &mut Env<'_>) -> Result<Images> {
        self.carry(sys::icc_map_apply, points, env)
    }

    /// Maps points from the target to the source.
    pub fn apply_inverse(&self, points: &[f64], env: &mut Env<'_>) -> Result<Images> {
        self.carry(sys::icc_map_apply_inverse, points, env)
    }

    fn carry(&self, function: Transform, points: &[f64], env: &mut Env<'_>) -> Result<Images> {
        let dim = self.dim();
        let n = count(points, dim, "points")?;
        let mut images = Images::new(n, dim);
        let status = Some(&mut images.status[..]);
        // SAFETY: both slices have n points.
        images.n_failed =
            unsafe { self.transform(function, n, points.as_ptr(), images.points.as_mut_ptr(), status, env) }?;
        Ok(images)
    }

    /// Like [`apply`](Self::apply), but writes to a slice of the same length, and n statuses. Returns the number of
    /// points without an image, which get NaN.
    pub fn apply_into(
        &self,
        points: &[f64],
        images: &mut [f64],
        status: Option<&mut [Status]>,
        env: &mut Env<'_>,
    ) -> Result<usize> {
        let n = count(points, self.dim(), "points")?;
        exactly(images, points.len(), "images")?;
        // SAFETY: both slices have n points.
        unsafe { self.transform(sys::icc_map_apply, n, points.as_ptr(), images.as_mut_ptr(), status, env) }
    }

    /// Like [`apply_inverse`](Self::apply_inverse), but writes to slices.
    pub fn apply_inverse_into(
        &self,
        points: &[f64],
        images: &mut [f64],
        status: Option<&mut [Status]>,
        env: &mut Env<'_>,
    ) -> Result<usize> {
        let n = count(points, self.dim(), "points")?;
        exactly(images, points.len(), "images")?;
        let function = sys::icc_map_apply_inverse;
        // SAFETY: both slices have n points.
        unsafe { self.transform(function, n, points.as_ptr(), images.as_mut_ptr(), status, env) }
    }

    /// Replaces points by their images. Returns the number of points without an image, which get NaN.
    pub fn apply_in_place(&self, points: &mut [f64], env: &mut Env<'_>) -> Result<usize> {
        let n = count(points, self.dim(), "points")?;
        let place = points.as_mut_ptr();
        // SAFETY: the library allows images where the points are.
        unsafe { self.transform(sys::icc_map_apply, n, place, place, None, env) }
    }

    /// # Safety
    /// `points` and `images` must be valid for n points.
    unsafe fn transform(
        &self,
        function: Transform,
        n: usize,
        points: *const f64,
        images: *mut f64,
        status: Option<&mut [Status]>,
        env: &mut Env<'_>,
    ) -> Result<usize> {
        let status = statuses(status, n)?;
        let mut n_failed = 0;
        env.call(|env, _| {
            // SAFETY: the caller's promise, and as many statuses.
            unsafe { function(self.as_ptr(), n, points, images, status, &mut n_failed, env) }
        })?;
        Ok(n_failed)
    }

    /// The derivative at points of the source's interior: rows of dim * dim numbers in
    /// [`Images::points`], image coordinate by point coordinate.
    pub fn jacobian(&self, points: &[f64], env: &mut Env<'_>) -> Result<Images> {
        let dim = self.dim();
        let n = count(points, dim, "points")?;
        let mut images = Images::new(n, dim * dim);
        let status = Some(&mut images.status[..]);
        let function = sys::icc_map_jacobian;
        // SAFETY: there is room for n matrices.
        images.n_failed =
            unsafe { self.transform(function, n, points.as_ptr(), images.points.as_mut_ptr(), status, env) }?;
        Ok(images)
    }

    /// Maps the vertices of a mesh and checks exactly whether the image is a valid mesh too. `simplices` has rows of
    /// dim + 1 vertex indices.
    pub fn certify(
        &self,
        vertices: &[f64],
        simplices: &[u32],
        env: &mut Env<'_>,
    ) -> Result<(Vec<f64>, Certificate)> {
        self.carry_mesh(sys::icc_map_certify, vertices, simplices, env)
    }

    /// Maps a mesh so that no simplex inverts, if possible, by moving the images of inner vertices. The certificate is
    /// about the returned images.
    pub fn repair(
        &self,
        vertices: &[f64],
        simplices: &[u32],
        env: &mut Env<'_>,
    ) -> Result<(Vec<f64>, Certificate)> {
        self.carry_mesh(sys::icc_map_repair, vertices, simplices, env)
    }

    fn carry_mesh(
        &self,
        function: CarryMesh,
        vertices: &[f64],
        simplices: &[u32],
        env: &mut Env<'_>,
    ) -> Result<(Vec<f64>, Certificate)> {
        let mesh = mesh_of(self.dim(), vertices, simplices)?;
        let mut images = vec![0.0; vertices.len()];
        let mut certificate = Certificate::default();
        env.call(|env, err| {
            // SAFETY: the counts are those of the slices.
            unsafe { function(self.as_ptr(), &mesh, images.as_mut_ptr(), &mut certificate, env, err) }
        })?;
        Ok((images, certificate))
    }

    /// Warps a picture. Each target pixel whose centre lies in the target domain gets the colour of its place in the
    /// source. Other pixels stay as they are. Returns the number of pixels inside without an image.
    ///
    /// Pixel (i, j), column i of row j, covers \[i, i+1\] x \[j, j+1\] in the coordinates of the domains. Both
    /// pictures need the same channels, bytes and alpha.
    ///
    /// ```
    /// use libicc::{Domain, Env, Map, MapOptions, Picture, PictureMut};
    /// let env = &mut Env::new();
    /// let shape = Domain::polygon(&[1.0, 1.0, 7.0, 1.0, 7.0, 7.0, 1.0, 7.0], env)?;
    /// let identity = Map::new(&shape, &shape, &MapOptions::default(), env)?;
    /// let grey: Vec<u8> = (0..64).collect();
    /// let mut result = vec![0; 64];
    /// let failed = identity.warp(&Picture::new(8, 8, 1, &grey)?, &mut PictureMut::new(8, 8, 1, &mut result)?, env)?;
    /// assert_eq!((failed, result[9], result[0]), (0, 9, 0));
    /// # Ok::<(), libicc::Error>(())
    /// ```
    pub fn warp(
        &self,
        source: &Picture<'_>,
        target: &mut PictureMut<'_>,
        env: &mut Env<'_>,
    ) -> Result<usize> {
        let mut n_failed = 0;
        env.call(|env, err| {
            // SAFETY: pictures cover what their slices hold; borrows keep them apart.
            unsafe { sys::icc_map_warp(self.as_ptr(), source.raw(), target.raw(), &mut n_failed, env, err) }
        })?;
        Ok(n_failed)
    }
}
