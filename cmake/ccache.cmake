# SPDX-License-Identifier: Apache-2.0
# Compiles through ccache if it is installed. Clones and presets share results: paths below the project are hashed as
# relative ones, and neither the compiler's working folder nor the names of unity files count. CCACHE_DISABLE=1 in the
# environment builds without it.
find_program(WAVETRACER_CCACHE ccache)
if(WAVETRACER_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${WAVETRACER_CCACHE})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
endif()
