# What all of our own targets are compiled with. Link icc_flags privately; it is never installed.
add_library(icc_flags INTERFACE)
target_compile_features(icc_flags INTERFACE c_std_11)

if(CMAKE_C_COMPILER_ID MATCHES "GNU|Clang")
  # Contraction to fused multiply-adds would change the sign of small determinants from one machine
  # to the next.
  target_compile_options(icc_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wstrict-prototypes -Wmissing-prototypes
    -Wundef -Wvla -ffp-contract=off $<$<BOOL:${ICC_WERROR}>:-Werror>
    # On s390x C11 would have GCC compute single precision in double.
    $<$<C_COMPILER_ID:GNU>:-fexcess-precision=fast>)
endif()

# Not tried: there is no such compiler where the tests run. It has C11's atomics behind an option.
if(MSVC)
  target_compile_options(icc_flags INTERFACE /fp:precise /experimental:c11atomics)
endif()

# Another project may have no build type, which means no optimisation and every assertion. Our own targets are then
# compiled as for Release. Flags that say how to optimise stay, and so does "None", the build type of distributions.
if(NOT CMAKE_C_FLAGS MATCHES "(^| )[-/]O")
  separate_arguments(release NATIVE_COMMAND "${CMAKE_C_FLAGS_RELEASE}")
  target_compile_options(icc_flags INTERFACE "$<$<STREQUAL:$<CONFIG>,>:${release}>")
endif()

# Names beyond POSIX (_SC_NPROCESSORS_ONLN) are hidden there once _POSIX_C_SOURCE is defined.
if(APPLE)
  target_compile_definitions(icc_flags INTERFACE _DARWIN_C_SOURCE)
endif()

# There GCC takes the stack to be aligned to 16 bytes and moves vectors of 32 and 64 as if it were aligned to as many
# (GCC bug 54412); and isnan() of mingw-w64's math.h has a branch for single precision.
if(MINGW AND CMAKE_C_COMPILER_ID STREQUAL GNU)
  target_compile_options(icc_flags INTERFACE -Wno-float-conversion)
  if(CMAKE_SIZEOF_VOID_P EQUAL 8)
    target_compile_options(icc_flags INTERFACE -Wa,-muse-unaligned-vector-move)
  endif()
endif()

# The x87 computes with excess precision, which the exact predicates cannot do with.
if(CMAKE_C_COMPILER_ID MATCHES "GNU|Clang" AND CMAKE_SIZEOF_VOID_P EQUAL 4 AND
   CMAKE_SYSTEM_PROCESSOR MATCHES "^(i[3-6]86|x86|x86_64|AMD64)$")
  target_compile_options(icc_flags INTERFACE -msse2 -mfpmath=sse)
endif()

# C11 without extensions, and nothing visible that is not declared so.
function(icc_add_flags target)
  set_target_properties(${target} PROPERTIES C_EXTENSIONS OFF C_VISIBILITY_PRESET hidden)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:icc_flags>)
endfunction()
