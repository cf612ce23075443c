# wavetracer_folder(NAME [DEPENDS folder...] [LIBRARIES target...] [PUBLIC_LIBRARIES target...])
# One host/ folder is one static library, made of all its .cpp files; DEPENDS names the folders that it may include.
function(wavetracer_folder name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES;PUBLIC_LIBRARIES;SOURCES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_library(wavetracer_${name} STATIC ${sources} ${ARG_SOURCES})
  set_target_properties(wavetracer_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(wavetracer_${name} PRIVATE ${CMAKE_SOURCE_DIR}/host)
  list(TRANSFORM ARG_DEPENDS PREPEND wavetracer_)
  target_link_libraries(wavetracer_${name} PUBLIC wavetracer_include ${ARG_DEPENDS} ${ARG_PUBLIC_LIBRARIES}
                        PRIVATE $<BUILD_INTERFACE:wavetracer_flags> ${ARG_LIBRARIES})
  set_property(GLOBAL APPEND PROPERTY WAVETRACER_TARGETS wavetracer_${name})
endfunction()
