//! Written by `cargo run --release -p saltus --example specialise`; not to be edited.

#[allow(unused_imports)]
use super::sums::{products, squares_and_products, term};
use crate::arith::Arith;

pub(super) const KEY: u64 = 0x99f81b543c9fbebc;
const SLOTS: usize = 30;
const STREAM: usize = 166;

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
    let n12 = term(a, c, 2, n11, if FIRST { a.load(&c[0]) } else { z });
    let n13 = term(a, c, 3, n10, if FIRST { a.load(&c[1]) } else { z });
    let n14 = term(a, c, 16, n8, term(a, c, 14, n10, term(a, c, 12, n3, term(a, c, 10, n2, term(a, c, 8, n1, term(a, c, 6, n0, if FIRST { a.load(&c[4]) } else { z }))))));
    let n15 = term(a, c, 17, n9, term(a, c, 15, n11, term(a, c, 13, n7, term(a, c, 11, n6, term(a, c, 9, n5, term(a, c, 7, n4, if FIRST { a.load(&c[5]) } else { z }))))));
    let n16 = term(a, c, 22, n15, term(a, c, 20, n14, if FIRST { a.load(&c[18]) } else { z }));
    let n17 = term(a, c, 23, n15, term(a, c, 21, n14, if FIRST { a.load(&c[19]) } else { z }));
    let n18 = term(a, c, 25, n17, if FIRST { a.load(&c[24]) } else { z });
    let n19 = term(a, c, 28, n11, term(a, c, 27, n10, if FIRST { a.load(&c[26]) } else { z }));
    row[4] = a.store(term(a, c, 37, n1, term(a, c, 33, n0, if FIRST { a.load(&c[29]) } else { z })));
    row[5] = a.store(term(a, c, 38, n2, term(a, c, 34, n0, if FIRST { a.load(&c[30]) } else { z })));
    row[6] = a.store(term(a, c, 39, n3, term(a, c, 35, n0, if FIRST { a.load(&c[31]) } else { z })));
    row[7] = a.store(term(a, c, 40, n2, term(a, c, 36, n1, if FIRST { a.load(&c[32]) } else { z })));
    row[8] = a.store(term(a, c, 45, n3, term(a, c, 43, n1, if FIRST { a.load(&c[41]) } else { z })));
    row[9] = a.store(term(a, c, 46, n3, term(a, c, 44, n2, if FIRST { a.load(&c[42]) } else { z })));
    row[29] = a.store(n14);
    row[28] = a.store(n16);
    let (q0, p0) = squares_and_products::<A, SLOTS, 5, 0, 10>(a, past, row);
    let (n26, p36) = (q0[0], p0[0]);
    let (n27, p37) = (q0[1], p0[1]);
    let (n28, p38) = (q0[2], p0[2]);
    let (n29, p39) = (q0[3], p0[3]);
    let (n30, p40) = (q0[4], p0[4]);
    let (q5, p5) = squares_and_products::<A, SLOTS, 5, 5, 15>(a, past, row);
    let (n31, p41) = (q5[0], p5[0]);
    let (n32, p42) = (q5[1], p5[1]);
    let (n33, p43) = (q5[2], p5[2]);
    let (n34, p44) = (q5[3], p5[3]);
    let (n35, p45) = (q5[4], p5[4]);
    let t0 = a.add(term(a, c, 79, n34, term(a, c, 71, n32, term(a, c, 63, n30, term(a, c, 55, n28, term(a, c, 47, n26, z))))), term(a, c, 83, n35, term(a, c, 75, n33, term(a, c, 67, n31, term(a, c, 59, n29, term(a, c, 51, n27, z))))));
    let t1 = a.add(term(a, c, 80, n34, term(a, c, 72, n32, term(a, c, 64, n30, term(a, c, 56, n28, term(a, c, 48, n26, z))))), term(a, c, 84, n35, term(a, c, 76, n33, term(a, c, 68, n31, term(a, c, 60, n29, term(a, c, 52, n27, z))))));
    let t2 = a.add(term(a, c, 81, n34, term(a, c, 73, n32, term(a, c, 65, n30, term(a, c, 57, n28, term(a, c, 49, n26, z))))), term(a, c, 85, n35, term(a, c, 77, n33, term(a, c, 69, n31, term(a, c, 61, n29, term(a, c, 53, n27, z))))));
    let t3 = a.add(term(a, c, 82, n34, term(a, c, 74, n32, term(a, c, 66, n30, term(a, c, 58, n28, term(a, c, 50, n26, z))))), term(a, c, 86, n35, term(a, c, 78, n33, term(a, c, 70, n31, term(a, c, 62, n29, term(a, c, 54, n27, z))))));
    let t4 = a.add(term(a, c, 95, n28, term(a, c, 87, n26, z)), term(a, c, 99, n29, term(a, c, 91, n27, z)));
    let t5 = a.add(term(a, c, 96, n28, term(a, c, 88, n26, z)), term(a, c, 100, n29, term(a, c, 92, n27, z)));
    let t6 = a.add(term(a, c, 97, n28, term(a, c, 89, n26, z)), term(a, c, 101, n29, term(a, c, 93, n27, z)));
    let t7 = a.add(term(a, c, 98, n28, term(a, c, 90, n26, z)), term(a, c, 102, n29, term(a, c, 94, n27, z)));
    let t8 = a.add(term(a, c, 107, n28, term(a, c, 103, n26, z)), term(a, c, 109, n29, term(a, c, 105, n27, z)));
    let t9 = a.add(term(a, c, 108, n28, term(a, c, 104, n26, z)), term(a, c, 110, n29, term(a, c, 106, n27, z)));
    let t4 = term(a, c, 111, n35, t4);
    let t9 = term(a, c, 112, n30, t9);
    row[10] = a.store(t0);
    let y0 = match past { [first, ..] => a.load(&first[0]), [] => a.load(&row[0]) };
    let n36 = a.mul_add(t0, y0, p36);
    row[11] = a.store(t1);
    let y1 = match past { [first, ..] => a.load(&first[1]), [] => a.load(&row[1]) };
    let n37 = a.mul_add(t1, y1, p37);
    row[12] = a.store(t2);
    let y2 = match past { [first, ..] => a.load(&first[2]), [] => a.load(&row[2]) };
    let n38 = a.mul_add(t2, y2, p38);
    row[13] = a.store(t3);
    let y3 = match past { [first, ..] => a.load(&first[3]), [] => a.load(&row[3]) };
    let n39 = a.mul_add(t3, y3, p39);
    row[14] = a.store(t4);
    let y4 = match past { [first, ..] => a.load(&first[4]), [] => a.load(&row[4]) };
    let n40 = a.mul_add(t4, y4, p40);
    row[15] = a.store(t5);
    let y5 = match past { [first, ..] => a.load(&first[5]), [] => a.load(&row[5]) };
    let n41 = a.mul_add(t5, y5, p41);
    row[16] = a.store(t6);
    let y6 = match past { [first, ..] => a.load(&first[6]), [] => a.load(&row[6]) };
    let n42 = a.mul_add(t6, y6, p42);
    row[17] = a.store(t7);
    let y7 = match past { [first, ..] => a.load(&first[7]), [] => a.load(&row[7]) };
    let n43 = a.mul_add(t7, y7, p43);
    row[18] = a.store(t8);
    let y8 = match past { [first, ..] => a.load(&first[8]), [] => a.load(&row[8]) };
    let n44 = a.mul_add(t8, y8, p44);
    row[19] = a.store(t9);
    let y9 = match past { [first, ..] => a.load(&first[9]), [] => a.load(&row[9]) };
    let n45 = a.mul_add(t9, y9, p45);
    let n56 = term(a, c, 145, n17, term(a, c, 141, n42, term(a, c, 137, n41, term(a, c, 133, n40, term(a, c, 129, n36, term(a, c, 125, n19, term(a, c, 121, n4, term(a, c, 117, n0, if FIRST { a.load(&c[113]) } else { z }))))))));
    let n57 = term(a, c, 146, n17, term(a, c, 142, n44, term(a, c, 138, n43, term(a, c, 134, n40, term(a, c, 130, n37, term(a, c, 126, n19, term(a, c, 122, n5, term(a, c, 118, n1, if FIRST { a.load(&c[114]) } else { z }))))))));
    let n58 = term(a, c, 147, n17, term(a, c, 143, n45, term(a, c, 139, n43, term(a, c, 135, n41, term(a, c, 131, n38, term(a, c, 127, n19, term(a, c, 123, n6, term(a, c, 119, n2, if FIRST { a.load(&c[115]) } else { z }))))))));
    let n59 = term(a, c, 148, n17, term(a, c, 144, n45, term(a, c, 140, n44, term(a, c, 136, n42, term(a, c, 132, n39, term(a, c, 128, n19, term(a, c, 124, n7, term(a, c, 120, n3, if FIRST { a.load(&c[116]) } else { z }))))))));
    let m0 = a.mul(n4, factor);
    next[0] = a.store(m0);
    let m1 = a.mul(n5, factor);
    next[1] = a.store(m1);
    let m2 = a.mul(n6, factor);
    next[2] = a.store(m2);
    let m3 = a.mul(n7, factor);
    next[3] = a.store(m3);
    let m4 = a.mul(n56, factor);
    next[20] = a.store(m4);
    let m5 = a.mul(n57, factor);
    next[21] = a.store(m5);
    let m6 = a.mul(n58, factor);
    next[22] = a.store(m6);
    let m7 = a.mul(n59, factor);
    next[23] = a.store(m7);
    let m8 = a.mul(n9, factor);
    next[24] = a.store(m8);
    let m9 = a.mul(n18, factor);
    next[25] = a.store(m9);
    let m10 = a.mul(n12, factor);
    next[26] = a.store(m10);
    let m11 = a.mul(n13, factor);
    next[27] = a.store(m11);
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
    let n14 = term(a, c, 161, n8, term(a, c, 159, n10, term(a, c, 157, n3, term(a, c, 155, n2, term(a, c, 153, n1, term(a, c, 151, n0, z))))));
    let n15 = term(a, c, 162, n9, term(a, c, 160, n11, term(a, c, 158, n7, term(a, c, 156, n6, term(a, c, 154, n5, term(a, c, 152, n4, z))))));
    let n16 = term(a, c, 165, n15, term(a, c, 164, n14, z));
    row[29] = a.store(n14);
    row[28] = a.store(n16);
}
