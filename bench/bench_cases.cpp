// SPDX-License-Identifier: Apache-2.0
// bench_cases measures twenty cases that nothing was tuned on individually: the losses of launches in each, how well
// "auto" keeps its promise, and whether the intervals of `missed` contain the truth. The truth is the list by beams,
// with all paths that any launch of a case found; "error" is the share of them that is lost. A path that only rays find
// is a fault of the beams: the program says so, and fails.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>

#include "json_line.hpp"
#include "known_paths.hpp"
#include "missed_record.hpp"
#include "path_recall.hpp"
#include "study_cases.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"
#include "wavetracer/simulation.hpp"

namespace wavetracer::bench {
namespace {

constexpr uint32_t drive_frames = 10;

struct Options {
  std::string device, shared = WAVETRACER_SHARED, directions = "horizon";
  std::vector<std::string> cases = study_case_names();
  std::vector<uint64_t> rays{10'000, 30'000, 100'000, 300'000, 1'000'000};
  bool beams = true;
  uint64_t truth_rays = 0, seed = 1;
  double recall = 0.99, seconds = 1e9;
  size_t frames = 3;
};

// A setting of a case, and its frame.
struct Launch {
  std::string setting;
  FrameResult result;
  double median_s = 0;
};

double wall_s(const std::function<void()>& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

class Bench {
 public:
  Bench(const Options& options, std::string command) : options_(options), command_(std::move(command)) {}

  // Returns the number of paths that only rays have found.
  size_t run() {
    const auto start = std::chrono::steady_clock::now();
    std::string left;
    for (const std::string& name : options_.cases)
      if (std::chrono::steady_clock::now() - start < std::chrono::duration<double>(options_.seconds))
        run_case(name);
      else
        left += " " + name;
    if (left.empty()) {
      if (options_.beams) print_beams();
      for (const auto& [setting, record] : records_) print_record(setting, record);
    } else {
      fmt::print(stderr, "bench_cases: --seconds {} is over; not measured: --cases{}\n", options_.seconds, left);
    }
    return only_rays_;
  }

 private:
  void run_case(const std::string& name) {
    const StudyCase study = study_case(name, options_.shared, folder_ / "", options_.seed);
    KnownPaths known;
    if (options_.beams) look(name, study, known);
    for (const char* directions : {"horizon", "hilbert"}) {
      if (options_.truth_rays == 0) break;
      Config config = study.config;
      config.trace.rays = options_.truth_rays;
      config.trace.directions = Directions::named(directions);
      Simulation simulation(config, options_.device);
      device_ = simulation.device().name;
      known.add(simulation.run_frame(0).paths);
      fmt::print(stderr, "{}: {} paths are known after {} rays, {}\n", name, known.size(), options_.truth_rays,
                 directions);
    }
    if (known.size() == 0) {
      fmt::print(stderr,
                 "bench_cases: {} has no path at these places and is left out; another --seed has other places\n",
                 name);
      return;
    }
    std::vector<Launch> launches;
    for (const uint64_t rays : options_.rays) {
      const std::string text = fmt::format("{:.0e} rays", static_cast<double>(rays));
      launches.push_back(standing(study, text, rays));
      launches.push_back(driven(study, text + ", reuse", rays));
    }
    launches.push_back(standing(study, "auto", 0));
    launches.push_back(driven(study, "auto, reuse", 0));
    for (const Launch& launch : launches) known.add(launch.result.paths);
    for (const Launch& launch : launches) judge(name, launch, known);
    if (options_.beams) judge_beams(name, known);
  }

  // Finds the list by beams.
  void look(const std::string& name, const StudyCase& study, KnownPaths& known) {
    Config config = study.config;
    config.trace.discovery = "beams";
    Simulation simulation(config, options_.device);
    device_ = simulation.device().name;
    simulation.run_frame(0);  // drivers finish compiling
    beams_.median_s = wall_s([&] { beams_.result = simulation.run_frame(0); });
    if (beams_.median_s < 1) beams_.median_s = median_of(simulation, beams_.result);
    known.add(beams_.result.paths);
    fmt::print(stderr, "{}: {} paths by beams in {:.3g} s\n", name, known.size(), beams_.median_s);
  }

  Config with_rays(Config config, uint64_t rays) const {
    config.trace.directions = Directions::named(options_.directions);
    config.trace.rays = rays > 0 ? std::optional(rays) : std::nullopt;  // 0 means "auto"
    config.trace.recall = options_.recall;
    return config;
  }

  Launch standing(const StudyCase& study, const std::string& setting, uint64_t rays) const {
    Simulation simulation(with_rays(study.config, rays), options_.device);
    Launch launch{setting, simulation.run_frame(0), 0};
    launch.median_s = median_of(simulation, launch.result);
    return launch;
  }

  // Returns the median time of warm frames, with the result of the last one.
  double median_of(Simulation& simulation, FrameResult& result) const {
    std::vector<double> seconds(options_.frames);
    for (double& one : seconds) one = wall_s([&] { result = simulation.run_frame(0); });
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2), seconds.end());
    return seconds[seconds.size() / 2];
  }

