//! Maps from control points, pins, walls and warps.
use libicc::{Constraint, Domain, Env, Fit, FitModel, FitOptions, Map, Status};

const POINTS: [f64; 10] = [0.0, 0.0, 4.0, 0.0, 4.0, 3.0, 0.0, 3.0, 2.0, 1.0];
const TARGETS: [f64; 10] = [1.0, 1.0, 5.0, 2.0, 6.0, 5.0, 1.0, 4.0, 3.0, 2.0];
// A square of 2 x 2 smaller ones, whose middle is vertex 4.
const VERTICES: [f64; 18] =
    [0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 1.0, 0.0, 2.0, 1.0, 2.0, 2.0, 2.0];
const TRIANGLES: [u32; 24] = [0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 7, 3, 7, 6, 4, 5, 8, 4, 8, 7];

fn near(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
}

#[test]
fn control_points() -> libicc::Result<()> {
    let env = &mut Env::new();
    let fit = Fit::new(&POINTS, &TARGETS, &FitOptions::default(), env)?;
    assert!(near(&fit.map().apply(&POINTS, env)?.points, &TARGETS));
    assert!(near(&fit.residuals()?, &[0.0; 10]) && fit.left_out()?.iter().all(|x| x.is_finite()));
    assert_eq!((fit.info().model, fit.info().n_items), (FitModel::Spline as i32, 5));
    let mut moved = TARGETS;
    moved[8] = 3.5;
    assert!(near(&fit.moved(&moved, env)?.map().apply(&POINTS, env)?.points, &moved));
    assert_eq!(fit.moved(&[1.0, 2.0], env).unwrap_err().status, Status::ARGUMENT);
    assert_eq!(
        Fit::new(&POINTS, &[1.0, 2.0], &FitOptions::default(), env).unwrap_err().status,
        Status::ARGUMENT
    );
    let wide = FitOptions { bounds: Some([-9.0, -9.0, 9.0, 9.0]), margin: 0.1, ..Default::default() };
    let known = [Constraint::Points { source: &POINTS, target: &TARGETS, tolerance: Some(&[0.1; 5]) }];
    let loose = Fit::with_constraints(&known, &wide, env)?;
    assert_eq!(loose.map().apply(&[-9.0, -9.0, 9.0, 9.0], env)?.n_failed, 0);
    Ok(())
}

#[test]
fn pins_and_lines_in_a_domain() -> libicc::Result<()> {
    let env = &mut Env::new();
    let square = [0.0, 0.0, 8.0, 0.0, 8.0, 8.0, 0.0, 8.0];
    let domain = Domain::polygon(&square, env)?;
    let (before, after) = ([2.0, 4.0, 6.0, 4.0], [2.5, 3.5, 5.5, 4.5]);
    let known = [
        Constraint::Vertices { vertices: &[0, 1, 2, 3], target: &square },
        Constraint::Line { source: &before, target: &after },
    ];
    let fit = Fit::in_domain(&domain, &known, &FitOptions { reach: 0.5, ..Default::default() }, env)?;
    assert!(near(&fit.map().apply(&before, env)?.points, &after));
    assert_eq!((fit.info().model, fit.info().n_off), (FitModel::Elastic as i32, 0));
    let outside = [Constraint::Points { source: &[9.0, 9.0], target: &[9.0, 9.0], tolerance: None }];
    let refused = Fit::in_domain(&domain, &outside, &FitOptions::default(), env);
    assert_eq!(refused.unwrap_err().status, Status::OUTSIDE);
    Ok(())
}

#[test]
fn a_wall_that_moves() -> libicc::Result<()> {
    let env = &mut Env::new();
    let known = [
        Constraint::Vertices {
            vertices: &[0, 1, 2, 6, 7, 8],
            target: &[0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 3.0, 1.0, 3.0, 2.0, 3.0],
        },
        Constraint::Sliding { vertices: &[3, 5], direction: Some(&[0.0, 1.0, 0.0, 1.0]) },
    ];
    let options = FitOptions { stiffness: 1.5, cell_stiffness: Some(&[1.0; 8]), ..Default::default() };
    let fit = Fit::on_mesh(&VERTICES, &TRIANGLES, &known, &options, env)?;
    let mesh = fit.map().mesh()?;
    assert_eq!((mesh.vertices.as_slice(), mesh.simplices.len()), (&VERTICES[..], TRIANGLES.len()));
    assert!(near(&[mesh.images[6], mesh.images[10], mesh.images[15]], &[0.0, 2.0, 3.0]));
    let few = FitOptions { cell_stiffness: Some(&[1.0; 7]), ..Default::default() };
    assert!(Fit::on_mesh(&VERTICES, &TRIANGLES, &known, &few, env).is_err());
    Ok(())
}

#[test]
fn the_nearest_map_of_a_warp() -> libicc::Result<()> {
    let env = &mut Env::new();
    let (same, report) = Map::nearest(&VERTICES, &TRIANGLES, &VERTICES, &[], env)?;
    assert_eq!((same.mesh()?.images.as_slice(), report.n_folded), (&VERTICES[..], 0));
    let mut folded = VERTICES;
    folded[8] = 2.5;
    let (map, report) = Map::nearest(&VERTICES, &TRIANGLES, &folded, &[], env)?;
    assert!(map.info().certified == 1 && report.n_folded > 0 && report.most_moved > 0.0);
    assert_eq!(Map::nearest(&VERTICES, &TRIANGLES, &[1.0], &[], env).unwrap_err().status, Status::ARGUMENT);
    Ok(())
}
