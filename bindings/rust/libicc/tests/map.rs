//! Maps and charts from Rust: what comes back, what fails and how, threads and callbacks.
use libicc::{
    flat, Certificate, Chart, ChartOptions, Domain, Env, Feature, Images, ImproveOptions, Interpolation,
    Item, Layout, Map, MapKind, MapOptions, Method, OwnedTie, Picture, PictureMut, Side, Status, Tie,
};
use std::cell::Cell;
use std::ops::ControlFlow;
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::Mutex;

const BEFORE: [[f64; 2]; 6] = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.5], [1.5, 1.5], [1.5, 4.0], [0.0, 4.0]];
const AFTER: [[f64; 2]; 6] = [[0.0, 0.0], [4.0, -1.0], [5.0, 0.5], [1.5, 1.5], [2.5, 4.5], [0.5, 4.5]];

fn domain(vertices: &[[f64; 2]]) -> Domain {
    Domain::polygon(flat(vertices), &mut Env::new()).unwrap()
}

fn map(options: &MapOptions<'_>) -> Map {
    Map::new(&domain(&BEFORE), &domain(&AFTER), options, &mut Env::new()).unwrap()
}

/// A lattice of points in the lower arm of the shape.
fn lattice(n: usize) -> Vec<f64> {
    (0..n * n)
        .flat_map(|k| {
            let step = |i: usize, length: f64| length * (i as f64 + 0.5) / n as f64;
            [step(k % n, 4.0), step(k / n, 1.5)]
        })
        .collect()
}

fn farthest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn domains_have_features() {
    let square = [0.0, 0.0, 9.0, 0.0, 9.0, 9.0, 0.0, 9.0];
    let hole = Feature::Hole(&[1.0, 1.0, 1.0, 3.0, 3.0, 3.0]);
    let bone = Feature::Line(&[5.0, 5.0, 7.0, 5.0]);
    let env = &mut Env::new();
    let domain = Domain::with_features(&square, &[hole, bone, Feature::Point(&[2.0, 8.0])], env).unwrap();
    assert_eq!((domain.info().n_features, domain.info().measure), (3, 79.0));
    let (vertices, facets) = domain.boundary().unwrap();
    assert_eq!(
        (vertices.len(), &vertices[18..], &facets[8..]),
        (20, &[2.0, 8.0][..], &[4, 5, 5, 6, 6, 4][..])
    );
    let told: Vec<_> = domain.features().iter().map(|f| (f.kind, f.first_vertex, f.n_vertices)).collect();
    assert_eq!(told, [(1, 4, 3), (2, 7, 2), (3, 9, 1)]);
    assert_eq!(domain.features()[0].orientation, -1);

    let sized = Domain::with_features(&square, &[Feature::Handle(&[2.0, 7.0], 1.0), bone], env).unwrap();
    let told: Vec<_> = sized.features().iter().map(|f| (f.kind, f.first_vertex, f.n_vertices)).collect();
    assert_eq!(told, [(3, 4, 1), (2, 5, 2), (2, 7, 16)]);
    assert_eq!(&sized.boundary().unwrap().0[14..16], &[3.0, 7.0]);
    let error = Domain::with_features(&square, &[Feature::Handle(&[2.0, 7.0], -1.0)], env).unwrap_err();
    assert_eq!(error.status, Status::ARGUMENT);

    let error = Domain::with_features(&square, &[bone, Feature::Point(&[9.0, 5.0])], env).unwrap_err();
    assert_eq!((error.status, error.index, error.item), (Status::OUTSIDE, Some(1), Some(Item::Feature)));
    let error = Domain::with_features(&square, &[bone, Feature::Point(&[6.0, 5.0])], env).unwrap_err();
    assert_eq!(error.status, Status::BOUNDARY);
    let error = Domain::with_features(&square, &[Feature::Line(&[1.0; 3])], env).unwrap_err();
    assert_eq!(error.status, Status::ARGUMENT);
    let error = Chart::new(&domain, &ChartOptions::default(), env).unwrap_err();
    assert_eq!(error.status, Status::UNSUPPORTED);

    let map = Map::new(&domain, &domain, &MapOptions::default(), env).unwrap();
    let own = map.ties();
    let ties: Vec<Tie<'_>> = own.iter().map(OwnedTie::borrow).collect();
    let again = Map::new(&domain, &domain, &MapOptions { ties: &ties, ..Default::default() }, env).unwrap();
    assert_eq!((again.info().class_kept, again.info().n_ties), (1, 3));
    assert_eq!(again.ties(), own);
    assert_eq!(Map::from_bytes(&map.to_bytes().unwrap(), env).unwrap().ties(), own);
}