  // Returns the last frame of a drive that ends where the case stands.
  Launch driven(const StudyCase& study, const std::string& setting, uint64_t rays) const {
    Simulation simulation(with_rays(driving(study, drive_frames), rays), options_.device);
    Launch launch{setting, {}, 0};
    for (uint32_t frame = 0; frame < drive_frames; ++frame)
      launch.median_s = wall_s([&] { launch.result = simulation.run_frame(frame); });
    return launch;
  }

  void judge(const std::string& name, const Launch& launch, const KnownPaths& known) {
    const KnownPaths::Lost lost = known.lost(launch.result.paths);
    const bool told = launch.result.missed.frames > 0;
    const Missed missed = estimate_missed(launch.result.missed);
    // The estimate of the power is a share of the power that was found.
    const double found = known.power() - lost.power, share = found > 0 ? lost.power / found : 0;
    const double lost_share =
        known.size() > 0 ? static_cast<double>(lost.paths) / static_cast<double>(known.size()) : 0;
    MissedRecord& record = record_of(launch.setting);
    record.add(lost_share <= 1 - options_.recall, launch.result.counts.segments, launch.median_s,
               {static_cast<double>(lost.paths), lost_share, share}, told ? std::optional(missed) : std::nullopt);
    Result line{"cases",
                fmt::format("{}, {}", name, launch.setting),
                device_,
                launch.median_s,
                "s per frame",
                Better::lower,
                "",
                {},
                lost_share,
                fmt::format("{} of {} paths lost, {:.1e} of the power; missed {}", lost.paths, known.size(), share,
                            told ? words_of(missed) : "unknown")};
    const auto range = [](const MissedRange& r) { return nlohmann::ordered_json{r.estimate, r.low, r.high}; };
    line.extra = {{"rays", launch.result.counts.rays},
                  {"segments", launch.result.counts.segments},
                  {"paths", known.size()},
                  {"lost_paths", lost.paths},
                  {"lost_power", share}};
    if (told) line.extra.update({{"missed_paths", range(missed.paths)}, {"missed_power", range(missed.power_share)}});
    if (options_.beams) line.extra["only_rays"] = path_recall(beams_.result.paths, launch.result.paths).extra();
    print(line, command_);
  }

  // known: with all that rays have found.
  void judge_beams(const std::string& name, const KnownPaths& known) {
    const KnownPaths::Lost lost = known.lost(beams_.result.paths);
    only_rays_ += lost.paths;
    const double share = static_cast<double>(lost.paths) / static_cast<double>(known.size());
    const Certificate& of = beams_.result.certificate;
    beam_record_.add(lost.paths == 0, 0, beams_.median_s, {static_cast<double>(lost.paths), share, 0}, {});
    Result line{"cases",
                fmt::format("{}, beams", name),
                device_,
                beams_.median_s,
                "s per frame",
                Better::lower,
                "",
                {},
                share,
                fmt::format("{} of {} paths are found by rays alone; {:.1e} sr of beams were not followed", lost.paths,
                            known.size(), of.left_out_sr)};
    line.extra = {{"paths", known.size()},
                  {"only_rays", lost.paths},
                  {"truth_rays", options_.truth_rays},
                  {"sequences", beams_.result.counts.sequences},
                  {"depth", of.depth},
                  {"left_out_sr", of.left_out_sr}};
    print(line, command_);
  }

