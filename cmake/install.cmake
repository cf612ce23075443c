# SPDX-License-Identifier: Apache-2.0
# Installs the program, the shared libraries, their headers, a package for find_package(wavetracer) and one for pkg-config.
# documentation.cmake installs man pages and completions. All of it may be moved to another prefix.
include(CMakePackageConfigHelpers)
install(TARGETS wavetracer RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS wavetracer_library EXPORT wavetracer_targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})

# This module reads maps by GDAL; the program opens it only when a map needs it.
if(TARGET wavetracer_maps)
  install(TARGETS wavetracer_maps LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/wavetracer)
endif()

# The kernel suite: a library, its headers, and the kernels with the headers that they share with hosts.
# `cmake --install BUILD --component kernels` installs this alone. share/wavetracer has the layout of the project's own
# folder, so that WAVETRACER_KERNEL_DIR may name its kernels.
install(TARGETS wavetracer_kernels EXPORT wavetracer_kernels_targets LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT kernels)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/wavetracer/kernels ${CMAKE_SOURCE_DIR}/include/wavetracer/device
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wavetracer COMPONENT kernels)
install(FILES ${CMAKE_SOURCE_DIR}/include/wavetracer/cache_config.hpp ${CMAKE_SOURCE_DIR}/include/wavetracer/choice.hpp
  ${CMAKE_SOURCE_DIR}/include/wavetracer/error.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wavetracer COMPONENT kernels)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/kernels DESTINATION ${CMAKE_INSTALL_DATADIR}/wavetracer COMPONENT kernels)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/wavetracer/device
  DESTINATION ${CMAKE_INSTALL_DATADIR}/wavetracer/include/wavetracer COMPONENT kernels)

# Headers between passes are not installed.
file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/include/wavetracer/*.h ${CMAKE_SOURCE_DIR}/include/wavetracer/*.hpp)
list(FILTER headers EXCLUDE REGEX path_geometry.hpp)
install(FILES ${headers} ${CMAKE_BINARY_DIR}/include/wavetracer/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/wavetracer)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/wavetracer)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/wavetracerConfig.cmake.in ${CMAKE_BINARY_DIR}/wavetracerConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/wavetracerConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT wavetracer_targets NAMESPACE wavetracer:: DESTINATION ${package})
install(EXPORT wavetracer_kernels_targets NAMESPACE wavetracer:: DESTINATION ${package} COMPONENT kernels)
install(FILES ${CMAKE_BINARY_DIR}/wavetracerConfig.cmake ${CMAKE_BINARY_DIR}/wavetracerConfigVersion.cmake DESTINATION ${package}
  COMPONENT kernels)

file(RELATIVE_PATH prefix_from_pc "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(${CMAKE_SOURCE_DIR}/cmake/wavetracer.pc.in ${CMAKE_BINARY_DIR}/wavetracer.pc @ONLY)
configure_file(${CMAKE_SOURCE_DIR}/cmake/wavetracer-kernels.pc.in ${CMAKE_BINARY_DIR}/wavetracer-kernels.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/wavetracer.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(FILES ${CMAKE_BINARY_DIR}/wavetracer-kernels.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT kernels)

# Installs configurations that run unchanged, and the examples of the library.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/wavetracer/configs
  PATTERN *.fcd.xml EXCLUDE PATTERN out EXCLUDE)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/examples/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/examples
  PATTERN __pycache__ EXCLUDE)
file(GLOB documents CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/docs/*.md)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${documents} DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/design DESTINATION ${CMAKE_INSTALL_DOCDIR})

# The module of ns-3, to be copied into its tree.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/integrations DESTINATION ${CMAKE_INSTALL_DATADIR}/wavetracer)

# Installs the Python package: below /usr, Debian's Python finds it; with another prefix, PYTHONPATH must name its
# folder.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/python/wavetracer DESTINATION lib/python3/dist-packages
  PATTERN __pycache__ EXCLUDE)
# These are the parts of the wheel that are not Python; pyproject.toml asks for this component alone.
install(TARGETS wavetracer RUNTIME DESTINATION wavetracer/bin COMPONENT wheel EXCLUDE_FROM_ALL)
install(PROGRAMS $<TARGET_FILE:wavetracer_library> DESTINATION wavetracer/lib RENAME libwavetracer.so COMPONENT wheel EXCLUDE_FROM_ALL)
install(PROGRAMS $<TARGET_FILE:wavetracer_kernels> DESTINATION wavetracer/lib RENAME libwavetracer_kernels.so COMPONENT wheel EXCLUDE_FROM_ALL)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/kernels DESTINATION wavetracer/share COMPONENT wheel EXCLUDE_FROM_ALL)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/include/wavetracer/device ${CMAKE_SOURCE_DIR}/include/wavetracer/kernels
  DESTINATION wavetracer/share/include/wavetracer COMPONENT wheel EXCLUDE_FROM_ALL)
install(FILES ${CMAKE_SOURCE_DIR}/include/wavetracer/cache_config.hpp ${CMAKE_SOURCE_DIR}/include/wavetracer/choice.hpp
  ${CMAKE_SOURCE_DIR}/include/wavetracer/error.hpp
  DESTINATION wavetracer/share/include/wavetracer COMPONENT wheel EXCLUDE_FROM_ALL)
find_file(WAVETRACER_PROJ_DATA proj.db PATHS /usr/share/proj /usr/local/share/proj)
if(WAVETRACER_PROJ_DATA)
  install(FILES ${WAVETRACER_PROJ_DATA} DESTINATION wavetracer/share/proj COMPONENT wheel EXCLUDE_FROM_ALL)
endif()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs/examples DESTINATION wavetracer/share COMPONENT wheel EXCLUDE_FROM_ALL
  PATTERN __pycache__ EXCLUDE)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/configs DESTINATION wavetracer/share COMPONENT wheel EXCLUDE_FROM_ALL
  PATTERN *.fcd.xml EXCLUDE PATTERN out EXCLUDE)