#[test]
fn maps_come_back() {
    for method in [Method::Foliation, Method::Disc] {
        for kind in [MapKind::Curves, MapKind::Mesh] {
            let chart = ChartOptions { method: Some(method), ..Default::default() };
            let map = map(&MapOptions { kind: Some(kind), chart, ..Default::default() });
            assert_eq!(map.info().certified, 1);
            let points = lattice(20);
            let images = map.apply(&points, &mut Env::new()).unwrap();
            assert_eq!(images.n_failed, 0);
            assert!(farthest(&points, &images.points) > 0.1);
            let back = map.apply_inverse(&images.points, &mut Env::new()).unwrap();
            assert_eq!(back.n_failed, 0);
            assert!(farthest(&points, &back.points) < 1e-9, "{:?} {:?}", method, kind);

            let mut in_place = points.clone();
            assert_eq!(map.apply_in_place(&mut in_place, &mut Env::new()).unwrap(), 0);
            assert_eq!(bits(&in_place), bits(&images.points));
        }
    }
}

#[test]
fn charts_come_back() {
    let chart = Chart::new(&domain(&BEFORE), &ChartOptions::default(), &mut Env::new()).unwrap();
    let points = lattice(20);
    let codes = chart.encode(&points, &mut Env::new()).unwrap();
    assert_eq!(codes.n_failed, 0);
    let start = &codes.start;
    let back = chart.decode(&start.facet, &start.bary, &codes.t, &mut Env::new()).unwrap();
    assert!(farthest(&points, &back.points) < 1e-9);

    let curve = chart.trace(&points[..2], &mut Env::new()).unwrap();
    assert!(curve.len() >= 4 && curve.len() % 2 == 0);
    assert!(farthest(&curve[curve.len() - 2..], &chart.info().maximum[..2]) < 1e-9);
    let (vertices, facets) = chart.domain().boundary().unwrap();
    assert_eq!((vertices.as_slice(), facets.len()), (flat(&BEFORE), 12));
}

#[test]
fn charts_outlive_what_they_are_made_from() {
    let map = map(&MapOptions { kind: Some(MapKind::Curves), ..Default::default() });
    let source = map.source_chart().unwrap();
    assert_eq!(source.domain().info().n_vertices, 6);
    assert_eq!(map.target_chart().unwrap().info().certified, 1);
}

#[test]
fn maps_of_charts() {
    let env = &mut Env::new();
    let chart = |vertices| {
        let options = ChartOptions { method: Some(Method::Disc), ..Default::default() };
        Chart::new(&domain(vertices), &options, &mut Env::new()).unwrap()
    };
    let (source, target) = (chart(&BEFORE), chart(&AFTER));
    let options = MapOptions { kind: Some(MapKind::Curves), ..Default::default() };
    let map = Map::from_charts(&source, &target, &options, env).unwrap();
    let points = lattice(10);
    let codes = source.encode(&points, env).unwrap();
    let decoded = target.decode(&codes.start.facet, &codes.start.bary, &codes.t, env).unwrap();
    let images = map.apply(&points, env).unwrap();
    assert_eq!((images.n_failed, decoded.n_failed), (0, 0));
    assert!(farthest(&images.points, &decoded.points) < 1e-9);
}

