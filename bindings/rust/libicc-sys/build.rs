//! Finds libicc and tells Cargo how to link it.
//!
//! - the feature `vendored`: compiled here from the sources in the folder `c`, by CMake and a C compiler, and linked in;
//!   for other machines CMake takes `CMAKE_TOOLCHAIN_FILE`.
//! - `LIBICC_DIR`: a folder with the library, or a prefix that it was installed to. Without it the command
//!   `pkg-config` (or `PKG_CONFIG`) is asked.
//! - `LIBICC_STATIC=1`, or the feature `static`: libicc.a instead of libicc.so.
//! - `LIBICC_PRIVATE_LIBS`: what libicc.a in `LIBICC_DIR` needs, `m pthread` if not set.
//!
//! A dynamic library beyond the system's folders must be found when the program starts, too, by
//! `LD_LIBRARY_PATH` or a run path.
use std::env;
use std::path::{Path, PathBuf};
use std::process::{exit, Command};

const VERSION: &str = "0.1.0";
const VARIABLES: [&str; 6] = [
    "LIBICC_DIR",
    "LIBICC_STATIC",
    "LIBICC_PRIVATE_LIBS",
    "PKG_CONFIG",
    "PKG_CONFIG_PATH",
    "CMAKE_TOOLCHAIN_FILE",
];

fn main() {
    for name in VARIABLES {
        println!("cargo:rerun-if-env-changed={}", name);
    }
    println!("cargo:rerun-if-changed=build.rs");
    if env::var_os("DOCS_RS").is_some() {
        return;
    }
    if env::var_os("CARGO_FEATURE_VENDORED").is_some() {
        return link_folder(&compiled(), true);
    }
    let linked_in = env::var_os("CARGO_FEATURE_STATIC").is_some()
        || env::var("LIBICC_STATIC").map_or(false, |value| !value.is_empty() && value != "0");
    match env::var("LIBICC_DIR") {
        Ok(dir) if !dir.is_empty() => link_folder(Path::new(&dir), linked_in),
        _ => link_installed(linked_in),
    }
}

/// The folder where libicc.a has been compiled.
fn compiled() -> PathBuf {
    let sources = Path::new(&variable("CARGO_MANIFEST_DIR")).join("c");
    let folder = Path::new(&variable("OUT_DIR")).join("c");
    println!("cargo:rerun-if-changed={}", sources.display());
    println!("cargo:include={}", sources.join("include").display());
    cmake(Command::new("cmake").arg("-S").arg(&sources).arg("-B").arg(&folder).args([
        "-DCMAKE_BUILD_TYPE=Release",
        "-DCMAKE_POSITION_INDEPENDENT_CODE=ON",
        "-DICC_BUILD_SHARED=OFF",
        "-DICC_BUILD_TOOLS=OFF",
    ]));
    let jobs = env::var("NUM_JOBS").unwrap_or_else(|_| "1".to_string());
    cmake(Command::new("cmake").arg("--build").arg(&folder).args([
        "--target",
        "icc_static",
        "--parallel",
        &jobs,
    ]));
    folder
}

fn cmake(command: &mut Command) {
    match command.output() {
        Err(why) => fail(&format!("the feature vendored needs CMake 3.25 or later: {}", why)),
        Ok(output) if !output.status.success() => fail(&String::from_utf8_lossy(&output.stderr)),
        Ok(_) => (),
    }
}

/// A variable that Cargo sets.
fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|_| fail(&format!("{} is not set: run this by Cargo", name)))
}

fn link_folder(dir: &Path, linked_in: bool) {
    let file = if linked_in { "libicc.a" } else { "libicc.so" };
    let places = library_folders(dir);
    let folder = match places.iter().find(|place| place.join(file).exists()) {
        Some(folder) => folder,
        None => fail(&format!("LIBICC_DIR: there is no {} in {}", file, dir.display())),
    };
    println!("cargo:rustc-link-search=native={}", folder.display());
    link_itself(linked_in);
    if linked_in {
        /* Rust's own part of a program for Windows has the static pthread in it, which must not come twice. */
        let windows = env::var("TARGET").map_or(false, |target| target.ends_with("-windows-gnu"));
        let usual = if windows { "m static:-bundle=pthread" } else { "m pthread" };
        let private = env::var("LIBICC_PRIVATE_LIBS").unwrap_or_else(|_| usual.to_string());
        for name in private.split_whitespace() {
            println!("cargo:rustc-link-lib={}", name);
        }
    }
    let include = dir.join("include");
    if include.exists() {
        println!("cargo:include={}", include.display());
    }
}

/// Where libraries are in a build tree, a prefix, and a prefix of a distribution.
fn library_folders(dir: &Path) -> Vec<PathBuf> {
    let target = env::var("TARGET").unwrap_or_default();
    let triplet = target.replace("-unknown-", "-");
    vec![dir.to_path_buf(), dir.join("lib"), dir.join("lib64"), dir.join("lib").join(triplet)]
}

fn link_installed(linked_in: bool) {
    if let Err(why) = pkg_config(&["--print-errors", "--atleast-version", VERSION]) {
        fail(&format!(
            "pkg-config does not know libicc {}: set PKG_CONFIG_PATH or LIBICC_DIR, install libicc-map-dev, \
             or have it compiled by the feature `vendored`.\n{}",
            VERSION, why
        ));
    }
    let kind: &[&str] = if linked_in { &["--static", "--libs"] } else { &["--libs"] };
    let flags = pkg_config(kind).unwrap_or_else(|why| fail(&why));
    /* pkg-config leaves out the folders of the system, where rustc does not look for static libraries. */
    let folder = pkg_config(&["--variable=libdir"]).unwrap_or_else(|why| fail(&why));
    println!("cargo:rustc-link-search=native={}", folder.trim());
    for flag in flags.split_whitespace() {
        if let Some(folder) = flag.strip_prefix("-L") {
            println!("cargo:rustc-link-search=native={}", folder);
        } else if flag == "-licc" {
            link_itself(linked_in);
        } else if let Some(name) = flag.strip_prefix("-l") {
            println!("cargo:rustc-link-lib={}", name);
        }
    }
    if let Ok(include) = pkg_config(&["--variable=includedir"]) {
        println!("cargo:include={}", include.trim());
    }
}

fn link_itself(linked_in: bool) {
    println!("cargo:rustc-link-lib={}=icc", if linked_in { "static" } else { "dylib" });
}

/// What the command prints, or why it could not.
fn pkg_config(arguments: &[&str]) -> Result<String, String> {
    let command = env::var("PKG_CONFIG").unwrap_or_else(|_| "pkg-config".to_string());
    let output = Command::new(&command)
        .args(arguments)
        .arg("libicc")
        .output()
        .map_err(|why| format!("{}: {}", command, why))?;
    if output.status.success() {
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

fn fail(why: &str) -> ! {
    eprintln!("libicc-sys: {}", why);
    exit(1)
}
