//! Written by `cargo run --release -p saltus --example specialise`; not to be edited.

#[allow(unused_imports)]
use super::sums::{products, squares_and_products, term};
use crate::arith::Arith;

pub(super) const KEY: u64 = 0xedf16f607186abb1;
const SLOTS: usize = 31;
const STREAM: usize = 179;

#[inline(always)]
pub(super) fn expand<A: Arith>(a: A, c: &[A::Cell], kept: &mut [A::Cell]) {
    let Some(c) = c.first_chunk::<STREAM>() else { return };
    let rows = kept.as_chunks_mut::<SLOTS>().0;
    let Some((first, rest)) = rows.split_first_mut() else { return };
    let Some(next) = rest.first_mut() else { return };
    order::<A, true>(a, c, &[], first, next, a.splat(1.0));
    let last = rows.len() - 1;
    for k in 1..last {
        let (past, rest) = rows.split_at_mut(k);
        let [row, next, ..] = rest else { return };
        order::<A, false>(a, c, past, row, next, a.splat(1.0 / (k + 1) as f64));
    }
    let (past, rest) = rows.split_at_mut(last);
    if let [row] = rest { guards(a, c, past, row) }
}

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
    let n0 = a.load(&row[0]);
    let n1 = a.load(&row[1]);
    let n2 = a.load(&row[2]);
    let n3 = a.load(&row[3]);
    let n4 = a.load(&row[20]);
    let n5 = a.load(&row[21]);
    let n6 = a.load(&row[22]);
    let n7 = a.load(&row[23]);
    let n8 = a.load(&row[24]);
    let n9 = a.load(&row[25]);
    let n10 = a.load(&row[26]);
    let n11 = a.load(&row[27]);
    let n12 = a.load(&row[28]);
    let n13 = term(a, c, 2, n12, if FIRST { a.load(&c[0]) } else { z });
    let n14 = term(a, c, 3, n11, if FIRST { a.load(&c[1]) } else { z });
    let n15 = term(a, c, 16, n8, term(a, c, 14, n11, term(a, c, 12, n3, term(a, c, 10, n2, term(a, c, 8, n1, term(a, c, 6, n0, if FIRST { a.load(&c[4]) } else { z }))))));
    let n16 = term(a, c, 17, n9, term(a, c, 15, n12, term(a, c, 13, n7, term(a, c, 11, n6, term(a, c, 9, n5, term(a, c, 7, n4, if FIRST { a.load(&c[5]) } else { z }))))));
    let n17 = term(a, c, 22, n16, term(a, c, 20, n15, if FIRST { a.load(&c[18]) } else { z }));
    let n18 = term(a, c, 23, n16, term(a, c, 21, n15, if FIRST { a.load(&c[19]) } else { z }));
    let n19 = term(a, c, 27, n18, if FIRST { a.load(&c[24]) } else { z });
    let n20 = term(a, c, 28, n16, if FIRST { a.load(&c[25]) } else { z });
    let n21 = term(a, c, 29, n10, if FIRST { a.load(&c[26]) } else { z });
    let n22 = term(a, c, 36, n21, term(a, c, 33, n20, if FIRST { a.load(&c[30]) } else { z }));
    let n23 = term(a, c, 37, n10, term(a, c, 34, n15, if FIRST { a.load(&c[31]) } else { z }));
    let n24 = term(a, c, 38, n12, term(a, c, 35, n11, if FIRST { a.load(&c[32]) } else { z }));
    row[4] = a.store(term(a, c, 47, n1, term(a, c, 43, n0, if FIRST { a.load(&c[39]) } else { z })));
    row[5] = a.store(term(a, c, 48, n2, term(a, c, 44, n0, if FIRST { a.load(&c[40]) } else { z })));
    row[6] = a.store(term(a, c, 49, n3, term(a, c, 45, n0, if FIRST { a.load(&c[41]) } else { z })));
    row[7] = a.store(term(a, c, 50, n2, term(a, c, 46, n1, if FIRST { a.load(&c[42]) } else { z })));
    row[8] = a.store(term(a, c, 55, n3, term(a, c, 53, n1, if FIRST { a.load(&c[51]) } else { z })));
    row[9] = a.store(term(a, c, 56, n3, term(a, c, 54, n2, if FIRST { a.load(&c[52]) } else { z })));
    row[29] = a.store(n17);
    row[30] = a.store(n23);
    let (q0, p0) = squares_and_products::<A, SLOTS, 5, 0, 10>(a, past, row);
    let (n31, p41) = (q0[0], p0[0]);
    let (n32, p42) = (q0[1], p0[1]);
    let (n33, p43) = (q0[2], p0[2]);
    let (n34, p44) = (q0[3], p0[3]);
    let (n35, p45) = (q0[4], p0[4]);
    let (q5, p5) = squares_and_products::<A, SLOTS, 5, 5, 15>(a, past, row);
    let (n36, p46) = (q5[0], p5[0]);
    let (n37, p47) = (q5[1], p5[1]);
    let (n38, p48) = (q5[2], p5[2]);
    let (n39, p49) = (q5[3], p5[3]);
    let (n40, p50) = (q5[4], p5[4]);
    let t0 = a.add(term(a, c, 89, n39, term(a, c, 81, n37, term(a, c, 73, n35, term(a, c, 65, n33, term(a, c, 57, n31, z))))), term(a, c, 93, n40, term(a, c, 85, n38, term(a, c, 77, n36, term(a, c, 69, n34, term(a, c, 61, n32, z))))));
    let t1 = a.add(term(a, c, 90, n39, term(a, c, 82, n37, term(a, c, 74, n35, term(a, c, 66, n33, term(a, c, 58, n31, z))))), term(a, c, 94, n40, term(a, c, 86, n38, term(a, c, 78, n36, term(a, c, 70, n34, term(a, c, 62, n32, z))))));
    let t2 = a.add(term(a, c, 91, n39, term(a, c, 83, n37, term(a, c, 75, n35, term(a, c, 67, n33, term(a, c, 59, n31, z))))), term(a, c, 95, n40, term(a, c, 87, n38, term(a, c, 79, n36, term(a, c, 71, n34, term(a, c, 63, n32, z))))));
    let t3 = a.add(term(a, c, 92, n39, term(a, c, 84, n37, term(a, c, 76, n35, term(a, c, 68, n33, term(a, c, 60, n31, z))))), term(a, c, 96, n40, term(a, c, 88, n38, term(a, c, 80, n36, term(a, c, 72, n34, term(a, c, 64, n32, z))))));
    let t4 = a.add(term(a, c, 105, n33, term(a, c, 97, n31, z)), term(a, c, 109, n34, term(a, c, 101, n32, z)));
    let t5 = a.add(term(a, c, 106, n33, term(a, c, 98, n31, z)), term(a, c, 110, n34, term(a, c, 102, n32, z)));
    let t6 = a.add(term(a, c, 107, n33, term(a, c, 99, n31, z)), term(a, c, 111, n34, term(a, c, 103, n32, z)));
    let t7 = a.add(term(a, c, 108, n33, term(a, c, 100, n31, z)), term(a, c, 112, n34, term(a, c, 104, n32, z)));
    let t8 = a.add(term(a, c, 117, n33, term(a, c, 113, n31, z)), term(a, c, 119, n34, term(a, c, 115, n32, z)));
    let t9 = a.add(term(a, c, 118, n33, term(a, c, 114, n31, z)), term(a, c, 120, n34, term(a, c, 116, n32, z)));
    let t4 = term(a, c, 121, n40, t4);
    let t9 = term(a, c, 122, n35, t9);
    row[10] = a.store(t0);
    let y0 = match past { [first, ..] => a.load(&first[0]), [] => a.load(&row[0]) };
    let n41 = a.mul_add(t0, y0, p41);
    row[11] = a.store(t1);
    let y1 = match past { [first, ..] => a.load(&first[1]), [] => a.load(&row[1]) };
    let n42 = a.mul_add(t1, y1, p42);
    row[12] = a.store(t2);
    let y2 = match past { [first, ..] => a.load(&first[2]), [] => a.load(&row[2]) };
    let n43 = a.mul_add(t2, y2, p43);
    row[13] = a.store(t3);
    let y3 = match past { [first, ..] => a.load(&first[3]), [] => a.load(&row[3]) };
    let n44 = a.mul_add(t3, y3, p44);
    row[14] = a.store(t4);
    let y4 = match past { [first, ..] => a.load(&first[4]), [] => a.load(&row[4]) };
    let n45 = a.mul_add(t4, y4, p45);
    row[15] = a.store(t5);
    let y5 = match past { [first, ..] => a.load(&first[5]), [] => a.load(&row[5]) };
    let n46 = a.mul_add(t5, y5, p46);
    row[16] = a.store(t6);
    let y6 = match past { [first, ..] => a.load(&first[6]), [] => a.load(&row[6]) };
    let n47 = a.mul_add(t6, y6, p47);
    row[17] = a.store(t7);
    let y7 = match past { [first, ..] => a.load(&first[7]), [] => a.load(&row[7]) };
    let n48 = a.mul_add(t7, y7, p48);
    row[18] = a.store(t8);
    let y8 = match past { [first, ..] => a.load(&first[8]), [] => a.load(&row[8]) };
    let n49 = a.mul_add(t8, y8, p49);
    row[19] = a.store(t9);
    let y9 = match past { [first, ..] => a.load(&first[9]), [] => a.load(&row[9]) };
    let n50 = a.mul_add(t9, y9, p50);
    let n61 = term(a, c, 155, n18, term(a, c, 151, n47, term(a, c, 147, n46, term(a, c, 143, n45, term(a, c, 139, n41, term(a, c, 135, n24, term(a, c, 131, n4, term(a, c, 127, n0, if FIRST { a.load(&c[123]) } else { z }))))))));
    let n62 = term(a, c, 156, n18, term(a, c, 152, n49, term(a, c, 148, n48, term(a, c, 144, n45, term(a, c, 140, n42, term(a, c, 136, n24, term(a, c, 132, n5, term(a, c, 128, n1, if FIRST { a.load(&c[124]) } else { z }))))))));
    let n63 = term(a, c, 157, n18, term(a, c, 153, n50, term(a, c, 149, n48, term(a, c, 145, n46, term(a, c, 141, n43, term(a, c, 137, n24, term(a, c, 133, n6, term(a, c, 129, n2, if FIRST { a.load(&c[125]) } else { z }))))))));
    let n64 = term(a, c, 158, n18, term(a, c, 154, n50, term(a, c, 150, n49, term(a, c, 146, n47, term(a, c, 142, n44, term(a, c, 138, n24, term(a, c, 134, n7, term(a, c, 130, n3, if FIRST { a.load(&c[126]) } else { z }))))))));
    let m0 = a.mul(n4, factor);
    next[0] = a.store(m0);
    let m1 = a.mul(n5, factor);
    next[1] = a.store(m1);
    let m2 = a.mul(n6, factor);
    next[2] = a.store(m2);
    let m3 = a.mul(n7, factor);
    next[3] = a.store(m3);
    let m4 = a.mul(n61, factor);
    next[20] = a.store(m4);
    let m5 = a.mul(n62, factor);
    next[21] = a.store(m5);
    let m6 = a.mul(n63, factor);
    next[22] = a.store(m6);
    let m7 = a.mul(n64, factor);
    next[23] = a.store(m7);
    let m8 = a.mul(n9, factor);
    next[24] = a.store(m8);
    let m9 = a.mul(n19, factor);
    next[25] = a.store(m9);
    let m10 = a.mul(n22, factor);
    next[26] = a.store(m10);
    let m11 = a.mul(n13, factor);
    next[27] = a.store(m11);
    let m12 = a.mul(n14, factor);
    next[28] = a.store(m12);
}

