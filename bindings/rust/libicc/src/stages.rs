//! The stages of Integral Curve Coordinates one by one: [`Grid`], [`Tree`], [`Field`], and [`triangulate`].
//!
//! For those who study or teach the method, or need one stage only.
//!
//! ```
//! use libicc::stages::{Field, FieldOptions, Grid, Tree, TreeOptions};
//! use libicc::{Domain, Env, Function};
//! let env = &mut Env::new();
//! let shape = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 1.0, 1.0, 1.0, 4.0, 0.0, 4.0], env)?;
//! let grid = Grid::new(&shape, 40, env)?;
//! let (root, _) = grid.maximum(env)?;
//! let tree = Tree::new(&grid, root, &TreeOptions::default(), env)?;
//! assert_eq!(tree.verify(env)?.n_cousin_violations, 0);
//! let options = FieldOptions { function: Some(Function::Laplace), ..Default::default() };
//! let field = Field::new(&tree, &options, env)?;
//! assert_eq!(field.values()[root as usize], 1.0);
//! assert_eq!(field.verify(env)?.n_maxima, 1);
//! # Ok::<(), libicc::Error>(())
//! ```
pub use crate::field::{Edge, Field, FieldInfo, FieldOptions};
pub use crate::grid::{Grid, GridInfo};
pub use crate::tree::{FieldReport, GrowReport, Order, Stuck, Tree, TreeOptions, TreeReport};
pub use crate::triangulate::triangulate;
