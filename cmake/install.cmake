# Components: Runtime (the shared library), Development (headers, static library, CMake and
# pkg-config files), Tools (the command).
set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/libicc)

foreach(target IN ITEMS icc icc_static)
  if(TARGET ${target})
    install(TARGETS ${target} EXPORT ${target}
      RUNTIME COMPONENT Runtime
      LIBRARY COMPONENT Runtime NAMELINK_COMPONENT Development
      ARCHIVE COMPONENT Development)
    install(EXPORT ${target} NAMESPACE libicc:: DESTINATION ${cmake_dir} COMPONENT Development)
  endif()
endforeach()

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/icc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT Development FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp" PATTERN "api.json")
install(FILES ${PROJECT_SOURCE_DIR}/docs/man/libicc.3 DESTINATION ${CMAKE_INSTALL_MANDIR}/man3
  COMPONENT Development)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/libiccConfig.cmake.in
  ${PROJECT_BINARY_DIR}/libiccConfig.cmake INSTALL_DESTINATION ${cmake_dir}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/libiccConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/libiccConfig.cmake
              ${PROJECT_BINARY_DIR}/libiccConfigVersion.cmake
  DESTINATION ${cmake_dir} COMPONENT Development)

set(private_libraries -lm)
if(ICC_WITH_THREADS)
  string(APPEND private_libraries " -lpthread")
endif()
# The prefix is known for certain only when installing (cmake --install --prefix). A prefix relative
# to the .pc file would make pkg-config print -I/usr/include/../.. in a multiarch directory.
install(CODE "
  get_filename_component(prefix \"\${CMAKE_INSTALL_PREFIX}\" ABSOLUTE)
  set(PROJECT_VERSION \"${PROJECT_VERSION}\")
  set(PROJECT_DESCRIPTION \"${PROJECT_DESCRIPTION}\")
  set(libdir \"${CMAKE_INSTALL_LIBDIR}\")
  set(includedir \"${CMAKE_INSTALL_INCLUDEDIR}\")
  set(private_libraries \"${private_libraries}\")
  cmake_path(ABSOLUTE_PATH libdir BASE_DIRECTORY \"\${prefix}\")
  cmake_path(ABSOLUTE_PATH includedir BASE_DIRECTORY \"\${prefix}\")
  configure_file(\"${PROJECT_SOURCE_DIR}/cmake/libicc.pc.in\"
                 \"${PROJECT_BINARY_DIR}/libicc.pc\" @ONLY)"
  COMPONENT Development)
install(FILES ${PROJECT_BINARY_DIR}/libicc.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT Development)
