//! What went wrong.
use crate::sys;
use std::ffi::CStr;
use std::fmt;

/// The result of a call, or of one of its points: [`Status::OK`] or what went wrong.
///
/// A number, as in C, so that statuses of points need no conversion and later versions may have more of them.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(transparent)]
pub struct Status(pub i32);

impl Status {
    /// the call has run; points may have statuses of their own
    pub const OK: Status = Status(sys::ICC_OK);
    /// an argument is missing or out of range
    pub const ARGUMENT: Status = Status(sys::ICC_ERR_ARGUMENT);
    /// an allocation failed
    pub const MEMORY: Status = Status(sys::ICC_ERR_MEMORY);
    /// a struct or saved object is from another version
    pub const VERSION: Status = Status(sys::ICC_ERR_VERSION);
    /// the boundary is not that of a simple, solid shape
    pub const BOUNDARY: Status = Status(sys::ICC_ERR_BOUNDARY);
    /// the grid is too coarse, or would be too large
    pub const RESOLUTION: Status = Status(sys::ICC_ERR_RESOLUTION);
    /// the shape or the grid has the wrong topology
    pub const TOPOLOGY: Status = Status(sys::ICC_ERR_TOPOLOGY);
    /// a point lies outside the domain
    pub const OUTSIDE: Status = Status(sys::ICC_ERR_OUTSIDE);
    /// a numerical solver did not converge
    pub const SOLVER: Status = Status(sys::ICC_ERR_SOLVER);
    /// an integral curve does not reach its end
    pub const TRACE: Status = Status(sys::ICC_ERR_TRACE);
    /// a result could not be certified
    pub const CERTIFICATE: Status = Status(sys::ICC_ERR_CERTIFICATE);
    /// the progress callback asked to stop
    pub const CANCELLED: Status = Status(sys::ICC_ERR_CANCELLED);
    /// this combination is not supported
    pub const UNSUPPORTED: Status = Status(sys::ICC_ERR_UNSUPPORTED);
    /// input data is malformed
    pub const FORMAT: Status = Status(sys::ICC_ERR_FORMAT);
    /// several answers are equally good
    pub const AMBIGUOUS: Status = Status(sys::ICC_ERR_AMBIGUOUS);

    /// Whether it is [`Status::OK`].
    pub fn is_ok(self) -> bool {
        self == Status::OK
    }

    /// The name in C, such as `ICC_ERR_MEMORY`, or `unknown status`.
    pub fn name(self) -> &'static str {
        // SAFETY: a static string for every number.
        unsafe { CStr::from_ptr(sys::icc_status_name(self.0)) }.to_str().unwrap_or("unknown status")
    }
}

impl fmt::Debug for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Which of two shapes is at fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// the source, before the deformation
    Source,
    /// the target, after the deformation
    Target,
}

/// What [`Error::index`] counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Item {
    /// vertices of a boundary, a mesh or the curves of a shape
    Vertex,
    /// facets of a boundary; edges of a polygon
    Facet,
    /// simplices of a mesh
    Simplex,
    /// cells of a mask, the first axis fastest
    Cell,
    /// vertices of a grid
    GridVertex,
    /// axes
    Axis,
    /// points of a list
    Point,
    /// regions of a shape
    Region,
    /// segments of a shape's curves
    Segment,
    /// samples of a sampling
    Sample,
    /// handles
    Handle,
    /// edges between handles
    Edge,
    /// lines to keep straight
    Line,
    /// entries of a list of nodes
    Node,
    /// features of a domain
    Feature,
}

/// In the order of the numbers `ICC_ITEM_*`, from 1.
const ITEMS: [Item; sys::ICC_ITEM_FEATURE as usize] = [
    Item::Vertex,
    Item::Facet,
    Item::Simplex,
    Item::Cell,
    Item::GridVertex,
    Item::Axis,
    Item::Point,
    Item::Region,
    Item::Segment,
    Item::Sample,
    Item::Handle,
    Item::Edge,
    Item::Line,
    Item::Node,
    Item::Feature,
];

/// Why a call failed.
///
/// ```
/// use libicc::{Domain, Env, Status};
/// let bow_tie = [0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0];
/// let error = Domain::polygon(&bow_tie, &mut Env::new()).unwrap_err();
/// assert_eq!(error.status, Status::BOUNDARY);
/// assert!(error.index.is_some() && error.item == Some(libicc::Item::Facet));
/// println!("{}", error);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Error {
    /// what kind of failure; never [`Status::OK`]
    pub status: Status,
    /// the item at fault, from 0
    pub index: Option<usize>,
    /// what that item is
    pub item: Option<Item>,
    /// which of two shapes is at fault
    pub side: Option<Side>,
    /// one line of English
    pub message: String,
}

/// What calls return.
pub type Result<T> = std::result::Result<T, Error>;

impl Error {
    pub(crate) fn argument(message: impl Into<String>) -> Error {
        Error { status: Status::ARGUMENT, index: None, item: None, side: None, message: message.into() }
    }

    /// For calls that fill in no `icc_error`.
    pub(crate) fn bare(status: sys::icc_status) -> Error {
        let status = Status(status);
        Error { status, index: None, item: None, side: None, message: status.name().to_string() }
    }

    pub(crate) fn from_raw(status: sys::icc_status, raw: &sys::icc_error) -> Error {
        if raw.status != status || raw.message[0] == 0 {
            return Error::bare(status);
        }
        // SAFETY: the library terminates the message.
        let message = unsafe { CStr::from_ptr(raw.message.as_ptr()) };
        Error {
            status: Status(status),
            index: usize::try_from(raw.index).ok(),
            item: usize::try_from(raw.item - 1).ok().and_then(|at| ITEMS.get(at).copied()),
            side: match raw.side {
                1 => Some(Side::Source),
                2 => Some(Side::Target),
                _ => None,
            },
            message: message.to_string_lossy().into_owned(),
        }
    }
}

/// For files: the input or output error wraps the library's error.
impl From<Error> for std::io::Error {
    fn from(error: Error) -> Self {
        std::io::Error::new(std::io::ErrorKind::InvalidData, error)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Error {}

pub(crate) fn check(status: sys::icc_status) -> Result<()> {
    if status == sys::ICC_OK {
        Ok(())
    } else {
        Err(Error::bare(status))
    }
}
