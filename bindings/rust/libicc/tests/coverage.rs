//! Two layers of the same regions from Rust: common vertices, differences, errors.
use libicc::{
    Coverage, CoverageOptions, DifferenceKind, Domain, Env, Feature, LayerRing, Map, MapOptions, Side,
    Status, Unmatched,
};

const NORTH: [f64; 8] = [0.0, 1.0, 4.0, 1.0, 4.0, 2.0, 0.0, 2.0];
const SOUTH: [f64; 8] = [0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 0.0, 1.0];
const NEW_NORTH: [f64; 10] = [0.0, 1.0, 2.0, 1.4, 4.0, 1.0, 4.0, 2.0, 0.0, 2.0];
const NEW_SOUTH: [f64; 10] = [0.0, 0.0, 4.0, 0.0, 4.0, 1.0, 2.0, 1.4, 0.0, 1.0];
const EAST: [f64; 6] = [5.0, 5.0, 6.0, 5.0, 6.0, 6.0];

fn ring(id: i64, vertices: &[f64]) -> LayerRing<'_> {
    LayerRing { id, hole: false, vertices }
}

#[test]
fn two_layers_become_one_map() {
    let env = &mut Env::new();
    let old = [ring(-7, &NORTH), ring(1 << 40, &SOUTH)];
    let new = [ring(1 << 40, &NEW_SOUTH), ring(-7, &NEW_NORTH)];
    let coverage = Coverage::new(&old, &new, &CoverageOptions::default(), env).unwrap();
    let info = coverage.info();
    assert_eq!((info.n_regions, info.n_nodes, info.n_sides, info.n_islands), (2, 2, 3, 0));
    assert!(coverage.differences().unwrap().is_empty());
    let map = Map::new(&coverage.source(), &coverage.target(), &MapOptions::default(), env).unwrap();
    assert_eq!(map.info().certified, 1);
    let rings = coverage.rings().unwrap();
    assert_eq!(
        rings.iter().map(|ring| (ring.id, ring.hole)).collect::<Vec<_>>(),
        [(-7, false), (1 << 40, false)]
    );
    for ring in rings {
        let images = map.apply(ring.source, env).unwrap().points;
        assert!(images.iter().zip(ring.target).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}

#[test]
fn differences_are_named_or_left_out() {
    let env = &mut Env::new();
    let old = [ring(1, &NORTH), ring(2, &SOUTH)];
    let new = [ring(1, &NEW_NORTH), ring(2, &NEW_SOUTH), ring(3, &EAST)];
    let error = Coverage::new(&old, &new, &CoverageOptions::default(), env).unwrap_err();
    assert_eq!(error.status, Status::TOPOLOGY);
    assert!(error.message.contains("region 3"), "{}", error.message);
    let leave_out = CoverageOptions { unmatched: Some(Unmatched::LeaveOut), ..Default::default() };
    let differences = Coverage::new(&old, &new, &leave_out, env).unwrap().differences().unwrap();
    assert_eq!(differences.len(), 1);
    let one = &differences[0];
    assert_eq!((one.kind, one.side, &one.ids[..]), (DifferenceKind::Region, Side::Target, &[3][..]));
    assert_eq!(one.place, [5.0, 5.0]);
    let given = CoverageOptions { left_out: &[3], ..Default::default() };
    assert!(Coverage::new(&old, &new, &given, env).unwrap().differences().unwrap().is_empty());
    let error = Coverage::new(&[ring(1, &[0.0; 3])], &new, &given, env).unwrap_err();
    assert_eq!(error.status, Status::ARGUMENT);
}

#[test]
fn a_domain_may_have_several_outlines() {
    let env = &mut Env::new();
    let features = [Feature::Region(&NORTH), Feature::Region(&EAST)];
    let info = Domain::with_features(&[], &features, env).unwrap().info();
    assert_eq!((info.measure, info.n_pieces, info.n_faces), (4.5, 2, 2));
}
