// SPDX-License-Identifier: Apache-2.0
// Handles processes with a limit of memory (`ulimit -v`, `ulimit -d`). Libraries, above all OpenCL's drivers, are ended
// by a signal if they get no memory. Without a limit nothing here has an effect.
#pragma once
#include <functional>
#include <string>

namespace wavetracer::app {

// Runs the program and returns its exit code. Under a limit it runs in a child, so that the parent can say why it was
// ended; the exit code is then that of a runtime error. Signals to this process are forwarded to the child.
int explained(const std::function<int()>& program);

// Returns words for the end of an error message about a device or a thread that could not be had: they name the limit
// of memory. Empty without a limit.
std::string limit_hint();

}  // namespace wavetracer::app
