//! Outlines that do not correspond.
use crate::domain::Domain;
use crate::env::Env;
use crate::error::Result;
use crate::object::{object, saved, to_bytes, Borrowed};
use crate::slices::count;
use crate::sys;

pub use crate::sys::icc_match_info as MatchInfo;

object!(
    /// The boundaries of two domains, paired. The two new domains have the same shapes and common vertices, and are
    /// ready for [`Map::new`].
    ///
    /// ```
    /// use libicc::{Domain, Env, Map, MapOptions, Match, MatchOptions};
    /// let env = &mut Env::new();
    /// let corner = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 1.0, 1.0, 1.0, 2.0, 0.0, 2.0], env)?;
    /// // The same with another first vertex, the other direction and one more vertex.
    /// let other = Domain::polygon(
    ///     &[1.0, 1.0, 2.0, 1.0, 4.0, 1.0, 4.0, 0.0, 0.0, 0.0, 0.0, 2.0, 1.0, 2.0],
    ///     env,
    /// )?;
    /// let pair = Match::new(&corner, &other, &[], &MatchOptions::default(), env)?;
    /// let (_, origins) = pair.origins();
    /// assert_eq!(origins[0], Some(4));
    /// let (images, off) = pair.apply(&[1.0, 1.0, 4.0, 0.0], env)?;
    /// assert_eq!((images, off), (vec![1.0, 1.0, 4.0, 0.0], vec![0.0, 0.0]));
    /// assert_eq!(Match::from_bytes(&pair.to_bytes()?, env)?.origins().1, origins);
    /// let map = Map::new(&pair.source(), &pair.target(), &MapOptions::default(), env)?;
    /// assert_eq!(map.info().certified, 1);
    /// # Ok::<(), libicc::Error>(())
    /// ```
    ///
    /// [`Map::new`]: crate::Map::new
    Match,
    icc_match,
    icc_match_free
);

type Follow = unsafe extern "C" fn(
    *const sys::icc_match,
    usize,
    *const f64,
    *mut f64,
    *mut f64,
    *const sys::icc_env,
) -> sys::icc_status;

/// Which rotations [`Match::new`] prefers without landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Turning {
    /// prefer small rotations among pairings that are nearly equal
    Upright = sys::ICC_TURNING_UPRIGHT,
    /// no preference
    Free = sys::ICC_TURNING_FREE,
}

/// How [`Match::new`] pairs the parts of two outlines between landmarks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Between {
    /// by shape: similar parts are paired
    Elastic = sys::ICC_BETWEEN_ELASTIC,
    /// by arc length, for outlines without distinct parts, such as discs
    Arc = sys::ICC_BETWEEN_ARC,
}

/// Options of [`Match::new`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct MatchOptions {
    /// without landmarks: which rotations are preferred
    pub turning: Option<Turning>,
    /// how the parts between landmarks are paired
    pub between: Option<Between>,
    /// without landmarks, a pairing whose [`MatchInfo::sure`](crate::MatchInfo) is less is refused; 0: 1.06; 1: none
    pub least_sure: f64,
    /// vertices that lie within this share of the perimeter become one pair; at most 0.01; 0: only if they lie within
    /// 0.3 of the shorter edge at them
    pub drop: f64,
    /// in space, how far the common surfaces may be off, as a share of the diagonal; 0: 1e-3; negative: not at all
    pub tolerance: f64,
    /// in space, the source keeps all its vertices and edges, and gets more vertices where the target needs them
    pub keep_source: bool,
}

impl Match {
    /// Pairs the boundaries of two domains of the plane or of space. Each row of `landmarks` is a point of the
    /// source and its partner in the target. It may be empty.
    ///
    /// # Errors
    /// [`Status::AMBIGUOUS`](crate::Status::AMBIGUOUS) if another pairing is nearly as good;
    /// [`Status::ARGUMENT`](crate::Status::ARGUMENT) with the landmark at fault as `index`.
    pub fn new(
        source: &Domain,
        target: &Domain,
        landmarks: &[f64],
        options: &MatchOptions,
        env: &mut Env<'_>,
    ) -> Result<Match> {
        let n = count(landmarks, 2 * source.dim(), "landmarks")?;
        let raw = sys::icc_match_options {
            turning: options.turning.map_or(0, |turning| turning as i32),
            between: options.between.map_or(0, |between| between as i32),
            least_sure: options.least_sure,
            drop: options.drop,
            tolerance: options.tolerance,
            keep_source: options.keep_source.into(),
            ..Default::default()
        };
        Match::make(env, |out, env, err| {
            // SAFETY: n rows of two points.
            unsafe {
                sys::icc_match_create(
                    out,
                    source.as_ptr(),
                    target.as_ptr(),
                    n,
                    landmarks.as_ptr(),
                    &raw,
                    env,
                    err,
                )
            }
        })
    }

