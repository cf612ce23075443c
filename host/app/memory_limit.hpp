// Processes that may take only so much memory (`ulimit -v`, `ulimit -d`). Libraries, above all OpenCL's drivers, are
// ended by a signal where they get none. Without a limit nothing here does anything.
#pragma once
#include <functional>
#include <string>

namespace wavetracer::app {

// Runs the program and returns its exit code. Under a limit it runs in a child, so that there is somebody left to say
// why it was ended; the exit code is then that of a runtime error. Signals to this process go on to the child.
int explained(const std::function<int()>& program);

// Words for the end of a message about something that was not to be had, such as a device or a thread: they name the
// limit of memory. Empty without a limit.
std::string limit_hint();

}  // namespace wavetracer::app
