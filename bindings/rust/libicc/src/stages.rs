//! The stages of Integral Curve Coordinates one by one: [`Grid`], [`Tree`], [`Function`], [`Curves`], and
//! [`triangulate`].
//!
//! Use these to study or teach the method, or if you need one stage only.
//!
//! ```
//! use libicc::stages::{Curves, End, Function, FunctionOptions, Grid, Tree, TreeOptions, Way};
//! use libicc::{Domain, Env, FunctionKind};
//! let env = &mut Env::new();
//! let shape = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 1.0, 1.0, 1.0, 4.0, 0.0, 4.0], env)?;
//! let grid = Grid::new(&shape, 40, env)?;
//! let (root, _) = grid.maximum(env)?;
//! let tree = Tree::new(&grid, root, &TreeOptions::default(), env)?;
//! assert_eq!(tree.report(env)?.n_cousin_violations, 0);
//! let options = FunctionOptions { function: Some(FunctionKind::Laplace), ..Default::default() };
//! let field = Function::new(&tree, &options, env)?;
//! assert_eq!(field.values()[root as usize], 1.0);
//! assert_eq!(field.report(env)?.n_maxima, 1);
//! let curves = Curves::new(&field, &[0.5, 2.0], Way::Up, env)?;
//! assert_eq!(curves.ends()[0].end, End::Maximum);
//! # Ok::<(), libicc::Error>(())
//! ```
pub use crate::curves::{CurveEnd, Curves, CurvesInfo, End, Way};
pub use crate::function::{Edge, Facet, FacetReport, Function, FunctionInfo, FunctionOptions, SolverReport};
pub use crate::grid::{Grid, GridInfo};
pub use crate::tree::{FunctionReport, GrowReport, Order, Stuck, Tree, TreeOptions, TreeReport};
pub use crate::triangulate::triangulate;
