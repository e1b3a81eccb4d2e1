//! Questions of a study file and what was found, as `saltus_commands` has them.

use crate::error;
use crate::running::{Board, Listener, aside, attended, sound};
use numpy::{IntoPyArray, PyArrayMethods};
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyUserWarning, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyTuple};
use saltus_commands::{
    Answer as Answered, CommandError, Destination, Existing, Fill, Folder, KeptResult, Pieces,
    PiecesAt, Request, RunContext, SavedResult, Store, Told, about, bibtex, citations,
};
use saltus_config::Study;
use saltus_results::{
    Attribute, Cells, Dataset, Figure as Drawing, FigureStyle, NamedColumn, Values, Variable,
    write_file_atomically,
};
use std::borrow::Cow;
use std::ffi::CString;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What was found, with what was asked.
#[pyclass(frozen, module = "saltus._native")]
pub(crate) struct Answer {
    known: Arc<Known>,
}

enum Known {
    /// Computed here.
    Found {
        request: Request,
        study: Study,
        found: Box<dyn Answered>,
    },
    /// Read from a folder.
    Kept(KeptResult),
}

impl Known {
    fn request(&self) -> &Request {
        match self {
            Self::Found { request, .. } => request,
            Self::Kept(kept) => kept.request(),
        }
    }

    fn study(&self) -> &Study {
        match self {
            Self::Found { study, .. } => study,
            Self::Kept(kept) => kept.study(),
        }
    }
}

/// A piece of long work: its number, and bytes that say of themselves whether they are whole and of which work.
type Piece = (u32, Cow<'static, [u8]>);

/// Asks; `request` and `study` are JSON. With `out` the folder of results is written too, and what is finished of
/// a long computation is kept beside it until then. With `pieces` these are put together.
#[pyfunction]
#[pyo3(signature = (request, study, *, out=None, resume=false, pieces=None, threads=0, progress=None))]
#[expect(
    clippy::too_many_arguments,
    reason = "all but two have names in Python"
)]
pub(crate) fn ask(
    py: Python<'_>,
    request: &str,
    study: &str,
    out: Option<PathBuf>,
    resume: bool,
    pieces: Option<Vec<(u32, Vec<u8>)>>,
    threads: usize,
    progress: Listener,
) -> PyResult<Answer> {
    let (request, study) = question(request, study)?;
    let board: Arc<Board> = Arc::default();
    let keep = match pieces {
        Some(pieces) => Some(Pieces {
            place: PiecesAt::Memory(pieces),
            found: Existing::Merge,
        }),
        None => out.clone().map(|out| Pieces {
            place: PiecesAt::Beside(out),
            found: if resume {
                Existing::Resume
            } else {
                Existing::Refuse
            },
        }),
    };
    let watch = Arc::clone(&board);
    let answer = attended(py, &progress, &board, move |stop| {
        let context = RunContext {
            threads,
            stop: stop.clone(),
            watch: &*watch,
            keep,
            ..RunContext::default()
        };
        asked(request, &study, out.as_deref(), &context).map_err(|failure| error::of(&failure))
    })?;
    for note in board.notes() {
        let note = CString::new(note).unwrap_or_default();
        PyErr::warn(py, &py.get_type::<PyUserWarning>(), &note, 2)?;
    }
    Ok(answer)
}

/// How many pieces the work can be cut into.
#[pyfunction]
pub(crate) fn pieces(request: &str, study: &str) -> PyResult<u32> {
    let (request, study) = question(request, study)?;
    sound(|| {
        request
            .pieces(&study)
            .map_err(|failure| error::of(&failure))
    })
}

/// Makes pieces of the work, counted from 0.
#[pyfunction]
#[pyo3(signature = (request, study, pieces, *, threads=0, progress=None))]
pub(crate) fn compute(
    py: Python<'_>,
    request: &str,
    study: &str,
    pieces: Vec<u32>,
    threads: usize,
    progress: Listener,
) -> PyResult<Vec<Piece>> {
    let (request, study) = question(request, study)?;
    let board: Arc<Board> = Arc::default();
    let watch = Arc::clone(&board);
    attended(py, &progress, &board, move |stop| {
        let context = RunContext {
            threads,
            stop: stop.clone(),
            watch: &*watch,
            keep: None,
            ..RunContext::default()
        };
        let made = request.compute(&study, &pieces, &context);
        let made = made.map_err(|failure| error::of(&failure))?;
        Ok(made
            .into_iter()
            .map(|(number, bytes)| (number, Cow::Owned(bytes)))
            .collect())
    })
}

