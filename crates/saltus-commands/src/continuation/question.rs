//! The question: parameters, their ranges, and the first orbit.

use crate::failure::CommandError;
use crate::plane::need_people;
use saltus::orbits::{BranchesOptions, ContinuationOptions, ParameterRange};
use saltus_config::{ContinueTable, Parameter, SecondTable, Study};

/// Shown to those whose study has none.
const EXAMPLE: &str = "\
add a table that says what changes, such as

  [continue]
  parameter = \"jumper.damping_ratio\"
  from = 0.1
  to = 0.5";

/// Branches over one parameter, and perhaps curves over a second one.
pub(super) struct Question {
    pub(super) table: ContinueTable,
    pub(super) parameter: Parameter,
    pub(super) second: Option<(SecondTable, Parameter)>,
    /// The study's own values: of the second parameter, if there is one, then of the first.
    pub(super) start: Vec<f64>,
}

impl Question {
    pub(super) fn new(study: &Study) -> Result<Self, CommandError> {
        let table = study.continuation.as_ref();
        let table = table
            .ok_or_else(|| CommandError::refused("the study has no [continue] table", EXAMPLE))?;
        need_people(study, "a branch of orbits")?;
        let mut start = vec![table.start(study)?];
        let mut second = None;
        if let Some(more) = &table.second {
            start.insert(0, more.start(study)?);
            second = Some((more.clone(), Parameter::parse(&more.parameter)?));
        }
        Ok(Self {
            table: table.clone(),
            parameter: Parameter::parse(&table.parameter)?,
            second,
            start,
        })
    }

    /// In the order of the values.
    pub(super) fn parameters(&self) -> Vec<&Parameter> {
        let second = self.second.iter().map(|(_, parameter)| parameter);
        second.chain([&self.parameter]).collect()
    }

    /// The values with the parameter of the branches at `value`.
    pub(super) fn at(&self, value: f64) -> Vec<f64> {
        let mut values = self.start.clone();
        values[self.along().parameter] = value;
        values
    }

    /// The range of the branches.
    pub(super) fn along(&self) -> ParameterRange {
        ParameterRange {
            parameter: self.start.len() - 1,
            from: self.table.from,
            to: self.table.to,
        }
    }

    /// The range of the second parameter.
    pub(super) fn across(&self) -> Option<ParameterRange> {
        let (table, _) = self.second.as_ref()?;
        Some(ParameterRange {
            parameter: 0,
            from: table.from,
            to: table.to,
        })
    }

    /// Points of branches and curves, about: as many to a largest step as in the paper's case.
    pub(super) fn points(&self) -> f64 {
        let curves = |(table, _): &(SecondTable, Parameter)| match table.curves.len() {
            0 => 8.0,
            some => some as f64,
        };
        let curves = self.second.as_ref().map_or(0.0, curves);
        (10.0 + 6.0 * curves) / self.table.step
    }

    pub(super) fn options(&self) -> BranchesOptions {
        let usual = ContinuationOptions::default();
        BranchesOptions {
            continuation: ContinuationOptions {
                initial: usual.initial.min(self.table.step),
                largest: self.table.step,
                points: self.table.points as usize,
                ..usual
            },
            doublings: self.table.doublings as usize,
            ..BranchesOptions::default()
        }
    }
}
