# SPDX-License-Identifier: Apache-2.0
# wavetracer_check_includes(TARGET SOURCES file... ALLOWED folder... ADVICE text): makes the build of TARGET fail if a
# source includes a header of a folder of host/ that is not allowed.
function(wavetracer_check_includes target)
  cmake_parse_arguments(ARG "" "ADVICE" "SOURCES;ALLOWED" ${ARGN})
  set(stamp ${CMAKE_CURRENT_BINARY_DIR}/${target}_includes_checked)
  list(JOIN ARG_SOURCES " " sources)
  list(JOIN ARG_ALLOWED " " allowed)
  add_custom_command(OUTPUT ${stamp}
    COMMAND ${CMAKE_COMMAND} -DROOT=${CMAKE_SOURCE_DIR} "-DSOURCES=${sources}" "-DALLOWED=${allowed}" "-DADVICE=${ARG_ADVICE}"
            -DSTAMP=${stamp} -P ${CMAKE_SOURCE_DIR}/cmake/check_includes.cmake
    DEPENDS ${ARG_SOURCES} ${CMAKE_SOURCE_DIR}/cmake/check_includes.cmake COMMENT "Checking the includes of ${target}" VERBATIM)
  add_custom_target(${target}_includes DEPENDS ${stamp})
  add_dependencies(${target} ${target}_includes)
endfunction()

# wavetracer_linked_folders(OUT target...): finds the folders of host/ whose libraries these targets are or link.
function(wavetracer_linked_folders out)
  set(seen "")
  set(next ${ARGN})
  while(NOT next STREQUAL "")
    list(POP_FRONT next target)
    if(TARGET ${target} AND NOT target IN_LIST seen)
      list(APPEND seen ${target})
      get_target_property(more ${target} LINK_LIBRARIES)
      if(more)
        list(APPEND next ${more})
      endif()
    endif()
  endwhile()
  list(FILTER seen INCLUDE REGEX "^wavetracer_")
  list(TRANSFORM seen REPLACE "^wavetracer_" "")
  set(${out} ${seen} PARENT_SCOPE)
endfunction()

# wavetracer_unity(TARGET): its sources are compiled several at a time, those of a folder of host/ as one, since each unit
# compiles the templates that it uses. So names in anonymous namespaces differ within a folder. Not CMake's own unity
# files: those name sources by the paths of this clone, and ccache would have to preprocess each in every other one.
function(wavetracer_unity target)
  if(NOT WAVETRACER_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES WAVETRACER_UNITY ON)
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR})
  # A type of an anonymous namespace is seen by an include of the generated file, which GCC takes for a header.
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>")
  cmake_language(EVAL CODE "cmake_language(DEFER CALL wavetracer_write_unity [[${target}]])")  # when all sources are known
endfunction()

# Replaces the sources of a target by files that include several of them. A target opts out with its property
# WAVETRACER_UNITY, a source with SKIP_UNITY_BUILD_INCLUSION or options of its own. Sources with the same
# UNITY_GROUP, a name, meet each other alone.
function(wavetracer_write_unity target)
  get_target_property(wanted ${target} WAVETRACER_UNITY)
  if(NOT wanted)
    return()
  endif()
  set(batch 8)
  if(CMAKE_CURRENT_SOURCE_DIR MATCHES "^${CMAKE_SOURCE_DIR}/host/")
    set(batch 1000)  # a folder is one unit
  endif()
  get_target_property(sources ${target} SOURCES)
  set(compiled "")
  set(groups "")
  foreach(source IN LISTS sources)
    get_filename_component(path "${source}" ABSOLUTE)
    get_source_file_property(alone "${path}" SKIP_UNITY_BUILD_INCLUSION)
    get_source_file_property(options "${path}" COMPILE_OPTIONS)
    get_source_file_property(group "${path}" UNITY_GROUP)
    string(FIND "${path}" "${CMAKE_BINARY_DIR}/" generated)
    if(alone OR options OR generated EQUAL 0 OR NOT source MATCHES "\\.cpp$")
      list(APPEND compiled "${source}")
      continue()
    endif()
    if(NOT group)
      set(group ${target})
    endif()
    list(APPEND groups ${group})
    file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR} "${path}")
    list(APPEND members_${group} ${name})
  endforeach()
  list(REMOVE_DUPLICATES groups)
  foreach(group IN LISTS groups)
    set(number 0)
    while(members_${group})
      list(SUBLIST members_${group} 0 ${batch} names)
      list(REMOVE_ITEM members_${group} ${names})
      list(TRANSFORM names REPLACE "(.+)" "#include \"\\1\"\n")
      string(CONCAT text ${names})
      set(file ${CMAKE_CURRENT_BINARY_DIR}/unity/${group}_${number}.cpp)
      file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
      list(APPEND compiled ${file})
      math(EXPR number "${number} + 1")
    endwhile()
  endforeach()
  set_target_properties(${target} PROPERTIES SOURCES "${compiled}")
endfunction()

# wavetracer_optimization_level(OUT TARGET): finds the option of a target, or an empty text. Sanitizer builds optimize
# only code that computes for long. Release builds compile other code, and tests, with -O1, which takes two thirds of the
# time of -O3. Results do not depend on it, since -ffp-contract is off.
function(wavetracer_optimization_level out target)
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(option "")
  if(WAVETRACER_SANITIZE AND folder MATCHES "^(imports|motion|scene|accel|radio|radar|gradient|lifetime|reference|output|results|viewer)$")
    set(option -O2)
  elseif(CMAKE_BUILD_TYPE STREQUAL Release)
    set(computing base gpu motion accel radio radar gradient lifetime passes simulation reference)
    if(target MATCHES "^(test|replay)_" OR (target MATCHES "^wavetracer" AND NOT folder IN_LIST computing))
      set(option -O1)
    endif()
  endif()
  set(${out} "${option}" PARENT_SCOPE)
endfunction()

# wavetracer_optimization(TARGET): compiles it with that option.
function(wavetracer_optimization target)
  wavetracer_optimization_level(option ${target})
  target_compile_options(${target} PRIVATE ${option})
endfunction()

# wavetracer_folder(NAME [DEPENDS folder...] [LIBRARIES target...] [PUBLIC_LIBRARIES target...])
# Makes one static library of all .cpp files of a host/ folder; DEPENDS names the folders that it may include.
function(wavetracer_folder name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES;PUBLIC_LIBRARIES;SOURCES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(wavetracer_${name} STATIC ${sources} ${ARG_SOURCES})
  set_target_properties(wavetracer_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  wavetracer_precompile(wavetracer_${name})
  wavetracer_unity(wavetracer_${name})
  wavetracer_optimization(wavetracer_${name})
  target_include_directories(wavetracer_${name} PRIVATE ${CMAKE_SOURCE_DIR}/host)
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
  wavetracer_check_includes(wavetracer_${name} SOURCES ${sources} ${headers} ALLOWED ${name} ${ARG_DEPENDS}
    ADVICE "Move what is needed to a folder below, or, if host/${name} may know that folder, name it behind DEPENDS in its CMakeLists.txt.")
  list(TRANSFORM ARG_DEPENDS PREPEND wavetracer_)
  target_link_libraries(wavetracer_${name} PUBLIC wavetracer_include ${ARG_DEPENDS} ${ARG_PUBLIC_LIBRARIES}
                        PRIVATE $<BUILD_INTERFACE:wavetracer_flags> ${ARG_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY WAVETRACER_TARGETS wavetracer_${name})
endfunction()
