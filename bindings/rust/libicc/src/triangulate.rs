//! Triangulation of sparse points.
use crate::env::Env;
use crate::error::{Error, Result};
use crate::slices::count;
use crate::sys;

/// Constrained Delaunay triangulation of a simple polygon with points inside (2-D), all decisions exact.
///
/// `points` has n * 2 coordinates, those of the polygon's `n_boundary` vertices first. The result has rows of three
/// indices, counter-clockwise with y upwards.
///
/// ```
/// use libicc::{stages::triangulate, Env};
/// let points = [0.0, 0.0, 2.0, 0.0, 2.0, 2.0, 0.0, 2.0, 1.0, 1.0];
/// assert_eq!(triangulate(4, &points, &mut Env::new())?.len(), 3 * 4);
/// # Ok::<(), libicc::Error>(())
/// ```
///
/// # Errors
/// [`Status::BOUNDARY`](crate::Status::BOUNDARY), [`Status::OUTSIDE`](crate::Status::OUTSIDE), whose `index` is a
/// point that is not strictly inside, or that repeats another.
pub fn triangulate(n_boundary: usize, points: &[f64], env: &mut Env<'_>) -> Result<Vec<u32>> {
    let n = count(points, 2, "points")?;
    if n_boundary < 3 || n_boundary > n {
        return Err(Error::argument(format!("{} of {} points on the boundary", n_boundary, n)));
    }
    let mut triangles = vec![0; 3 * (2 * n - n_boundary - 2)];
    env.call(|env, err| {
        // SAFETY: there is room for all triangles.
        unsafe { sys::icc_triangulate(n_boundary, n, points.as_ptr(), triangles.as_mut_ptr(), env, err) }
    })?;
    Ok(triangles)
}
