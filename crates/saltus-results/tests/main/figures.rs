//! Figures stand whatever the data: well-formed, finite, inked, the same each time.

use saltus_results::{
    Axis, Bifurcation, BifurcationSet, Branches, Class, ClassMap, Cloud, Colour, Curves, Figure,
    FigureStyle, Grid, History, Panel, Portrait, ResultsError, Shares, ValueMap,
};

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
        ClassMap::new("m <i>", grid(x, y), [0, 1, 2, 1, 0, 3], two_classes())
            .shares()
            .into(),
        ValueMap::new("v", grid(y, x), x, Axis::new("v & <w> (m/s²)")).into(),
    ]
    .into_iter()
    .chain(dynamics(x, y, &marked))
    .collect()
}

/// Every kind of panel for branches, exponents and basins over the same data.
fn dynamics(x: &[f64], y: &[f64], stable: &[bool]) -> Vec<Panel> {
    let ((a, b), (c, d), (e, f)) = (axes(), axes(), axes());
    let branches = Branches::new("b <i>", a, b)
        .cloud("brute & force", y, x)
        .branch("p", x, stable, [y.to_vec(), x.to_vec()])
        .branch("", y, stable, []);
    let kinds = Bifurcation::ALL.into_iter().zip(x.iter().copied());
    let branches = kinds.fold(branches, |branches, (kind, x)| {
        branches.special(kind, "<PD>", x, y)
    });
    let set = BifurcationSet::over(ClassMap::new("", grid(x, y), [0, 1, 2], two_classes()))
        .curve(Bifurcation::Fold, "SN & <1>", x, y)
        .curve(Bifurcation::Grazing, "", y, x);
    let shares = Shares::new("s", c, x, d)
        .share("one & two", y)
        .share("t", x);
    let curves = Curves::new("λ", e, f.logarithmic())
        .line("a", x, y)
        .band("± <1>", y, x)
        .dots("b", x, y)
        .bars("& 95 %", x, y)
        .shade("chaos", &[(0.1, 0.2), (f64::NAN, 1.0)])
        .level("zero", 0.0);
    vec![branches.into(), set.into(), shares.into(), curves.into()]
}

/// A grid of up to nine cells.
fn grid(x: &[f64], y: &[f64]) -> Grid {
    let few = |values: &[f64]| values[..values.len().min(3)].to_vec();
    let (a, b) = axes();
    Grid::new(a, few(x), b, few(y))
}

fn two_classes() -> [Class; 2] {
    [
        Class::new("one & two", Colour::of_period(1)),
        Class::new("<three>", Colour::IRREGULAR),
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
            .filter(|a| a.name() != "href" && a.value().contains(word))
            .map(|a| a.value().to_owned())
            .collect();
        assert!(found.is_empty(), "{word} in {found:?}");
    }
}

/// Width, height and three bytes for each pixel.
fn pixels(png: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(png));
    decoder.set_transformations(png::Transformations::EXPAND);
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    (info.width, info.height, pixels)
}

