// SPDX-License-Identifier: Apache-2.0
// `wavetracer events` lists every birth and death of a path in a drive, with its time.
// The checks that need no device come first, so that a mistake is reported at once.
#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <span>
#include "app/commands.hpp"
#include "app/number_range.hpp"
#include "base/csv.hpp"
#include "base/pending_file.hpp"
#include "jobs/frame_range.hpp"
#include "jobs/path_events.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/interaction_kinds.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::app {
namespace {

namespace fs = std::filesystem;

struct EventOptions {
  std::string file, output, frames, device;
  std::vector<std::string> sets;
  EventChoice choice;
};

Config events_config(const EventOptions& options) {
  std::vector<std::string> sets = options.sets;
  sets.push_back("output.lifetimes=true");  // what does not go with it is refused here
  Config config = load_config(options.file, sets);
  if (!config.trace.by_beams())
    throw ConfigError(options.file +
                      ": rays may miss a path in one frame and find it in the next, which is no birth: events need "
                      "trace.discovery = \"beams\"");
  if (!config.live_vehicles.empty())
    throw ConfigError(options.file +
                      ": the poses of [[live_vehicle]] tables are known when they come, and events are those of "
                      "trajectories: give trajectories instead");
  if (config.trace.scattering || (config.trace.target && !config.target_models.empty()))
    throw ConfigError(options.file +
                      ": events tell paths apart by their surfaces and edges, and paths by tiles or targets have "
                      "neither: set trace.scattering and trace.target to false");
  return config;
}

// Returns a path in words: "reflection:12 diffraction:3@car7", the surfaces and edges with the vehicles that have them.
std::string in_words(const Touched& path, const std::vector<Instance>& instances) {
  std::string out;
  for (const TouchedThing& at : path) {
    out += fmt::format("{}{}:{}", out.empty() ? "" : " ", find_interaction(at.interaction)->word, at.thing);
    if (at.instance != no_instance) out += "@" + instances[at.instance].id;
  }
  return out.empty() ? "line of sight" : out;
}

Csv table_of(const EventList& list, const Simulation& simulation) {
  Csv out({"time_s", "event", "tx", "rx", "depth", "path"});
  const Config& config = simulation.config();
  for (const PathEvent& event : list.events)
    out.add(event.time_s, event.birth ? "birth" : "death", config.transmitters[event.link.tx].name,
            config.receivers[event.link.rx].name, event.path.size(), in_words(event.path, simulation.instances()));
  return out;
}

// The frames of the option, of a drive of so many.
FrameRange events_range(const std::string& frames, uint64_t frame_count) {
  const FrameRange range = parse_frames(frames, frame_count);
  if (range.count() < 2)
    throw ConfigError("events happen between frames, and there is only one: give trajectories, and --frames A:B");
  return range;
}

void events(const EventOptions& options) {
  check_frames(options.frames);
  const Config config = events_config(options);
  FrameRange range;
  Simulation simulation(config, options.device, [&](uint64_t frames) { range = events_range(options.frames, frames); });
  simulation.profile_every(profiled_frames);
  std::vector<double> times;
  for (uint32_t frame = range.first; frame <= range.last; ++frame) times.push_back(simulation.time_s(frame));
  for (const std::string& warning : simulation.warnings()) std::cerr << "warning: " << warning << "\n";
  const EventList list = find_events(drive_of(simulation), times, options.choice);
  const Csv table = table_of(list, simulation);
  PendingFile file(fs::absolute(options.output), std::as_bytes(std::span(table.text())));
  file.commit();
  const auto births = std::ranges::count(list.events, true, &PathEvent::birth);
  std::cout << fmt::format("{} births and {} deaths in {} steps, {} times computed, written to {}\n", births,
                           static_cast<int64_t>(list.events.size()) - births, times.size() - 1, list.instants,
                           options.output);
  if (list.unsure > 0)
    std::cout << fmt::format(
        "in {} pieces of at most {:g} of a step a path may have died and come back; a smaller --finest cuts them\n",
        list.unsure, options.choice.finest);
  if (list.unbounded > 0)
    std::cout << fmt::format(
        "{} times a path without a lifetime is at both ends of a part of a step, so nothing is known of it between\n",
        list.unbounded);
}

}  // namespace

void add_events(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("events", "List the births and deaths of paths in a drive, with their times");
  const auto options = std::make_shared<EventOptions>();
  command->add_option("-c,--config", options->file, "Config file (TOML) with trajectories, and beams")->required();
  command->add_option("-o,--output", options->output, "CSV file for the events")->required();
  command
      ->add_option("--set", options->sets, "KEY=VALUE: set a key of the config, overriding the file; may be repeated")
      ->allow_extra_args(false);
  command->add_option("--frames", options->frames, "Numbers of the first and last frame, A:B; all frames if not given");
  command->add_option("--device", options->device,
                      "OpenCL device: its index, or a part of its name or of its platform's name");
  command
      ->add_option("--parts", options->choice.parts,
                   "Compute all links at the ends of so many parts of each step: a path that lives for a part is found")
      ->check(number_range(1u, 1000000u));
  command
      ->add_option("--precision", options->choice.precision,
                   "Precision of times, as a share of a step; 0.001 if not given")
      ->check(number_range(1e-9, 1.0));
  command
      ->add_option("--finest", options->choice.finest,
                   "Shortest piece, as a share of a step, that is cut because a path may die and come back in it; "
                   "1/32 if not given")
      ->check(number_range(1e-9, 1.0));
  command->callback([options] { events(*options); });
}

}  // namespace wavetracer::app
