//! Two layers of regions that share borders.
use crate::domain::Domain;
use crate::env::Env;
use crate::error::{check, Error, Result, Side};
use crate::matching::Between;
use crate::object::{object, Borrowed};
use crate::slices::count;
use crate::sys;
use std::{ptr, slice};

pub use crate::sys::icc_coverage_info as CoverageInfo;

object!(
    /// Two layers of the same regions, such as two surveys of one county. The two new domains have common vertices, and
    /// are ready for [`Map::new`].
    ///
    /// ```
    /// use libicc::{Coverage, CoverageOptions, Env, LayerRing, Map, MapOptions};
    /// let env = &mut Env::new();
    /// let ring = |id, vertices| LayerRing { id, hole: false, vertices };
    /// let north = ring(1, &[0.0, 1.0, 4.0, 1.0, 4.0, 2.0, 0.0, 2.0]);
    /// let south = ring(2, &[0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 0.0, 1.0]);
    /// // The border bends in the new layer, and its regions come in another order.
    /// let new_south = ring(2, &[0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 2.0, 1.4, 0.0, 1.0]);
    /// let new_north = ring(1, &[0.0, 1.0, 2.0, 1.4, 4.0, 1.0, 4.0, 2.0, 0.0, 2.0]);
    /// let options = CoverageOptions::default();
    /// let coverage = Coverage::new(&[north, south], &[new_south, new_north], &options, env)?;
    /// assert_eq!((coverage.info().n_nodes, coverage.info().n_sides), (2, 3));
    /// let map = Map::new(&coverage.source(), &coverage.target(), &MapOptions::default(), env)?;
    /// assert_eq!(map.info().certified, 1);
    /// # Ok::<(), libicc::Error>(())
    /// ```
    ///
    /// [`Map::new`]: crate::Map::new
    Coverage,
    icc_coverage,
    icc_coverage_free
);

/// A ring of a layer. A region is all rings with its number.
#[derive(Clone, Copy, Debug)]
pub struct LayerRing<'a> {
    /// the number of the region, any number
    pub id: i64,
    /// whether it is a hole of the region
    pub hole: bool,
    /// x and y of at least 3 vertices, in either direction; the last one joins the first
    pub vertices: &'a [f64],
}

/// What [`Coverage::new`] does with borders that only one of the two layers has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Unmatched {
    /// it fails, and names one of them
    Refuse = sys::ICC_UNMATCHED_REFUSE,
    /// it goes on without the regions at these borders
    LeaveOut = sys::ICC_UNMATCHED_LEAVE_OUT,
}

/// Options of [`Coverage::new`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct CoverageOptions<'a> {
    /// for the source and the target: vertices within this length become one, and a vertex within this length of a side
    /// becomes part of it; 0: only where this is exact
    pub weld: [f64; 2],
    /// how vertices along a border are paired
    pub between: Option<Between>,
    /// what happens with borders that only one layer has
    pub unmatched: Option<Unmatched>,
    /// numbers of regions that are left out of both layers
    pub left_out: &'a [i64],
}

/// A ring of a [`Coverage`]: the same number of vertices in both layers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoverageRing<'a> {
    /// the number of the region
    pub id: i64,
    /// whether it is a hole
    pub hole: bool,
    /// x and y of each vertex in the source
    pub source: &'a [f64],
    /// x and y of each vertex in the target
    pub target: &'a [f64],
}

/// The kind of a [`Difference`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum DifferenceKind {
    /// a region that one layer does not have
    Region,
    /// a border between nodes
    Border,
    /// a closed border without a node: an island, a lake
    Island,
}

/// Something that only one of the two layers has.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// what it is
    pub kind: DifferenceKind,
    /// the layer that has it
    pub side: Side,
    /// the region, or the regions on both sides of the border
    pub ids: Vec<i64>,
    /// a vertex of it, in that layer's coordinates
    pub place: [f64; 2],
}

/// A layer as C has it, and its arrays.
struct Layer {
    first: Vec<usize>,
    vertices: Vec<f64>,
    ids: Vec<i64>,
    holes: Vec<u8>,
}

