//! Writes a program out as Rust.

use std::fmt::{Result, Write};

use crate::structure::{Cubic, Group, Op, Place, Rate, Step, Structure};

/// The key of a program: 64-bit FNV-1a of all that the code depends on.
pub(super) fn key(structure: &Structure) -> u64 {
    let text = format!(
        "{:?}",
        (
            structure.states,
            structure.slots,
            &structure.program,
            &structure.guard_program,
            &structure.groups,
            &structure.cubics,
            &structure.terms,
            &structure.keeps,
            &structure.rates,
            &structure.state_copies,
            structure.stream.len(),
        )
    );
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// The straight-line code of a program; `None` if it has an operation that is not written out.
pub(crate) fn source(structure: &Structure) -> Option<String> {
    let mut out = String::new();
    Writer {
        structure,
        out: &mut out,
    }
    .file()
    .ok()?;
    Some(out)
}

struct Writer<'a> {
    structure: &'a Structure,
    out: &'a mut String,
}

impl Writer<'_> {
    fn file(&mut self) -> Result {
        self.head()?;
        self.order()?;
        self.guards()
    }

    /// Writes the constants of the program, and the loop over the orders.
    fn head(&mut self) -> Result {
        let s = self.structure;
        write!(
            self.out,
            r"//! Written by `cargo run --release -p saltus --example specialise`; not to be edited.

#[allow(unused_imports)]
use super::sums::{{products, squares_and_products, term}};
use crate::arith::Arith;

pub(super) const KEY: u64 = {:#018x};
const SLOTS: usize = {};
const STREAM: usize = {};

#[inline(always)]
pub(super) fn expand<A: Arith>(a: A, c: &[A::Cell], kept: &mut [A::Cell]) {{
    let Some(c) = c.first_chunk::<STREAM>() else {{ return }};
    let rows = kept.as_chunks_mut::<SLOTS>().0;
    let Some((first, rest)) = rows.split_first_mut() else {{ return }};
    let Some(next) = rest.first_mut() else {{ return }};
",
            key(s),
            s.slots,
            s.stream.len()
        )?;
        for &(state, slot) in &s.state_copies {
            let from = s.state_slots[state];
            writeln!(self.out, "    first[{slot}] = first[{from}];")?;
        }
        self.out.write_str(
            r"    order::<A, true>(a, c, &[], first, next, a.splat(1.0));
    let last = rows.len() - 1;
    for k in 1..last {
        let (past, rest) = rows.split_at_mut(k);
        let [row, next, ..] = rest else { return };
        order::<A, false>(a, c, past, row, next, a.splat(1.0 / (k + 1) as f64));
    }
    let (past, rest) = rows.split_at_mut(last);
    if let [row] = rest { guards(a, c, past, row) }
}
",
        )
    }

    /// Writes one order of all nodes, and the next one of the states.
    fn order(&mut self) -> Result {
        let s = self.structure;
        self.out.write_str(
            r"
#[cfg_attr(not(unoptimised), inline(always))]
fn order<A: Arith, const FIRST: bool>(
    a: A,
    c: &[A::Cell; STREAM],
    past: &[[A::Cell; SLOTS]],
    row: &mut [A::Cell; SLOTS],
    next: &mut [A::Cell; SLOTS],
    factor: A::V,
) {
    let z = a.splat(0.0);
",
        )?;
        self.program(&s.program, "if FIRST { a.load(&c[{}]) } else { z }")?;
        for (state, Rate { node, slot }) in s.rates.iter().enumerate() {
            writeln!(self.out, "    let m{state} = a.mul(n{node}, factor);")?;
            writeln!(self.out, "    next[{slot}] = a.store(m{state});")?;
        }
        for (state, slot) in &s.state_copies {
            writeln!(self.out, "    next[{slot}] = a.store(m{state});")?;
        }
        self.out.write_str("}\n")
    }

    /// Writes the last order, of the guards alone.
    fn guards(&mut self) -> Result {
        self.out.write_str(
            r"
#[cfg_attr(not(unoptimised), inline(always))]
fn guards<A: Arith>(
    a: A,
    c: &[A::Cell; STREAM],
    past: &[[A::Cell; SLOTS]],
    row: &mut [A::Cell; SLOTS],
) {
    let (z, _) = (a.splat(0.0), past);
",
        )?;
        self.program(&self.structure.guard_program, "z")?;
        self.out.write_str("}\n")
    }

    fn program(&mut self, program: &[Step], constant: &str) -> Result {
        let s = self.structure;
        for (state, slot) in s.state_slots.iter().enumerate() {
            writeln!(self.out, "    let n{state} = a.load(&row[{slot}]);")?;
        }
        for step in program {
            match &step.op {
                Op::Linear { groups } => {
                    for group in &s.groups[groups.0..groups.1] {
                        self.group(group, constant)?;
                    }
                }
                Op::Recall { out, slot, count } => {
                    for i in 0..*count {
                        writeln!(
                            self.out,
                            "    let n{} = a.load(&row[{}]);",
                            out + i,
                            slot + i
                        )?;
                    }
                }
                Op::Cubic(index) => self.cubic(&s.cubics[*index])?,
                Op::Matrix {
                    out,
                    rows,
                    weights,
                    nodes,
                } => self.matrix(*out, *rows, *weights, *nodes)?,
                Op::Products {
                    out,
                    count,
                    factors,
                } => self.products(*out, *count, *factors)?,
                Op::Squares { .. }
                | Op::Quotient { .. }
                | Op::Power { .. }
                | Op::Function { .. } => {
                    return Err(std::fmt::Error);
                }
            }
            for (node, slot) in &s.keeps[step.keeps.0..step.keeps.1] {
                writeln!(self.out, "    row[{slot}] = a.store(n{node});")?;
            }
        }
        Ok(())
    }

    fn group(&mut self, group: &Group, constant: &str) -> Result {
        let s = self.structure;
        for w in 0..group.width {
            let mut sum = constant.replace("{}", &(group.weights + w).to_string());
            for t in 0..group.terms {
                let weight = group.weights + group.width * (t + 1) + w;
                let node = s.terms[group.nodes + group.width * t + w];
                sum = format!("term(a, c, {weight}, n{node}, {sum})");
            }
            match group.out {
                Place::Now(node) => writeln!(self.out, "    let n{} = {sum};", node + w)?,
                Place::Kept(slot) => writeln!(self.out, "    row[{}] = a.store({sum});", slot + w)?,
            }
        }
        Ok(())
    }

    fn matrix(&mut self, out: Place, rows: usize, weights: usize, nodes: (usize, usize)) -> Result {
        let nodes = &self.structure.terms[nodes.0..nodes.1];
        for row in 0..rows {
            let block = row / 4 * 4;
            let width = (rows - block).min(4);
            let mut sum = "z".to_owned();
            for (column, node) in nodes.iter().enumerate() {
                let weight = weights + block * nodes.len() + column * width + row - block;
                sum = format!("term(a, c, {weight}, n{node}, {sum})");
            }
            match out {
                Place::Now(node) => writeln!(self.out, "    let n{} = {sum};", node + row)?,
                Place::Kept(slot) => {
                    writeln!(self.out, "    row[{}] = a.store({sum});", slot + row)?;
                }
            }
        }
        Ok(())
    }

    fn products(&mut self, out: usize, count: usize, [first, second]: [usize; 2]) -> Result {
        let mut at = 0;
        while at < count {
            let width = (count - at).min(8);
            writeln!(
                self.out,
                "    let p{} = products::<A, SLOTS, {width}, {}, {}>(a, past, row);",
                out + at,
                first + at,
                second + at
            )?;
            for w in 0..width {
                writeln!(self.out, "    let n{} = p{}[{w}];", out + at + w, out + at)?;
            }
            at += width;
        }
        Ok(())
    }

    fn cubic(&mut self, cubic: &Cubic) -> Result {
        let Cubic {
            out,
            count,
            y,
            t,
            heads,
            ..
        } = *cubic;
        let blocks = count.div_ceil(8);
        let mut at = 0;
        for block in 0..blocks {
            let width = (count - at) / (blocks - block);
            writeln!(
                self.out,
                "    let (q{at}, p{at}) = squares_and_products::<A, SLOTS, {width}, {}, {}>(a, past, row);",
                y + at,
                t + at
            )?;
            for w in 0..width {
                let (q, p) = (out + at + w, out + count + at + w);
                writeln!(self.out, "    let (n{q}, p{p}) = (q{at}[{w}], p{at}[{w}]);")?;
            }
            at += width;
        }
        self.rows(cubic, 0, heads, count, cubic.weights)?;
        self.rows(cubic, heads, count, heads, cubic.weights + heads * count)?;
        for (row, column, weight) in &cubic.extra {
            let q = out + column;
            writeln!(
                self.out,
                "    let t{row} = term(a, c, {weight}, n{q}, t{row});"
            )?;
        }
        for i in 0..count {
            let p = out + count + i;
            writeln!(self.out, "    row[{}] = a.store(t{i});", t + i)?;
            writeln!(
                self.out,
                "    let y{i} = match past {{ [first, ..] => a.load(&first[{0}]), [] => a.load(&row[{0}]) }};",
                y + i
            )?;
            writeln!(self.out, "    let n{p} = a.mul_add(t{i}, y{i}, p{p});")?;
        }
        Ok(())
    }

    /// Rows of t = A q + added, each in two sums as the interpreter does it.
    fn rows(
        &mut self,
        cubic: &Cubic,
        from: usize,
        to: usize,
        columns: usize,
        weights: usize,
    ) -> Result {
        for row in from..to {
            let block = (row - from) / 4 * 4;
            let width = (to - from - block).min(4);
            let weight =
                |column: usize| weights + block * columns + column * width + (row - from - block);
            let start = cubic
                .added
                .map_or("z".to_owned(), |first| format!("n{}", first + row));
            let (mut even, mut odd) = (start, "z".to_owned());
            for column in 0..columns {
                let last_alone = columns % 2 == 1 && column == columns - 1;
                let sum = if column % 2 == 0 || last_alone {
                    &mut even
                } else {
                    &mut odd
                };
                *sum = format!(
                    "term(a, c, {}, n{}, {sum})",
                    weight(column),
                    cubic.out + column
                );
            }
            writeln!(self.out, "    let t{row} = a.add({even}, {odd});")?;
        }
        Ok(())
    }
}
