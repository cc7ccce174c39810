//! The first stage: a regular grid, and its deepest vertex.
use crate::domain::Domain;
use crate::env::Env;
use crate::error::{check, Result};
use crate::object::object;
use crate::slices::{exactly, int, product};
use crate::sys;

pub use crate::sys::icc_grid_info as GridInfo;

object!(
    /// A regular grid of vertices, each inside or outside a shape; the first axis is fastest.
    ///
    /// ```
    /// use libicc::stages::Grid;
    /// let mask = [0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 0, 0, 1, 1, 1, 0, 0, 0, 0, 0, 0];
    /// let env = &mut libicc::Env::new();
    /// let grid = Grid::from_mask(&[5, 5], &mask, env)?;
    /// assert_eq!(grid.info().n_inside, 9);
    /// assert_eq!(grid.maximum(env)?, (12, 1));
    /// # Ok::<(), libicc::Error>(())
    /// ```
    Grid,
    icc_grid,
    icc_grid_free
);

impl Grid {
    /// Covers a domain with a grid of `cells` cells along the longest side of its box. 0 means 50, or for masks two
    /// for each cell of the mask.
    ///
    /// # Errors
    /// [`Status::RESOLUTION`](crate::Status::RESOLUTION) when no vertex is inside, or there would be too many.
    pub fn new(domain: &Domain, cells: usize, env: &mut Env<'_>) -> Result<Grid> {
        Grid::make(env, |out, env, err| {
            // SAFETY: a valid object.
            unsafe { sys::icc_grid_create(out, domain.as_ptr(), int(cells), env, err) }
        })
    }

    /// A grid from a mask of its vertices: origin 0, spacing 1.
    pub fn from_mask(shape: &[usize], inside: &[u8], env: &mut Env<'_>) -> Result<Grid> {
        exactly(inside, product(shape)?, "inside")?;
        Grid::make(env, |out, env, err| {
            // SAFETY: there are as many vertices as `shape` says.
            unsafe {
                sys::icc_grid_create_mask(out, int(shape.len()), shape.as_ptr(), inside.as_ptr(), env, err)
            }
        })
    }

    /// A grid of half the spacing with the same inside.
    pub fn refine(&self, env: &mut Env<'_>) -> Result<Grid> {
        Grid::make(env, |out, env, err| {
            // SAFETY: a valid object.
            unsafe { sys::icc_grid_refine(out, self.as_ptr(), env, err) }
        })
    }

    /// Copies the grid and moves vertices with 0 in `keep`, one byte per vertex, to the outside.
    pub fn restrict(&self, keep: &[u8], env: &mut Env<'_>) -> Result<Grid> {
        exactly(keep, self.info().n_vertices, "keep")?;
        Grid::make(env, |out, env, err| {
            // SAFETY: one byte per vertex.
            unsafe { sys::icc_grid_restrict(out, self.as_ptr(), keep.as_ptr(), env, err) }
        })
    }

    /// Shape, origin, spacing and counts.
    pub fn info(&self) -> GridInfo {
        let mut info = GridInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_grid_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// One byte per vertex, 1 inside and 0 outside.
    pub fn inside(&self) -> &[u8] {
        // SAFETY: borrowed from the grid, one byte per vertex.
        unsafe { std::slice::from_raw_parts(sys::icc_grid_inside(self.as_ptr()), self.info().n_vertices) }
    }

    /// The vertex farthest from the outside in the grassfire transform, and the number of rounds before the fire
    /// reached it.
    pub fn maximum(&self, env: &mut Env<'_>) -> Result<(u32, u32)> {
        let (mut vertex, mut rounds) = (0, 0);
        env.call(|env, err| {
            // SAFETY: two numbers to write to.
            unsafe { sys::icc_grid_find_maximum(self.as_ptr(), &mut vertex, &mut rounds, env, err) }
        })?;
        Ok((vertex, rounds))
    }

    /// Positions of vertices, dim coordinates each.
    ///
    /// # Errors
    /// [`Status::ARGUMENT`](crate::Status::ARGUMENT) for a number that is not that of a vertex.
    pub fn points(&self, vertices: &[u32]) -> Result<Vec<f64>> {
        let mut points = vec![0.0; vertices.len() * self.info().dim as usize];
        // SAFETY: as many vertices, and room for their coordinates.
        check(unsafe {
            sys::icc_grid_get_points(self.as_ptr(), vertices.len(), vertices.as_ptr(), points.as_mut_ptr())
        })?;
        Ok(points)
    }

    /// The vertex inside that is nearest to a point of dim coordinates.
    pub fn nearest(&self, point: &[f64]) -> Result<u32> {
        exactly(point, self.info().dim as usize, "point")?;
        let mut vertex = 0;
        // SAFETY: dim coordinates.
        check(unsafe { sys::icc_grid_find_nearest(self.as_ptr(), point.as_ptr(), &mut vertex) })?;
        Ok(vertex)
    }
}
