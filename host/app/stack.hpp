// SPDX-License-Identifier: Apache-2.0
// Provides stacks for the drivers: LLVM, which compiles kernels, needs megabytes, and a system may give a process less
// (`ulimit -s`).
#pragma once
#include <functional>

namespace wavetracer::app {

// Runs the program with 8 MiB of stack, and gives as much to threads that start afterwards: in this thread if the
// system allows that, else in another one.
int with_enough_stack(const std::function<int()>& program);

}  // namespace wavetracer::app
