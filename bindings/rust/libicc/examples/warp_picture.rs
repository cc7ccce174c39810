//! Warps a picture: what lies inside one cage follows it into another.
//!
//!     warp_picture SOURCE.txt TARGET.txt IN.ppm OUT.ppm
//!
//! A cage is a text file with one vertex `x y` per line, in pixels, x to the right and y down. Vertex i of the
//! source goes to vertex i of the target. What lies outside the target becomes white. Pictures are binary PPM;
//! netpbm converts others: `pngtopnm in.png > in.ppm`, `pnmtopng out.ppm > out.png`.
use libicc::{Domain, Env, Map, MapOptions, Picture, PictureMut};
use std::error::Error;
use std::fs;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [source, target, before, after] = match <[String; 4]>::try_from(arguments) {
        Ok(paths) => paths,
        Err(_) => return Err("usage: warp_picture SOURCE.txt TARGET.txt IN.ppm OUT.ppm".into()),
    };
    let env = &mut Env::new().all_threads();
    let source = Domain::polygon(&read_cage(&source)?, env)?;
    let target = Domain::polygon(&read_cage(&target)?, env)?;
    let map = Map::new(&source, &target, &MapOptions::default(), env)?;

    let (width, height, pixels) = read_ppm(&before)?;
    let mut warped = vec![255; pixels.len()];
    let drawn = &mut PictureMut::new(width, height, 3, &mut warped)?;
    map.warp(&Picture::new(width, height, 3, &pixels)?, drawn, env)?;
    write_ppm(&after, width, height, &warped)?;
    println!("the result is {}", after);
    Ok(())
}

fn read_cage(path: &str) -> Result<Vec<f64>, Box<dyn Error>> {
    let text = fs::read_to_string(path)?;
    Ok(text.split_whitespace().map(str::parse).collect::<Result<_, _>>()?)
}

/// Width, height, and three bytes a pixel.
fn read_ppm(path: &str) -> Result<(usize, usize, Vec<u8>), Box<dyn Error>> {
    let data = fs::read(path)?;
    let mut at = 0;
    let (kind, width, height, most) =
        (word(&data, &mut at), word(&data, &mut at), word(&data, &mut at), word(&data, &mut at));
    if kind != "P6" || most != "255" {
        return Err(format!("{}: not a binary PPM of 255 values", path).into());
    }
    Ok((width.parse()?, height.parse()?, data[at..].to_vec()))
}

/// The next word of a header, and one white space behind it; comments are passed over.
fn word(data: &[u8], at: &mut usize) -> String {
    let mut found = String::new();
    let mut comment = false;
    while let Some(&byte) = data.get(*at) {
        *at += 1;
        comment = byte == b'#' || comment && byte != b'\n';
        if !comment && !byte.is_ascii_whitespace() {
            found.push(byte as char);
        } else if !found.is_empty() {
            break;
        }
    }
    found
}

fn write_ppm(path: &str, width: usize, height: usize, pixels: &[u8]) -> std::io::Result<()> {
    let mut data = format!("P6\n{} {}\n255\n", width, height).into_bytes();
    data.extend(pixels);
    fs::write(path, data)
}
