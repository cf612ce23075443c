# SPDX-License-Identifier: Apache-2.0
# Installs, builds the examples of docs/examples against the installed files, runs them, and checks their output. It
# expects BUILD, SOURCE, WORK and VERSION; it stops at the first step that fails.

include(${CMAKE_CURRENT_LIST_DIR}/steps.cmake)

file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
# The folder is moved as a user would move it: nothing may remember where it was built or installed first.
file(RENAME ${prefix} ${WORK}/moved)
set(prefix ${WORK}/moved)
step(${prefix}/bin/wavetracer --version)
expect("^wavetracer ${VERSION}\n.*compiler .*OpenCL ")

# C++, through find_package.
step(${CMAKE_COMMAND} -S ${SOURCE}/docs/examples/find_package -B ${WORK}/cpp -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release
     -DCMAKE_CXX_FLAGS=-Wall\ -Wextra\ -Werror)
step(${CMAKE_COMMAND} --build ${WORK}/cpp)
step(${WORK}/cpp/example ${WORK}/out)
expect("paths on .*line of sight.*reflection \\(.*written .*/paths.h5")
foreach(file paths.h5 links.csv summary.json)
  if(NOT EXISTS ${WORK}/out/${file})
    message(FATAL_ERROR "${file} was not written")
  endif()
endforeach()

# C99, through pkg-config.
file(GLOB_RECURSE pc ${prefix}/*/wavetracer.pc)
get_filename_component(pc_folder ${pc} DIRECTORY)
get_filename_component(library_folder ${pc_folder} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_folder})
step(pkg-config --modversion wavetracer)
expect("^${VERSION}\n")
step(pkg-config --cflags --libs wavetracer)
separate_arguments(flags UNIX_COMMAND "${said}")
step(cc -std=c99 -Wall -Wextra -Werror -pedantic ${SOURCE}/docs/examples/pkg_config/main.c ${flags} -o ${WORK}/c_example)
set(ENV{LD_LIBRARY_PATH} ${library_folder})
step(${WORK}/c_example ${SOURCE}/configs/city.toml trace.rays=20000)
expect("frame 0: [1-9][0-9]* paths\n.* ns .* dB")
# The client of the server takes headers alone.
step(c++ -std=c++17 -Wall -Wextra -Werror -I${prefix}/include ${SOURCE}/docs/examples/live_client.cpp -o ${WORK}/live_client)
execute_process(COMMAND ${WORK}/live_client unix:${WORK}/no_server RESULT_VARIABLE result ERROR_VARIABLE said)
expect("^live_client: no server answers at .*start one with .wavetracer serve -c ")
# Files that a configuration names are searched beside it, wherever the program was started.
file(WRITE ${WORK}/beside/room.toml "[scene]\nfile = \"room/room.xml\"\n[trace]\nrays = 1000\n"
  "[[transmitter]]\nname = \"t\"\nposition_m = [1, 1, 1]\n[[receiver]]\nname = \"r\"\nposition_m = [2, 1, 1]\n")
file(COPY ${prefix}/share/wavetracer/configs/scenes/room DESTINATION ${WORK}/beside)
step(${WORK}/c_example ${WORK}/beside/room.toml)
expect("frame 0: [1-9][0-9]* paths")
# All configurations are installed, with the files that they name.
step(${prefix}/bin/wavetracer validate -c ${prefix}/share/wavetracer/configs/demo.toml)
foreach(file sumo/scene/city.xml sumo/town.sumocfg sumo/live.toml scenes/room/room.xml live.toml coverage.toml)
  if(NOT EXISTS ${prefix}/share/wavetracer/configs/${file})
    message(FATAL_ERROR "configs/${file} was not installed")
  endif()
endforeach()

# The kernel suite is a part of the package, with its kernels.
file(WRITE ${WORK}/suite/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)\nproject(suite CXX)\nfind_package(wavetracer REQUIRED)\n"
  "if(NOT TARGET wavetracer::kernels)\n  message(FATAL_ERROR \"no wavetracer::kernels\")\nendif()\n")
step(${CMAKE_COMMAND} -S ${WORK}/suite -B ${WORK}/suite/build -DCMAKE_PREFIX_PATH=${prefix})
file(GLOB_RECURSE kernels ${prefix}/share/wavetracer/kernels/*.cl)
if(kernels STREQUAL "")
  message(FATAL_ERROR "no kernels were installed")
endif()

# Python uses the installed package and library, and no others.
if(PYTHON)
  set(ENV{PYTHONPATH} ${prefix}/lib/python3/dist-packages)
  set(ENV{PYTHONDONTWRITEBYTECODE} 1)
  step(${CMAKE_COMMAND} -E chdir ${WORK} ${PYTHON} -c "
try:
    import numpy
except ImportError:
    print('skipped')
else:
    import wavetracer as wt
    simulation = wt.Simulation(wt.configs / 'city.toml', trace={'rays': 20000, 'max_depth': 2})
    assert str(wt.configs).startswith('${prefix}/share'), wt.configs
    print(wt.__version__, simulation.run_frame(), open('/proc/self/maps').read().count('${library_folder}/libwavetracer.so') > 0)
")
  expect("^(skipped|${VERSION} .*: [1-9][0-9,]* paths of .* True)")
endif()

# The library exports functions of wavetracer, of C and C++, and none of the libraries that it is made of.
file(GLOB library ${library_folder}/libwavetracer.so)
step(nm --dynamic --defined-only --demangle --format=posix ${library})
string(REGEX REPLACE "(wavetracer_|wavetracer::|(typeinfo|typeinfo name|vtable) for wavetracer::)[^\n]*\n" "" others "${said}")
if(NOT others STREQUAL "")
  message(FATAL_ERROR "foreign symbols are exported:\n${others}")
endif()
