# SPDX-License-Identifier: Apache-2.0
# Installs the kernel suite alone, builds docs/examples/kernels against it by CMake and by pkg-config, and runs what was
# built. It expects BUILD, SOURCE, WORK and VERSION; it stops at the first step that fails.
include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

file(REMOVE_RECURSE ${WORK})
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --component kernels)
# The folder is moved as a user would move it.
file(RENAME ${WORK}/prefix ${WORK}/moved)
set(prefix ${WORK}/moved)
if(EXISTS ${prefix}/bin)
  message(FATAL_ERROR "the component kernels has programs")
endif()
set(samples ${SOURCE}/docs/examples/kernels)

step(${CMAKE_COMMAND} -S ${samples} -B ${WORK}/cpp -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release
     "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wconversion -Wshadow -Werror")
step(${CMAKE_COMMAND} --build ${WORK}/cpp)
step(${WORK}/cpp/sort_a_buffer)
expect("^[^\n]+ sorted 1048576 keys as std::sort does, in [0-9.]+ ms\n$")

step(${WORK}/cpp/morton_order)
expect("^[^\n]+ put 262144 points into Morton order as std::stable_sort does\n$")
step(${WORK}/cpp/trace_triangles)
expect("^[^\n]+ traced 2000 rays, of which [0-9]+ meet one of 1152 triangles, as all triangles in turn say\n$")
step(${WORK}/cpp/cache_rays)
expect("^[^\n]+ traced [0-9]+ of 80000 rays and had the hits of all\n$")

# The kernels that are installed are those that run where they are asked for.
set(ENV{WAVETRACER_KERNEL_DIR} ${prefix}/share/wavetracer/kernels)
step(${WORK}/cpp/sort_a_buffer 0 70000)
expect("sorted 70000 keys")
set(ENV{WAVETRACER_KERNEL_DIR} ${prefix}/share/wavetracer/include)
execute_process(COMMAND ${WORK}/cpp/sort_a_buffer 0 70000 RESULT_VARIABLE result ERROR_VARIABLE said)
expect("radix_sort[a-z_]*.cl is in no folder of ")
unset(ENV{WAVETRACER_KERNEL_DIR})

# The whole package is not there, and the message says so.
file(WRITE ${WORK}/whole/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(whole CXX)\nfind_package(wavetracer REQUIRED)\n")
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK}/whole -B ${WORK}/whole/build -DCMAKE_PREFIX_PATH=${prefix}
                RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE said)
expect("only the kernel suite is installed here")

file(GLOB_RECURSE pc ${prefix}/*/wavetracer-kernels.pc)
get_filename_component(pc_folder ${pc} DIRECTORY)
get_filename_component(library_folder ${pc_folder} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
step(pkg-config --modversion wavetracer-kernels)
expect("^${VERSION}\n")
step(pkg-config --cflags --libs wavetracer-kernels)
separate_arguments(flags UNIX_COMMAND "${said}")
step(c++ -std=c++20 -Wall -Wextra -Werror ${samples}/sort_a_buffer.cpp ${flags} -o ${WORK}/by_pkg_config)
set(ENV{LD_LIBRARY_PATH} ${library_folder})
step(${WORK}/by_pkg_config 0 1000)
expect("sorted 1000 keys")

# Device headers are there for hosts, too.
foreach(file include/wavetracer/device/types.h include/wavetracer/kernels/context.hpp)
  if(NOT EXISTS ${prefix}/${file})
    message(FATAL_ERROR "${file} was not installed")
  endif()
endforeach()

# The library needs few of the libraries that the program does (TBB builds trees), and exports nothing but the suite.
set(library ${library_folder}/libwavetracer_kernels.so)
step(readelf -d ${library})
string(REGEX MATCHALL "NEEDED[^\n]*" needed "${said}")
list(FILTER needed EXCLUDE REGEX "\\[(libOpenCL|libfmt|libtbb|libstdc\\+\\+|libm|libgcc_s|libc|ld-linux[^]]*)\\.so")
if(NOT needed STREQUAL "")
  message(FATAL_ERROR "the library needs more than OpenCL, fmt and TBB: ${needed}")
endif()
step(nm --dynamic --defined-only --demangle --format=posix ${library})
string(REGEX REPLACE "(wavetracer_kernels_|wavetracer::kernels::|(typeinfo|typeinfo name|vtable) for wavetracer::kernels::)[^\n]*\n" "" others "${said}")
if(NOT others STREQUAL "")
  message(FATAL_ERROR "foreign symbols are exported:\n${others}")
endif()
