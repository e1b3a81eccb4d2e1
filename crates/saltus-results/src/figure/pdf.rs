//! The PDF backend: one page of the size of the figure. Type is drawn as outlines, so that it looks the same everywhere
//! and no font is embedded; cells and shades are images.

use super::colour::Colour;
use super::ink::{Density, Drawing, Ink, Step, Type};
use super::mosaic::Mosaic;
use super::style::{HALO, RIM};
use super::typeface::Curve;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, TextStr};
use std::io::Write;

/// Points of a unit of the SVG where the figure has no size in print: CSS has 96 pixels to an inch.
const POINT: f64 = 0.75;

/// The drawing as a document.
pub(crate) fn pdf(drawing: &Drawing) -> Vec<u8> {
    let point = drawing.point.unwrap_or(POINT);
    let [catalog, pages, page, content, info] = [1, 2, 3, 4, 5].map(Ref::new);
    let mut sheet = Sheet {
        pdf: Pdf::new(),
        content: Content::new(),
        next: 6,
        images: Vec::new(),
        opacities: Vec::new(),
    };
    // The sheet counts downwards in pixels, a page upwards in points.
    let (unit, top) = (point as f32, (point * drawing.height) as f32);
    sheet.content.transform([unit, 0.0, 0.0, -unit, 0.0, top]);
    sheet.content.set_line_cap(LineCapStyle::RoundCap);
    sheet.content.set_line_join(LineJoinStyle::RoundJoin);
    drawing.ink.iter().for_each(|mark| sheet.draw(mark));

    let Sheet {
        mut pdf,
        content: drawn,
        images,
        opacities,
        ..
    } = sheet;
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let mut one = pdf.page(page);
    one.media_box(Rect::new(0.0, 0.0, (point * drawing.width) as f32, top));
    one.parent(pages);
    one.contents(content);
    let mut resources = one.resources();
    let mut objects = resources.x_objects();
    for image in images {
        objects.pair(Name(name('I', image.get()).as_bytes()), image);
    }
    objects.finish();
    let mut states = resources.ext_g_states();
    for opacity in opacities {
        let state = name('O', i32::from(opacity));
        let mut state = states
            .insert(Name(state.as_bytes()))
            .start::<pdf_writer::writers::ExtGraphicsState>();
        state.non_stroking_alpha(f32::from(opacity) / 255.0);
    }
    states.finish();
    resources.finish();
    one.finish();
    let packed = packed(&drawn.finish());
    pdf.stream(content, &packed).filter(Filter::FlateDecode);
    let mut about = pdf.document_info(info);
    about.title(TextStr(&drawing.title));
    about.subject(TextStr(&drawing.description));
    about.creator(TextStr("saltus"));
    about.finish();
    pdf.finish()
}

/// A resource's name on the page.
fn name(kind: char, number: i32) -> String {
    format!("{kind}{number}")
}

/// Compressed bytes; writing to memory does not fail.
fn packed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    let _ = encoder.write_all(bytes);
    encoder.finish().unwrap_or_default()
}

/// A document in the making.
struct Sheet {
    pdf: Pdf,
    content: Content,
    next: i32,
    images: Vec<Ref>,
    /// Opacities in use, of 255.
    opacities: Vec<u8>,
}

impl Sheet {
    fn draw(&mut self, mark: &Ink) {
        match mark {
            Ink::Trail {
                steps,
                width,
                colour,
            } => {
                self.pen(*colour, *width);
                self.path(steps.iter().copied());
                self.content.stroke();
            }
            Ink::Dot {
                centre,
                radius,
                colour,
            } => self.dot(*centre, *radius, *colour),
            Ink::Area {
                corners,
                colour,
                opacity,
            } => self.area(corners, *colour, *opacity),
            Ink::Type(letters) => self.text(letters),
            Ink::Mosaic(mosaic) => self.cells(mosaic),
            Ink::Density(density) => self.shades(density),
        }
    }

    fn pen(&mut self, Colour(red, green, blue): Colour, width: f64) {
        let [r, g, b] = [red, green, blue].map(|channel| f32::from(channel) / 255.0);
        self.content.set_stroke_rgb(r, g, b);
        self.content.set_line_width(width as f32);
    }

    fn fill(&mut self, Colour(red, green, blue): Colour) {
        let [r, g, b] = [red, green, blue].map(|channel| f32::from(channel) / 255.0);
        self.content.set_fill_rgb(r, g, b);
    }

    fn path(&mut self, steps: impl Iterator<Item = Step>) {
        for step in steps {
            match step {
                Step::Move(x, y) => self.content.move_to(short(x), short(y)),
                Step::Line(x, y) => self.content.line_to(short(x), short(y)),
            };
        }
    }

