// SPDX-License-Identifier: Apache-2.0
// While an interrupt removes what is unfinished, nothing new appears beside it and nothing gets its final name.
#include <doctest/doctest.h>
#include <chrono>
#include <functional>
#include <thread>
#include "base/pending_file.hpp"
#include "base/pending_folder.hpp"
#include "temporary_folder.hpp"

namespace fs = std::filesystem;
using namespace wavetracer;

TEST_CASE("what begins, grows or is renamed waits while somebody holds what is pending") {
  const test::TemporaryFolder folder;
  const auto entries = [&] { return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()); };
  const auto waits = [&](const std::function<void()>& action) {
    const auto before = entries();
    auto hold = hold_pending();
    std::jthread thread(action);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const bool same = entries() == before;
    hold.unlock();
    thread.join();
    return same && entries() != before;
  };
  const uint64_t named = final_names();
  CHECK(waits([&] { PendingDirectory(folder.path() / "a").keep(); }));
  CHECK(waits([&] { PendingFolder(folder.path() / "b").commit(); }));
  CHECK(waits([&] { PendingFile(folder.path() / "c", {}).commit(); }));
  CHECK(final_names() == named + 2);  // a folder that holds others is no result
  { const PendingFile dropped(folder.path() / "d", {}); }
  CHECK(final_names() == named + 2);
}