#[test]
fn pictures_of_values() {
    let env = &mut Env::new();
    let square = domain(&[[0.0, 0.0], [6.0, 0.0], [6.0, 5.0], [0.0, 5.0]]);
    let map = Map::new(&square, &square, &MapOptions::default(), env).unwrap();
    let values: Vec<f32> = (0..30).map(|k| if k == 7 { f32::NAN } else { k as f32 + 0.5 }).collect();
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_ne_bytes().to_vec()).collect();
    let layout = Layout { bytes: 4, ..Default::default() };
    for how in [Interpolation::Nearest, Interpolation::Linear, Interpolation::Cubic] {
        let mut result = vec![0; bytes.len()];
        let source = Picture::with_layout(6, 5, 1, layout, &bytes).unwrap();
        let source = source.interpolated(how).with_nodata(f64::NAN);
        let mut target = PictureMut::with_layout(6, 5, 1, layout, &mut result).unwrap();
        map.warp(&source, &mut target, env).unwrap();
        for (k, value) in result.chunks(4).enumerate() {
            let value = f32::from_ne_bytes([value[0], value[1], value[2], value[3]]);
            assert!(if k == 7 { value.is_nan() } else { value == values[k] }, "{:?} {}", how, k);
        }
    }
}

/// Two bytes a sample, alpha, rows with gaps: the gaps stay as they are.
#[test]
fn pictures_of_any_layout() {
    let square = domain(&[[0.0, 0.0], [6.0, 0.0], [6.0, 5.0], [0.0, 5.0]]);
    let identity = Map::new(&square, &square, &MapOptions::default(), &mut Env::new()).unwrap();
    let layout = Layout { bytes: 2, alpha: true, stride: 6 * 2 * 2 + 3 };
    let length = 4 * layout.stride + 6 * 2 * 2;
    let pixels: Vec<u8> =
        (0..length).map(|k| if k % layout.stride % 4 > 1 { 255 } else { k as u8 }).collect();
    let mut result = vec![7; length];
    let source = Picture::with_layout(6, 5, 2, layout, &pixels).unwrap();
    let mut target = PictureMut::with_layout(6, 5, 2, layout, &mut result).unwrap();
    assert_eq!(identity.warp(&source, &mut target, &mut Env::new()).unwrap(), 0);
    for (k, (&before, &after)) in pixels.iter().zip(&result).enumerate() {
        assert_eq!(after, if k % layout.stride < 24 { before } else { 7 }, "byte {}", k);
    }
}

#[test]
fn failures_name_who_is_at_fault() {
    let mut square = vec![0.0, 0.0, 4.0, 0.0, 4.0, 4.0, 0.0, 4.0];
    square[5] = f64::NAN;
    let error = Domain::polygon(&square, &mut Env::new()).unwrap_err();
    assert_eq!(error.index, Some(2), "{}", error);
    assert!(!error.message.is_empty());

    let error = Domain::polygon(&[0.0, 0.0, 1.0], &mut Env::new()).unwrap_err();
    assert_eq!((error.status, error.index), (Status::ARGUMENT, None));

    let triangle = domain(&BEFORE[..3]);
    let options = MapOptions::default();
    let error = Map::new(&domain(&BEFORE), &triangle, &options, &mut Env::new()).unwrap_err();
    assert_eq!(error.status, Status::BOUNDARY);

    let outside = [9.0, 9.0];
    let options = MapOptions { target_maximum: Some(&outside), ..Default::default() };
    let curves = MapOptions { kind: Some(MapKind::Curves), ..options };
    let error = Map::new(&domain(&BEFORE), &domain(&AFTER), &curves, &mut Env::new()).unwrap_err();
    assert_eq!((error.status, error.side), (Status::OUTSIDE, Some(Side::Target)));
    assert!(error.to_string().starts_with("target: "));
}

#[test]
fn points_fail_one_by_one() {
    let map = map(&MapOptions::default());
    let images = map.apply(&[1.0, 1.0, 3.0, 3.0, f64::NAN, 0.0], &mut Env::new()).unwrap();
    let Images { points, status, n_failed } = images;
    assert_eq!((status, n_failed), (vec![Status::OK, Status::OUTSIDE, Status::ARGUMENT], 2));
    assert!(points[..2].iter().all(|x| x.is_finite()) && points[2..].iter().all(|x| x.is_nan()));
}

