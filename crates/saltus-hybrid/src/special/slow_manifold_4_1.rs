//! Written by `cargo run --release -p saltus --example specialise`; not to be edited.

#[allow(unused_imports)]
use super::sums::{products, squares_and_products, term};
use crate::arith::Arith;

pub(super) const KEY: u64 = 0x89160e89d4c0f505;
const SLOTS: usize = 49;
const STREAM: usize = 367;

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
    let n0 = a.load(&row[20]);
    let n1 = a.load(&row[21]);
    let n2 = a.load(&row[22]);
    let n3 = a.load(&row[23]);
    let n4 = a.load(&row[40]);
    let n5 = a.load(&row[41]);
    let n6 = a.load(&row[42]);
    let n7 = a.load(&row[43]);
    let n8 = a.load(&row[44]);
    let n9 = a.load(&row[45]);
    let n10 = a.load(&row[46]);
    let n11 = a.load(&row[47]);
    let n12 = term(a, c, 2, n11, if FIRST { a.load(&c[0]) } else { z });
    let n13 = term(a, c, 3, n10, if FIRST { a.load(&c[1]) } else { z });
    let n14 = term(a, c, 16, n8, term(a, c, 14, n10, term(a, c, 12, n3, term(a, c, 10, n2, term(a, c, 8, n1, term(a, c, 6, n0, if FIRST { a.load(&c[4]) } else { z }))))));
    let n15 = term(a, c, 17, n9, term(a, c, 15, n11, term(a, c, 13, n7, term(a, c, 11, n6, term(a, c, 9, n5, term(a, c, 7, n4, if FIRST { a.load(&c[5]) } else { z }))))));
    let n16 = term(a, c, 22, n15, term(a, c, 20, n14, if FIRST { a.load(&c[18]) } else { z }));
    let n17 = term(a, c, 23, n15, term(a, c, 21, n14, if FIRST { a.load(&c[19]) } else { z }));
    let n18 = term(a, c, 25, n17, if FIRST { a.load(&c[24]) } else { z });
    let n19 = term(a, c, 28, n11, term(a, c, 27, n10, if FIRST { a.load(&c[26]) } else { z }));
    row[24] = a.store(term(a, c, 37, n1, term(a, c, 33, n0, if FIRST { a.load(&c[29]) } else { z })));
    row[25] = a.store(term(a, c, 38, n2, term(a, c, 34, n0, if FIRST { a.load(&c[30]) } else { z })));
    row[26] = a.store(term(a, c, 39, n3, term(a, c, 35, n0, if FIRST { a.load(&c[31]) } else { z })));
    row[27] = a.store(term(a, c, 40, n2, term(a, c, 36, n1, if FIRST { a.load(&c[32]) } else { z })));
    row[28] = a.store(term(a, c, 45, n3, term(a, c, 43, n1, if FIRST { a.load(&c[41]) } else { z })));
    row[29] = a.store(term(a, c, 46, n3, term(a, c, 44, n2, if FIRST { a.load(&c[42]) } else { z })));
    row[48] = a.store(n16);
    let n26 = a.load(&row[0]);
    let n27 = a.load(&row[1]);
    let n28 = a.load(&row[2]);
    let n29 = a.load(&row[3]);
    let n30 = a.load(&row[4]);
    let n31 = a.load(&row[5]);
    let n32 = a.load(&row[6]);
    let n33 = a.load(&row[7]);
    let n34 = a.load(&row[8]);
    let n35 = a.load(&row[9]);
    let (q0, p0) = squares_and_products::<A, SLOTS, 5, 20, 30>(a, past, row);
    let (n36, p46) = (q0[0], p0[0]);
    let (n37, p47) = (q0[1], p0[1]);
    let (n38, p48) = (q0[2], p0[2]);
    let (n39, p49) = (q0[3], p0[3]);
    let (n40, p50) = (q0[4], p0[4]);
    let (q5, p5) = squares_and_products::<A, SLOTS, 5, 25, 35>(a, past, row);
    let (n41, p51) = (q5[0], p5[0]);
    let (n42, p52) = (q5[1], p5[1]);
    let (n43, p53) = (q5[2], p5[2]);
    let (n44, p54) = (q5[3], p5[3]);
    let (n45, p55) = (q5[4], p5[4]);
    let t0 = a.add(term(a, c, 280, n44, term(a, c, 272, n42, term(a, c, 264, n40, term(a, c, 256, n38, term(a, c, 248, n36, n26))))), term(a, c, 284, n45, term(a, c, 276, n43, term(a, c, 268, n41, term(a, c, 260, n39, term(a, c, 252, n37, z))))));
    let t1 = a.add(term(a, c, 281, n44, term(a, c, 273, n42, term(a, c, 265, n40, term(a, c, 257, n38, term(a, c, 249, n36, n27))))), term(a, c, 285, n45, term(a, c, 277, n43, term(a, c, 269, n41, term(a, c, 261, n39, term(a, c, 253, n37, z))))));
    let t2 = a.add(term(a, c, 282, n44, term(a, c, 274, n42, term(a, c, 266, n40, term(a, c, 258, n38, term(a, c, 250, n36, n28))))), term(a, c, 286, n45, term(a, c, 278, n43, term(a, c, 270, n41, term(a, c, 262, n39, term(a, c, 254, n37, z))))));
    let t3 = a.add(term(a, c, 283, n44, term(a, c, 275, n42, term(a, c, 267, n40, term(a, c, 259, n38, term(a, c, 251, n36, n29))))), term(a, c, 287, n45, term(a, c, 279, n43, term(a, c, 271, n41, term(a, c, 263, n39, term(a, c, 255, n37, z))))));
    let t4 = a.add(term(a, c, 296, n38, term(a, c, 288, n36, n30)), term(a, c, 300, n39, term(a, c, 292, n37, z)));
    let t5 = a.add(term(a, c, 297, n38, term(a, c, 289, n36, n31)), term(a, c, 301, n39, term(a, c, 293, n37, z)));
    let t6 = a.add(term(a, c, 298, n38, term(a, c, 290, n36, n32)), term(a, c, 302, n39, term(a, c, 294, n37, z)));
    let t7 = a.add(term(a, c, 299, n38, term(a, c, 291, n36, n33)), term(a, c, 303, n39, term(a, c, 295, n37, z)));
    let t8 = a.add(term(a, c, 308, n38, term(a, c, 304, n36, n34)), term(a, c, 310, n39, term(a, c, 306, n37, z)));
    let t9 = a.add(term(a, c, 309, n38, term(a, c, 305, n36, n35)), term(a, c, 311, n39, term(a, c, 307, n37, z)));
    let t4 = term(a, c, 312, n45, t4);
    let t9 = term(a, c, 313, n40, t9);
    row[30] = a.store(t0);
    let y0 = match past { [first, ..] => a.load(&first[20]), [] => a.load(&row[20]) };
    let n46 = a.mul_add(t0, y0, p46);
    row[31] = a.store(t1);
    let y1 = match past { [first, ..] => a.load(&first[21]), [] => a.load(&row[21]) };
    let n47 = a.mul_add(t1, y1, p47);
    row[32] = a.store(t2);
    let y2 = match past { [first, ..] => a.load(&first[22]), [] => a.load(&row[22]) };
    let n48 = a.mul_add(t2, y2, p48);
    row[33] = a.store(t3);
    let y3 = match past { [first, ..] => a.load(&first[23]), [] => a.load(&row[23]) };
    let n49 = a.mul_add(t3, y3, p49);
    row[34] = a.store(t4);
    let y4 = match past { [first, ..] => a.load(&first[24]), [] => a.load(&row[24]) };
    let n50 = a.mul_add(t4, y4, p50);
    row[35] = a.store(t5);
    let y5 = match past { [first, ..] => a.load(&first[25]), [] => a.load(&row[25]) };
    let n51 = a.mul_add(t5, y5, p51);
    row[36] = a.store(t6);
    let y6 = match past { [first, ..] => a.load(&first[26]), [] => a.load(&row[26]) };
    let n52 = a.mul_add(t6, y6, p52);
    row[37] = a.store(t7);
    let y7 = match past { [first, ..] => a.load(&first[27]), [] => a.load(&row[27]) };
    let n53 = a.mul_add(t7, y7, p53);
    row[38] = a.store(t8);
    let y8 = match past { [first, ..] => a.load(&first[28]), [] => a.load(&row[28]) };
    let n54 = a.mul_add(t8, y8, p54);
    row[39] = a.store(t9);
    let y9 = match past { [first, ..] => a.load(&first[29]), [] => a.load(&row[29]) };
    let n55 = a.mul_add(t9, y9, p55);
    row[10] = a.store(n36);
    row[11] = a.store(n37);
    row[12] = a.store(n38);
    row[13] = a.store(n39);
    row[14] = a.store(n40);
    row[15] = a.store(n41);
    row[16] = a.store(n42);
    row[17] = a.store(n43);
    row[18] = a.store(n44);
    row[19] = a.store(n45);
    let n66 = term(a, c, 346, n17, term(a, c, 342, n52, term(a, c, 338, n51, term(a, c, 334, n50, term(a, c, 330, n46, term(a, c, 326, n19, term(a, c, 322, n4, term(a, c, 318, n0, if FIRST { a.load(&c[314]) } else { z }))))))));
    let n67 = term(a, c, 347, n17, term(a, c, 343, n54, term(a, c, 339, n53, term(a, c, 335, n50, term(a, c, 331, n47, term(a, c, 327, n19, term(a, c, 323, n5, term(a, c, 319, n1, if FIRST { a.load(&c[315]) } else { z }))))))));
    let n68 = term(a, c, 348, n17, term(a, c, 344, n55, term(a, c, 340, n53, term(a, c, 336, n51, term(a, c, 332, n48, term(a, c, 328, n19, term(a, c, 324, n6, term(a, c, 320, n2, if FIRST { a.load(&c[316]) } else { z }))))))));
    let n69 = term(a, c, 349, n17, term(a, c, 345, n55, term(a, c, 341, n54, term(a, c, 337, n52, term(a, c, 333, n49, term(a, c, 329, n19, term(a, c, 325, n7, term(a, c, 321, n3, if FIRST { a.load(&c[317]) } else { z }))))))));
    let m0 = a.mul(n4, factor);
    next[20] = a.store(m0);
    let m1 = a.mul(n5, factor);
    next[21] = a.store(m1);
    let m2 = a.mul(n6, factor);
    next[22] = a.store(m2);
    let m3 = a.mul(n7, factor);
    next[23] = a.store(m3);
    let m4 = a.mul(n66, factor);
    next[40] = a.store(m4);
    let m5 = a.mul(n67, factor);
    next[41] = a.store(m5);
    let m6 = a.mul(n68, factor);
    next[42] = a.store(m6);
    let m7 = a.mul(n69, factor);
    next[43] = a.store(m7);
    let m8 = a.mul(n9, factor);
    next[44] = a.store(m8);
    let m9 = a.mul(n18, factor);
    next[45] = a.store(m9);
    let m10 = a.mul(n12, factor);
    next[46] = a.store(m10);
    let m11 = a.mul(n13, factor);
    next[47] = a.store(m11);
}

