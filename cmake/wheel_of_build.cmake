# SPDX-License-Identifier: Apache-2.0
# Packs a complete build folder as a wheel: pip's build copies from it, and compiles nothing.
add_custom_target(wavetracer)
add_custom_target(wavetracer_library)
add_custom_target(wavetracer_kernels)
get_filename_component(build ${WAVETRACER_BUILD} ABSOLUTE BASE_DIR ${CMAKE_SOURCE_DIR})
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} --install ${build} --component wheel --prefix \${CMAKE_INSTALL_PREFIX}
                        COMMAND_ERROR_IS_FATAL ANY)" COMPONENT wheel)