#[test]
fn slices_of_the_wrong_length_are_refused() {
    let map = map(&MapOptions::default());
    let env = &mut Env::new();
    let refused = |result: libicc::Result<usize>| assert_eq!(result.unwrap_err().status, Status::ARGUMENT);
    refused(map.apply_into(&[1.0, 1.0], &mut [0.0; 4], None, env));
    refused(map.apply_into(&[1.0, 1.0, 1.0], &mut [0.0; 3], None, env));
    refused(map.apply_into(&[1.0, 1.0], &mut [0.0; 2], Some(&mut [Status::OK; 2]), env));
    let options = ChartOptions { maximum: Some(&[1.0]), ..Default::default() };
    assert_eq!(Chart::new(&domain(&BEFORE), &options, env).unwrap_err().status, Status::ARGUMENT);
    let mut pixels = [0; 15];
    assert!(PictureMut::new(4, 4, 1, &mut pixels).is_err());
    assert!(Picture::with_layout(usize::MAX, 2, 4, Layout::default(), &pixels).is_err());
    assert!(Picture::with_layout(3, 4, 1, Layout { stride: 4, ..Default::default() }, &pixels).is_ok());
}

#[test]
fn threads_change_no_bit() {
    let points = lattice(150);
    let of = |threads| {
        let mut env = Env::new().threads(threads);
        let (before, after) = (domain(&BEFORE), domain(&AFTER));
        let options = MapOptions { kind: Some(MapKind::Curves), ..Default::default() };
        let map = Map::new(&before, &after, &options, &mut env).unwrap();
        bits(&map.apply(&points, &mut env).unwrap().points)
    };
    let one = of(1);
    for threads in [2, 3, 8] {
        assert!(one == of(threads), "{} threads", threads);
    }
}

#[test]
fn objects_are_shared_between_threads() {
    fn shared<T: Send + Sync>() {}
    shared::<Domain>();
    shared::<Chart>();
    shared::<Map>();
    shared::<libicc::stages::Grid>();
    shared::<libicc::stages::Tree>();
    shared::<libicc::stages::Function>();
    shared::<libicc::kernel::Shape>();
    shared::<libicc::kernel::Sampling>();
    shared::<libicc::kernel::Weights>();
    shared::<libicc::kernel::Binding>();
    shared::<libicc::Error>();

    let map = map(&MapOptions::default());
    let points = lattice(40);
    let expected = bits(&map.apply(&points, &mut Env::new()).unwrap().points);
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let images = map.apply(&points, &mut Env::new()).unwrap();
                assert_eq!(bits(&images.points), expected);
            });
        }
    });
}

#[test]
fn progress_is_heard_and_may_cancel() {
    let heard = Cell::new(0);
    let mut env = Env::new().progress(|stage, share| {
        assert!(!stage.is_empty() && (0.0..=1.0).contains(&share));
        heard.set(heard.get() + 1);
        ControlFlow::Continue(())
    });
    Map::new(&domain(&BEFORE), &domain(&AFTER), &MapOptions::default(), &mut env).unwrap();
    assert!(heard.get() > 0);

    let after = Cell::new(0);
    let mut env = Env::new().progress(|_, _| {
        after.set(after.get() + 1);
        ControlFlow::Break(())
    });
    let error = Chart::new(&domain(&BEFORE), &ChartOptions::default(), &mut env).unwrap_err();
    assert_eq!(error.status, Status::CANCELLED);
    assert!(after.get() > 0);
}

#[test]
fn cancelled_improvement_gives_what_there_is() {
    let options = MapOptions { kind: Some(MapKind::Mesh), iterations: -1, ..Default::default() };
    let rough = map(&options);
    let mut env = Env::new().progress(|_, _| ControlFlow::Break(()));
    let (map, report) = rough.improve(&ImproveOptions::default(), &mut env).unwrap();
    assert_eq!(report.cancelled, 1);
    assert_eq!(map.info().certified, 1);
    let (fair, report) = rough.improve(&ImproveOptions::default(), &mut Env::new()).unwrap();
    assert_eq!((report.cancelled, fair.info().certified), (0, 1));
    assert!(report.energy < report.energy_start);
}