#[cfg_attr(not(unoptimised), inline(always))]
fn guards<A: Arith>(
    a: A,
    c: &[A::Cell; STREAM],
    past: &[[A::Cell; SLOTS]],
    row: &mut [A::Cell; SLOTS],
) {
    let (z, _) = (a.splat(0.0), past);
    let n0 = a.load(&row[20]);
    let n1 = a.load(&row[21]);
    let n2 = a.load(&row[22]);
    let n3 = a.load(&row[23]);
    let n4 = a.load(&row[40]);
    let n5 = a.load(&row[41]);
    let n6 = a.load(&row[42]);
    let n7 = a.load(&row[43]);
    let n8 = a.load(&row[44]);
    let n9 = a.load(&row[45]);
    let n10 = a.load(&row[46]);
    let n11 = a.load(&row[47]);
    let n14 = term(a, c, 362, n8, term(a, c, 360, n10, term(a, c, 358, n3, term(a, c, 356, n2, term(a, c, 354, n1, term(a, c, 352, n0, z))))));
    let n15 = term(a, c, 363, n9, term(a, c, 361, n11, term(a, c, 359, n7, term(a, c, 357, n6, term(a, c, 355, n5, term(a, c, 353, n4, z))))));
    let n16 = term(a, c, 366, n15, term(a, c, 365, n14, z));
    row[48] = a.store(n16);
}
