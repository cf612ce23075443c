// Who removes what a process has not finished, because it is told to end, holds this meanwhile: no temporary file or
// folder begins, grows by a file, or gets its final name.
#pragma once
#include <mutex>

namespace wavetracer {

// Waits for what is being begun or renamed. Not to be asked for twice by one thread.
std::unique_lock<std::mutex> hold_pending();

}  // namespace wavetracer
