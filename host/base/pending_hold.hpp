// SPDX-License-Identifier: Apache-2.0
// A lock for code that removes unfinished files when the process is told to end. While it is held, no temporary file or
// folder is created, gets another file, or gets its final name.
#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>

namespace wavetracer {

// Waits for files that are being created or renamed at the moment. A thread must not call it twice without releasing
// the lock.
std::unique_lock<std::mutex> hold_pending();

// The number of files and folders that got their final names in this process. It is changed only while hold_pending()
// is held.
std::atomic<uint64_t>& final_names();

}  // namespace wavetracer
