// SPDX-License-Identifier: Apache-2.0
// A frame becomes a run of one frame, and the run a page, by the same code as for other runs.
// The run lies in a hidden folder beside the page, and is removed with the object.
#include "app/live_page.hpp"
#include <fmt/format.h>
#include "base/file.hpp"
#include "base/html_page.hpp"
#include "base/output_place.hpp"
#include "base/times.hpp"
#include "viewer/view.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds between_pages{1};
constexpr double reload_s = 2;
std::string no_frame_yet() {
  return html_page("wavetracer", "", "<p>No frame was solved yet.</p>\n",
                   "<meta http-equiv=\"refresh\" content=\"2\">\n");
}

}  // namespace

LivePage::LivePage(const fs::path& file, Tell tell)
    : file_(fs::absolute(file)),
      folder_(file_.parent_path() / ("." + file_.filename().string() + ".run")),
      tell_(std::move(tell)) {
  if (output_place(file_).stream)
    throw ConfigError(fmt::format(
        "--page {}: this is a device or a pipe, but the page is written anew for later frames: name a plain file",
        file.string()));
  write_file(file_, no_frame_yet());
  thread_ = std::thread([this] { work(); });
}

LivePage::~LivePage() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  thread_.join();
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void LivePage::show(const Simulation& simulation, const LiveFrame& frame) {
  {
    const std::lock_guard lock(mutex_);
    if (!world_) {
      const Run run = make_run(simulation);
      world_ = World{run.config, run.scene, run.instances, run.models, run.summary};
    }
    newest_ = frame;
  }
  changed_.notify_all();
}

void LivePage::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ends_ || newest_; });
    if (!newest_) return;
    const LiveFrame frame = std::move(*newest_);
    newest_.reset();
    lock.unlock();
    write(frame);
    lock.lock();
    changed_.wait_for(lock, between_pages, [this] { return ends_; });
  }
}

void LivePage::write(const LiveFrame& frame) {
  try {
    Config config = world_->config;  // with the names that the sender of the poses uses
    std::vector<Instance> instances = world_->instances;
    for (size_t i = 0; i < config.transmitters.size(); ++i) config.transmitters[i].name = frame.transmitters.at(i);
    for (size_t i = 0; i < config.receivers.size(); ++i) config.receivers[i].name = frame.receivers.at(i);
    for (size_t i = 0; i < instances.size(); ++i) instances[i].id = frame.instances.at(i);
    const Run run{config, world_->scene, instances, world_->models, world_->summary};
    write_outputs(folder_, run, std::span(&frame.result, 1));
    const SavedRun saved(folder_);
    if (!drawn_) drawn_ = load_saved_world(saved, true);
    const std::string title = fmt::format("Live world, {} s", time_text(frame.result.world.time_s));
    const ViewPage page = make_view(saved, *drawn_, {.title = title, .reload_s = reload_s});
    write_file(file_, page.html);
    failed_ = false;
  } catch (const std::exception& e) {
    if (!failed_) tell_(fmt::format("the page {} could not be written: {}; frames go on", file_.string(), e.what()));
    failed_ = true;
  }
}

}  // namespace wavetracer::app