/// At every place where the callback is run: the library gets its answer, cleans up, and the panic goes on.
#[test]
fn panics_in_progress_go_on_after_the_call() {
    let (before, after) = (domain(&BEFORE), domain(&AFTER));
    let count = Cell::new(0_usize);
    let options = MapOptions::default();
    let mut env = Env::new().progress(|_, _| {
        count.set(count.get() + 1);
        ControlFlow::Continue(())
    });
    let whole = Map::new(&before, &after, &options, &mut env).unwrap();
    let n = count.get();
    assert!(n > 2);
    for at in (1..=n).step_by((n / 20).max(1)) {
        let calls = Cell::new(0_usize);
        let mut env = Env::new().progress(|_, _| {
            calls.set(calls.get() + 1);
            if calls.get() == at {
                resume_unwind(Box::new(at)); /* a panic that prints nothing */
            }
            ControlFlow::Continue(())
        });
        let payload =
            catch_unwind(AssertUnwindSafe(|| Map::new(&before, &after, &options, &mut env))).unwrap_err();
        assert_eq!(payload.downcast_ref::<usize>(), Some(&at));
        assert_eq!(calls.get(), at);
    }
    let again = Map::new(&before, &after, &options, &mut Env::new()).unwrap();
    let points = lattice(10);
    let images = |map: &Map| bits(&map.apply(&points, &mut Env::new()).unwrap().points);
    assert_eq!(images(&again), images(&whole));
}

/// Stars so wild that the first attempt cannot be repaired.
fn stars() -> [Domain; 2] {
    [[1.0, 0.02, 1.0, 0.02], [0.02, 1.0, 0.02, 0.5]].map(|radii| {
        let corner = |k: usize| {
            let (sin, cos) = (k as f64 * std::f64::consts::PI / 8.0).sin_cos();
            [radii[k % 4] * cos, radii[k % 4] * sin]
        };
        domain(&(0..16).map(corner).collect::<Vec<_>>())
    })
}

#[test]
fn diagnostics_are_heard_and_may_panic() {
    let [before, after] = stars();
    let lines = Mutex::new(Vec::new());
    let mut env = Env::new().log(|line| lines.lock().unwrap().push(line.to_string()));
    Map::new(&before, &after, &MapOptions::default(), &mut env).unwrap();
    drop(env);
    let lines = lines.into_inner().unwrap();
    assert!(lines.iter().any(|line| line.contains("are inverted")), "{:?}", lines);

    let mut env = Env::new().log(|_| resume_unwind(Box::new("log")));
    let call = AssertUnwindSafe(|| Map::new(&before, &after, &MapOptions::default(), &mut env));
    assert_eq!(catch_unwind(call).unwrap_err().downcast_ref::<&str>(), Some(&"log"));
}

#[test]
fn following_a_target_that_moves() {
    let first = map(&MapOptions { kind: Some(MapKind::Mesh), ..Default::default() });
    let mut moved = AFTER;
    moved[2][0] += 0.1;
    let next = first.retarget(&domain(&moved), 0, &mut Env::new()).unwrap();
    assert_eq!(next.info().certified, 1);
    assert!(next.source_chart().is_none());
    let corner = next.apply(&BEFORE[2], &mut Env::new()).unwrap();
    assert!(farthest(&corner.points, &moved[2]) < 1e-12);
}

#[test]
fn following_a_surface_that_moves() {
    let mut vertices = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let faces = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
    let env = &mut Env::new();
    let before = Domain::new(3, &vertices, &faces, env).unwrap();
    let mut frame = Map::new(&before, &before, &MapOptions::default(), env).unwrap();
    for _ in 0..3 {
        vertices[9] += 0.1;
        let target = Domain::new(3, &vertices, &faces, env).unwrap();
        frame = frame.retarget(&target, 0, env).unwrap();
        assert_eq!(frame.info().certified, 1);
    }
    let corner = frame.apply(&[0.0, 0.0, 1.0], env).unwrap();
    assert!(farthest(&corner.points, &vertices[9..]) < 1e-12);
}

#[test]
fn meshes_are_carried_and_certified() {
    let map = map(&MapOptions { kind: Some(MapKind::Mesh), ..Default::default() });
    let mesh = map.mesh().unwrap();
    let info = map.info();
    assert_eq!(mesh.vertices.len(), 2 * info.n_vertices);
    assert_eq!(mesh.simplices.len(), 3 * info.n_simplices);
    let mut points = flat(&BEFORE).to_vec();
    points.extend([0.7, 0.7, 2.5, 0.7, 0.7, 2.5]);
    let triangles = libicc::stages::triangulate(6, &points, &mut Env::new()).unwrap();
    let check = |(images, certificate): (Vec<f64>, Certificate)| {
        assert_eq!((images.len(), certificate.n_no_image), (points.len(), 0));
        assert_eq!(certificate.certified, 1);
    };
    check(map.repair(&points, &triangles, &mut Env::new()).unwrap());
    let (_, certificate) = map.certify(&points, &triangles, &mut Env::new()).unwrap();
    assert_eq!(certificate.certified == 1, certificate.first == -1);
}

