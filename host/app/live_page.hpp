// SPDX-License-Identifier: Apache-2.0
// `wavetracer serve --page FILE`: writes the live world as a page again and again while frames are solved. A thread of
// its own writes, at most once per second: no frame waits for the page, and a newer frame replaces a waiting one. The
// page reloads itself in the browser.
#pragma once
#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include "results/saved_world.hpp"
#include "wavetracer/live.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer::app {

class LivePage {
 public:
  using Tell = std::function<void(const std::string&)>;

  // tell: called on the thread of the page with the first error; frames continue. Throws RuntimeError if the page
  // cannot be written at all.
  LivePage(const std::filesystem::path& file, Tell tell);
  // Returns after the page of the last frame was written.
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  // Takes a copy of a frame that this simulation has solved.
  void show(const Simulation& simulation, const LiveFrame& frame);

 private:
  // The content of a page besides its frame; the simulation may be gone while the last page is written.
  struct World {
    Config config;
    Scene scene;
    std::vector<Instance> instances;
    std::vector<Scene> models;
    RunSummary summary;
  };

  void work();
  void write(const LiveFrame& frame);

  std::filesystem::path file_, folder_;  // folder_: the run that the page is made of
  Tell tell_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<World> world_;
  std::optional<SavedWorld> drawn_;  // used by the page's thread: the same world in the form that the page draws
  std::optional<LiveFrame> newest_;
  bool ends_ = false, failed_ = false;
  std::thread thread_;
};

}  // namespace wavetracer::app