fn question(request: &str, study: &str) -> PyResult<(Request, Study)> {
    sound(|| {
        let request: Request = serde_json::from_str(request).map_err(error::of_definition)?;
        let study =
            Study::from_json(study, &[]).map_err(|problem| error::of_study(&problem, &[]))?;
        Ok((request, study))
    })
}

fn asked(
    request: Request,
    study: &Study,
    out: Option<&Path>,
    context: &RunContext,
) -> Result<Answer, CommandError> {
    let study = request.study(study)?;
    let destination = Destination {
        request: &request,
        study: &study,
        context,
    };
    // refused before a long computation
    out.map_or(Ok(()), |out| destination.try_out(out))?;
    let mut found = request.ask(&study, context)?;
    if let Some(out) = out {
        destination.store(out, found.as_ref())?;
        found.stored()?;
    }
    let known = Known::Found {
        request,
        study,
        found,
    };
    Ok(Answer {
        known: Arc::new(known),
    })
}

/// Reads a result from its folder.
#[pyfunction]
pub(crate) fn read(py: Python<'_>, path: PathBuf) -> PyResult<Answer> {
    aside(py, move || {
        let kept = SavedResult::open(&path).and_then(SavedResult::read);
        let kept = kept.map_err(|failure| error::of(&failure))?;
        Ok(Answer {
            known: Arc::new(Known::Kept(kept)),
        })
    })
}

#[pymethods]
impl Answer {
    /// The command.
    #[getter]
    fn command(&self) -> &'static str {
        self.known.request().name()
    }

    /// The study it is about, as JSON, TOML and hash.
    #[getter]
    fn study(&self) -> PyResult<(String, String, String)> {
        let study = self.known.study();
        sound(|| Ok((study.to_json(), study.to_toml(), study.hash())))
    }

    /// What it says to people.
    fn summary(&self) -> PyResult<String> {
        sound(|| {
            Ok(match &*self.known {
                Known::Found { found, .. } => Told::summary(&**found),
                Known::Kept(kept) => kept.summary().to_owned(),
            })
        })
    }

    /// The JSON document.
    fn document(&self, py: Python<'_>) -> PyResult<String> {
        sound(|| {
            let text = match &*self.known {
                Known::Found { found, .. } => {
                    let mut text = Vec::new();
                    py.detach(|| Told::document(&**found, &mut text))?;
                    text
                }
                Known::Kept(kept) => kept.document().to_vec(),
            };
            String::from_utf8(text).map_err(error::of_computation)
        })
    }

    /// The works that it rests on, as BibTeX.
    fn cite(&self) -> PyResult<String> {
        sound(|| {
            Ok(match &*self.known {
                Known::Found { request, study, .. } => bibtex(&citations(request, study)),
                Known::Kept(kept) => kept.cite(),
            })
        })
    }

    /// Why it is not all that was asked for, if so.
    fn shortfall(&self) -> PyResult<Option<String>> {
        sound(|| {
            Ok(match &*self.known {
                Known::Found { found, .. } => found.shortfall().map(|failure| failure.to_string()),
                Known::Kept(kept) => kept.shortfall().map(str::to_owned),
            })
        })
    }

    /// Everything but the document: tables, figures, datasets and texts, each a dict by name. Of a result that was read
    /// tables and figures are among the texts, as the bytes of their files.
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        sound(|| {
            let mut memory = Memory::default();
            let name = self.known.request().dataset();
            py.detach(|| match &*self.known {
                Known::Found { found, .. } => found.fill(&mut memory, &name),
                Known::Kept(kept) => {
                    memory.texts = kept.files().to_vec();
                    memory.datasets.push((name, kept.data()?));
                    Ok(())
                }
            })
            .map_err(|failure| error::of(&failure))?;
            memory.handed_over(py)
        })
    }

    /// Writes the folder of results that the program writes.
    fn save(&self, py: Python<'_>, out: PathBuf) -> PyResult<()> {
        let known = Arc::clone(&self.known);
        attended(py, &None, &Arc::default(), move |stop| {
            let context = RunContext {
                stop: stop.clone(),
                ..RunContext::default()
            };
            let save = || match &*known {
                Known::Found {
                    request,
                    study,
                    found,
                } => {
                    let about = about(request, study);
                    let mut folder = Folder::stage(&out, Some(about), study, &context)?;
                    found.store(request, &mut folder)?;
                    folder.commit().map(drop)
                }
                Known::Kept(kept) => kept.save(&out),
            };
            save().map_err(|failure| error::of(&failure))
        })
    }
}

