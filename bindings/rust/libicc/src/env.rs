//! Threads, progress and diagnostics of a call.
use crate::error::{Error, Result};
use crate::sys;
use std::any::Any;
use std::ffi::CStr;
use std::fmt;
use std::ops::ControlFlow;
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::{Mutex, PoisonError};

type Progress<'a> = dyn FnMut(&str, f64) -> ControlFlow<()> + 'a;
type Log<'a> = dyn Fn(&str) + Sync + 'a;

/// How a call runs: its threads, and its callbacks for progress and diagnostics.
///
/// Results are bit-identical for every number of threads.
///
/// ```
/// use libicc::{Chart, ChartOptions, Domain, Env};
/// use std::ops::ControlFlow;
/// let mut stages = Vec::new();
/// let mut env = Env::new().threads(2).progress(|stage, share| {
///     stages.push((stage.to_string(), share));
///     ControlFlow::Continue(())
/// });
/// let square = Domain::polygon(&[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0], &mut env)?;
/// Chart::new(&square, &ChartOptions::default(), &mut env)?;
/// drop(env);
/// assert!(stages.iter().all(|(_, share)| (0.0..=1.0).contains(share)));
/// # Ok::<(), libicc::Error>(())
/// ```
#[derive(Default)]
pub struct Env<'a> {
    threads: i32,
    load_limit: u64,
    progress: Option<Box<Progress<'a>>>,
    log: Option<Box<Log<'a>>>,
}

impl<'a> Env<'a> {
    /// One thread, no callback.
    pub fn new() -> Self {
        Env::default()
    }

    /// Number of threads that a call may use, including the calling one; 0 and 1 mean one. They live only during the
    /// call.
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = i32::try_from(threads).unwrap_or(i32::MAX);
        self
    }

    /// As many threads as the machine runs at a time.
    pub fn all_threads(self) -> Self {
        let threads = std::thread::available_parallelism().map_or(1, |n| n.get());
        self.threads(threads)
    }

    /// Bytes of memory that loading an object may take, in addition to 64 for each byte of its data; 0 means
    /// 256,000,000. Time is limited in proportion. Charts on fine grids are rebuilt and may need more. `u64::MAX` is
    /// for bytes that you trust.
    pub fn load_limit(mut self, bytes: u64) -> Self {
        self.load_limit = bytes;
        self
    }

    /// Called on the calling thread from time to time during long work, with the name of the stage and the share
    /// of the whole call that is done, which goes from 0 to 1 and never falls. [`ControlFlow::Break`] cancels the
    /// call, which then fails with [`Status::CANCELLED`](crate::Status::CANCELLED) as soon as it can. A panic cancels
    /// it as well, and resumes after the library has cleaned up.
    pub fn progress(mut self, callback: impl FnMut(&str, f64) -> ControlFlow<()> + 'a) -> Self {
        self.progress = Some(Box::new(callback));
        self
    }

    /// Called with lines of diagnostics, on any thread. A panic resumes as in [`progress`](Self::progress).
    pub fn log(mut self, callback: impl Fn(&str) + Sync + 'a) -> Self {
        self.log = Some(Box::new(callback));
        self
    }

    /// Makes a call with a raw environment, and turns its status into a result.
    pub(crate) fn call(
        &mut self,
        function: impl FnOnce(*const sys::icc_env, *mut sys::icc_error) -> sys::icc_status,
    ) -> Result<()> {
        let mut error = sys::icc_error { index: -1, ..Default::default() };
        let mut raw =
            sys::icc_env { threads: self.threads, load_limit: self.load_limit, ..Default::default() };
        if self.progress.is_none() && self.log.is_none() {
            return finish(function(&raw, &mut error), &error);
        }
        raw.progress = Some(report);
        if self.log.is_some() {
            raw.log = Some(tell);
        }
        let mut listener = Listener {
            progress: self.progress.as_deref_mut(),
            log: self.log.as_deref(),
            panic: Mutex::new(None),
        };
        raw.user = &mut listener as *mut Listener<'_, 'a> as *mut c_void;
        let status = function(&raw, &mut error);
        if let Some(payload) = listener.panic.into_inner().unwrap_or_else(PoisonError::into_inner) {
            resume_unwind(payload);
        }
        finish(status, &error)
    }
}

impl fmt::Debug for Env<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Env")
            .field("threads", &self.threads)
            .field("progress", &self.progress.is_some())
            .field("log", &self.log.is_some())
            .finish()
    }
}

fn finish(status: sys::icc_status, error: &sys::icc_error) -> Result<()> {
    if status == sys::ICC_OK {
        Ok(())
    } else {
        Err(Error::from_raw(status, error))
    }
}

/// The receivers of callbacks. No panic may unwind through C, so the first one cancels the call and is kept until the
/// call is over.
struct Listener<'c, 'a> {
    progress: Option<&'c mut Progress<'a>>,
    log: Option<&'c Log<'a>>,
    panic: Mutex<Option<Payload>>,
}

type Payload = Box<dyn Any + Send>;

/// Runs a callback unless one has panicked.
fn guarded<T>(panic: &Mutex<Option<Payload>>, callback: impl FnOnce() -> T) -> Option<T> {
    let kept = || panic.lock().unwrap_or_else(PoisonError::into_inner);
    if kept().is_some() {
        return None;
    }
    match catch_unwind(AssertUnwindSafe(callback)) {
        Ok(value) => Some(value),
        Err(payload) => {
            kept().get_or_insert(payload);
            None
        }
    }
}

/// Passes the library's progress on.
unsafe extern "C" fn report(user: *mut c_void, stage: *const c_char, share: f64) -> i32 {
    let listener = user as *mut Listener<'_, '_>;
    // SAFETY: `user` is the listener in `Env::call`; only this function, which the library calls on the calling
    // thread, touches its progress.
    let (progress, panic) = unsafe { (&mut (*listener).progress, &(*listener).panic) };
    // SAFETY: the names of stages are terminated strings.
    let stage = unsafe { CStr::from_ptr(stage) }.to_str().unwrap_or("");
    let answer = guarded(panic, || match progress {
        Some(progress) => progress(stage, share),
        None => ControlFlow::Continue(()),
    });
    i32::from(answer != Some(ControlFlow::Continue(())))
}

/// Passes a line of diagnostics on, on any thread.
unsafe extern "C" fn tell(user: *mut c_void, message: *const c_char) {
    let listener = user as *const Listener<'_, '_>;
    // SAFETY: `user` is the listener in `Env::call`; these two members may be shared.
    let (log, panic) = unsafe { (&(*listener).log, &(*listener).panic) };
    // SAFETY: a terminated string.
    let message = unsafe { CStr::from_ptr(message) }.to_string_lossy();
    if let Some(log) = log {
        guarded(panic, || log(&message));
    }
}
