//! Colours that people with colour-blindness can tell apart: the palette of Okabe & Ito (2008).

/// A solid colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(
    /// Red, 0 to 255.
    pub u8,
    /// Green, 0 to 255.
    pub u8,
    /// Blue, 0 to 255.
    pub u8,
);

impl Colour {
    /// Okabe-Ito black.
    pub const BLACK: Self = Self(0, 0, 0);
    /// Okabe-Ito orange.
    pub const ORANGE: Self = Self(230, 159, 0);
    /// Okabe-Ito sky blue.
    pub const SKY: Self = Self(86, 180, 233);
    /// Okabe-Ito bluish green.
    pub const GREEN: Self = Self(0, 158, 115);
    /// Okabe-Ito yellow; weak on white, so in no automatic order.
    pub const YELLOW: Self = Self(240, 228, 66);
    /// Okabe-Ito blue.
    pub const BLUE: Self = Self(0, 114, 178);
    /// Okabe-Ito vermillion.
    pub const VERMILLION: Self = Self(213, 94, 0);
    /// Okabe-Ito reddish purple.
    pub const PURPLE: Self = Self(204, 121, 167);
    /// Neutral grey for lines that carry other marks.
    pub const GREY: Self = Self(140, 140, 140);
    /// Dark grey for reference lines.
    pub const DARK: Self = Self(70, 70, 70);

    /// Order for curves: the first colours are the darkest on white.
    pub(crate) const CURVES: [Self; 7] = [
        Self::BLUE,
        Self::VERMILLION,
        Self::GREEN,
        Self::PURPLE,
        Self::ORANGE,
        Self::SKY,
        Self::BLACK,
    ];

    /// Order for nested marks: light below, dark on top.
    pub(crate) const NESTED: [Self; 6] = [
        Self::SKY,
        Self::VERMILLION,
        Self::BLACK,
        Self::GREEN,
        Self::PURPLE,
        Self::ORANGE,
    ];

    /// Order for stroboscopic points over a thin line.
    pub(crate) const POINTS: [Self; 5] = [
        Self::VERMILLION,
        Self::BLUE,
        Self::BLACK,
        Self::GREEN,
        Self::PURPLE,
    ];

    /// The colour for number `index` of `order`, starting over at its end.
    pub(crate) fn of(order: &[Self], index: usize) -> Self {
        order[index % order.len()]
    }

    /// As written in SVG: `#rrggbb`.
    pub fn hex(self) -> String {
        format!("#{:02x}{:02x}{:02x}", self.0, self.1, self.2)
    }
}

impl From<Colour> for kuva::render::color::Color {
    fn from(colour: Colour) -> Self {
        Self::Rgb(colour.0, colour.1, colour.2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hex_is_what_svg_reads() {
        assert_eq!(Colour::VERMILLION.hex(), "#d55e00");
        assert_eq!(Colour::of(&Colour::CURVES, 7), Colour::BLUE);
    }
}
