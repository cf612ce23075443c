# SPDX-License-Identifier: Apache-2.0
# The outside project of docs/examples/kernels under the address and undefined-behaviour sanitizers: it installs the kernel
# suite of a build with sanitizers, builds the samples with the same sanitizers against it, and runs them. It expects
# BUILD, SOURCE, WORK, COMPILER and SANITIZERS; it stops at the first step that fails. A report of a sanitizer fails a step.
include(${SOURCE}/tests/install/steps.cmake)

file(REMOVE_RECURSE ${WORK})
step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --component kernels)
set(options -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_CXX_COMPILER=${COMPILER}
    "-DCMAKE_CXX_FLAGS=-g1 -fsanitize=${SANITIZERS} -fno-sanitize-recover=all -fno-omit-frame-pointer")
step(${CMAKE_COMMAND} -S ${SOURCE}/docs/examples/kernels -B ${WORK}/cpp ${options})
step(${CMAKE_COMMAND} --build ${WORK}/cpp --parallel 2)

step(${WORK}/cpp/sort_a_buffer 0 70000)
expect("sorted 70000 keys as std::sort does")
step(${WORK}/cpp/morton_order 0 30000)
expect("put 30000 points into Morton order as std::stable_sort does")
step(${WORK}/cpp/trace_triangles 0 300)
expect("traced 300 rays, of which [0-9]+ meet one of 1152 triangles, as all triangles in turn say")
step(${WORK}/cpp/cache_rays 0 2000)
expect("traced [0-9]+ of 8000 rays and had the hits of all")

# The library was built with the sanitizers, too: what it reads past the end of a caller's memory is reported.
file(WRITE ${WORK}/overread/overread.cpp "#include \"wavetracer/kernels/kernels.hpp\"
int main() {
  const wavetracer::kernels::Context context;
  const std::vector<float> three(3);
  context.buffer<float>(4).write({three.data(), 4});
}
")
file(WRITE ${WORK}/overread/CMakeLists.txt "cmake_minimum_required(VERSION 3.25)
project(overread CXX)
find_package(wavetracer REQUIRED COMPONENTS kernels)
add_executable(overread overread.cpp)
target_link_libraries(overread PRIVATE wavetracer::kernels)
")
step(${CMAKE_COMMAND} -S ${WORK}/overread -B ${WORK}/overread/build ${options})
step(${CMAKE_COMMAND} --build ${WORK}/overread/build)
execute_process(COMMAND ${WORK}/overread/build/overread RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE said)
expect("heap-buffer-overflow.*READ of size 16 ")
