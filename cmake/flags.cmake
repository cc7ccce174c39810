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

# C11 without extensions, and nothing visible that is not declared so.
function(icc_add_flags target)
  set_target_properties(${target} PROPERTIES C_EXTENSIONS OFF C_VISIBILITY_PRESET hidden)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:icc_flags>)
endfunction()
