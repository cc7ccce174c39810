"""Runs the blocks of a page of documentation: they share one folder, in which the tree's examples and bindings
are at hand, and run in their order; Python blocks share their names. Tells what was left out and why.

usage: snippets.py ROOT STAGE WORK CC CXX CARGO PAGE      STAGE: an installed library; CARGO may be empty
"""

import contextlib
import importlib.util
import io
import os
import re
import shutil
import subprocess
import sys
import traceback
import types
from pathlib import Path

from blocks import HERE, RUN, Mistake, blocks_of

STRICT = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
CARGO_TOML = """[package]
name = "{1}"
version = "1.0.0"
edition = "2021"

[dependencies]
libicc = {{ path = "{0}/bindings/rust/libicc" }}
"""


class LeftOut(Exception):
    """Why a block was not run."""


class Page:
    def __init__(self, root, stage, work, cc, cxx, cargo):
        self.root, self.stage, self.work = Path(root), Path(stage), Path(work)
        self.tools = {"c": cc, "cpp": cxx, "rust": cargo}
        self.names = types.ModuleType("__main__")
        self.n_programs = 0
        self.files = {}
        self.environment()

    def environment(self):
        """A fresh folder that looks like the top of the tree, and the library installed for everybody."""
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        for folder in ("examples", "bindings", "include"):
            (self.work / folder).symlink_to(self.root / folder)
        built = self.stage.parents[2]               # STAGE is tests/install/stage in it
        if (built / "tools/libicc").exists():
            (self.work / "build").mkdir()
            (self.work / "build/release").symlink_to(built)
        os.chdir(self.work)
        (self.work / "bin").mkdir()
        (self.work / "bin/python3").symlink_to(sys.executable)
        libdir = next(self.stage.glob("lib*/**/libicc.so.0")).parent
        for name, value in {"PATH": f"{self.work / 'bin'}:{self.stage / 'bin'}", "LD_LIBRARY_PATH": libdir,
                            "PKG_CONFIG_PATH": libdir / "pkgconfig",
                            "PYTHONPATH": self.root / "bindings/python"}.items():
            os.environ[name] = f"{value}:{os.environ.get(name, '')}".rstrip(":")
        os.environ.update(CMAKE_PREFIX_PATH=str(self.stage), PYTHONDONTWRITEBYTECODE="1",
                          LIBICC_LIBRARY=str(libdir / "libicc.so.0"),
                          CARGO_TARGET_DIR=str(self.work.parent / "cargo"))
        sys.path.insert(0, str(self.root / "bindings/python"))
        sys.dont_write_bytecode = True
        if self.tools["rust"]:
            os.environ["PATH"] += f":{Path(self.tools['rust']).parent}"

    def run(self, block):
        """What a block prints."""
        self.check_needs(block)
        text = self.framed(block)
        if "file" in block.says:
            self.write(block, text)
            return ""
        for name in re.findall(r"[\w./-]+", text):
            self.files.pop(name, None)
        return getattr(self, "run_" + block.language)(text)

    def check_needs(self, block):
        if "not run" in block.says:
            raise LeftOut(block.says["not run"])
        needs = [need.strip() for need in block.says.get("needs", "").split(",") if need.strip()]
        if block.language == "python":
            needs.append("module numpy")
        if block.language == "rust" and not self.tools["rust"]:
            raise LeftOut("Cargo is missing")
        for need in needs:
            module = need.removeprefix("module ")
            if not (importlib.util.find_spec(module) if module != need else shutil.which(need)):
                raise LeftOut(f"{need} is missing")

    def framed(self, block):
        if "in" not in block.says:
            return block.text
        frame = (HERE / block.says["in"]).read_text(encoding="utf-8")
        before, after = re.split(r"^ *SNIPPET\n", frame, flags=re.M)
        return before + block.text + after

    def write(self, block, text):
        name = block.says["file"]
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(text, encoding="utf-8")
        self.files[name] = block.line

    def program(self, ending, text):
        self.n_programs += 1
        path = self.work / f"snippet{self.n_programs}{ending}"
        path.write_text(text, encoding="utf-8")
        return path

    def command(self, *words):
        done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=500)
        if done.returncode != 0:
            raise Mistake(f"exit code {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def compiled(self, compiler, source, *options):
        flags = self.command("pkg-config", "--cflags", "--libs", "libicc", "libpng").split()
        program = source.with_suffix("")
        self.command(*compiler.split(), *options, *STRICT, source, "-o", program, *flags, "-lm")
        return self.command(program)

    def run_c(self, text):
        return self.compiled(self.tools["c"], self.program(".c", text), "-std=c99")

    def run_cpp(self, text):
        return self.compiled(self.tools["cpp"], self.program(".cpp", text), "-std=c++17")

    def run_python(self, text):
        sys.modules["__main__"] = self.names
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(compile(text, "block", "exec"), vars(self.names))
        return output.getvalue()

    def run_rust(self, text):
        # What is built goes to one folder for all pages, so names tell of which page it is.
        self.n_programs += 1
        crate, name = self.work / "crate", f"{self.work.name}-{self.n_programs}"
        (crate / "src/bin").mkdir(parents=True, exist_ok=True)
        (crate / "Cargo.toml").write_text(CARGO_TOML.format(self.root, self.work.name))
        (crate / "src/bin" / (name + ".rs")).write_text(text, encoding="utf-8")
        return self.command(self.tools["rust"], "run", "--offline", "--quiet", "--manifest-path",
                            crate / "Cargo.toml", "--bin", name)

    def run_sh(self, text):
        # The next block goes on in the folder that this one ends in, as a reader's shell does.
        folder = self.work / "folder"
        printed = self.command("sh", "-eu", self.program(".sh", f'{text}\npwd > "{folder}"\n'))
        os.chdir(folder.read_text(encoding="utf-8").rstrip("\n"))
        return printed

    def run_cmake(self, text):
        Path("CMakeLists.txt").write_text(text, encoding="utf-8")
        self.command("cmake", "-S", ".", "-B", "build")
        return self.command("cmake", "--build", "build")


def agrees(shown, printed):
    """Whether output is as shown, where "..." stands for anything."""
    shown, printed = ("\n".join(line.rstrip() for line in text.strip().split("\n"))
                      for text in (shown, printed))
    pattern = ".*?".join(re.escape(part) for part in shown.split("..."))
    return re.fullmatch(pattern, printed, re.S) is not None


def run_page(page, path):
    """Runs all blocks of a page; returns how many were run, and the lines and reasons of the others."""
    n_run, left_out, printed = 0, [], None
    for block in blocks_of(path):
        where = f"{path}:{block.line}"
        if "output" in block.says:
            if printed is not None and not agrees(block.text, printed):
                raise Mistake(f"{where}: shown is\n{block.text}\nprinted was\n{printed}")
        elif block.language in RUN or "file" in block.says:
            try:
                printed = page.run(block)
                n_run += 1
            except LeftOut as reason:
                left_out.append(f"{where}: left out: {reason}")
                printed = None
            except Mistake as mistake:
                raise Mistake(f"{where}: {mistake}")
            except Exception:
                raise Mistake(f"{where}: {traceback.format_exc()}")
    for name, line in page.files.items():
        raise Mistake(f"{path}:{line}: no block uses {name}")
    return n_run, left_out


def main():
    path = Path(sys.argv[7]).resolve()
    try:
        n_run, left_out = run_page(Page(*sys.argv[1:7]), path)
    except Mistake as mistake:
        sys.exit(str(mistake))
    n_missing = sum(line.endswith("is missing") for line in left_out)
    print(*left_out, f"{path.name}: {n_run} blocks run, {len(left_out) - n_missing} cannot be run here, "
          f"{n_missing} want what is missing", sep="\n")


if __name__ == "__main__":
    main()