impl Layer {
    fn new(rings: &[LayerRing<'_>]) -> Result<Layer> {
        let mut layer = Layer { first: vec![0], vertices: vec![], ids: vec![], holes: vec![] };
        for ring in rings {
            count(ring.vertices, 2, "the vertices of a ring")?;
            layer.vertices.extend_from_slice(ring.vertices);
            layer.first.push(layer.vertices.len() / 2);
            layer.ids.push(ring.id);
            layer.holes.push(ring.hole.into());
        }
        Ok(layer)
    }

    fn raw(&self) -> sys::icc_layer {
        sys::icc_layer {
            n_rings: self.ids.len(),
            first: self.first.as_ptr(),
            vertices: self.vertices.as_ptr(),
            ids: self.ids.as_ptr(),
            holes: self.holes.as_ptr(),
            ..Default::default()
        }
    }
}

impl Coverage {
    /// Cleans both layers, finds which borders are the same, and gives them common vertices.
    ///
    /// # Errors
    /// [`Status::BOUNDARY`](crate::Status::BOUNDARY) if regions of one layer overlap or cross;
    /// [`Status::TOPOLOGY`](crate::Status::TOPOLOGY) if the layers differ, or nothing is left.
    pub fn new(
        source: &[LayerRing<'_>],
        target: &[LayerRing<'_>],
        options: &CoverageOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Coverage> {
        let (source, target) = (Layer::new(source)?, Layer::new(target)?);
        let raw = sys::icc_coverage_options {
            weld: options.weld,
            between: options.between.map_or(0, |between| between as i32),
            unmatched: options.unmatched.map_or(0, |unmatched| unmatched as i32),
            n_left_out: options.left_out.len(),
            left_out: options.left_out.as_ptr(),
            ..Default::default()
        };
        Coverage::make(env, |out, env, err| {
            // SAFETY: the layers and the options live, and their counts are those of the arrays.
            unsafe { sys::icc_coverage_create(out, &source.raw(), &target.raw(), &raw, env, err) }
        })
    }

    /// Counts, and what was done.
    pub fn info(&self) -> CoverageInfo {
        let mut info = CoverageInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_coverage_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// The source with common vertices. Each ring is a feature.
    pub fn source(&self) -> Borrowed<'_, Domain> {
        // SAFETY: the coverage keeps its domains.
        unsafe { Self::side(sys::icc_coverage_source(self.as_ptr())) }
    }

    /// The target with common vertices.
    pub fn target(&self) -> Borrowed<'_, Domain> {
        // SAFETY: the coverage keeps its domains.
        unsafe { Self::side(sys::icc_coverage_target(self.as_ptr())) }
    }

    /// # Safety
    /// `raw` must live as long as the borrow.
    unsafe fn side<'a>(raw: *const sys::icc_domain) -> Borrowed<'a, Domain> {
        let domain = Domain::found(raw).expect("libicc: a coverage has both domains");
        // SAFETY: see above.
        unsafe { Borrowed::new(domain) }
    }

    /// All rings, sorted by region.
    pub fn rings(&self) -> Result<Vec<CoverageRing<'_>>> {
        let n = self.info().n_features;
        let mut ids = vec![0; n];
        // SAFETY: there is room for n numbers.
        check(unsafe { sys::icc_coverage_get_ids(self.as_ptr(), ids.as_mut_ptr()) })?;
        let (mut source, mut target) = (ptr::null(), ptr::null());
        // SAFETY: both pointers are written.
        check(unsafe { sys::icc_coverage_get_features(self.as_ptr(), &mut source, &mut target) })?;
        // SAFETY: the coverage has n features on each side, at least one, with 2 coordinates for each vertex.
        let (source, target) =
            unsafe { (slice::from_raw_parts(source, n), slice::from_raw_parts(target, n)) };
        let vertices = |feature: &sys::icc_feature| -> &[f64] {
            // SAFETY: as above.
            unsafe { slice::from_raw_parts(feature.vertices, 2 * feature.n_vertices) }
        };
        let ring = |((id, a), b): ((i64, &sys::icc_feature), &sys::icc_feature)| CoverageRing {
            id,
            hole: a.kind == sys::ICC_FEATURE_HOLE,
            source: vertices(a),
            target: vertices(b),
        };
        Ok(ids.into_iter().zip(source).zip(target).map(ring).collect())
    }

    /// What only one layer has; the differences of the source come first.
    pub fn differences(&self) -> Result<Vec<Difference>> {
        (0..self.info().n_differences).map(|k| self.difference(k)).collect()
    }

    fn difference(&self, k: usize) -> Result<Difference> {
        let mut raw = sys::icc_coverage_difference::default();
        // SAFETY: `size` is set, and there is such a difference.
        check(unsafe { sys::icc_coverage_get_difference(self.as_ptr(), k, &mut raw) })?;
        let kind = match raw.kind {
            sys::ICC_DIFFERENCE_REGION => DifferenceKind::Region,
            sys::ICC_DIFFERENCE_BORDER => DifferenceKind::Border,
            sys::ICC_DIFFERENCE_ISLAND => DifferenceKind::Island,
            other => return Err(Error::argument(format!("a difference of kind {}", other))),
        };
        let side = if raw.side == 1 { Side::Source } else { Side::Target };
        Ok(Difference { kind, side, ids: raw.ids[..raw.n_ids as usize].to_vec(), place: raw.place })
    }
}