/// A figure, drawn when it is asked for.
#[pyclass(frozen, module = "saltus._native")]
pub(crate) struct Figure {
    drawing: Drawing,
}

#[pymethods]
impl Figure {
    /// As SVG.
    fn svg(&self, py: Python<'_>) -> PyResult<String> {
        sound(|| Ok(py.detach(|| self.drawing.svg())))
    }

    /// The same figure of a width and size of type in print, with or without titles.
    fn styled(&self, width: Option<&str>, font_size: &str, titles: bool) -> PyResult<Self> {
        let styled = || {
            let style = FigureStyle::default().titles(titles).font_size(font_size)?;
            match width {
                Some(width) => style.width(width),
                None => Ok(style),
            }
        };
        let style = styled().map_err(|error| PyValueError::new_err(error.to_string()))?;
        let drawing = self.drawing.clone().style(style);
        Ok(Self { drawing })
    }

    /// As PDF.
    fn pdf(&self, py: Python<'_>) -> PyResult<Vec<u8>> {
        sound(|| Ok(py.detach(|| self.drawing.pdf())))
    }

    /// As PNG, with so many pixels per unit of the SVG.
    fn png(&self, py: Python<'_>, scale: f32) -> PyResult<Vec<u8>> {
        sound(|| {
            py.detach(|| self.drawing.png(scale))
                .map_err(|failure| error::of(&failure.into()))
        })
    }
}

/// The parts of an answer, kept.
#[derive(Default)]
struct Memory {
    tables: Vec<(String, Vec<NamedColumn>)>,
    figures: Vec<(String, Drawing)>,
    datasets: Vec<(String, Dataset)>,
    texts: Vec<(String, Vec<u8>)>,
}

impl Memory {
    fn handed_over(self, py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
        let (tables, figures) = (PyDict::new(py), PyDict::new(py));
        let (datasets, texts) = (PyDict::new(py), PyDict::new(py));
        for (name, columns) in self.tables {
            tables.set_item(name, table(py, columns)?)?;
        }
        for (name, drawing) in self.figures {
            figures.set_item(name, Figure { drawing })?;
        }
        for (name, data) in self.datasets {
            datasets.set_item(name, dataset(py, data)?)?;
        }
        for (name, text) in self.texts {
            texts.set_item(name, text)?;
        }
        PyTuple::new(py, [tables, figures, datasets, texts])
    }
}

impl Store for Memory {
    fn put_text(&mut self, name: &str, fill: Fill) -> Result<(), CommandError> {
        let mut text = Vec::new();
        // a vector takes everything
        let _ = fill(&mut text);
        self.texts.push((name.to_owned(), text));
        Ok(())
    }

    fn put_figure(&mut self, name: &str, figure: &Drawing) -> Result<(), CommandError> {
        self.figures.push((name.to_owned(), figure.clone()));
        Ok(())
    }

    fn put_dataset(&mut self, name: &str, dataset: Dataset) -> Result<(), CommandError> {
        for table in dataset.tables().iter().filter(|table| table.is_file()) {
            let columns = table.to_columns(&dataset)?;
            self.tables.push((format!("{}.csv", table.name()), columns));
        }
        self.datasets.push((name.to_owned(), dataset));
        Ok(())
    }
}

