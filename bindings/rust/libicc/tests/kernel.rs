//! Kernel coordinates from Rust.
use libicc::kernel::{
    Binding, InitialWeights, Line, Pose, Sampling, SamplingKind, SamplingOptions, Shape, Weights,
    WeightsMethod, WeightsOptions,
};
use libicc::{Domain, Env, Status};

const SQUARE: [f64; 8] = [0.0, 0.0, 10.0, 0.0, 10.0, 10.0, 0.0, 10.0];
const HANDLES: [f64; 8] = [1.0, 1.0, 9.0, 1.0, 9.0, 9.0, 1.0, 9.0];
const POINTS: [f64; 6] = [5.0, 5.0, 3.0, 4.0, 1.0, 1.0];

fn shape() -> Shape {
    let env = &mut Env::new();
    Shape::of_regions(2, &[&Domain::polygon(&SQUARE, env).unwrap()], env).unwrap()
}

fn sampling() -> Sampling {
    let options = SamplingOptions { spacing: 0.7, seed: 3, ..Default::default() };
    Sampling::new(&shape(), &options, &mut Env::new()).unwrap()
}

fn kernel(options: &WeightsOptions<'_>) -> Weights {
    Weights::new(&sampling(), &HANDLES, options, &mut Env::new()).unwrap()
}

#[test]
fn samplings() {
    let env = &mut Env::new();
    let sampling = sampling();
    let points = sampling.points().unwrap();
    assert_eq!(points.len(), 2 * sampling.info().n_samples);
    let again = Sampling::from_bytes(&sampling.to_bytes().unwrap(), env).unwrap();
    assert_eq!(again.points().unwrap(), points);
    let mut damaged = sampling.to_bytes().unwrap();
    damaged[40] ^= 1;
    assert_eq!(Sampling::from_bytes(&damaged, env).unwrap_err().status, Status::FORMAT);
    assert_eq!(Sampling::from_bytes(&[], env).unwrap_err().status, Status::FORMAT);

    let from = Sampling::from_points(&shape(), &[5.0, 5.0, 2.0, 2.0, 7.0, 2.0], env).unwrap();
    assert_eq!(from.info().n_samples, 3);
    let error = Sampling::from_points(&shape(), &[5.0, 5.0, 20.0, 2.0], env).unwrap_err();
    assert_eq!((error.status, error.index), (Status::OUTSIDE, Some(1)));

    let fixed = [5.0, 5.0];
    let options = SamplingOptions { fixed: Some(&fixed), spacing: 1.0, ..Default::default() };
    let points = Sampling::new(&shape(), &options, env).unwrap().points().unwrap();
    assert!(points.chunks(2).any(|point| point == fixed));
    let grid = SamplingOptions { kind: Some(SamplingKind::Grid), spacing: 1.0, ..Default::default() };
    assert!(Sampling::new(&shape(), &grid, env).unwrap().info().n_samples > 80);
    let uneven = SamplingOptions { fixed: Some(&fixed[..1]), ..Default::default() };
    assert_eq!(Sampling::new(&shape(), &uneven, env).unwrap_err().status, Status::ARGUMENT);
}

#[test]
fn weights_reproduce_points() {
    let env = &mut Env::new();
    for method in [WeightsMethod::Qp, WeightsMethod::Equality, WeightsMethod::L1] {
        let kernel = kernel(&WeightsOptions { method: Some(method), ..Default::default() });
        let found = kernel.weights(&POINTS, true, env).unwrap();
        assert_eq!(found.gradients.unwrap().len(), 3 * 4 * 2);
        for (point, weights) in POINTS.chunks(2).zip(found.weights.chunks(4)) {
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-9);
            for axis in 0..2 {
                let sum: f64 = weights.iter().zip(HANDLES.chunks(2)).map(|(w, h)| w * h[axis]).sum();
                assert!((sum - point[axis]).abs() < 1e-9);
            }
        }
        assert!(kernel.report(&POINTS, env).unwrap().reproduction < 1e-9);
    }
}

