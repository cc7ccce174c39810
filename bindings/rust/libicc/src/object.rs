//! Handles of the library's objects, and objects as bytes.
use crate::error::{check, Result};
use crate::sys::icc_status;
use std::marker::PhantomData;
use std::mem::ManuallyDrop;
use std::ops::Deref;
use std::os::raw::c_void;
use std::ptr;

/// A borrowed object that belongs to another one, and lives as long as that one.
#[derive(Debug)]
pub struct Borrowed<'a, T> {
    object: ManuallyDrop<T>,
    owner: PhantomData<&'a T>,
}

impl<T> Borrowed<'_, T> {
    /// # Safety
    /// The object must live as long as the borrow. It is not freed.
    pub(crate) unsafe fn new(object: ManuallyDrop<T>) -> Self {
        Borrowed { object, owner: PhantomData }
    }
}

impl<T> Deref for Borrowed<'_, T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.object
    }
}

/// Declares the owner of an object, which frees it.
macro_rules! object {
    ($(#[$doc:meta])* $name:ident, $raw:ident, $free:ident) => {
        $(#[$doc])*
        #[derive(Debug)]
        pub struct $name(std::ptr::NonNull<$crate::sys::$raw>);

        // SAFETY: the library's objects never change once they are made, and count their owners atomically:
        // any number of threads may use one, and any thread may free it.
        unsafe impl Send for $name {}
        unsafe impl Sync for $name {}

        impl Drop for $name {
            fn drop(&mut self) {
                // SAFETY: made by the library, freed once.
                unsafe { $crate::sys::$free(self.0.as_ptr()) }
            }
        }

        impl $name {
            /// The raw object for calls of `libicc-sys`. Valid as long as `self`.
            pub fn as_ptr(&self) -> *const $crate::sys::$raw {
                self.0.as_ptr()
            }

            /// Calls a creator. Frees its result if the progress callback panicked.
            #[allow(dead_code)]
            pub(crate) fn make(
                env: &mut $crate::env::Env<'_>,
                create: impl FnOnce(
                    *mut *mut $crate::sys::$raw,
                    *const $crate::sys::icc_env,
                    *mut $crate::sys::icc_error,
                ) -> $crate::sys::icc_status,
            ) -> $crate::error::Result<Self> {
                let mut made = None;
                env.call(|env, err| {
                    let mut out = std::ptr::null_mut();
                    let status = create(&mut out, env, err);
                    made = std::ptr::NonNull::new(out).map($name);
                    status
                })?;
                Ok(made.expect("libicc: success without an object"))
            }

            /// An object that belongs to another one; it must not be dropped.
            #[allow(dead_code)]
            pub(crate) fn found(raw: *const $crate::sys::$raw) -> Option<std::mem::ManuallyDrop<Self>> {
                std::ptr::NonNull::new(raw as *mut _).map(|raw| std::mem::ManuallyDrop::new($name(raw)))
            }
        }
    };
}
pub(crate) use object;

/// Files of objects that have `to_bytes` and `from_bytes`.
macro_rules! saved {
    ($name:ident) => {
        impl $name {
            /// Writes [`to_bytes`](Self::to_bytes) to a file.
            pub fn save(&self, path: impl AsRef<std::path::Path>) -> std::io::Result<()> {
                std::fs::write(path, self.to_bytes()?)
            }

            /// Reads a file that [`save`](Self::save) wrote, as [`from_bytes`](Self::from_bytes) reads bytes.
            ///
            /// # Errors
            /// Those of reading the file; and an error of kind `InvalidData` that holds an [`Error`](crate::Error).
            pub fn load(
                path: impl AsRef<std::path::Path>,
                env: &mut $crate::env::Env<'_>,
            ) -> std::io::Result<$name> {
                Ok($name::from_bytes(&std::fs::read(path)?, env)?)
            }
        }
    };
}
pub(crate) use saved;

/// Asks how many bytes are needed, then for them.
pub(crate) fn to_bytes(write: impl Fn(usize, *mut c_void, *mut usize) -> icc_status) -> Result<Vec<u8>> {
    let mut n = 0;
    check(write(0, ptr::null_mut(), &mut n))?;
    let mut data = vec![0; n];
    check(write(data.len(), data.as_mut_ptr().cast(), &mut n))?;
    Ok(data)
}
