//! The third stage: a function that falls from parent to child.
use crate::chart::{Constraints, FunctionKind, Solver};
use crate::env::Env;
use crate::error::{check, Result};
use crate::object::{object, Borrowed};
use crate::slices::exactly;
use crate::sys;
use crate::tree::{FunctionReport, Tree};
use std::ptr;

pub use crate::sys::icc_facet_report as FacetReport;
pub use crate::sys::icc_function_info as FunctionInfo;
pub use crate::sys::icc_solver_report as SolverReport;

object!(
    /// A function on the vertices of a tree.
    Function,
    icc_function,
    icc_function_free
);

/// Options of [`Function::new`]. `None` and 0 mean the default.
#[derive(Clone, Copy, Debug, Default)]
pub struct FunctionOptions {
    /// `None`: decay
    pub function: Option<FunctionKind>,
    /// `None`: needed
    pub constraints: Option<Constraints>,
    /// `None`: by the predicted work
    pub solver: Option<Solver>,
    /// least relative fall from parent to child; 0: 1e-6
    pub min_fall: f64,
    /// constrained bi-Laplace: least value at the leaves; 0: 1e-9
    pub leaf_min: f64,
}

/// An edge between two triangles whose gradients both point to it or both point away from it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Edge {
    /// its ends, grid vertices
    pub vertices: [u32; 2],
    /// true: curves merge on the way up (compression); false: on the way down (expansion)
    pub compression: bool,
}

/// A facet between two simplices whose gradients both point to it or both point away from it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Facet {
    /// its corners, grid vertices
    pub vertices: Vec<u32>,
    /// true: curves merge on the way up (compression); false: on the way down (expansion)
    pub compression: bool,
}

impl FunctionOptions {
    fn raw(&self) -> sys::icc_function_options {
        sys::icc_function_options {
            function: self.function.map_or(0, |value| value as i32),
            constraints: self.constraints.map_or(0, |value| value as i32),
            solver: self.solver.map_or(0, |value| value as i32),
            min_fall: self.min_fall,
            leaf_min: self.leaf_min,
            ..Default::default()
        }
    }
}

impl Function {
    /// Gives values to the vertices of a tree.
    pub fn new(tree: &Tree, options: &FunctionOptions, env: &mut Env<'_>) -> Result<Function> {
        let raw = options.raw();
        Function::make(env, |out, env, err| {
            // SAFETY: the options are valid during the call.
            unsafe { sys::icc_function_create(out, tree.as_ptr(), &raw, env, err) }
        })
    }

    /// A function with values of your own, one per grid vertex, finite at the vertices inside that the tree reaches.
    /// Where a value outside is NaN, the function goes on as it falls inside.
    pub fn from_values(tree: &Tree, values: &[f64], env: &mut Env<'_>) -> Result<Function> {
        exactly(values, tree.grid().info().n_vertices, "values")?;
        Function::make(env, |out, env, err| {
            // SAFETY: a value for each vertex.
            unsafe { sys::icc_function_create_values(out, tree.as_ptr(), values.as_ptr(), env, err) }
        })
    }

    /// The same from natural logarithms, for values that doubles cannot hold. The function is 0 just outside.
    pub fn from_logs(tree: &Tree, logs: &[f64], env: &mut Env<'_>) -> Result<Function> {
        exactly(logs, tree.grid().info().n_vertices, "logs")?;
        Function::make(env, |out, env, err| {
            // SAFETY: a logarithm for each vertex.
            unsafe { sys::icc_function_create_logs(out, tree.as_ptr(), logs.as_ptr(), env, err) }
        })
    }

    /// Solves an equation with fixed values (NaN: free) and a right-hand side, one number per grid vertex each.
    ///
    /// # Errors
    /// [`Status::UNSUPPORTED`](crate::Status::UNSUPPORTED) unless the function is Laplace or bi-Laplace, without
    /// constraints, by the direct solver.
    pub fn solve(
        tree: &Tree,
        options: &FunctionOptions,
        fixed: Option<&[f64]>,
        right_side: Option<&[f64]>,
        env: &mut Env<'_>,
    ) -> Result<Function> {
        let raw = options.raw();
        let n = tree.grid().info().n_vertices;
        fixed.map_or(Ok(()), |given| exactly(given, n, "fixed"))?;
        right_side.map_or(Ok(()), |given| exactly(given, n, "right_side"))?;
        let address = |given: Option<&[f64]>| given.map_or(ptr::null(), <[f64]>::as_ptr);
        Function::make(env, |out, env, err| {
            // SAFETY: numbers for each vertex, or NULL.
            unsafe {
                sys::icc_function_create_solve(
                    out,
                    tree.as_ptr(),
                    &raw,
                    address(fixed),
                    address(right_side),
                    env,
                    err,
                )
            }
        })
    }

