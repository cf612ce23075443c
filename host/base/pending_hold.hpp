// Who removes what a process has not finished, because it is told to end, holds this meanwhile: no temporary file or
// folder begins, grows by a file, or gets its final name.
#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>

namespace wavetracer {

// Waits for what is being begun or renamed. Not to be asked for twice by one thread.
std::unique_lock<std::mutex> hold_pending();

// How many files and folders have got their final names in this process; counted by who holds hold_pending().
std::atomic<uint64_t>& final_names();

}  // namespace wavetracer
