//! Maps that are sampled on a grid.

use crate::env::Env;
use crate::sys::{self, icc_field};
use crate::{Error, Map, Result};

/// What a sample gets whose place has no image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// not a number
    Nan,
    /// the place stays where it is
    Identity,
    /// the place moves as the nearest point of the boundary does
    Nearest,
}

/// A regular grid, and whether its values are displacements or images themselves.
#[derive(Clone, Debug)]
pub struct Grid {
    /// samples along each of two or three axes
    pub shape: Vec<usize>,
    /// place of the first sample
    pub origin: Vec<f64>,
    /// one vector for each axis, one after the other
    pub step: Vec<f64>,
    /// values are added to the place
    pub displacement: bool,
}

impl Grid {
    /// Number of values.
    pub fn n_values(&self) -> usize {
        self.shape.iter().fold(self.shape.len(), |n, side| n.saturating_mul(*side))
    }

    fn raw(&self, n: usize, values: *mut f64) -> Result<icc_field> {
        let dim = self.shape.len();
        let fits = (dim == 2 || dim == 3) && self.origin.len() == dim && self.step.len() == dim * dim;
        if !fits || n != self.n_values() {
            return Err(Error::argument(format!("a grid of {:?} samples needs {} values", self.shape, self.n_values())));
        }
        let mut raw = icc_field { dim: dim as i32, bytes: 8, ..Default::default() };
        raw.displacement = i32::from(self.displacement);
        raw.shape[..dim].copy_from_slice(&self.shape);
        raw.origin[..dim].copy_from_slice(&self.origin);
        raw.step[..dim * dim].copy_from_slice(&self.step);
        raw.values = values.cast();
        Ok(raw)
    }
}

/// What [`certify_field`] found.
pub type FieldReport = sys::icc_field_report;

/// Proves that a sampled field does not fold, or counts and lists up to `most` cells where it does, with `ICC_CELL_*`.
///
/// ```
/// use libicc::{certify_field, Env, Grid};
/// let grid = Grid { shape: vec![2, 2], origin: vec![0.0; 2], step: vec![1.0, 0.0, 0.0, 1.0], displacement: true };
/// let (report, cells) = certify_field(&grid, &[0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0], 9, &mut Env::new())?;
/// assert_eq!((report.n_folded, cells), (1, vec![(0, libicc::sys::ICC_CELL_FOLDED)]));
/// # Ok::<(), libicc::Error>(())
/// ```
pub fn certify_field(
    grid: &Grid,
    values: &[f64],
    most: usize,
    env: &mut Env<'_>,
) -> Result<(FieldReport, Vec<(u32, i32)>)> {
    let raw = grid.raw(values.len(), values.as_ptr() as *mut f64)?;
    let (mut cells, mut kinds) = (vec![0; most], vec![0; most]);
    let mut report = FieldReport::default();
    env.call(|env, err| {
        // SAFETY: the values fit the grid and are only read; there is room for `most` cells.
        unsafe { sys::icc_field_certify(&raw, most, cells.as_mut_ptr(), kinds.as_mut_ptr(), &mut report, env, err) }
    })?;
    let n = report.n_folded + report.n_undecided + report.n_missing;
    Ok((report, cells.into_iter().zip(kinds).take(n).collect()))
}

impl Map {
    /// Samples the map, or its inverse, on a grid. Returns the values and the number of samples without an image.
    pub fn sample(
        &self,
        grid: &Grid,
        outside: Outside,
        inverse: bool,
        env: &mut Env<'_>,
    ) -> Result<(Vec<f64>, usize)> {
        let mut values = vec![0.0; grid.n_values()];
        let mut raw = grid.raw(values.len(), values.as_mut_ptr())?;
        raw.outside = outside as i32 + 1;
        let mut n_outside = 0;
        env.call(|env, err| {
            // SAFETY: the values have the size of the grid.
            unsafe { sys::icc_map_sample(self.as_ptr(), i32::from(inverse), &raw, &mut n_outside, env, err) }
        })?;
        Ok((values, n_outside))
    }
}