  MissedRecord& record_of(const std::string& setting) {
    for (auto& [known, record] : records_)
      if (known == setting) return record;
    return records_.emplace_back(setting, MissedRecord{}).second;
  }

  void print_beams() const {
    const MissedRecord& of = beam_record_;
    Result line{"cases",
                "all, beams",
                device_,
                of.kept_share(),
                "of the cases",
                Better::higher,
                "",
                {},
                of.mean_path_share(),
                fmt::format("{} of {} cases without a path that rays alone find; {:.3g} s", of.kept(), of.cases(),
                            of.seconds())};
    line.extra = {{"cases", of.cases()}, {"kept", of.kept()}, {"only_rays", only_rays_}, {"seconds", of.seconds()}};
    print(line, command_);
  }

  void print_record(const std::string& setting, const MissedRecord& record) const {
    Result line{"cases",
                "all, " + setting,
                device_,
                record.kept_share(),
                "of the cases",
                Better::higher,
                "",
                {},
                record.mean_path_share(),
                words_of(record, options_.recall)};
    line.extra = {{"cases", record.cases()},           {"kept", record.kept()},
                  {"losing", record.losing()},         {"paths_held", record.paths_held()},
                  {"power_held", record.power_held()}, {"power_near", record.power_near()},
                  {"segments", record.segments()},     {"seconds", record.seconds()}};
    print(line, command_);
  }

  const Options& options_;
  std::string command_, device_;
  test::TemporaryFolder folder_;
  Launch beams_{"beams", {}, 0};  // that of the present case
  MissedRecord beam_record_;
  size_t only_rays_ = 0;
  std::vector<std::pair<std::string, MissedRecord>> records_;  // by setting, in order of their first case
};

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app(
      "Measures the paths that launches lose in twenty cases, with the promise of \"auto\" and the estimate `missed`");
  bench::Options options;
  std::vector<std::string> names = bench::study_case_names();
  for (const std::string& further : bench::further_case_names()) names.push_back(further);
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/");
  app.add_option("--cases", options.cases, "some of the cases")->check(CLI::IsMember(names));
  app.add_option("--rays", options.rays, "fixed numbers of rays per transmitter")
      ->check(CLI::Range(uint64_t{100}, uint64_t{2'000'000'000}));
  app.add_flag("--beams,!--no-beams", options.beams, "the list by beams is a part of the truth");
  app.add_option("--truth-rays", options.truth_rays,
                 "of each of two launches, \"horizon\" and \"hilbert\", that are a part of the truth; 0: none")
      ->check(CLI::Range(uint64_t{0}, uint64_t{2'000'000'000}));
  app.add_option("--seconds", options.seconds, "start no case after this time")->check(CLI::PositiveNumber);
  app.add_option("--directions", options.directions, "horizon or hilbert")
      ->check(CLI::IsMember({"horizon", "hilbert"}));
  app.add_option("--recall", options.recall, "what \"auto\" is asked for")->check(CLI::Range(0.5, 0.9999));
  app.add_option("--seed", options.seed, "of the places of all ends");
  app.add_option("--frames", options.frames, "warm frames of which the median counts")->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  try {
    if (const size_t only_rays = bench::Bench(options, bench::command_line(argc, argv)).run(); only_rays > 0) {
      fmt::print(stderr, "bench_cases: beams lack {} paths that rays have found\n", only_rays);
      return 1;
    }
  } catch (const Error& error) {
    fmt::print(stderr, "bench_cases: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