    /// The cost of the pairing, and the confidence in it.
    pub fn info(&self) -> MatchInfo {
        let mut info = MatchInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_match_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// The source with the common vertices.
    pub fn source(&self) -> Borrowed<'_, Domain> {
        // SAFETY: the match keeps its domains.
        unsafe { Self::side(sys::icc_match_source(self.as_ptr())) }
    }

    /// The target with the common vertices.
    pub fn target(&self) -> Borrowed<'_, Domain> {
        // SAFETY: the match keeps its domains.
        unsafe { Self::side(sys::icc_match_target(self.as_ptr())) }
    }

    /// # Safety
    /// `raw` must live as long as the borrow.
    unsafe fn side<'a>(raw: *const sys::icc_domain) -> Borrowed<'a, Domain> {
        let domain = Domain::found(raw).expect("libicc: a match has both domains");
        // SAFETY: see above.
        unsafe { Borrowed::new(domain) }
    }

    /// For each common vertex its number in the given source and in the given target; `None` if it was added.
    pub fn origins(&self) -> (Vec<Option<u32>>, Vec<Option<u32>>) {
        let n = self.info().n_vertices;
        let (mut source, mut target) = (vec![0; n], vec![0; n]);
        // SAFETY: n numbers each. It cannot fail.
        unsafe { sys::icc_match_get_origins(self.as_ptr(), source.as_mut_ptr(), target.as_mut_ptr()) };
        let given = |v: Vec<u32>| v.into_iter().map(|v| (v != u32::MAX).then_some(v)).collect();
        (given(source), given(target))
    }

    /// Takes points of the source's boundary, n * dim coordinates, to the target's. Returns their images and their
    /// distances from the common boundary. Both are NaN for points that are not finite.
    ///
    /// # Errors
    /// [`Status::CANCELLED`](crate::Status::CANCELLED)
    pub fn apply(&self, points: &[f64], env: &mut Env<'_>) -> Result<(Vec<f64>, Vec<f64>)> {
        self.follow(sys::icc_match_apply, points, env)
    }

    /// Target to source; otherwise like [`apply`](Self::apply).
    ///
    /// # Errors
    /// [`Status::CANCELLED`](crate::Status::CANCELLED)
    pub fn apply_inverse(&self, points: &[f64], env: &mut Env<'_>) -> Result<(Vec<f64>, Vec<f64>)> {
        self.follow(sys::icc_match_apply_inverse, points, env)
    }

    fn follow(&self, function: Follow, points: &[f64], env: &mut Env<'_>) -> Result<(Vec<f64>, Vec<f64>)> {
        let n = count(points, self.source().dim(), "points")?;
        let (mut images, mut off) = (vec![0.0; points.len()], vec![0.0; n]);
        env.call(|env, _| {
            // SAFETY: the slices have n points, and n numbers.
            unsafe { function(self.as_ptr(), n, points.as_ptr(), images.as_mut_ptr(), off.as_mut_ptr(), env) }
        })?;
        Ok((images, off))
    }

    /// The match as bytes, with both domains, the same on every machine.
    ///
    /// # Errors
    /// None is expected.
    pub fn to_bytes(&self) -> Result<Vec<u8>> {
        to_bytes(|capacity, data, n| {
            // SAFETY: there is room for `capacity` bytes.
            unsafe { sys::icc_match_save(self.as_ptr(), capacity, data, n) }
        })
    }

    /// Reads a match back; its domains are checked as they were when they were made.
    ///
    /// # Errors
    /// [`Status::FORMAT`](crate::Status::FORMAT); [`Status::VERSION`](crate::Status::VERSION) if a later version
    /// wrote the bytes.
    pub fn from_bytes(data: &[u8], env: &mut Env<'_>) -> Result<Match> {
        Match::make(env, |out, env, err| {
            // SAFETY: as many bytes.
            unsafe { sys::icc_match_load(out, data.len(), data.as_ptr().cast(), env, err) }
        })
    }
}

saved!(Match);
