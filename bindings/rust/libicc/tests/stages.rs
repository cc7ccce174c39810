//! The stages one by one.
use libicc::stages::{Function, FunctionOptions, Grid, Stuck, Tree, TreeOptions};
use libicc::{Chart, ChartOptions, Domain, Env, FunctionKind, Method, Status, TreeForm};

const ELL: [f64; 12] = [0.0, 0.0, 4.0, 0.0, 4.0, 1.5, 1.5, 1.5, 1.5, 4.0, 0.0, 4.0];

fn grid() -> Grid {
    let env = &mut Env::new();
    Grid::new(&Domain::polygon(&ELL, env).unwrap(), 40, env).unwrap()
}

#[test]
fn grids() {
    let env = &mut Env::new();
    let grid = grid();
    let info = grid.info();
    assert_eq!(info.shape[0] * info.shape[1], info.n_vertices);
    assert_eq!(grid.inside().len(), info.n_vertices);
    assert_eq!(grid.inside().iter().filter(|&&inside| inside == 1).count(), info.n_inside);
    let (vertex, rounds) = grid.maximum(env).unwrap();
    assert!(grid.inside()[vertex as usize] == 1 && rounds > 0);
    let fine = grid.refine(env).unwrap();
    assert_eq!(fine.info().spacing, info.spacing / 2.0);
    let mut keep = vec![1; info.n_vertices];
    keep[vertex as usize] = 0;
    assert_eq!(grid.restrict(&keep, env).unwrap().info().n_inside, info.n_inside - 1);
    assert_eq!(grid.restrict(&keep[1..], env).unwrap_err().status, Status::ARGUMENT);
    let at = |axis: usize, i: usize| info.origin[axis] + info.spacing * i as f64;
    let (i, j) = (vertex as usize % info.shape[0], vertex as usize / info.shape[0]);
    assert_eq!(grid.nearest(&[at(0, i), at(1, j)]).unwrap(), vertex);
}

#[test]
fn trees_lead_to_the_root() {
    let env = &mut Env::new();
    let grid = grid();
    let (root, _) = grid.maximum(env).unwrap();
    let options = TreeOptions { form: Some(TreeForm::Paper), axis_order: Some(&[1, 0]) };
    let tree = Tree::new(&grid, root, &options, env).unwrap();
    drop(grid);
    assert_eq!(tree.root(), root);
    assert_eq!(tree.grid().info().dim, 2);
    for (vertex, &parent) in tree.parents().iter().enumerate() {
        if parent != u32::MAX {
            assert_eq!(tree.generations()[vertex], tree.generations()[parent as usize] + 1);
        }
    }
    let report = tree.report(env).unwrap();
    assert_eq!((report.n_cousin_violations, report.n_unreachable), (0, 0));
    let wrong = TreeOptions { axis_order: Some(&[0]), ..options };
    assert_eq!(Tree::new(&tree.grid(), root, &wrong, env).unwrap_err().status, Status::ARGUMENT);

    let order = tree.grow(None, env).unwrap();
    assert_eq!(order.rank[root as usize], 0);
    let report = tree.rank_report(&order.rank, env).unwrap();
    assert_eq!((report.n_maxima, report.n_minima, report.n_saddles), (1, 0, 0));
}

/// A ring is no disc: growth gets stuck, and the order comes with the error.
#[test]
fn growth_gets_stuck_on_rings() {
    let env = &mut Env::new();
    let inside: Vec<u8> = (0..81)
        .map(|k| (k % 9, k / 9))
        .map(|(i, j): (i32, i32)| u8::from((2..=3).contains(&(i - 4).abs().max((j - 4).abs()))))
        .collect();
    let grid = Grid::from_mask(&[9, 9], &inside, env).unwrap();
    let (root, _) = grid.maximum(env).unwrap();
    let tree = Tree::new(&grid, root, &TreeOptions::default(), env).unwrap();
    let Stuck { error, order } = tree.grow(None, env).unwrap_err();
    assert_eq!(error.status, Status::TOPOLOGY);
    assert!(error.index.is_some());
    assert_eq!(order.unwrap().rank[root as usize], 0);
    let Stuck { error, order } = tree.grow(Some(&[0.0; 3]), env).unwrap_err();
    assert_eq!((error.status, order.is_none()), (Status::ARGUMENT, true));
}