    /// The tree that the function was made on.
    pub fn tree(&self) -> Borrowed<'_, Tree> {
        // SAFETY: the field keeps its tree, of which it always has one.
        unsafe {
            let raw = sys::icc_function_tree(self.as_ptr());
            Borrowed::new(Tree::found(raw).expect("libicc: a field without a tree"))
        }
    }

    /// What the function is.
    pub fn info(&self) -> FunctionInfo {
        let mut info = FunctionInfo::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_function_get_info(self.as_ptr(), &mut info) };
        info
    }

    /// How the function was computed: iterations and seconds.
    pub fn solver_report(&self) -> SolverReport {
        let mut report = SolverReport::default();
        // SAFETY: `size` is set. It cannot fail.
        unsafe { sys::icc_function_get_solver_report(self.as_ptr(), &mut report) };
        report
    }

    fn n_vertices(&self) -> usize {
        self.tree().grid().info().n_vertices
    }

    /// One value per grid vertex; NaN where the tree does not reach.
    pub fn values(&self) -> &[f64] {
        // SAFETY: borrowed from the field, one number per vertex.
        unsafe { std::slice::from_raw_parts(sys::icc_function_values(self.as_ptr()), self.n_vertices()) }
    }

    /// The logarithm of every value, even where the values underflow. `None` for decay and distance, and if a value
    /// inside is not positive.
    pub fn logs(&self) -> Option<&[f64]> {
        // SAFETY: borrowed from the field, one number per vertex unless NULL.
        unsafe {
            let logs = sys::icc_function_logs(self.as_ptr());
            (!logs.is_null()).then(|| std::slice::from_raw_parts(logs, self.n_vertices()))
        }
    }

    /// Counts critical points.
    pub fn report(&self, env: &mut Env<'_>) -> Result<FunctionReport> {
        let mut report = FunctionReport::default();
        env.call(|env, err| {
            // SAFETY: `size` is set.
            unsafe { sys::icc_function_get_report(self.as_ptr(), &mut report, env, err) }
        })?;
        Ok(report)
    }

    /// Compression and expansion edges (2-D).
    ///
    /// # Errors
    /// [`Status::UNSUPPORTED`](crate::Status::UNSUPPORTED) in other dimensions.
    pub fn edges(&self) -> Result<Vec<Edge>> {
        let mut capacity = 256;
        loop {
            let mut edges = vec![[0; 2]; capacity];
            let mut kinds = vec![0; capacity];
            let mut n = 0;
            // SAFETY: there is room for `capacity` edges.
            check(unsafe {
                sys::icc_function_get_edges(
                    self.as_ptr(),
                    capacity,
                    edges.as_mut_ptr().cast(),
                    kinds.as_mut_ptr(),
                    &mut n,
                    ptr::null_mut(),
                )
            })?;
            if n <= capacity {
                let all = edges.into_iter().zip(kinds).take(n);
                return Ok(all
                    .map(|(vertices, kind)| Edge { vertices, compression: kind == sys::ICC_EDGE_COMPRESSION })
                    .collect());
            }
            capacity = n;
        }
    }

    /// Counts compression and expansion facets in any dimension.
    pub fn facet_report(&self, env: &mut Env<'_>) -> Result<FacetReport> {
        self.list_facets(&mut [], &mut [], env)
    }

    /// Compression and expansion facets in any dimension.
    pub fn facets(&self, env: &mut Env<'_>) -> Result<Vec<Facet>> {
        let report = self.facet_report(env)?;
        let dim = self.tree().grid().info().dim as usize;
        let n = report.n_compression + report.n_expansion;
        let (mut facets, mut kinds) = (vec![0; n * dim], vec![0; n]);
        self.list_facets(&mut facets, &mut kinds, env)?;
        let all = facets.chunks(dim).zip(kinds);
        Ok(all
            .map(|(vertices, kind)| Facet {
                vertices: vertices.to_vec(),
                compression: kind == sys::ICC_EDGE_COMPRESSION,
            })
            .collect())
    }

    fn list_facets(&self, facets: &mut [u32], kinds: &mut [i32], env: &mut Env<'_>) -> Result<FacetReport> {
        let mut report = FacetReport::default();
        env.call(|env, err| {
            // SAFETY: `size` is set, and there is room for as many facets as kinds.
            unsafe {
                sys::icc_function_get_facets(
                    self.as_ptr(),
                    kinds.len(),
                    facets.as_mut_ptr(),
                    kinds.as_mut_ptr(),
                    &mut report,
                    env,
                    err,
                )
            }
        })?;
        Ok(report)
    }
}
