//! Pictures in memory.
use crate::error::{Error, Result};
use crate::slices::int;
use crate::sys::{self, icc_picture};
use std::marker::PhantomData;
use std::os::raw::c_void;

/// A picture that is read: rows from top to bottom, samples of a pixel side by side.
#[derive(Clone, Debug)]
pub struct Picture<'a> {
    raw: icc_picture,
    pixels: PhantomData<&'a [u8]>,
}

/// A picture that is written to.
#[derive(Debug)]
pub struct PictureMut<'a> {
    raw: icc_picture,
    pixels: PhantomData<&'a mut [u8]>,
}

/// How samples lie in memory, if not one byte each in rows without gaps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layout {
    /// bytes of a sample, in the machine's order: 1 or 2, unsigned; 4 or 8, floats; 0 means 1
    pub bytes: usize,
    /// whether the last of at least two channels is opacity
    pub alpha: bool,
    /// bytes from one row to the next; 0: no gaps
    pub stride: usize,
}

/// How a [`Picture`] is read between the centres of its pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(i32)]
pub enum Interpolation {
    /// the pixel's own samples, for classes and labels
    Nearest = sys::ICC_INTERPOLATION_NEAREST,
    /// bilinear
    Linear = sys::ICC_INTERPOLATION_LINEAR,
    /// bicubic
    Cubic = sys::ICC_INTERPOLATION_CUBIC,
}

impl<'a> Picture<'a> {
    /// One byte a sample, no alpha, rows without gaps: height * width * channels bytes.
    ///
    /// # Errors
    /// [`Status::ARGUMENT`](crate::Status::ARGUMENT) when `pixels` is too short.
    pub fn new(width: usize, height: usize, channels: usize, pixels: &'a [u8]) -> Result<Self> {
        Self::with_layout(width, height, channels, Layout::default(), pixels)
    }

    /// Any layout.
    ///
    /// # Errors
    /// [`Status::ARGUMENT`](crate::Status::ARGUMENT) when `pixels` is too short.
    pub fn with_layout(
        width: usize,
        height: usize,
        channels: usize,
        layout: Layout,
        pixels: &'a [u8],
    ) -> Result<Self> {
        let raw = picture(width, height, channels, layout, pixels.len())?;
        let pixels_at = pixels.as_ptr() as *mut c_void;
        Ok(Picture { raw: icc_picture { pixels: pixels_at, ..raw }, pixels: PhantomData })
    }

    /// Sets how it is read between the centres of its pixels; the default is linear.
    pub fn interpolated(mut self, interpolation: Interpolation) -> Self {
        self.raw.interpolation = interpolation as i32;
        self
    }

    /// Samples with this value, which may be NaN, are missing.
    pub fn with_nodata(mut self, nodata: f64) -> Self {
        self.raw.has_nodata = 1;
        self.raw.nodata = nodata;
        self
    }

    pub(crate) fn raw(&self) -> *const icc_picture {
        &self.raw
    }
}

impl<'a> PictureMut<'a> {
    /// Like [`Picture::new`].
    pub fn new(width: usize, height: usize, channels: usize, pixels: &'a mut [u8]) -> Result<Self> {
        Self::with_layout(width, height, channels, Layout::default(), pixels)
    }

    /// Like [`Picture::with_layout`].
    pub fn with_layout(
        width: usize,
        height: usize,
        channels: usize,
        layout: Layout,
        pixels: &'a mut [u8],
    ) -> Result<Self> {
        let raw = picture(width, height, channels, layout, pixels.len())?;
        let pixels_at = pixels.as_mut_ptr() as *mut c_void;
        Ok(PictureMut { raw: icc_picture { pixels: pixels_at, ..raw }, pixels: PhantomData })
    }

    pub(crate) fn raw(&mut self) -> *const icc_picture {
        &self.raw
    }
}

/// Everything except the pixels, of which there must be enough. The library checks the rest.
fn picture(
    width: usize,
    height: usize,
    channels: usize,
    layout: Layout,
    available: usize,
) -> Result<icc_picture> {
    let bytes = layout.bytes.max(1);
    let row = width.checked_mul(channels).and_then(|n| n.checked_mul(bytes));
    let stride = match layout.stride {
        0 => row.unwrap_or(usize::MAX),
        stride => stride,
    };
    let needed = match (row, height) {
        (Some(_), 0) => Some(0),
        (Some(row), _) => stride.checked_mul(height - 1).and_then(|n| n.checked_add(row)),
        (None, _) => None,
    };
    if needed.map_or(true, |needed| needed > available) {
        return Err(Error::argument(format!(
            "a picture of {} x {} pixels needs more than {} bytes",
            width, height, available
        )));
    }
    Ok(icc_picture {
        width: int(width),
        height: int(height),
        channels: int(channels),
        bytes: int(bytes),
        alpha: i32::from(layout.alpha),
        stride,
        ..Default::default()
    })
}
