//! The fourth stage: integral curves of a function.
use crate::env::Env;
use crate::error::Result;
use crate::function::Function;
use crate::object::object;
use crate::slices::count;
use crate::sys;

pub use crate::sys::icc_curves_info as CurvesInfo;

object!(
    /// Integral curves of a function through given points, as polylines.
    Curves,
    icc_curves,
    icc_curves_free
);

/// The two ways along a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Way {
    /// uphill, to a maximum
    Up = sys::ICC_WAY_UP,
    /// downhill, to the boundary
    Down = sys::ICC_WAY_DOWN,
}

/// How a curve ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum End {
    /// no curve: the point lies outside, or where there are no values
    None,
    /// at the root of the tree
    Maximum,
    /// on the boundary of the domain that the grid was made from
    Boundary,
    /// at a vertex other than the root that has no higher neighbour, or downhill no lower one
    Critical,
    /// where the values end
    Values,
}

/// The end of one curve.
#[derive(Clone, Debug, PartialEq)]
pub struct CurveEnd {
    /// how it ends
    pub end: End,
    /// arc length
    pub length: f64,
    /// arc length up to where other curves join it; all of it if none do
    pub alone: f64,
    /// the facet of the boundary where it ends, and barycentric coordinates there
    pub boundary: Option<(u32, Vec<f64>)>,
}

impl Curves {
    /// Traces the curves through points of dim coordinates each.
    pub fn new(function: &Function, points: &[f64], way: Way, env: &mut Env<'_>) -> Result<Curves> {
        let n = count(points, function.tree().grid().info().dim as usize, "points")?;
        Curves::make(env, |out, env, err| {
            // SAFETY: n points.
            unsafe { sys::icc_curves_create(out, function.as_ptr(), n, points.as_ptr(), way as i32, env, err) }
        })
    }

    /// How many curves and vertices there are.
    pub fn info(&self) -> CurvesInfo {
        let mut info = CurvesInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_curves_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// The coordinates of each curve's vertices, beginning with its point.
    pub fn vertices(&self) -> Vec<Vec<f64>> {
        let info = self.info();
        let dim = info.dim as usize;
        let mut first = vec![0; info.n_curves + 1];
        let mut all = vec![0.0; info.n_vertices * dim];
        // SAFETY: room for what the info counts. It cannot fail.
        unsafe { sys::icc_curves_get_vertices(self.as_ptr(), first.as_mut_ptr(), all.as_mut_ptr()) };
        first.windows(2).map(|at| all[dim * at[0]..dim * at[1]].to_vec()).collect()
    }

    /// How each curve ends.
    pub fn ends(&self) -> Vec<CurveEnd> {
        let info = self.info();
        let (n, dim) = (info.n_curves, info.dim as usize);
        let (mut ends, mut facets) = (vec![0; n], vec![0; n]);
        let (mut lengths, mut alone, mut bary) = (vec![0.0; n], vec![0.0; n], vec![0.0; n * dim]);
        // SAFETY: room for an entry a curve. It cannot fail.
        unsafe {
            sys::icc_curves_get_ends(
                self.as_ptr(),
                ends.as_mut_ptr(),
                lengths.as_mut_ptr(),
                alone.as_mut_ptr(),
                facets.as_mut_ptr(),
                bary.as_mut_ptr(),
            )
        };
        (0..n)
            .map(|i| CurveEnd {
                end: match ends[i] {
                    sys::ICC_END_MAXIMUM => End::Maximum,
                    sys::ICC_END_BOUNDARY => End::Boundary,
                    sys::ICC_END_CRITICAL => End::Critical,
                    sys::ICC_END_VALUES => End::Values,
                    _ => End::None,
                },
                length: lengths[i],
                alone: alone[i],
                boundary: (ends[i] == sys::ICC_END_BOUNDARY)
                    .then(|| (facets[i], bary[dim * i..dim * (i + 1)].to_vec())),
            })
            .collect()
    }
}
