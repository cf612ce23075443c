# wavetracer_check_includes(TARGET NAME folder...): the build of TARGET, made of host/NAME, fails where a source includes a
# header of a folder of host/ that is not named.
function(wavetracer_check_includes target name)
  set(stamp ${CMAKE_CURRENT_BINARY_DIR}/includes_checked)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
  list(JOIN ARGN " " depends)
  add_custom_command(OUTPUT ${stamp}
    COMMAND ${CMAKE_COMMAND} -DHOST=${CMAKE_SOURCE_DIR}/host -DFOLDER=${name} "-DDEPENDS=${depends}" -DSTAMP=${stamp}
            -P ${CMAKE_SOURCE_DIR}/cmake/check_includes.cmake
    DEPENDS ${sources} ${CMAKE_SOURCE_DIR}/cmake/check_includes.cmake COMMENT "" VERBATIM)
  add_custom_target(${target}_includes DEPENDS ${stamp})
  add_dependencies(${target} ${target}_includes)
endfunction()

# wavetracer_folder(NAME [DEPENDS folder...] [LIBRARIES target...] [PUBLIC_LIBRARIES target...])
# One host/ folder is one static library, made of all its .cpp files; DEPENDS names the folders that it may include.
function(wavetracer_folder name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES;PUBLIC_LIBRARIES;SOURCES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(wavetracer_${name} STATIC ${sources} ${ARG_SOURCES})
  set_target_properties(wavetracer_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(wavetracer_${name} PRIVATE ${CMAKE_SOURCE_DIR}/host)
  wavetracer_check_includes(wavetracer_${name} ${name} ${ARG_DEPENDS})
  list(TRANSFORM ARG_DEPENDS PREPEND wavetracer_)
  target_link_libraries(wavetracer_${name} PUBLIC wavetracer_include ${ARG_DEPENDS} ${ARG_PUBLIC_LIBRARIES}
                        PRIVATE $<BUILD_INTERFACE:wavetracer_flags> ${ARG_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY WAVETRACER_TARGETS wavetracer_${name})
endfunction()
