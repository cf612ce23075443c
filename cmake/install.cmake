# Install: the program, the libraries, the headers, and a package for find_package(wavetracer).
get_property(targets GLOBAL PROPERTY WAVETRACER_TARGETS)
install(TARGETS ${targets} EXPORT wavetracer_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/wavetracer DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")
install(FILES ${CMAKE_BINARY_DIR}/include/wavetracer/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wavetracer)
if(TARGET wavetracer)
  install(TARGETS wavetracer RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
include(CMakePackageConfigHelpers)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/wavetracerConfig.cmake.in ${CMAKE_BINARY_DIR}/wavetracerConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/wavetracer)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/wavetracerConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT wavetracer_targets NAMESPACE wavetracer:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/wavetracer)
install(FILES ${CMAKE_BINARY_DIR}/wavetracerConfig.cmake ${CMAKE_BINARY_DIR}/wavetracerConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/wavetracer)
