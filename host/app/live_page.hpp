// `wavetracer serve --page FILE`: the live world as a page that is written anew while frames are solved.
// Written by a thread of its own, at most once per second: no frame waits for the page, and a newer frame replaces one
// that waits. A browser that shows the page loads it again by itself.
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

  // tell: what goes wrong is said once, and frames go on; called on the thread of the page. Throws RuntimeError where
  // the page cannot be written at all.
  LivePage(const std::filesystem::path& file, Tell tell);
  // After the page of the last frame.
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  // A frame of this simulation was solved. Copies it.
  void show(const Simulation& simulation, const LiveFrame& frame);

 private:
  // What a page says besides its frame; the simulation may be gone while the last page is written.
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
  std::optional<SavedWorld> drawn_;  // of the thread of the page: the same, as the page draws it
  std::optional<LiveFrame> newest_;
  bool ends_ = false, failed_ = false;
  std::thread thread_;
};

}  // namespace wavetracer::app
