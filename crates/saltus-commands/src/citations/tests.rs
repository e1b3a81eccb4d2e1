//! Whether the entries are sound, and the right ones are found.

use super::{REFERENCES, citations};
use crate::request::Request;
use saltus_config::{Inertia, Method, Study};
use std::collections::BTreeSet;

/// Works of `docs/references.md` that answers do not rest on: they are behind tests, formulas and figures.
const NOT_CITED: [&str; 16] = [
    "AbramowitzStegun",
    "Bapat1986",
    "CH1956",
    "Feigenbaum1978",
    "Holmes1982",
    "HosChampneys2012",
    "Levy1942",
    "LiangBarsky1984",
    "LuoHan1996",
    "Newcombe1998",
    "Nunez2018",
    "OkabeIto2008",
    "ShawHolmes1983",
    "Sprott2003",
    "Timoshenko",
    "saltus",
];

fn study(change: impl FnOnce(&mut Study)) -> Study {
    let mut study = crate::reproduce::study();
    change(&mut study);
    study
}

fn keys(request: &Request, study: &Study) -> BTreeSet<&'static str> {
    let works = citations(request, study);
    assert!(works.iter().all(|work| !work.why.is_empty()));
    works.into_iter().map(|work| work.key).collect()
}

fn requests() -> [Request; 11] {
    [
        Request::Frequencies,
        Request::Simulate,
        Request::Sweep,
        Request::Map,
        Request::Basins { matched: false },
        Request::Basins { matched: true },
        Request::Orbit,
        Request::Continue {
            origin: None,
            over: None,
        },
        Request::Lyapunov,
        Request::Attractors,
        Request::Reproduce { quick: true },
    ]
}

/// `**Flegal & Jones 2010**` is FlegalJones2010.
fn documented() -> BTreeSet<String> {
    let text = include_str!("../../../../docs/references.md");
    let lines = text.lines().filter_map(|line| line.strip_prefix("- **"));
    let names = lines.filter_map(|line| line.split("**").next());
    let plain = |name: &str| {
        let name = name.replace('ü', "ue").replace('ő', "o").replace('ñ', "n");
        name.chars().filter(char::is_ascii_alphanumeric).collect()
    };
    names.map(plain).collect()
}

#[test]
fn every_work_in_the_documents_is_cited_or_known_not_to_be() {
    let studies = [
        study(|_| {}),
        study(|s| s.solver.method = Method::Rk4),
        study(|s| s.plate.inertia = Inertia::SlowManifold),
    ];
    let cited = studies
        .iter()
        .flat_map(|study| requests().map(|request| keys(&request, study)));
    let cited: BTreeSet<String> = cited.flatten().map(str::to_owned).collect();
    let mut all = documented();
    assert!(all.len() > 30, "{all:?}");
    assert!(all.contains("Mueller1995"), "{all:?}");
    all.insert("saltus".to_owned());
    let rest = NOT_CITED.map(str::to_owned);
    let known = cited.iter().chain(&rest).cloned().collect();
    assert_eq!(all, known);
    let both = rest.iter().filter(|key| cited.contains(*key));
    assert_eq!(both.collect::<Vec<_>>(), ["saltus"]);
    let entries = REFERENCES.matches("\n@").count() + 1;
    assert_eq!(entries, cited.len(), "an entry that nobody cites");
}

#[test]
fn a_request_cites_what_it_uses_and_nothing_else() {
    let paper = study(|_| {});
    let of = |request: Request| keys(&request, &paper);
    let simulate = ["DP", "JZ2005", "MRR2005", "saltus"];
    assert_eq!(of(Request::Frequencies), ["DP", "saltus"].into());
    assert_eq!(of(Request::Simulate), simulate.into());
    let branches = of(Request::Continue {
        origin: None,
        over: None,
    });
    for key in ["Keller1977", "Kuznetsov2004", "Nordmark1991", "BBCK2008"] {
        assert!(branches.contains(key), "{key}");
    }
    assert!(!branches.contains("Benettin1980"));
    let matched = of(Request::Basins { matched: true });
    assert!(matched.contains("DRW2023") && matched.contains("Burley2020"));
    assert!(!of(Request::Basins { matched: false }).contains("DRW2023"));
    assert!(of(Request::Lyapunov).contains("KaplanYorke1979"));
}

#[test]
fn the_study_says_which_methods_there_are() {
    let rk4 = study(|s| s.solver.method = Method::Rk4);
    let simulate = keys(&Request::Simulate, &rk4);
    assert!(simulate.contains("HW1996") && !simulate.contains("JZ2005"));
    let orbit = keys(&Request::Orbit, &rk4);
    assert!(orbit.contains("HW1996") && orbit.contains("JZ2005"));
    let slow = study(|s| s.plate.inertia = Inertia::SlowManifold);
    assert!(keys(&Request::Simulate, &slow).contains("Lorenz1986"));
    let silent = study(|s| {
        let map = s.map.as_mut().expect("the paper's study has a map");
        map.exponent = 0;
    });
    assert!(keys(&Request::Map, &Study::paper()).contains("Benettin1980"));
    assert!(!keys(&Request::Map, &silent).contains("Benettin1980"));
}

/// The fields of an entry; panics where BibTeX would complain.
fn fields(entry: &str) -> BTreeSet<&str> {
    let mut depth = 0;
    for letter in entry.chars() {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        assert!(depth >= 0, "{entry}");
    }
    assert_eq!(depth, 0, "{entry}");
    assert!(entry.is_ascii(), "{entry}");
    let lines = entry
        .lines()
        .filter(|line| line.starts_with("  ") && line.contains(" = {"));
    let names: Vec<&str> = lines
        .filter_map(|line| line.trim().split(" = ").next())
        .collect();
    let unique: BTreeSet<&str> = names.iter().copied().collect();
    assert_eq!(unique.len(), names.len(), "{entry}");
    unique
}

#[test]
fn entries_are_sound() {
    let mut keys = BTreeSet::new();
    for entry in REFERENCES.split("\n\n") {
        let (kind, rest) = entry.trim_start_matches('@').split_once('{').expect(entry);
        let key = rest.split(',').next().expect(entry);
        assert!(keys.insert(key), "{key} twice");
        let required: &[&str] = match kind {
            "misc" => &["author", "title"],
            "article" => &["author", "title", "journal", "volume", "year"],
            "book" => &["author", "title", "publisher", "year"],
            "incollection" => &["author", "title", "booktitle", "year"],
            other => panic!("an entry of kind {other}"),
        };
        let fields = fields(entry);
        assert!(
            required.iter().all(|field| fields.contains(field)),
            "{entry}"
        );
    }
}

#[test]
fn the_entry_of_a_work_is_its_own() {
    let works = citations(&Request::Simulate, &Study::paper());
    assert!(works[0].bibtex.starts_with("@misc{saltus,"));
    assert!(works[0].bibtex.contains(env!("CARGO_PKG_VERSION")));
    assert!(works[2].bibtex.contains("Jorba") && works[2].bibtex.ends_with("\n}\n"));
    assert_eq!(works[2].bibtex.matches('@').count(), 1);
    let title = "saltus: people who jump on a vibrating von Kármán plate";
    assert!(include_str!("../../../../CITATION.cff").contains(title));
    let plain = works[0].bibtex.replace("{\\'a}", "á");
    assert!(plain.contains(title), "{plain}");
}