#[test]
fn kernels_are_changed_into_others() {
    let env = &mut Env::new();
    let first = kernel(&WeightsOptions::default());
    let nodes = first.nodes().unwrap();
    assert_eq!(nodes.weights.len(), 4 * first.info().n_nodes);
    let painted = first.paint(0, &[5.0, 5.0], 3.0, 0.3, env).unwrap();
    let weight = |kernel: &Weights| kernel.weights(&[5.0, 5.0], false, &mut Env::new()).unwrap().weights[0];
    assert!(weight(&painted) > weight(&first) + 0.01);
    assert_eq!(first.nodes().unwrap(), nodes);
    let inner: Vec<u32> = (0..first.info().n_nodes)
        .filter(|&k| k >= 4 && nodes.points[2 * k..2 * k + 2].iter().all(|x| (x - 5.0).abs() < 1.5))
        .map(|k| k as u32)
        .collect();
    let dual = first.dual(4, &nodes.points, env).unwrap();
    assert!((dual[4] - 1.0).abs() < 1e-9 && dual[5].abs() < 1e-9);
    let (_, energy) = first.stiffen(&inner, None, env).unwrap();
    assert!(energy[1] < energy[0]);
    let wish: Vec<f64> = inner.iter().flat_map(|_| [1.0, 0.0, 0.0, 0.0]).collect();
    first.repaint(&inner, &wish, env).unwrap();
    assert_eq!(first.repaint(&inner, &wish[1..], env).unwrap_err().status, Status::ARGUMENT);
    assert_eq!(first.stiffen(&inner, Some(&[1.0]), env).unwrap_err().status, Status::ARGUMENT);
    let other = first.with_method(WeightsMethod::Equality, env).unwrap();
    assert_eq!(other.info().method, WeightsMethod::Equality as i32);
}

#[test]
fn options_are_taken() {
    let lines = [Line { from: [3.0, 5.0, 0.0], to: [7.0, 5.0, 0.0], parallel: None }];
    let edges = [[0, 1], [1, 2]];
    let with = kernel(&WeightsOptions { lines: &lines, edges: &edges, ..Default::default() });
    assert_eq!(with.info().initial, libicc::sys::ICC_INITIAL_EDGES);
    let n = sampling().info().n_samples;
    let given = vec![0.25; 4 * n];
    let options = WeightsOptions { initial: Some(InitialWeights::Given(&given)), ..Default::default() };
    kernel(&options);
    let short = WeightsOptions { initial: Some(InitialWeights::Given(&given[1..])), ..Default::default() };
    let error = Weights::new(&sampling(), &HANDLES, &short, &mut Env::new()).unwrap_err();
    assert_eq!(error.status, Status::ARGUMENT);
    let mut outside = HANDLES;
    outside[4] = 30.0;
    let options = WeightsOptions::default();
    let error = Weights::new(&sampling(), &outside, &options, &mut Env::new()).unwrap_err();
    assert_eq!((error.status, error.index), (Status::OUTSIDE, Some(2)));
}

#[test]
fn poses() {
    let env = &mut Env::new();
    let kernel = kernel(&WeightsOptions::default());
    let binding = Binding::new(&kernel, &POINTS, true, env).unwrap();
    drop(kernel);
    let mut pose = Pose::rest(&binding).unwrap();
    assert_eq!(binding.pose(&pose, env).unwrap(), POINTS);
    pose.shift(0, &[0.5, -0.25]).unwrap();
    pose.turn(0, None, std::f64::consts::FRAC_PI_2).unwrap();
    let (images, jacobians) = binding.pose_with_jacobians(&pose, env).unwrap();
    assert!((images[4] - 1.5).abs() < 1e-9 && (images[5] - 0.75).abs() < 1e-9);
    assert_eq!(jacobians.len(), 3 * 4);
    assert_eq!(pose.shift(4, &[0.0, 0.0]).unwrap_err().status, Status::ARGUMENT);
    assert_eq!(pose.shift(0, &[0.0]).unwrap_err().status, Status::ARGUMENT);
    pose.set(0, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0]).unwrap();
    assert_eq!(binding.pose(&pose, env).unwrap(), POINTS);

    let again = Binding::from_bytes(&binding.to_bytes().unwrap(), env).unwrap();
    assert_eq!(again.weights().unwrap(), binding.weights().unwrap());
    assert_eq!(again.counts(), binding.counts());
    let mut images = [0.0; 5];
    assert!(binding.pose_into(pose.transforms(), &mut images, None, env).is_err());
}
