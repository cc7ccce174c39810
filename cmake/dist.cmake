# The preset `dist`: targets that fill dist/ with the files of a release. cmake/dist.sh makes them; docs/packaging.md
# says how. `dist` makes all parts, `dist_PART` one of them, and `dist_check` tries what has been made.
set(parts source linux-x86_64 linux-arm64 windows python crates npm debian notes)
set(script ${PROJECT_SOURCE_DIR}/cmake/dist.sh)

add_custom_target(dist COMMAND sh ${script} ${parts} USES_TERMINAL VERBATIM)
foreach(part IN LISTS parts)
  add_custom_target(dist_${part} COMMAND sh ${script} ${part} USES_TERMINAL VERBATIM)
endforeach()
add_custom_target(dist_check COMMAND sh ${PROJECT_SOURCE_DIR}/cmake/dist_check.sh USES_TERMINAL VERBATIM)