/// Width, height and the share of pixels that are not white.
fn inked(png: &[u8]) -> (u32, u32, f64) {
    let (width, height, pixels) = pixels(png);
    let dark = pixels
        .chunks_exact(3)
        .filter(|pixel| pixel.iter().any(|&v| v < 250))
        .count();
    (width, height, dark as f64 / f64::from(width * height))
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
    let panels: [Panel; 4] = [
        Cloud::new("", axis(), axis())
            .series("a", &x[..], &y[..])
            .into(),
        Curves::new("", axis(), axis())
            .line("a", &x[..], &y[..])
            .band("b", &x[..], &y[..])
            .bars("c", &x[..], &y[..])
            .into(),
        Branches::new("", axis(), axis())
            .branch("a", &x[..], &[false; 2000], [y.clone()])
            .special(Bifurcation::Fold, "b", 0.5, &y[..])
            .into(),
        Shares::new("", axis(), [0.0, 1.0], axis())
            .share("a", [0.3, 0.9])
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
        for point in data.trim_end_matches('z').split(['M', 'L']).skip(1) {
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
    for scale in [0.0, -1.0, f32::NAN, f32::INFINITY, 33.0] {
        assert!(
            matches!(figure.png(scale), Err(ResultsError::PngScale { .. })),
            "{scale}"
        );
    }
}

/// The embedded image of a map, as [`pixels`].
fn image(svg: &str) -> (u32, u32, Vec<u8>) {
    let data = svg.split("data:image/png;base64,").nth(1).unwrap();
    let data = data.split('"').next().unwrap();
    let png = base64::Engine::decode(&base64::engine::general_purpose::STANDARD, data).unwrap();
    pixels(&png)
}

/// Columns and rows of the embedded image of a map, reduced to one pixel for each of `cells`.
fn embedded(svg: &str, cells: (usize, usize)) -> Vec<Colour> {
    let (width, height, pixels) = image(svg);
    let (across, down) = (width as usize / cells.0, height as usize / cells.1);
    assert_eq!(
        (across * cells.0, down * cells.1),
        (width as usize, height as usize)
    );
    let colour = |column: usize, row: usize| {
        let at = 3 * ((row * down + down / 2) * width as usize + column * across + across / 2);
        Colour(pixels[at], pixels[at + 1], pixels[at + 2])
    };
    let rows = (0..cells.1).flat_map(|row| (0..cells.0).map(move |column| (column, row)));
    rows.map(|(column, row)| colour(column, row)).collect()
}

fn letters(figure: &Figure) -> String {
    let svg = figure.svg();
    let tree = roxmltree::Document::parse(&svg).unwrap();
    let texts: Vec<&str> = tree
        .descendants()
        .filter(|node| node.ancestors().any(|above| above.has_tag_name("text")))
        .filter_map(|node| node.text())
        .map(str::trim)
        .collect();
    texts.join(" ")
}

#[test]
fn cells_lie_where_their_values_are() {
    let [one, two] = two_classes().map(|class| class.colour);
    let cells = [0, 0, 1, 0, 1, 9];
    let figure = |x: [f64; 3], y: [f64; 2]| {
        let grid = Grid::new(Axis::new("x"), x, Axis::new("y"), y);
        Figure::new(ClassMap::new("t", grid, cells, two_classes())).svg()
    };
    // Larger y is further up, whichever end the values begin at.
    let upright = [one, two, Colour::MISSING, one, one, two];
    assert_eq!(
        embedded(&figure([0.0, 1.0, 2.0], [0.0, 1.0]), (3, 2)),
        upright
    );
    let turned = [two, one, one, Colour::MISSING, two, one];
    assert_eq!(
        embedded(&figure([2.0, 1.0, 0.0], [1.0, 0.0]), (3, 2)),
        turned
    );
}

#[test]
fn cells_of_unequal_values_end_halfway_between_them() {
    let [one, two] = two_classes().map(|class| class.colour);
    // Columns end at -0.5, 0.5, 2, 5 and 9, rows at -0.5, 0.5, 2.5 and 5.5.
    let (x, y) = ([0.0, 1.0, 3.0, 7.0], [0.0, 1.0, 4.0]);
    let mut cells = [0; 12];
    cells[11] = 1;
    let grid = Grid::new(Axis::new("x"), x, Axis::new("y"), y);
    let figure = Figure::new(ClassMap::new("t", grid, cells, two_classes()));
    let (width, height, pixels) = image(&figure.svg());
    let (width, height) = (f64::from(width), f64::from(height));
    let colour = |x: f64, y: f64| {
        let (column, row) = (width * (x + 0.5) / 9.5, height * (5.5 - y) / 6.0);
        let at = 3 * (row as usize * width as usize + column as usize);
        Colour(pixels[at], pixels[at + 1], pixels[at + 2])
    };
    // Four pixels per unit of the sheet: a hundredth of a cell is more than a pixel.
    let (x, y) = ((5.0, 9.0), (2.5, 5.5));
    for near in [x.0 + 0.04, 7.0, x.1 - 0.04] {
        assert_eq!(
            (colour(near, y.0 + 0.04), colour(near, y.0 - 0.04)),
            (two, one)
        );
    }
    for near in [y.0 + 0.04, 4.0, y.1 - 0.04] {
        assert_eq!(
            (colour(x.0 + 0.04, near), colour(x.0 - 0.04, near)),
            (two, one)
        );
    }
}

#[test]
fn a_map_has_no_seams() {
    let [one, _] = two_classes().map(|class| class.colour);
    let side: Vec<f64> = (0..37).map(f64::from).collect();
    let grid = Grid::new(Axis::new("x"), &side[..], Axis::new("y"), &side[..]);
    let map = ClassMap::new("", grid, vec![0; 37 * 37], two_classes());
    let (width, height, pixels) =
        pixels(&Figure::new(map).plot_size(211.0, 157.0).png(1.3).unwrap());
    let inside = pixels
        .chunks_exact(3)
        .filter(|p| *p == [one.0, one.1, one.2])
        .count();
    // Less the frame of one unit; the legend has one patch more.
    let plot = (211.0 - 2.0) * (157.0 - 2.0) * 1.3 * 1.3;
    assert!(
        inside as f64 > plot && width > 270 && height > 200,
        "{inside} of {plot}"
    );
}

#[test]
fn the_legend_has_what_occurs_in_the_order_given_with_its_share() {
    let map = |cells: [u8; 8]| -> Panel {
        let grid = Grid::new(
            Axis::new("x"),
            [1.0, 2.0, 3.0, 4.0],
            Axis::new("y"),
            [1.0, 2.0],
        );
        let classes =
            ["first", "second", "third", "fourth"].map(|label| Class::new(label, Colour::SKY));
        ClassMap::new("", grid, cells, classes).shares().into()
    };
    let text = letters(&Figure::new(map([2, 2, 2, 2, 2, 0, 0, 0])));
    let (first, third) = (text.find("first (37.5 %)"), text.find("third (62.5 %)"));
    assert!(first.is_some() && first < third, "{text}");
    assert!(
        !text.contains("second") && !text.contains("fourth") && !text.contains("No value"),
        "{text}"
    );
    let text = letters(&Figure::grid(2, [map([2; 8]), map([1; 8])]));
    assert!(
        text.find("second (50.0 %)") < text.find("third (50.0 %)"),
        "{text}"
    );
}

#[test]
fn a_colour_bar_says_what_colours_mean() {
    let map = |values: [f64; 4]| {
        let grid = Grid::new(Axis::new("x"), [0.9, 1.1], Axis::new("y"), [0.1, 0.5]);
        ValueMap::new(
            "",
            grid,
            values,
            Axis::new("Contact ratio (-)").range(0.0, 1.0),
        )
        .missing("Failed")
    };
    let text = letters(&Figure::new(map([0.0, 0.3, 1.0, 1.0])));
    for word in ["Contact ratio", "0.0", "0.2", "1.0"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    assert!(!text.contains("Failed"), "{text}");
    let figure = Figure::new(map([f64::NAN, 0.3, 7.0, 0.0]));
    assert!(letters(&figure).contains("Failed"));
    let colours = embedded(&figure.svg(), (2, 2));
    // The top row is that of y = 0.5; what lies beyond the limits has the colour of the end.
    assert_eq!(colours[0], Colour(253, 231, 37));
    assert_eq!(colours[2], Colour::MISSING);
}

#[test]
fn useless_grids_make_an_empty_map() {
    let (a, b) = axes();
    let (nan, none) = ([f64::NAN, 1.0], [0.0; 0]);
    for x in [&nan[..], &none[..], &[1.0, 1.0], &[1.0, 2.0, 1.5]] {
        let grid = Grid::new(a.clone(), x, b.clone(), [1.0, 2.0]);
        let figure = Figure::new(ClassMap::new("t", grid, [0_u8; 6], two_classes()));
        check_svg(&figure.svg());
        figure.png(0.6).unwrap();
    }
}

/// How many pixels of the figure have this very colour, at one pixel per unit.
fn count(figure: &Figure, colour: Colour) -> usize {
    let (_, _, pixels) = pixels(&figure.png(1.0).unwrap());
    let wanted = [colour.0, colour.1, colour.2];
    pixels.chunks_exact(3).filter(|p| **p == wanted).count()
}

/// An axis from 0 to 1.
fn unit(label: &str) -> Axis {
    Axis::new(label).range(0.0, 1.0)
}

#[test]
fn unstable_parts_are_broken_and_stable_ones_whole() {
    // The step from 0.4 to 0.5 has an unstable end: the stable part is 0.4 of the width.
    let x: Vec<f64> = (0..=10).map(|i| f64::from(i) / 10.0).collect();
    let stable: Vec<bool> = (0..=10).map(|i| i < 5).collect();
    let figure = |stable: &[bool]| {
        let branches = Branches::new("", unit("x"), unit("y"));
        Figure::new(branches.branch("", &x[..], stable, [vec![0.5; 11]])).plot_size(400.0, 200.0)
    };
    // A line of 1.9 px has its full colour in one row of pixels at least.
    let inked = |stable: &[bool]| count(&figure(stable), Colour::BLUE) as f64;
    let (whole, mixed, broken) = (inked(&[true; 11]), inked(&stable), inked(&[false; 11]));
    // Of 11 px the pen rests 4.5, and the pixels at round ends have not the full colour.
    let share = broken / whole;
    assert!((share - 6.5 / 11.0).abs() < 0.04, "{share}");
    let expected = 0.4 * whole + 0.6 * broken;
    assert!(
        (mixed - expected).abs() < 0.02 * whole,
        "{mixed} for {expected}"
    );
    let text = letters(&figure(&[true; 11]));
    assert!(
        text.contains("Stable") && !text.contains("Unstable"),
        "{text}"
    );
}

#[test]
fn branches_of_one_label_share_a_colour_and_the_legend_names_what_occurs() {
    let (x, stable) = ([0.0, 1.0], [true, true]);
    let branches = Branches::new("", unit("x"), unit("y"))
        .branch("Period 1", x, &stable, [vec![0.2; 2]])
        .branch("Period 2", x, &stable, [vec![0.4; 2], vec![0.6; 2]])
        .branch("Period 1", x, &stable, [vec![0.8; 2]])
        .special(Bifurcation::Grazing, "G1", 0.5, [0.2]);
    let figure = Figure::new(branches);
    let text = letters(&figure);
    // `letters` sees each text as that of its element and as itself.
    assert_eq!(text.matches("Period 1").count(), 2, "{text}");
    assert!(text.contains("Grazing") && text.contains("G1"), "{text}");
    for absent in ["Fold", "Unstable", "Period doubling"] {
        assert!(!text.contains(absent), "{absent}: {text}");
    }
    let (one, two) = (
        count(&figure, Colour::BLUE),
        count(&figure, Colour::VERMILLION),
    );
    // Each period has two lines; a symbol hides some pixels of one.
    assert!(one.abs_diff(two) < 40 && one > 1400, "{one} {two}");
    assert_eq!(count(&figure, Colour::GREEN), 0);
}

#[test]
fn a_crowd_of_labels_loses_some_and_keeps_all_symbols() {
    let crowd = (0..60).fold(Branches::new("", unit("x"), unit("y")), |crowd, i| {
        crowd.special(Bifurcation::Fold, format!("SN{i}"), 0.5, [0.5])
    });
    let figure = Figure::new(crowd);
    let shown = letters(&figure).matches("SN").count() / 2;
    assert!((3..60).contains(&shown), "{shown}");
    // A symbol is one area; the legend has one more.
    assert_eq!(figure.svg().matches("fill=\"#000000\"/>").count(), 61);
}

#[test]
fn a_map_keeps_its_axes_below_curves() {
    let map = || {
        let grid = Grid::new(Axis::new("x"), [0.0, 1.0], Axis::new("y"), [0.0, 1.0]);
        ClassMap::new("", grid, [0, 1, 1, 0], two_classes())
    };
    let far = [-7.0, 9.0];
    let set = BifurcationSet::over(map()).curve(Bifurcation::NeimarkSacker, "NS", far, far);
    let (alone, below) = (Figure::new(map()), Figure::new(set));
    assert_eq!(
        embedded(&alone.svg(), (2, 2)),
        embedded(&below.svg(), (2, 2))
    );
    let text = letters(&below);
    let ticks = letters(&alone);
    assert!(ticks.contains("1.4") && !text.contains("9"), "{text}");
    assert!(text.contains("NS") && text.contains("Neimark"), "{text}");
    assert!(count(&below, Bifurcation::NeimarkSacker.colour()) > 700);
}

#[test]
fn a_cycle_shows_in_front_of_chaos_whatever_the_order() {
    let (x, y) = noise(60_000);
    let line: Vec<f64> = (0..2000).map(|i| f64::from(i) / 2000.0).collect();
    let cycle = |cloud: Cloud| cloud.series("cycle", &line[..], vec![0.5; 2000]);
    let chaos = |cloud: Cloud| cloud.series("chaos", &x[..], &y[..]);
    let empty = || Cloud::new("", unit("x"), unit("y")).apart();
    let [first, second] = [0, 1].map(|number| Colour::ATTRACTORS[number]);
    let below = count(&Figure::new(cycle(chaos(empty()))), second);
    let above = count(&Figure::new(chaos(cycle(empty()))), first);
    assert!(below > 700 && above.abs_diff(below) < 20, "{above} {below}");
}

#[test]
fn shares_that_add_up_fill_the_frame_without_seams() {
    let at = [0.0, 0.3, 1.0];
    let stack = Shares::new("", unit("x"), at, unit("y"))
        .share("one", [0.2, 0.7, 0.4])
        .share("two", [0.8, 0.3, 0.6])
        .colour(Colour::ORANGE);
    let figure = Figure::new(stack).plot_size(211.0, 157.0);
    let (one, two) = (
        count(&figure, Colour::ATTRACTORS[0]),
        count(&figure, Colour::ORANGE),
    );
    let plot = 209.0 * 155.0;
    // Along the border between both, two pixels a column at most have neither colour.
    let both = (one + two) as f64;
    assert!(
        both > plot - 3.0 * 211.0 && both < plot + 600.0,
        "{both} of {plot}"
    );
    // The mean of the first share by the trapezoidal rule; its patch in the legend is some 200 pixels.
    let share = one as f64 / both;
    assert!((share - 0.52).abs() < 0.02, "{share}");
}

#[test]
fn a_share_that_is_not_known_leaves_a_gap_above_it() {
    let at: Vec<f64> = (0..=10).map(|i| f64::from(i) / 10.0).collect();
    let mut unknown = vec![0.3; 11];
    unknown[5] = f64::NAN;
    let figure = |upper: &[f64]| {
        let stack = Shares::new("", unit("x"), &at[..], unit("y"));
        let stack = stack.share("low", vec![0.5; 11]).share("high", upper);
        Figure::new(stack).plot_size(400.0, 200.0)
    };
    let [low, high] = [0, 1].map(|number| Colour::ATTRACTORS[number]);
    let (whole, gap) = (figure(&[0.3; 11]), figure(&unknown));
    assert_eq!(count(&whole, low), count(&gap, low));
    let (whole, gap) = (count(&whole, high) as f64, count(&gap, high) as f64);
    // Two of ten steps are lost; the legend's patch counts a little.
    assert!((gap / whole - 0.8).abs() < 0.02, "{gap} of {whole}");
}

#[test]
fn a_band_and_bars_reach_from_low_to_high() {
    let x: Vec<f64> = (0..=20).map(|i| f64::from(i) / 20.0).collect();
    let curves = || Curves::new("", unit("x"), unit("y")).line("λ", &x[..], vec![0.5; 21]);
    let plot = |curves: Curves| Figure::new(curves).plot_size(400.0, 200.0);
    let (low, high) = (vec![0.3; 21], vec![0.7; 21]);
    let banded = plot(curves().band("± one standard error", &low[..], &high[..]));
    // A quarter of blue over white, as the backend rounds it.
    let (_, _, seen) = pixels(&banded.png(1.0).unwrap());
    let tinted =
        |p: &&[u8]| p[0].abs_diff(191) < 3 && p[1].abs_diff(220) < 3 && p[2].abs_diff(236) < 3;
    let area = seen.chunks_exact(3).filter(tinted).count() as f64;
    // 80 of 200 rows, less the line and a line of the grid each tenth or so.
    assert!((0.85..1.0).contains(&(area / (400.0 * 80.0))), "{area}");
    let barred = plot(curves().bars("95 %", &low[..], &high[..]));
    let more = inked(&barred.png(1.0).unwrap()).2 > inked(&plot(curves()).png(1.0).unwrap()).2;
    assert!(more && letters(&barred).contains("95 %") && letters(&banded).contains("± one"));
}

#[test]
fn intervals_by_label_have_colours_of_their_own() {
    let curves = Curves::new("", unit("x"), unit("y"))
        .shade("Periodic", &[(0.0, 0.5)])
        .shade("Chaotic", &[(0.5, 1.0)])
        .level("Zero", 0.0);
    let figure = Figure::new(curves);
    let svg = figure.svg();
    for colour in [Colour::SKY, Colour::VERMILLION, Colour::YELLOW] {
        let shades = svg.matches(&format!("fill=\"{}\"", colour.hex())).count();
        // One in the frame and one in the legend.
        assert_eq!(shades, if colour == Colour::VERMILLION { 0 } else { 2 });
    }
    let text = letters(&figure);
    assert!(
        ["Periodic", "Chaotic", "Zero"]
            .iter()
            .all(|word| text.contains(word)),
        "{text}"
    );
}

#[test]
fn dots_over_few_values_are_wide_and_over_many_as_fine_as_any() {
    let inked = |cloud: Cloud| {
        let dots = cloud.series("dots", [0.2, 0.5, 0.8], [0.5; 3]);
        count(&Figure::new(dots), Colour::ATTRACTORS[0])
    };
    let empty = || Cloud::new("", unit("x"), unit("y"));
    let [few, many, fine] = [
        empty().apart_over(3),
        empty().apart_over(9999),
        empty().apart(),
    ]
    .map(inked);
    assert_eq!(many, fine);
    // three discs of 5 px instead of 2.2, and wider in the legend too
    assert!(few > many + 20, "{few} {many}");
}

#[test]
fn a_figure_has_the_width_asked_for_in_every_format() {
    let (x, y) = noise(400);
    let style = FigureStyle::default();
    let style = style.width("85mm").expect("a width");
    for figure in [
        Figure::grid(2, panels(&x, &y)).title("Long title of a figure that has to be broken"),
        Figure::new(Cloud::new("t", unit("x"), unit("y")).series("s", &x[..], &y[..])),
    ] {
        let figure = figure.style(style.titles(false));
        let svg = figure.svg();
        check_svg(&svg);
        assert!(svg.contains("width=\"85mm\""), "{svg:.300}");
        assert!(!letters(&figure).contains("Long title"));
        // 85 mm at 600 to an inch; the sheet has whole pixels
        let (width, ..) = pixels(&figure.png(2.0).expect("a PNG"));
        assert!(width.abs_diff(2008) < 3, "{width}");
        let pdf = figure.pdf();
        let text = String::from_utf8_lossy(&pdf);
        let page = text.split("/MediaBox [0 0 ").nth(1).expect("a page");
        let points: f64 = page
            .split(' ')
            .next()
            .unwrap_or("")
            .parse()
            .expect("a width");
        assert!((points - 240.945).abs() < 0.01, "{points}");
    }
}

#[test]
fn a_poster_has_fewer_pixels_to_an_inch_and_no_figure_is_refused() {
    let tall = || {
        Figure::grid(
            1,
            (0..6).map(|_| Curves::new("", unit("x"), unit("y")).into()),
        )
    };
    for (width, font) in [("1000mm", "4pt"), ("30mm", "36pt")] {
        let style = FigureStyle::default().width(width).expect("a width");
        let figure = tall().style(style.font_size(font).expect("a size"));
        let png = figure
            .png(2.0)
            .unwrap_or_else(|error| panic!("{width}: {error}"));
        assert!(png.len() > 1000, "{width}");
        check_svg(&figure.svg());
    }
}

#[test]
fn panels_to_be_compared_share_their_scales() {
    let panel = |y: [f64; 2]| -> Panel {
        let axes = (Axis::new("x"), Axis::new("y"));
        Curves::new("", axes.0, axes.1)
            .line("a", [0.0, 1.0], y)
            .into()
    };
    let both = || Figure::grid(2, [panel([0.0, 1.0]), panel([0.0, 70.0])]);
    // on two horizontal axes, and of its own on the vertical one of the first panel
    let ones = |figure: &Figure| letters(figure).matches("1.0 1.0").count();
    assert_eq!((ones(&both()), ones(&both().same_scales())), (3, 2));
}
