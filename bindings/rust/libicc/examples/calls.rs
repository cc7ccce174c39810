//! What a call costs from Rust beyond the same call in C.
//!
//!     calls C_EMPTY C_POINT     nanoseconds that bindings/calls.c prints
//!
//! Prints the least of many means, since whatever else runs makes them longer, never shorter; the rest is noise, so
//! that less than nothing is nothing.
use libicc::{Domain, Env, Map, MapOptions};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let in_c = std::env::args().skip(1).map(|text| text.parse()).collect::<Result<Vec<f64>, _>>()?;
    let [c_empty, c_point] = <[f64; 2]>::try_from(in_c).map_err(|_| "usage: calls C_EMPTY C_POINT")?;
    let env = &mut Env::new();
    let before = Domain::polygon(&[0.0, 0.0, 4.0, 0.0, 4.0, 3.0, 0.0, 3.0], env)?;
    let after = Domain::polygon(&[0.0, 0.0, 4.0, 1.0, 4.0, 4.0, 0.0, 3.0], env)?;
    let map = Map::new(&before, &after, &MapOptions::default(), env)?;
    let (point, mut image) = ([1.0, 1.0], [0.0; 2]);

    let empty = nanoseconds(libicc::version_number);
    let safe = nanoseconds(|| map.apply_into(&point, &mut image, None, env));
    println!(
        "rust: {:.2} us a call for one point, {:.2} us an empty call, beyond C",
        (safe - c_point).max(0.0) / 1e3,
        (empty - c_empty).max(0.0) / 1e3
    );
    Ok(())
}

fn nanoseconds<T>(mut call: impl FnMut() -> T) -> f64 {
    const CALLS: usize = 20000;
    let mean = |_| {
        let start = Instant::now();
        for _ in 0..CALLS {
            call();
        }
        start.elapsed().as_nanos() as f64 / CALLS as f64
    };
    (0..50).map(mean).fold(f64::INFINITY, f64::min)
}
