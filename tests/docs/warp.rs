//! Around the lines of the front page: they turn a picture of one colour in a square.
use libicc::{Domain, Env, Map, MapOptions, Picture, PictureMut};

fn main() -> libicc::Result<()> {
    let env = &mut Env::new();
    let before = [0.0, 0.0, 8.0, 0.0, 8.0, 8.0, 0.0, 8.0];
    let after = [4.0, 0.0, 8.0, 4.0, 4.0, 8.0, 0.0, 4.0];
    let (pixels, mut result) = ([200; 64], [0; 64]);
    let picture = Picture::new(8, 8, 1, &pixels)?;
    let mut warped = PictureMut::new(8, 8, 1, &mut result)?;

    SNIPPET

    assert!(result[4 * 8 + 4] == 200 && result[0] == 0);
    Ok(())
}
