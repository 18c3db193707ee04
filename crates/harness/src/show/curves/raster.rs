//! Draws figures into a PNG.
//!
//! The crate that plots has a backend for pictures, but its fonts come from an unmaintained parser
//! (RUSTSEC-2026-0192): text is drawn with the bitmap font of the sheets instead.

use std::io::Cursor;

use image::imageops::{FilterType, resize};
use image::{ImageFormat, Rgb, RgbImage};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
};

use crate::show::lettering;

/// Pixels of the PNG for one of the figure: sharp on dense screens.
const DENSITY: u32 = 2;
/// Pixels that are drawn and averaged for one of the PNG, in each direction.
const SAMPLES: u32 = 2;
const SCALE: i32 = (DENSITY * SAMPLES) as i32;
/// Width and height of a character as parts of the font's size.
const CHARACTER: (f64, f64) = (0.58, 0.75);

/// A drawing backend of a PNG file.
pub(super) struct Raster<'r> {
    png: &'r mut Vec<u8>,
    size: (u32, u32),
    canvas: Pixels,
}

/// The pixels, in their own coordinates. All shapes come down to [`DrawingBackend::draw_pixel`].
struct Pixels(RgbImage);

/// A style whose lines are as many times wider as the canvas is larger.
struct Wider(BackendColor, u32);

type Done<E> = Result<(), DrawingErrorKind<E>>;

impl<'r> Raster<'r> {
    /// Writes the file's bytes to `png` when the figure is presented.
    pub(super) fn new(png: &'r mut Vec<u8>, size: (u32, u32)) -> Self {
        let canvas = Pixels(RgbImage::new(size.0 * SCALE as u32, size.1 * SCALE as u32));
        Self { png, size, canvas }
    }
}

impl BackendStyle for Wider {
    fn color(&self) -> BackendColor {
        self.0
    }

    fn stroke_width(&self) -> u32 {
        self.1
    }
}

impl Wider {
    fn new(style: &impl BackendStyle) -> Self {
        Self(style.color(), style.stroke_width() * SCALE as u32)
    }
}

fn scaled((x, y): BackendCoord) -> BackendCoord {
    (x * SCALE, y * SCALE)
}

impl DrawingBackend for Pixels {
    type ErrorType = image::ImageError;

    fn get_size(&self) -> (u32, u32) {
        self.0.dimensions()
    }

    fn ensure_prepared(&mut self) -> Done<Self::ErrorType> {
        Ok(())
    }

    fn present(&mut self) -> Done<Self::ErrorType> {
        Ok(())
    }

    fn draw_pixel(&mut self, (x, y): BackendCoord, color: BackendColor) -> Done<Self::ErrorType> {
        let inside = u32::try_from(x).ok().zip(u32::try_from(y).ok());
        if let Some(pixel) = inside.and_then(|(x, y)| self.0.get_pixel_mut_checked(x, y)) {
            let (r, g, b) = color.rgb;
            let mixed = |old: u8, new: u8| {
                (f64::from(old) + color.alpha * (f64::from(new) - f64::from(old))).round() as u8
            };
            let Rgb([x, y, z]) = *pixel;
            *pixel = Rgb([mixed(x, r), mixed(y, g), mixed(z, b)]);
        }
        Ok(())
    }
}

impl DrawingBackend for Raster<'_> {
    type ErrorType = image::ImageError;

    fn get_size(&self) -> (u32, u32) {
        self.size
    }

    fn ensure_prepared(&mut self) -> Done<Self::ErrorType> {
        Ok(())
    }

    fn present(&mut self) -> Done<Self::ErrorType> {
        let (width, height) = (self.size.0 * DENSITY, self.size.1 * DENSITY);
        let mut bytes = Cursor::new(Vec::new());
        resize(&self.canvas.0, width, height, FilterType::Triangle)
            .write_to(&mut bytes, ImageFormat::Png)
            .map_err(DrawingErrorKind::DrawingError)?;
        *self.png = bytes.into_inner();
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Done<Self::ErrorType> {
        let (x, y) = scaled(point);
        for (dx, dy) in (0..SCALE * SCALE).map(|index| (index % SCALE, index / SCALE)) {
            self.canvas.draw_pixel((x + dx, y + dy), color)?;
        }
        Ok(())
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Done<Self::ErrorType> {
        self.canvas.draw_line(scaled(from), scaled(to), &Wider::new(style))
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        low: BackendCoord,
        high: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done<Self::ErrorType> {
        self.canvas.draw_rect(scaled(low), scaled(high), &Wider::new(style), fill)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Done<Self::ErrorType> {
        self.canvas.draw_path(path.into_iter().map(scaled), &Wider::new(style))
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        center: BackendCoord,
        radius: u32,
        style: &S,
        fill: bool,
    ) -> Done<Self::ErrorType> {
        self.canvas.draw_circle(scaled(center), radius * SCALE as u32, &Wider::new(style), fill)
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        corners: I,
        style: &S,
    ) -> Done<Self::ErrorType> {
        self.canvas.fill_polygon(corners.into_iter().map(scaled), &Wider::new(style))
    }

    fn draw_text<T: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &T,
        point: BackendCoord,
    ) -> Done<Self::ErrorType> {
        let (width, height) = text_size(text, style.size());
        let left = match style.anchor().h_pos {
            HPos::Left => 0.0,
            HPos::Center => -0.5 * width,
            HPos::Right => -width,
        };
        let top = match style.anchor().v_pos {
            VPos::Top => 0.0,
            VPos::Center => -0.5 * height,
            VPos::Bottom => -height,
        };
        let scale = f64::from(SCALE);
        let dot = (CHARACTER.0 * style.size() * scale / 8.0, height * scale / 8.0);
        let origin = scaled(point);
        for (column, row) in lettering::dots_of(text) {
            let x = (left * scale + f64::from(column) * dot.0) as i32;
            let y = (top * scale + f64::from(row) * dot.1) as i32;
            let end = (x + dot.0.ceil() as i32, y + dot.1.ceil() as i32);
            for y in y..end.1 {
                for x in x..end.0 {
                    let (x, y) = style.transform().transform(x, y);
                    self.canvas.draw_pixel((origin.0 + x, origin.1 + y), style.color())?;
                }
            }
        }
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Self::ErrorType>> {
        let (width, height) = text_size(text, style.size());
        Ok((width.ceil() as u32, height.ceil() as u32))
    }
}

fn text_size(text: &str, size: f64) -> (f64, f64) {
    (text.chars().count() as f64 * CHARACTER.0 * size, CHARACTER.1 * size)
}
