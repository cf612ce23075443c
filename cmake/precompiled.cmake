# SPDX-License-Identifier: Apache-2.0
# Headers of the standard library, fmt and glm that most sources include: they are compiled once for all targets. Clang
# is left out: ccache needs options of its own for what clang compiles with precompiled headers. Without WAVETRACER_UNITY
# nothing is precompiled either: that build shows whether each source includes what it uses.
# GCC takes the level of optimization of the precompiled headers for the functions that are compiled with them, whatever
# its options say. So each level has headers of its own.
if(WAVETRACER_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(source ${CMAKE_BINARY_DIR}/precompiled.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// The target of the precompiled headers needs a source.\n")
  foreach(level "" -O1)
    add_library(wavetracer_precompiled${level} OBJECT ${source})
    set_target_properties(wavetracer_precompiled${level} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(wavetracer_precompiled${level} PRIVATE ${level})
    target_link_libraries(wavetracer_precompiled${level} PRIVATE wavetracer_flags fmt::fmt glm::glm)
    target_precompile_headers(wavetracer_precompiled${level} PRIVATE
      <algorithm> <array> <bit> <charconv> <chrono> <cmath> <complex> <cstdint> <cstring> <filesystem> <fstream>
      <functional> <iostream> <limits> <map> <memory> <numbers> <numeric> <optional> <set> <span> <stdexcept> <string>
      <string_view> <thread> <tuple> <utility> <variant> <vector> <fmt/format.h> <fmt/ranges.h> <glm/common.hpp>
      <glm/geometric.hpp> <glm/gtc/quaternion.hpp> <glm/vec2.hpp> <glm/vec3.hpp>)
  endforeach()
endif()

# wavetracer_precompile(TARGET): the sources of TARGET, a program or a library of position-independent code, are compiled
# with these headers. CMake also copies compiler options of the headers' target, so this comes before other options.
function(wavetracer_precompile target)
  if(TARGET wavetracer_precompiled)
    wavetracer_optimization_level(level ${target})
    target_precompile_headers(${target} REUSE_FROM wavetracer_precompiled${level})
    get_target_property(type ${target} TYPE)
    if(type STREQUAL EXECUTABLE)
      target_compile_options(${target} PRIVATE -fPIC)  # as the headers; CMake's own option would be -fPIE
    endif()
    # GCC forgets which warnings <bits/char_traits.h> turns off for its false alarms on std::string (bug 105651).
    target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
    # Macros must be the same as where the headers were compiled.
    target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
  endif()
endfunction()