/// Notes on the columns, and the columns.
fn table<'py>(py: Python<'py>, columns: Vec<NamedColumn>) -> PyResult<Bound<'py, PyTuple>> {
    let (notes, arrays) = (PyDict::new(py), PyDict::new(py));
    for column in columns {
        let array = match column.cells {
            Cells::F64(values) => values.into_pyarray(py).into_any(),
            Cells::I64(values) => values.into_pyarray(py).into_any(),
            Cells::Flags(values) => PyList::new(py, values)?.into_any(),
            Cells::Text(values) => PyList::new(py, values)?.into_any(),
            other => return Err(error::of_computation(format!("{other:?}"))),
        };
        notes.set_item(&column.title, column.note)?;
        arrays.set_item(column.title, array)?;
    }
    PyTuple::new(py, [notes, arrays])
}

/// Attributes, and the variables in their order.
fn dataset<'py>(py: Python<'py>, dataset: Dataset) -> PyResult<Bound<'py, PyTuple>> {
    let attributes = attributes(py, dataset.attributes())?;
    let coordinates: Vec<bool> = dataset
        .variables()
        .iter()
        .map(|variable| dataset.is_coordinate(variable.name()))
        .collect();
    let lengths = dataset.dimensions().to_vec();
    let length = |name: &String| {
        let known = lengths.iter().find(|(dimension, _)| dimension == name);
        known.map_or(0, |(_, length)| *length)
    };
    let variables = PyList::empty(py);
    for (variable, coordinate) in dataset.into_variables().into_iter().zip(coordinates) {
        let shape: Vec<usize> = variable.dimensions().iter().map(length).collect();
        variables.append(array(py, variable, &shape, coordinate)?)?;
    }
    PyTuple::new(py, [attributes.into_any(), variables.into_any()])
}

/// Name, dimensions, shape, values, attributes, meanings of flags, what stands for no value, whether it is a coordinate.
fn array<'py>(
    py: Python<'py>,
    variable: Variable,
    shape: &[usize],
    coordinate: bool,
) -> PyResult<Bound<'py, PyTuple>> {
    let name = variable.name().to_owned();
    let dimensions = variable.dimensions().to_vec();
    let about = attributes(py, variable.attributes())?;
    let flags = variable.flag_meanings().to_vec();
    let fill = variable.fill_value();
    let values = match variable.into_values() {
        Values::F64(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        Values::F32(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        Values::I32(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        Values::U16(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        Values::U8(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        Values::I64(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        Values::Bool(values) => values.into_pyarray(py).reshape(shape)?.into_any(),
        Values::Text(values) => PyList::new(py, values)?.into_any(),
        other => return Err(error::of_computation(format!("{other:?}"))),
    };
    PyTuple::new(
        py,
        [
            name.into_bound_py_any(py)?,
            dimensions.into_bound_py_any(py)?,
            shape.to_vec().into_bound_py_any(py)?,
            values,
            about.into_any(),
            flags.into_bound_py_any(py)?,
            fill.into_bound_py_any(py)?,
            coordinate.into_bound_py_any(py)?,
        ],
    )
}

fn attributes<'py, 'a>(
    py: Python<'py>,
    list: impl IntoIterator<Item = &'a (String, Attribute)>,
) -> PyResult<Bound<'py, PyDict>> {
    let attributes = PyDict::new(py);
    for (name, value) in list {
        match value {
            Attribute::Text(text) => attributes.set_item(name, text)?,
            Attribute::Number(number) => attributes.set_item(name, number)?,
            Attribute::Integer(number) => attributes.set_item(name, number)?,
            Attribute::Numbers(numbers) => attributes.set_item(name, numbers.clone())?,
            other => return Err(error::of_computation(format!("{other:?}"))),
        }
    }
    Ok(attributes)
}

/// Writes a file, which keeps its old content until all of the new is on disk.
#[pyfunction]
pub(crate) fn write(py: Python<'_>, path: PathBuf, content: Vec<u8>) -> PyResult<()> {
    sound(|| {
        py.detach(|| write_file_atomically(&path, content))
            .map_err(|failure| error::of(&failure.into()))
    })
}

/// The program, with these arguments; gives its exit code.
#[pyfunction]
pub(crate) fn program(py: Python<'_>, arguments: Vec<std::ffi::OsString>) -> PyResult<u8> {
    sound(|| Ok(py.detach(|| saltus_cli::main(arguments))))
}