#[test]
fn derivatives_are_those_of_differences() {
    let map = map(&MapOptions { kind: Some(MapKind::Mesh), ..Default::default() });
    let step = 1e-7;
    let at = [0.733, 0.641];
    let jacobian = map.jacobian(&at, &mut Env::new()).unwrap();
    assert_eq!(jacobian.n_failed, 0);
    let near = [at[0] + step, at[1], at[0], at[1] + step, at[0], at[1]];
    let images = map.apply(&near, &mut Env::new()).unwrap().points;
    for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        let difference = (images[2 * j + i] - images[4 + i]) / step;
        assert!((difference - jacobian.points[2 * i + j]).abs() < 1e-6);
    }
}

#[test]
fn tetrahedra_make_a_domain() {
    let vertices = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.25, 0.25, 0.25];
    let tetrahedra = [4, 1, 2, 3, 0, 4, 2, 3, 0, 1, 4, 3, 0, 1, 2, 4];
    let env = &mut Env::new();
    let ball = Domain::from_mesh(3, &vertices, &tetrahedra, None, env).unwrap();
    let info = ball.info();
    assert_eq!((info.n_vertices, info.n_facets), (4, 4));
    let chart = Chart::new(&ball, &ChartOptions::default(), env).unwrap();
    assert_eq!(chart.info().certified, 1);
    let codes = chart.encode(&[0.1, 0.2, 0.3], env).unwrap();
    let start = &codes.start;
    let back = chart.decode(&start.facet, &start.bary, &codes.t, env).unwrap();
    assert!(farthest(&back.points, &[0.1, 0.2, 0.3]) < 1e-12);
}

#[test]
fn surfaces_are_filled() {
    let vertices = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let faces = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2];
    let env = &mut Env::new();
    let filled = Domain::new(3, &vertices, &faces, env).unwrap().filled(env).unwrap();
    let (points, simplices) = filled.mesh().unwrap();
    assert_eq!(points[..12], vertices);
    assert_eq!(simplices.len(), 4 * filled.info().n_mesh_simplices);
    assert!(filled.filled(env).is_err());
}

#[test]
fn masks_are_repaired() {
    let env = &mut Env::new();
    let mut cells = [1, 0, 0, 1];
    let error = Domain::from_mask(&[2, 2], &cells, env).unwrap_err();
    assert_eq!(error.status, Status::TOPOLOGY);
    assert_eq!(libicc::repair_mask(&[2, 2], &mut cells, env).unwrap(), 1);
    assert_eq!(Domain::from_mask(&[2, 2], &cells, env).unwrap().info().measure, 3.0);
    assert!(Domain::from_mask(&[2, 2], &[1; 3], env).is_err());
    assert!(Domain::from_mask(&[usize::MAX, 2], &[1; 3], env).is_err());
}

#[test]
fn proj_gets_a_triangulation() {
    let map = map(&MapOptions::default());
    let text = map.to_proj(Some("EPSG:2056"), Some("a \"local\" one")).unwrap();
    let mesh = map.mesh().unwrap();
    let last = &mesh.simplices[mesh.simplices.len() - 3..];
    for part in [
        "\"file_type\": \"triangulation_file\"",
        "\"input_crs\": \"EPSG:2056\",",
        "\"output_crs\": \"a \\\"local\\\" one\",",
        &format!("[{}, {}, {}]]", last[0], last[1], last[2]),
    ] {
        assert!(text.contains(part), "{part} is not in it");
    }
    let rows = text.matches("\n[").count();
    assert_eq!(rows, mesh.vertices.len() / 2 + mesh.simplices.len() / 3);
    let curves = MapOptions { kind: Some(MapKind::Curves), ..MapOptions::default() };
    let map = Map::new(&domain(&BEFORE), &domain(&AFTER), &curves, &mut Env::new()).unwrap();
    assert_eq!(map.to_proj(None, None).unwrap_err().status, Status::UNSUPPORTED);
}
