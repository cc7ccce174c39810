//! Lengths of slices, and points as arrays.
use crate::error::{Error, Result};
use crate::sys;

/// Points as one slice of coordinates, without a copy.
///
/// ```
/// assert_eq!(libicc::flat(&[[0.0, 1.0], [2.0, 3.0]]), [0.0, 1.0, 2.0, 3.0]);
/// ```
pub fn flat<const N: usize>(points: &[[f64; N]]) -> &[f64] {
    // SAFETY: an array has no padding, so these are the same numbers side by side.
    unsafe { std::slice::from_raw_parts(points.as_ptr().cast(), points.len() * N) }
}

/// Like [`flat`], but mutable.
pub fn flat_mut<const N: usize>(points: &mut [[f64; N]]) -> &mut [f64] {
    // SAFETY: as in `flat`.
    unsafe { std::slice::from_raw_parts_mut(points.as_mut_ptr().cast(), points.len() * N) }
}

/// Coordinates as points, without a copy.
///
/// ```
/// assert_eq!(libicc::rows::<2>(&[0.0, 1.0, 2.0, 3.0]), [[0.0, 1.0], [2.0, 3.0]]);
/// ```
///
/// # Panics
/// If there is not a whole number of points.
pub fn rows<const N: usize>(coordinates: &[f64]) -> &[[f64; N]] {
    assert!(N > 0 && coordinates.len() % N == 0, "no whole number of points");
    // SAFETY: as in `flat`.
    unsafe { std::slice::from_raw_parts(coordinates.as_ptr().cast(), coordinates.len() / N) }
}

/// Number of rows of `width` numbers.
pub(crate) fn count<T>(values: &[T], width: usize, name: &str) -> Result<usize> {
    if width == 0 || values.len() % width != 0 {
        return Err(Error::argument(format!("{}: {} numbers, not rows of {}", name, values.len(), width)));
    }
    Ok(values.len() / width)
}

pub(crate) fn exactly<T>(values: &[T], wanted: usize, name: &str) -> Result<()> {
    if values.len() != wanted {
        return Err(Error::argument(format!("{}: {} numbers, not {}", name, values.len(), wanted)));
    }
    Ok(())
}

/// A mesh that the library only reads: it borrows the slices.
pub(crate) fn mesh_of(dim: usize, vertices: &[f64], simplices: &[u32]) -> Result<sys::icc_mesh> {
    Ok(sys::icc_mesh {
        dim: int(dim),
        n_vertices: count(vertices, dim, "vertices")?,
        vertices: vertices.as_ptr() as *mut f64,
        n_cells: count(simplices, dim.saturating_add(1), "simplices")?,
        cells: simplices.as_ptr() as *mut u32,
        ..Default::default()
    })
}

/// Converts numbers that the library takes as `int32_t`. A number that does not fit becomes one that the library
/// refuses.
pub(crate) fn int(value: usize) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX)
}

pub(crate) fn product(shape: &[usize]) -> Result<usize> {
    shape
        .iter()
        .try_fold(1_usize, |n, &k| n.checked_mul(k))
        .ok_or_else(|| Error::argument("shape: too large"))
}

pub(crate) fn pointer<T>(values: Option<&[T]>) -> *const T {
    values.map_or(std::ptr::null(), |values| values.as_ptr())
}

pub(crate) fn pointer_mut<T>(values: Option<&mut [T]>) -> *mut T {
    values.map_or(std::ptr::null_mut(), |values| values.as_mut_ptr())
}
