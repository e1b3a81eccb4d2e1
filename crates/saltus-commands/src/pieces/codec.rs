//! Numbers and words as bytes: what the content of a piece is made of. Numbers come back to the bit.

use saltus::orbits::{Exponent, MotionKind};

/// Code for none.
const NO_EXPONENT: Exponent = Exponent {
    per_iterate: 0.0,
    standard_error: 0.0,
    batches: 0,
    batch_length: 0,
};

/// Appends to the content of a piece.
pub(crate) struct Writer<'a>(&'a mut Vec<u8>);

impl<'a> Writer<'a> {
    pub(crate) fn new(to: &'a mut Vec<u8>) -> Self {
        Self(to)
    }
    pub(crate) fn whole(&mut self, value: u64) {
        self.0.extend(value.to_le_bytes());
    }
    pub(crate) fn numbers(&mut self, values: &[f64]) {
        values.iter().for_each(|v| self.whole(v.to_bits()));
    }
    pub(crate) fn kind(&mut self, kind: MotionKind) {
        self.whole(kind.code() as u64);
        self.whole(kind.period().unwrap_or(0).into());
    }
    pub(crate) fn exponent(&mut self, exponent: Option<Exponent>) {
        let (there, e) = (exponent.is_some(), exponent.unwrap_or(NO_EXPONENT));
        self.whole(there.into());
        self.numbers(&[e.per_iterate, e.standard_error]);
        self.whole(e.batches as u64);
        self.whole(e.batch_length as u64);
    }
    pub(crate) fn text(&mut self, text: &str) {
        self.whole(text.len() as u64);
        self.0.extend(text.as_bytes());
    }
}

/// Takes off the content of a piece; every method gives `None` if it is not there.
pub(crate) struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    pub(crate) fn new(from: &'a [u8]) -> Self {
        Self(from)
    }
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
    pub(crate) fn whole(&mut self) -> Option<u64> {
        let (first, rest) = self.0.split_first_chunk::<8>()?;
        self.0 = rest;
        Some(u64::from_le_bytes(*first))
    }
    pub(crate) fn number(&mut self) -> Option<f64> {
        self.whole().map(f64::from_bits)
    }
    pub(crate) fn numbers(&mut self, count: usize) -> Option<Vec<f64>> {
        (0..count).map(|_| self.number()).collect()
    }
    /// `lists` lists of `numbers` numbers each.
    pub(crate) fn lists(&mut self, lists: usize, numbers: usize) -> Option<Vec<Vec<f64>>> {
        (0..lists).map(|_| self.numbers(numbers)).collect()
    }
    pub(crate) fn kind(&mut self) -> Option<MotionKind> {
        let (kind, period) = (self.whole()?, self.whole()?);
        Some(match kind {
            0 => MotionKind::Periodic(u32::try_from(period).ok()?),
            1 => MotionKind::QuasiPeriodic,
            2 => MotionKind::Chaotic,
            3 => MotionKind::NotPeriodic,
            4 => MotionKind::Undecided,
            _ => return None,
        })
    }
    pub(crate) fn exponent(&mut self) -> Option<Option<Exponent>> {
        let there = self.whole()? != 0;
        let exponent = Exponent {
            per_iterate: self.number()?,
            standard_error: self.number()?,
            batches: usize::try_from(self.whole()?).ok()?,
            batch_length: usize::try_from(self.whole()?).ok()?,
        };
        Some(there.then_some(exponent))
    }
    pub(crate) fn text(&mut self) -> Option<String> {
        let length = usize::try_from(self.whole()?).ok()?;
        let (text, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        String::from_utf8(text.to_vec()).ok()
    }
}
