# WebAssembly by Debian's clang, lld, llvm, wasi-libc and libclang-rt-dev-wasm32. Programs are run by node.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_SYSROOT /usr)
# What engines have had since 2021: memory copied and set at once, conversions that do not trap.
set(CMAKE_C_FLAGS_INIT
    "-isystem /usr/include/wasm32-wasi -mbulk-memory -mnontrapping-fptoint -msign-ext")
# Of linking only: without it clang runs Binaryen on what it has linked wherever that is installed, and without a word of
# what the module uses. bindings/js/CMakeLists.txt runs it.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-L/usr/lib/wasm32-wasi -O0")
set(CMAKE_EXECUTABLE_SUFFIX_C .wasm)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_CROSSCOMPILING_EMULATOR node;--no-warnings;${CMAKE_CURRENT_LIST_DIR}/../bindings/js/tools/run.js)
