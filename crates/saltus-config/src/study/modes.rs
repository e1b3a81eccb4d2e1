//! `plate.modes`: a preset, a complete set, or lists of half-wave numbers.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Which terms carry the plate's displacements.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "Spelling", into = "Spelling")]
#[schemars(with = "Spelling")]
pub enum Modes {
    /// The 16 terms of Dias & Del Prado.
    Paper,
    /// Every transverse term up to `m` half-waves along x and `n` along y, with the in-plane terms they need.
    Complete {
        /// Half-waves along x.
        m: u32,
        /// Half-waves along y.
        n: u32,
    },
    /// Terms chosen one by one.
    Lists(ModeLists),
}

/// Half-wave numbers [m, n] of each term (-), along x and along y.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModeLists {
    /// Terms of the in-plane displacement along x: half-wave numbers (-), such as [[2, 1], [4, 1]].
    pub u: Vec<[u32; 2]>,
    /// Terms of the in-plane displacement along y: half-wave numbers (-), such as [[1, 2], [1, 4]].
    pub v: Vec<[u32; 2]>,
    /// Terms of the transverse displacement: half-wave numbers (-), such as [[1, 1], [3, 1]].
    pub w: Vec<[u32; 2]>,
}

impl Modes {
    /// Most transverse terms, as the physics has it.
    pub(crate) const MAX_TRANSVERSE: usize = 400;
    /// Most terms of either in-plane displacement.
    pub(crate) const MAX_IN_PLANE: usize = 2048;
    /// Largest half-wave number of a term in a list.
    pub(crate) const MAX_HALF_WAVES: u32 = 1000;
}

/// `plate.modes` as written.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
enum Spelling {
    /// "paper", or a complete set "MxN" such as "3x3".
    Word(#[schemars(extend("format" = "mode-set"))] String),
    /// Lists of half-wave numbers.
    Lists(ModeLists),
}

impl TryFrom<Spelling> for Modes {
    type Error = String;

    fn try_from(spelling: Spelling) -> Result<Self, String> {
        match spelling {
            Spelling::Word(word) => word.parse(),
            Spelling::Lists(lists) => Ok(Self::Lists(lists)),
        }
    }
}

impl From<Modes> for Spelling {
    fn from(modes: Modes) -> Self {
        match modes {
            Modes::Lists(lists) => Self::Lists(lists),
            word => Self::Word(word.to_string()),
        }
    }
}

impl FromStr for Modes {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        if word == "paper" {
            return Ok(Self::Paper);
        }
        let numbers = word
            .split_once(['x', 'X'])
            .and_then(|(m, n)| Some((m.parse::<u32>().ok()?, n.parse::<u32>().ok()?)));
        match numbers {
            Some((m, n))
                if (1..=Self::MAX_TRANSVERSE as u64).contains(&(u64::from(m) * u64::from(n))) =>
            {
                Ok(Self::Complete { m, n })
            }
            Some(_) => Err(format!(
                "a complete set MxN has M N from 1 to {} transverse terms",
                Self::MAX_TRANSVERSE
            )),
            None => Err("write \"paper\", a complete set such as \"3x3\", or lists \
                 such as { u = [[2, 1]], v = [[1, 2]], w = [[1, 1]] }"
                .to_owned()),
        }
    }
}

impl fmt::Display for Modes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Paper => f.write_str("paper"),
            Self::Complete { m, n } => write!(f, "{m}x{n}"),
            Self::Lists(lists) => write!(
                f,
                "{} u, {} v, {} w",
                lists.u.len(),
                lists.v.len(),
                lists.w.len()
            ),
        }
    }
}
