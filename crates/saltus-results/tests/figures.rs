//! Figures stand whatever the data: well-formed, finite, inked, the same each time.
#![allow(clippy::unwrap_used)]

use saltus_results::{Axis, Cloud, Curves, Figure, History, Panel, Portrait, ResultsError};

const BAD: [f64; 5] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e308, -1e308];

fn axes() -> (Axis, Axis) {
    (Axis::new("x & <y> \u{7} (m)"), Axis::new("ζ_h (-)"))
}

/// Every kind of panel over the same data.
fn panels(x: &[f64], y: &[f64]) -> Vec<Panel> {
    let ((a, b), (c, d), (e, f)) = (axes(), axes(), axes());
    let logarithmic = (Axis::new("h").logarithmic(), Axis::new("e").logarithmic());
    let marked: Vec<bool> = (0..x.len()).map(|i| i % 2 == 0).collect();
    vec![
        Cloud::new("Cloud <b>", a, b)
            .series("one & two", x, y)
            .series("", y, x)
            .flag(1.0, "<flag>")
            .into(),
        Portrait::new("", c, d)
            .marked_path(("p", "q"), x, y, &marked)
            .path("r", y, x)
            .points("s", x, y)
            .into(),
        History::new("h", e, f)
            .curve("c", x, y)
            .shade("s", &[(0.1, 0.2), (0.15, f64::INFINITY), (f64::NAN, 1.0)])
            .level("l", f64::NAN)
            .level("m", 0.5)
            .into(),
        Curves::new("c", logarithmic.0, logarithmic.1)
            .line("a", x, y)
            .dotted_line("b", x, y)
            .dots("c", x, y)
            .into(),
    ]
}

fn noise(count: usize) -> (Vec<f64>, Vec<f64>) {
    // Weyl sequences fill the square evenly and need no random numbers.
    let along = |ratio: f64| (1..=count).map(|i| (i as f64 * ratio).fract()).collect();
    (along(0.618_033_988_749), along(0.754_877_666_246))
}

fn check_svg(svg: &str) {
    let tree =
        roxmltree::Document::parse(svg).unwrap_or_else(|error| panic!("{error}: {svg:.300}"));
    assert_eq!(tree.root_element().tag_name().name(), "svg");
    for word in ["NaN", "inf", "1e30"] {
        let found = tree
            .descendants()
            .flat_map(|node| node.attributes().collect::<Vec<_>>());
        let found: Vec<_> = found
            .filter(|a| a.value().contains(word))
            .map(|a| a.value().to_owned())
            .collect();
        assert!(found.is_empty(), "{word} in {found:?}");
    }
}

/// Width, height and the share of pixels that are not white.
fn inked(png: &[u8]) -> (u32, u32, f64) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(png))
        .read_info()
        .unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    let dark = pixels
        .chunks_exact(3)
        .filter(|pixel| pixel.iter().any(|&v| v < 250))
        .count();
    (
        info.width,
        info.height,
        dark as f64 / f64::from(info.width * info.height),
    )
}

#[test]
fn any_data_make_a_figure() {
    let constant = ([2.0; 9], [7.0; 9]);
    let (many_x, many_y) = noise(3000);
    let cases: [(&[f64], &[f64]); 7] = [
        (&[], &[]),
        (&BAD, &BAD),
        (&[1.0, 2.0, 3.0], &BAD),
        (&constant.0, &constant.1),
        (&[1.0], &[1.0, 2.0]),
        (&[1e-300, 2e-300, 5e-324], &[1e-12, 1e12, 0.0]),
        (&many_x, &many_y),
    ];
    for (x, y) in cases {
        let figure = Figure::grid(2, panels(x, y)).title("Title & <more>");
        check_svg(&figure.svg());
        // Rasterising is slow without optimisation; the drawing is what depends on the data.
        assert!(inked(&figure.plot_size(120.0, 90.0).png(0.6).unwrap()).2 > 0.005);
        for panel in panels(x, y) {
            check_svg(&Figure::new(panel).svg());
        }
    }
}

#[test]
fn an_empty_grid_is_a_sheet() {
    let figure = Figure::grid(0, []).title("Nothing yet");
    check_svg(&figure.svg());
    figure.png(1.0).unwrap();
}

#[test]
fn a_fixed_range_keeps_marks_inside_the_frame() {
    let (x, y) = noise(2000);
    let axis = || Axis::new("x").range(0.4, 0.6);
    let panels: [Panel; 2] = [
        Cloud::new("", axis(), axis())
            .series("a", &x[..], &y[..])
            .into(),
        Curves::new("", axis(), axis())
            .line("a", &x[..], &y[..])
            .into(),
    ];
    let svg = Figure::grid(2, panels).svg();
    let size: Vec<f64> = svg
        .split("viewBox=\"0 0 ")
        .nth(1)
        .unwrap()
        .split(['"', ' '])
        .take(2)
        .map(|v| v.parse().unwrap())
        .collect();
    for data in svg
        .split(" d=\"")
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap())
    {
        for point in data.split(['M', 'L']).skip(1) {
            let numbers: Vec<f64> = point
                .split([' ', 'v'])
                .map(|v| v.parse().unwrap())
                .collect();
            assert!(
                numbers[0] > 0.0
                    && numbers[0] < size[0]
                    && numbers[1] > 0.0
                    && numbers[1] < size[1],
                "{point}"
            );
        }
    }
}

#[test]
fn a_heavy_cloud_stays_light() {
    let (x, y) = noise(200_000);
    let (a, b) = axes();
    let cloud = Cloud::new("Noise", a, b)
        .series("1", &x[..], &y[..])
        .series("2", &y[..], &x[..]);
    let svg = Figure::new(cloud).svg();
    check_svg(&svg);
    assert!(svg.len() < 1_600_000, "{} bytes", svg.len());
}

#[test]
fn equal_figures_are_equal_bits() {
    let (x, y) = noise(500);
    let figure = || Figure::grid(2, panels(&x, &y)).plot_size(150.0, 120.0);
    assert_eq!(figure().svg(), figure().svg());
    assert_eq!(figure().png(1.5).unwrap(), figure().png(1.5).unwrap());
}

#[test]
fn svg_and_png_have_one_size_and_odd_scales_are_refused() {
    let (a, b) = axes();
    let figure = Figure::new(Cloud::new("t", a, b).series("s", [1.0, 2.0], [1.0, 2.0]));
    let svg = figure.svg();
    let (width, height, ink) = inked(&figure.png(2.0).unwrap());
    assert!(svg.contains(&format!("viewBox=\"0 0 {} {}\"", width / 2, height / 2)));
    assert!(ink > 0.005);
    for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 9.0] {
        assert!(
            matches!(figure.png(scale), Err(ResultsError::PngScale { .. })),
            "{scale}"
        );
    }
}