    fn curves(&mut self, curves: impl Iterator<Item = Curve>) {
        for curve in curves {
            match curve {
                Curve::Move((x, y)) => self.content.move_to(short(x), short(y)),
                Curve::Line((x, y)) => self.content.line_to(short(x), short(y)),
                Curve::Cubic(a, b, c) => {
                    let [(x1, y1), (x2, y2), (x, y)] = [a, b, c].map(|(x, y)| (short(x), short(y)));
                    self.content.cubic_to(x1, y1, x2, y2, x, y)
                }
                Curve::Close => self.content.close_path(),
            };
        }
    }

    /// A disc of the colour, and its white rim.
    fn dot(&mut self, (x, y): (f64, f64), radius: f64, colour: Colour) {
        // Four Bézier curves are round to 0.03 %.
        let arm = 0.5523 * radius;
        let r = radius;
        self.fill(colour);
        self.pen(Colour(255, 255, 255), RIM);
        self.curves(
            [
                Curve::Move((x + r, y)),
                Curve::Cubic((x + r, y + arm), (x + arm, y + r), (x, y + r)),
                Curve::Cubic((x - arm, y + r), (x - r, y + arm), (x - r, y)),
                Curve::Cubic((x - r, y - arm), (x - arm, y - r), (x, y - r)),
                Curve::Cubic((x + arm, y - r), (x + r, y - arm), (x + r, y)),
                Curve::Close,
            ]
            .into_iter(),
        );
        self.content.fill_nonzero_and_stroke();
    }

    fn area(&mut self, corners: &[(f64, f64)], colour: Colour, opacity: f64) {
        let opacity = (opacity * 255.0).round().clamp(0.0, 255.0) as u8;
        self.content.save_state();
        if opacity < 255 {
            if !self.opacities.contains(&opacity) {
                self.opacities.push(opacity);
            }
            let state = name('O', i32::from(opacity));
            self.content.set_parameters(Name(state.as_bytes()));
        }
        self.fill(colour);
        let steps = corners.iter().enumerate();
        self.path(steps.map(|(number, &(x, y))| match number {
            0 => Step::Move(x, y),
            _ => Step::Line(x, y),
        }));
        self.content.close_path().fill_nonzero();
        self.content.restore_state();
    }

    fn text(&mut self, letters: &Type) {
        if letters.rim {
            self.pen(Colour(255, 255, 255), HALO);
            self.curves(letters.outlines());
            self.content.stroke();
        }
        self.fill(letters.colour);
        self.curves(letters.outlines());
        self.content.fill_nonzero();
    }

    fn cells(&mut self, mosaic: &Mosaic) {
        let raster = mosaic.blocks();
        let codes = mosaic.sample(raster).into_iter();
        let colours = codes.map(|code| mosaic.colours[usize::from(code)]);
        let bytes: Vec<u8> = colours.flat_map(|c| [c.0, c.1, c.2]).collect();
        self.image(mosaic.shown, raster.size, &bytes, None);
    }

    fn shades(&mut self, density: &Density) {
        let Colour(red, green, blue) = density.colour;
        let bytes = [red, green, blue].repeat(density.shades.len());
        let shades = Some(&density.shades[..]);
        self.image(density.sides, density.size, &bytes, shades);
    }

    /// An image of three bytes a pixel, with an opacity for each if `shades` are given.
    fn image(
        &mut self,
        [left, top, right, bottom]: [f64; 4],
        size: (usize, usize),
        bytes: &[u8],
        shades: Option<&[u8]>,
    ) {
        let [image, mask] = [self.next, self.next + 1].map(Ref::new);
        self.next += 2;
        let size = (size.0 as i32, size.1 as i32);
        let bytes = packed(bytes);
        let mut object = self.pdf.image_xobject(image, &bytes);
        object.filter(Filter::FlateDecode);
        object.width(size.0).height(size.1).bits_per_component(8);
        object.color_space().device_rgb();
        if shades.is_some() {
            object.s_mask(mask);
        }
        object.finish();
        if let Some(shades) = shades {
            let shades = packed(shades);
            let mut object = self.pdf.image_xobject(mask, &shades);
            object.filter(Filter::FlateDecode);
            object.width(size.0).height(size.1).bits_per_component(8);
            object.color_space().device_gray();
        }
        self.images.push(image);
        let (wide, high) = ((right - left) as f32, (bottom - top) as f32);
        self.content.save_state();
        // An image is the unit square with its first row at the top.
        let place = [wide, 0.0, 0.0, -high, left as f32, bottom as f32];
        self.content.transform(place);
        self.content
            .x_object(Name(name('I', image.get()).as_bytes()));
        self.content.restore_state();
    }
}

/// A coordinate to a thousandth of a pixel.
fn short(value: f64) -> f32 {
    ((value * 1000.0).round() / 1000.0) as f32
}
