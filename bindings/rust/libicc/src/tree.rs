//! The second stage: a breadth-first tree, and orders of its vertices.
use crate::chart::TreeForm;
use crate::env::Env;
use crate::error::{Error, Result, Status};
use crate::grid::Grid;
use crate::object::{object, Borrowed};
use crate::slices::{exactly, int, pointer};
use crate::sys;
use std::fmt;

pub use crate::sys::icc_function_report as FunctionReport;
pub use crate::sys::icc_grow_report as GrowReport;
pub use crate::sys::icc_tree_report as TreeReport;

object!(
    /// A breadth-first tree over a grid; a cousin tree where the shape allows it.
    Tree,
    icc_tree,
    icc_tree_free
);

/// Options of [`Tree::new`].
#[derive(Clone, Copy, Debug, Default)]
pub struct TreeOptions<'a> {
    /// `None`: the thesis'
    pub form: Option<TreeForm>,
    /// the order in which a generation expands along the axes, a permutation of 0..dim; `None`: 0, 1 and so on
    pub axis_order: Option<&'a [usize]>,
}

/// An order of the vertices inside: see [`Tree::grow`].
#[derive(Clone, Debug)]
pub struct Order {
    /// one number per grid vertex: 0 for the root, then 1, 2 and so on; `u32::MAX` for vertices without a place
    pub rank: Vec<u32>,
    /// what was done
    pub report: GrowReport,
}

/// Why there is no order, and the part that was found. `?` turns it into an [`Error`](crate::Error).
#[derive(Clone, Debug)]
pub struct Stuck {
    /// what went wrong
    pub error: Error,
    /// with [`Status::TOPOLOGY`]: the vertices that growth has placed have their ranks
    pub order: Option<Box<Order>>,
}

impl From<Stuck> for Error {
    fn from(stuck: Stuck) -> Error {
        stuck.error
    }
}

impl fmt::Display for Stuck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl std::error::Error for Stuck {}

impl Tree {
    /// Grows the tree from a vertex inside, such as [`Grid::maximum`].
    pub fn new(grid: &Grid, root: u32, options: &TreeOptions<'_>, env: &mut Env<'_>) -> Result<Tree> {
        Tree::create(grid, root, None, options, env)
    }

    /// A tree with parents of your own, one number per grid vertex: a neighbour inside, or `u32::MAX` for the root and
    /// for vertices to leave out. Numbers of vertices outside are ignored.
    ///
    /// # Errors
    /// [`Status::ARGUMENT`], whose `index` is a vertex whose parents do not lead to the root.
    pub fn from_parents(
        grid: &Grid,
        root: u32,
        parents: &[u32],
        options: &TreeOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Tree> {
        exactly(parents, grid.info().n_vertices, "parents")?;
        Tree::create(grid, root, Some(parents), options, env)
    }

    fn create(
        grid: &Grid,
        root: u32,
        parents: Option<&[u32]>,
        options: &TreeOptions<'_>,
        env: &mut Env<'_>,
    ) -> Result<Tree> {
        let axis_order: Option<Vec<i32>> =
            options.axis_order.map(|order| order.iter().map(|&axis| int(axis)).collect());
        if let Some(order) = &axis_order {
            exactly(order, grid.info().dim as usize, "axis_order")?;
        }
        let raw = sys::icc_tree_options {
            form: options.form.map_or(0, |form| form as i32),
            axis_order: pointer(axis_order.as_deref()),
            ..Default::default()
        };
        Tree::make(env, |out, env, err| {
            // SAFETY: the options are valid during the call, and there is a parent for each vertex.
            unsafe {
                match parents {
                    None => sys::icc_tree_create(out, grid.as_ptr(), root, &raw, env, err),
                    Some(p) => {
                        sys::icc_tree_create_parents(out, grid.as_ptr(), root, p.as_ptr(), &raw, env, err)
                    }
                }
            }
        })
    }

    /// The grid that the tree was grown on.
    pub fn grid(&self) -> Borrowed<'_, Grid> {
        // SAFETY: the tree keeps its grid, of which it always has one.
        unsafe {
            let raw = sys::icc_tree_grid(self.as_ptr());
            Borrowed::new(Grid::found(raw).expect("libicc: a tree without a grid"))
        }
    }

    /// The vertex that the tree was grown from.
    pub fn root(&self) -> u32 {
        // SAFETY: a valid object.
        unsafe { sys::icc_tree_root(self.as_ptr()) }
    }

    fn n_vertices(&self) -> usize {
        self.grid().info().n_vertices
    }

    /// The parent of each grid vertex: `u32::MAX` for the root and for vertices without one.
    pub fn parents(&self) -> &[u32] {
        // SAFETY: borrowed from the tree, one number per vertex.
        unsafe { std::slice::from_raw_parts(sys::icc_tree_parents(self.as_ptr()), self.n_vertices()) }
    }

    /// The generation of each grid vertex: 0 for the root, -1 for vertices that are not reached.
    pub fn generations(&self) -> &[i32] {
        // SAFETY: borrowed from the tree, one number per vertex.
        unsafe { std::slice::from_raw_parts(sys::icc_tree_generations(self.as_ptr()), self.n_vertices()) }
    }

    /// Checks the cousin rule on every pair of neighbours inside.
    pub fn report(&self, env: &mut Env<'_>) -> Result<TreeReport> {
        let mut report = TreeReport::default();
        env.call(|env, err| {
            // SAFETY: `size` is set.
            unsafe { sys::icc_tree_get_report(self.as_ptr(), &mut report, env, err) }
        })?;
        Ok(report)
    }

    /// Orders the vertices inside so that the root is the only critical one. `values` gives the preferred order, one
    /// value per grid vertex, the largest first. `None` means the order of the tree.
    ///
    /// # Errors
    /// [`Status::TOPOLOGY`] comes with the part of the order that was found. Its `index` is the vertex where growth got
    /// stuck.
    pub fn grow(&self, values: Option<&[f64]>, env: &mut Env<'_>) -> std::result::Result<Order, Stuck> {
        let n = self.n_vertices();
        if let Some(values) = values {
            exactly(values, n, "values").map_err(|error| Stuck { error, order: None })?;
        }
        let mut order = Order { rank: vec![0; n], report: GrowReport::default() };
        let called = env.call(|env, err| {
            let (rank, report) = (order.rank.as_mut_ptr(), &mut order.report);
            // SAFETY: one value and one rank per vertex.
            unsafe { sys::icc_tree_grow(self.as_ptr(), pointer(values), rank, report, env, err) }
        });
        match called {
            Ok(()) => Ok(order),
            Err(error) => {
                let order = (error.status == Status::TOPOLOGY).then(|| Box::new(order));
                Err(Stuck { error, order })
            }
        }
    }

    /// Counts the critical vertices of any order: one number per grid vertex, smaller for higher ones.
    pub fn rank_report(&self, rank: &[u32], env: &mut Env<'_>) -> Result<FunctionReport> {
        exactly(rank, self.n_vertices(), "rank")?;
        let mut report = FunctionReport::default();
        env.call(|env, err| {
            // SAFETY: one rank per vertex; `size` is set.
            unsafe { sys::icc_tree_get_rank_report(self.as_ptr(), rank.as_ptr(), &mut report, env, err) }
        })?;
        Ok(report)
    }
}
