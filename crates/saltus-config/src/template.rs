//! The study file that `saltus init paper` writes.

/// The paper's case as a study file, each key explained. Parses to [`Study::paper`](crate::Study::paper).
pub fn paper_template() -> String {
    include_str!("template.toml").to_owned()
}
