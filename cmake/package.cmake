# SPDX-License-Identifier: Apache-2.0
# `cpack -G DEB` in the build folder: the package wavetracer for Debian 12, with what its libraries need. It needs
# dpkg-dev (dpkg-shlibdeps) and gzip. tests/install/clean_system.sh installs it in a separate system. Debian requires
# the name and address of a maintainer: those that Debian's own tools use, else root of the machine.
set(maintainer "wavetracer developers <root@localhost>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(WAVETRACER_MAINTAINER "${maintainer}" CACHE STRING "name and mail address that packages carry: NAME <ADDRESS>")
if(NOT WAVETRACER_MAINTAINER MATCHES "^[^<>]+ <[^<> ]+@[^<> ]+>$")
  message(FATAL_ERROR "WAVETRACER_MAINTAINER is \"${WAVETRACER_MAINTAINER}\": give it as NAME <ADDRESS>")
endif()
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME wavetracer)
set(CPACK_PACKAGE_CONTACT "${WAVETRACER_MAINTAINER}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# pocl-opencl-icd is the device if there is no GPU; gnuplot-nox draws the plots of `plot` and `thesis`.
# The module for maps opens GDAL itself, so CPack finds no dependency on it.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd, gnuplot-nox")
if(WAVETRACER_GDAL_NAME MATCHES "^libgdal\\.so\\.([0-9]+)$")
  string(APPEND CPACK_DEBIAN_PACKAGE_RECOMMENDS ", libgdal${CMAKE_MATCH_1}")
endif()
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libglm-dev, ocl-icd-opencl-dev, pkgconf, python3-h5py, python3-numpy, sumo")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Traces every propagation path between antennas on vehicles and at the
roadside through a city: reflected, diffracted, transmitted and scattered,
with exact geometry, delay, complex gain, angles and Doppler shift. Vehicles
come from SUMO, CSV or built-in traffic; results go to HDF5 and CSV.

Runs on any OpenCL device, also on the CPU with PoCL. This package holds the
program, the shared library with its headers for C and C++, the kernel suite
as a library for programs with a context and queue of their own, and a Python
package.")
# CPack 3.25 calls ldconfig in its own scripts; Debian requires the trigger.
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA ${CMAKE_SOURCE_DIR}/cmake/triggers)
set(CPACK_STRIP_FILES ON)
# Folders that CPack makes get the modes that Debian requires.
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Makes the changelog of a Debian package from CHANGELOG.md.
add_custom_command(OUTPUT ${pages}/changelog.gz VERBATIM
  COMMAND ${CMAKE_COMMAND} -DINPUT=${CMAKE_SOURCE_DIR}/CHANGELOG.md -DOUTPUT=${pages}/changelog "-DMAINTAINER=${WAVETRACER_MAINTAINER}"
          -P ${CMAKE_SOURCE_DIR}/cmake/debian_changelog.cmake
  COMMAND gzip -9nf ${pages}/changelog
  DEPENDS ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/cmake/debian_changelog.cmake)
add_custom_target(wavetracer_changelog ALL DEPENDS ${pages}/changelog.gz)
install(FILES ${pages}/changelog.gz ${CMAKE_SOURCE_DIR}/cmake/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR})
include(CPack)
