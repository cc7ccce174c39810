//! Charts and maps as bytes.
use libicc::{
    Chart, ChartOptions, Domain, Env, Images, ImproveOptions, Map, MapKind, MapOptions, Method, Status,
};

const BEFORE: [f64; 12] = [0.0, 0.0, 4.0, 0.0, 4.0, 1.5, 1.5, 1.5, 1.5, 4.0, 0.0, 4.0];
const AFTER: [f64; 12] = [0.0, 0.0, 4.0, -1.0, 5.0, 0.5, 1.5, 1.5, 2.5, 4.5, 0.5, 4.5];

fn domain(vertices: &[f64]) -> Domain {
    Domain::polygon(vertices, &mut Env::new()).unwrap()
}

fn map(kind: MapKind) -> Map {
    let options = MapOptions { kind: Some(kind), ..Default::default() };
    Map::new(&domain(&BEFORE), &domain(&AFTER), &options, &mut Env::new()).unwrap()
}

/// Points in the lower arm of the shape, and some outside.
fn points() -> Vec<f64> {
    (0..500).flat_map(|k| [f64::from(k) * 0.81 % 4.1, f64::from(k) * 0.37 % 1.6]).collect()
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

fn same(one: &Images, two: &Images) {
    assert_eq!(one.status, two.status);
    assert_eq!(bits(&one.points), bits(&two.points));
}

#[test]
fn maps_answer_as_they_did() {
    let env = &mut Env::new().threads(2);
    for map in [map(MapKind::Mesh), map(MapKind::Curves)] {
        let data = map.to_bytes().unwrap();
        let again = Map::from_bytes(&data, env).unwrap();
        assert_eq!((again.info().certified, again.info().kind), (1, map.info().kind));
        same(&again.apply(&points(), env).unwrap(), &map.apply(&points(), env).unwrap());
        same(&again.apply_inverse(&points(), env).unwrap(), &map.apply_inverse(&points(), env).unwrap());
        assert_eq!(again.to_bytes().unwrap(), data);
    }
}

#[test]
fn maps_go_on_as_they_would_have() {
    let env = &mut Env::new();
    let map = map(MapKind::Mesh);
    let again = Map::from_bytes(&map.to_bytes().unwrap(), env).unwrap();
    let options = ImproveOptions { iterations: 3, ..Default::default() };
    let (one, _) = map.improve(&options, env).unwrap();
    let (two, _) = again.improve(&options, env).unwrap();
    same(&one.apply(&points(), env).unwrap(), &two.apply(&points(), env).unwrap());
}

/// An outline of 1000 vertices with petals.
fn flower(petals: f64, depth: f64, phase: f64) -> Domain {
    let vertex = |k: u32| {
        let angle = 2.0 * std::f64::consts::PI * f64::from(k) / 1000.0;
        let radius = 1.0 + depth * (petals * angle + phase).cos();
        [radius * angle.cos(), radius * angle.sin()]
    };
    domain(&(0..1000).flat_map(vertex).collect::<Vec<f64>>())
}

#[test]
fn maps_overlaid_in_patches_go_on_as_they_would_have() {
    let env = &mut Env::new();
    let (source, target, moved) = (flower(5.0, 0.4, 0.0), flower(4.0, 0.4, 1.0), flower(4.0, 0.38, 1.05));
    let map = Map::new(&source, &target, &MapOptions::default(), env).unwrap();
    assert!(map.report().n_inverted > 0 && map.info().n_vertices > 2000);
    let again = Map::from_bytes(&map.to_bytes().unwrap(), env).unwrap();
    let improved = |map: &Map| map.improve(&ImproveOptions::default(), &mut Env::new()).unwrap().0;
    let followed = |map: &Map| map.retarget(&moved, 0, &mut Env::new()).unwrap();
    let pairs = [(improved(&map), improved(&again)), (followed(&map), followed(&again)), (map, again)];
    for (one, two) in &pairs {
        let (mesh, other) = (one.mesh().unwrap(), two.mesh().unwrap());
        assert_eq!((one.info().certified, two.info().certified), (1, 1));
        assert_eq!(bits(&mesh.images), bits(&other.images));
        let (images, certificate) = one.certify(&mesh.vertices, &mesh.simplices, env).unwrap();
        let (again, other) = two.certify(&mesh.vertices, &mesh.simplices, env).unwrap();
        assert_eq!((bits(&images), certificate.certified), (bits(&again), other.certified));
    }
}

#[test]
fn charts_answer_as_they_did() {
    let env = &mut Env::new();
    for method in [Method::Foliation, Method::Disc, Method::Gradient, Method::Field] {
        let options = ChartOptions { method: Some(method), cells: 30, ..Default::default() };
        let chart = Chart::new(&domain(&BEFORE), &options, env).unwrap();
        let again = Chart::from_bytes(&chart.to_bytes().unwrap(), env).unwrap();
        let (one, two) = (chart.encode(&points(), env).unwrap(), again.encode(&points(), env).unwrap());
        assert_eq!(one.status, two.status);
        assert_eq!(one.start.facet, two.start.facet);
        assert_eq!(bits(&one.start.bary), bits(&two.start.bary));
        assert_eq!(bits(&one.t), bits(&two.t));
        assert_eq!(again.domain().info().n_vertices, 6);
    }
}

#[test]
fn other_bytes_are_refused() {
    let env = &mut Env::new();
    let data = map(MapKind::Mesh).to_bytes().unwrap();
    for at in (0..data.len()).step_by(data.len() / 50) {
        let mut damaged = data.clone();
        damaged[at] ^= 1;
        assert_eq!(Map::from_bytes(&damaged, env).unwrap_err().status, Status::FORMAT);
        assert_eq!(Map::from_bytes(&data[..at], env).unwrap_err().status, Status::FORMAT);
    }
    assert_eq!(Chart::from_bytes(&data, env).unwrap_err().status, Status::FORMAT);
}

#[test]
fn files_hold_the_same_bytes() {
    let env = &mut Env::new();
    let path = std::env::temp_dir().join(format!("libicc-{}.map", std::process::id()));
    let map = map(MapKind::Mesh);
    map.save(&path).unwrap();
    let again = Map::load(&path, env).unwrap();
    assert_eq!(again.to_bytes().unwrap(), map.to_bytes().unwrap());
    let wrong = Chart::load(&path, env).unwrap_err();
    assert_eq!(wrong.kind(), std::io::ErrorKind::InvalidData);
    std::fs::remove_file(&path).unwrap();
    assert_eq!(Map::load(&path, env).unwrap_err().kind(), std::io::ErrorKind::NotFound);
}
