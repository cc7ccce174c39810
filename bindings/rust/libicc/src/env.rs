//! Threads and progress of a call.
use crate::error::{Error, Result};
use crate::sys;
use std::any::Any;
use std::ffi::CStr;
use std::fmt;
use std::ops::ControlFlow;
use std::os::raw::{c_char, c_void};
use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};

type Progress<'a> = dyn FnMut(&str, f64) -> ControlFlow<()> + 'a;

/// How a call runs: on how many threads, and who hears of its progress.
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
    progress: Option<Box<Progress<'a>>>,
}

impl<'a> Env<'a> {
    /// One thread, no callback.
    pub fn new() -> Self {
        Env::default()
    }

    /// How many threads a call may use, the calling one included; 0 and 1 mean one. They live only during the
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

    /// Called on the calling thread now and then during long work, with the name of the stage and the share
    /// done, in \[0,1\]. [`ControlFlow::Break`] cancels the call, which then fails with
    /// [`Status::CANCELLED`](crate::Status::CANCELLED) as soon as it can. A panic cancels it, too, and goes on
    /// when the library has cleaned up.
    pub fn progress(mut self, callback: impl FnMut(&str, f64) -> ControlFlow<()> + 'a) -> Self {
        self.progress = Some(Box::new(callback));
        self
    }

    /// Makes a call with a raw environment, and turns its status into a result.
    pub(crate) fn call(
        &mut self,
        function: impl FnOnce(*const sys::icc_env, *mut sys::icc_error) -> sys::icc_status,
    ) -> Result<()> {
        let mut error = sys::icc_error { index: -1, ..Default::default() };
        let mut raw = sys::icc_env { threads: self.threads, ..Default::default() };
        let progress = match &mut self.progress {
            None => return finish(function(&raw, &mut error), &error),
            Some(progress) => progress.as_mut(),
        };
        let mut listener = Listener { progress, panic: None };
        raw.user = &mut listener as *mut Listener<'_, 'a> as *mut c_void;
        raw.progress = Some(report);
        let status = function(&raw, &mut error);
        if let Some(payload) = listener.panic {
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

struct Listener<'c, 'a> {
    progress: &'c mut Progress<'a>,
    panic: Option<Box<dyn Any + Send>>,
}

/// Hands the library's progress to the listener. No panic may unwind through C: it is kept until the call is
/// over, and the callback is not run again.
unsafe extern "C" fn report(user: *mut c_void, stage: *const c_char, share: f64) -> i32 {
    // SAFETY: `user` is the listener in `Env::call`, which the library hands out on the calling thread only.
    let listener = unsafe { &mut *(user as *mut Listener<'_, '_>) };
    if listener.panic.is_some() {
        return 1;
    }
    // SAFETY: the names of stages are terminated strings.
    let stage = unsafe { CStr::from_ptr(stage) }.to_str().unwrap_or("");
    let progress = &mut listener.progress;
    match catch_unwind(AssertUnwindSafe(|| progress(stage, share))) {
        Ok(ControlFlow::Continue(())) => 0,
        Ok(ControlFlow::Break(())) => 1,
        Err(payload) => {
            listener.panic = Some(payload);
            1
        }
    }
}
