//! Warps a PPM picture by a cage, and prints what calls cost.
//!
//! usage: warp [IN.ppm OUT.ppm]     without files a checkered picture is made up
use libicc::{Domain, Env, Map, MapOptions, Picture, PictureMut};
use std::error::Error;
use std::fs;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let picture = match files.first() {
        Some(path) => Ppm::read(path)?,
        None => Ppm::checkered(640, 480),
    };
    let env = &mut Env::new().all_threads();
    let (w, h) = (picture.width as f64, picture.height as f64);
    let frame = [0.0, 0.0, w / 2.0, 0.0, w, 0.0, w, h, w / 2.0, h, 0.0, h];
    let mut bent = frame;
    bent[3] += h / 4.0;
    bent[9] -= h / 4.0;
    let before = Domain::polygon(&frame, env)?;
    let after = Domain::polygon(&bent, env)?;
    let map = Map::new(&before, &after, &MapOptions::default(), env)?;

    let mut warped = Ppm { pixels: vec![255; picture.pixels.len()], ..picture };
    let (width, height) = (picture.width, picture.height);
    let source = Picture::new(width, height, 3, &picture.pixels)?;
    let start = Instant::now();
    map.warp(&source, &mut PictureMut::new(width, height, 3, &mut warped.pixels)?, env)?;
    println!("{} x {} pixels in {:.1} ms", width, height, 1e3 * start.elapsed().as_secs_f64());
    if let Some(path) = files.get(1) {
        warped.write(path)?;
    }
    overhead(&map)
}

/// What a call costs from Rust beyond the same call in C: one point, written to a slice. The least of many means.
fn overhead(map: &Map) -> Result<(), Box<dyn Error>> {
    let point = [10.0, 10.0];
    let mut image = [0.0; 2];
    let env = &mut Env::new();
    let (mut safe, mut raw) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..50 {
        let mut failed = Ok(0);
        safe = safe.min(nanoseconds(|| failed = map.apply_into(&point, &mut image, None, env)));
        failed?;
        let none = std::ptr::null_mut();
        raw = raw.min(nanoseconds(|| {
            let (points, images) = (point.as_ptr(), image.as_mut_ptr());
            // SAFETY: one point in 2-D.
            unsafe {
                libicc::sys::icc_map_apply(map.as_ptr(), 1, points, images, none, none.cast(), none.cast())
            };
        }));
    }
    println!("a call for one point: {:.0} ns safe, {:.0} ns raw, {:.0} ns overhead", safe, raw, safe - raw);
    Ok(())
}

fn nanoseconds(mut call: impl FnMut()) -> f64 {
    const CALLS: usize = 4000;
    let start = Instant::now();
    for _ in 0..CALLS {
        call();
    }
    start.elapsed().as_nanos() as f64 / CALLS as f64
}

struct Ppm {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
}

impl Ppm {
    fn checkered(width: usize, height: usize) -> Ppm {
        let colour = |k: usize| match (k % width / 32 + k / width / 32) % 2 {
            0 => [230, 230, 230],
            _ => [40, 80, 160],
        };
        Ppm { width, height, pixels: (0..width * height).flat_map(colour).collect() }
    }

    /// A binary PPM of one byte a sample, without comments.
    fn read(path: &str) -> Result<Ppm, Box<dyn Error>> {
        let data = fs::read(path)?;
        let mut rest = data.as_slice();
        let mut word = || {
            let n = rest.iter().position(|byte| byte.is_ascii_whitespace()).unwrap_or(rest.len());
            let found = String::from_utf8_lossy(&rest[..n]).into_owned();
            rest = rest.get(n + 1..).unwrap_or(&[]);
            found
        };
        let (kind, width, height, most) = (word(), word().parse()?, word().parse()?, word());
        if kind != "P6" || most != "255" {
            return Err(format!("{}: not a P6 picture of 255", path).into());
        }
        Ok(Ppm { width, height, pixels: rest.to_vec() })
    }

    fn write(&self, path: &str) -> std::io::Result<()> {
        let mut data = format!("P6\n{} {}\n255\n", self.width, self.height).into_bytes();
        data.extend(&self.pixels);
        fs::write(path, data)
    }
}