#[test]
fn fields_fall_from_the_root() {
    let env = &mut Env::new();
    let grid = grid();
    let (root, _) = grid.maximum(env).unwrap();
    let tree = Tree::new(&grid, root, &TreeOptions::default(), env).unwrap();
    for function in
        [FunctionKind::Decay, FunctionKind::Distance, FunctionKind::Laplace, FunctionKind::Bilaplace]
    {
        let options = FunctionOptions { function: Some(function), ..Default::default() };
        let field = Function::new(&tree, &options, env).unwrap();
        assert_eq!(field.info().function, function as i32);
        let values = field.values();
        let greatest = values.iter().copied().filter(|value| !value.is_nan()).fold(f64::MIN, f64::max);
        assert_eq!(greatest, values[root as usize]);
        assert_eq!(field.report(env).unwrap().n_maxima, 1);
        assert_eq!(field.tree().root(), root);
        if let Some(logs) = field.logs() {
            assert_eq!(logs[root as usize], 0.0);
        }
        assert!(field.edges().unwrap().iter().all(|edge| edge.vertices[0] != edge.vertices[1]));
    }
}

#[test]
fn charts_follow_functions() {
    let env = &mut Env::new();
    let grid = grid();
    let (root, _) = grid.maximum(env).unwrap();
    let options = TreeOptions { axis_order: Some(&[1, 0]), ..Default::default() };
    let tree = Tree::new(&grid, root, &options, env).unwrap();
    let function = Function::new(&tree, &FunctionOptions::default(), env).unwrap();
    let chart = Chart::from_function(&function, env).unwrap();
    drop(function);
    let options = ChartOptions {
        method: Some(Method::Gradient),
        cells: 40,
        axis_order: Some(&[1, 0]),
        ..Default::default()
    };
    let shape = Domain::polygon(&ELL, env).unwrap();
    let same = Chart::new(&shape, &options, env).unwrap();
    let points = [1.0, 1.0, 3.0, 0.5, 0.5, 3.0];
    assert_eq!(chart.encode(&points, env).unwrap(), same.encode(&points, env).unwrap());
    let bytes = chart.to_bytes().unwrap();
    assert_eq!(Chart::from_bytes(&bytes, env).unwrap().to_bytes().unwrap(), bytes);
    let wrong = ChartOptions { axis_order: Some(&[0]), ..options };
    assert_eq!(Chart::new(&shape, &wrong, env).unwrap_err().status, Status::ARGUMENT);
    let fine = grid.refine(env).unwrap();
    let (root, _) = fine.maximum(env).unwrap();
    let tree = Tree::new(&fine, root, &TreeOptions::default(), env).unwrap();
    let function = Function::new(&tree, &FunctionOptions::default(), env).unwrap();
    assert_eq!(Chart::from_function(&function, env).unwrap_err().status, Status::UNSUPPORTED);
}

#[test]
fn charts_show_their_field() {
    let env = &mut Env::new();
    let shape = Domain::polygon(&ELL, env).unwrap();
    let options = ChartOptions { method: Some(Method::Gradient), ..Default::default() };
    let chart = Chart::new(&shape, &options, env).unwrap();
    let field = chart.function().unwrap();
    let info = chart.gradient_info().unwrap();
    assert_eq!(field.values().len(), info.n_grid);
    let tree = field.tree();
    let mut fixed = vec![f64::NAN; info.n_grid];
    fixed[tree.root() as usize] = 2.0;
    let laplace = FunctionOptions { function: Some(FunctionKind::Laplace), ..Default::default() };
    let solved = Function::solve(&tree, &laplace, Some(&fixed), None, env).unwrap();
    assert_eq!(solved.values()[tree.root() as usize], 2.0);
    assert!(Function::solve(&tree, &FunctionOptions::default(), Some(&fixed[1..]), None, env).is_err());
    let edges = field.edges().unwrap();
    let merging = edges.iter().filter(|edge| edge.compression).count();
    assert_eq!((merging, edges.len() - merging), (info.n_compression, info.n_expansion));
    let facets = field.facets(env).unwrap();
    assert_eq!(facets.len(), edges.len());
    assert!(facets.iter().zip(&edges).all(|(facet, edge)| facet.vertices == edge.vertices));
    assert_eq!(field.facet_report(env).unwrap().n_tested, info.n_edges);
    assert!(chart.report(1000, env).unwrap().collapsed > 0.0);
    let others = (chart.field_info(), chart.foliation_info(), chart.shelling_info(), chart.disc_info());
    assert!(matches!(others, (None, None, None, None)));
    assert!(Chart::new(&shape, &ChartOptions::default(), env).unwrap().function().is_none());
}