#[cfg_attr(not(unoptimised), inline(always))]
fn guards<A: Arith>(
    a: A,
    c: &[A::Cell; STREAM],
    past: &[[A::Cell; SLOTS]],
    row: &mut [A::Cell; SLOTS],
) {
    let (z, _) = (a.splat(0.0), past);
    let n0 = a.load(&row[0]);
    let n1 = a.load(&row[1]);
    let n2 = a.load(&row[2]);
    let n3 = a.load(&row[3]);
    let n4 = a.load(&row[20]);
    let n5 = a.load(&row[21]);
    let n6 = a.load(&row[22]);
    let n7 = a.load(&row[23]);
    let n8 = a.load(&row[24]);
    let n9 = a.load(&row[25]);
    let n10 = a.load(&row[26]);
    let n11 = a.load(&row[27]);
    let n12 = a.load(&row[28]);
    let n15 = term(a, c, 171, n8, term(a, c, 169, n11, term(a, c, 167, n3, term(a, c, 165, n2, term(a, c, 163, n1, term(a, c, 161, n0, z))))));
    let n16 = term(a, c, 172, n9, term(a, c, 170, n12, term(a, c, 168, n7, term(a, c, 166, n6, term(a, c, 164, n5, term(a, c, 162, n4, z))))));
    let n17 = term(a, c, 175, n16, term(a, c, 174, n15, z));
    let n23 = term(a, c, 178, n10, term(a, c, 177, n15, z));
    row[29] = a.store(n17);
    row[30] = a.store(n23);
}
