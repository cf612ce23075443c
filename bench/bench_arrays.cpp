// SPDX-License-Identifier: Apache-2.0
// bench_arrays measures the time that array elements add to a frame whose links have one antenna at each end: responses
// at 1 and at 64 subcarriers, and beams. "ratio" is the time of the frame of one antenna over that of the frame with
// arrays; "error" is the rms error of plane wavefronts against spherical ones, which are exact.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "json_line.hpp"
#include "places.hpp"
#include "turns.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

struct Options {
  std::string device, shared = WAVETRACER_SHARED;
  size_t repeat = 15;
};

void respond(Config& config, uint32_t subcarriers) {
  config.response.bandwidth_hz = 20e6;
  config.response.subcarriers = subcarriers;
}

// Adds a panel of 8 x 8 elements at transmitters and one of 4 x 2 at receivers.
void add_panels(Config& config) {
  config.arrays.resize(2);
  config.arrays[0].name = "64";
  config.arrays[0].rows = config.arrays[0].columns = 8;
  config.arrays[1].name = "8";
  config.arrays[1].rows = 4;
  config.arrays[1].columns = 2;
  for (RadioEnd& end : config.transmitters) end.array = "64";
  for (RadioEnd& end : config.receivers) end.array = "8";
}

double rms_error(const Responses& found, const Responses& exact) {
  double error = 0, power = 0;
  for (size_t i = 0; i < exact.h.size(); ++i) {
    error += std::norm(found.h[i] - exact.h[i]);
    power += std::norm(exact.h[i]);
  }
  return std::sqrt(error / power);
}

void run_case(const Place& place, size_t receivers, bool diffraction, const Options& options,
              const std::string& command) {
  Config common = config_of(place, 1, receivers);
  common.trace.diffraction = diffraction;
  std::vector<Variant> variants;
  for (const uint32_t subcarriers : {1u, 64u}) {
    variants.push_back(
        {fmt::format("1 x 1, {} subcarriers", subcarriers), [=](Config& c) { respond(c, subcarriers); }});
    variants.push_back({fmt::format("64 x 8, {} subcarriers", subcarriers), [=](Config& c) {
                          respond(c, subcarriers);
                          add_panels(c);
                        }});
    variants.push_back({fmt::format("64 x 8 plane, {} subcarriers", subcarriers), [=](Config& c) {
                          respond(c, subcarriers);
                          add_panels(c);
                          c.radio.wavefront = "plane";
                        }});
  }
  variants.push_back({"64 x 8, DFT beams of both", [](Config& c) {
                        add_panels(c);
                        c.arrays[0].codebook = c.arrays[1].codebook = "dft";
                      }});
  const std::vector<Turns> turns = run_in_turn(common, variants, options.device, options.repeat);
  for (size_t i = 0; i < turns.size(); ++i) {
    const size_t baseline = i < 3 || i == 6 ? 0 : 3;
    if (i == baseline) continue;
    Result result{.bench = "arrays",
                  .name = fmt::format("{}, 1x{}{}, {}", place.name, receivers, diffraction ? ", diffraction" : "",
                                      variants[i].name),
                  .device = turns[i].device,
                  .value = 1e3 * turns[i].median_s,
                  .unit = "ms",
                  .better = Better::lower,
                  .baseline = variants[baseline].name,
                  .baseline_value = 1e3 * turns[baseline].median_s,
                  .error = 0,
                  .detail = ""};
    const FrameResult& frame = turns[i].result;
    if (i == 2 || i == 5) result.error = rms_error(frame.responses, turns[i - 1].result.responses);
    const auto elements = frame.seconds.find("elements");
    result.detail = fmt::format("{} paths; elements {:.2f} ms", frame.paths.size(),
                                elements == frame.seconds.end() ? 0.0 : 1e3 * elements->second);
    print(result, command);
  }
}

void run(const Options& options, const std::string& command) {
  const std::optional<Place> munich = munich_place(options.shared, 1, 10);
  if (!munich)
    fmt::print(stderr, "bench_arrays: munich is not in {}/scenes, so the generated city takes its place\n",
               options.shared);
  const Place place = munich ? *munich : city_place(1, 10);
  run_case(place, 1, false, options, command);
  run_case(place, 10, false, options, command);
  run_case(place, 1, true, options, command);
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app(
      "Measures the time that responses between elements of arrays, and beams, add to a frame of single antennas");
  bench::Options options;
  app.add_option("--device", options.device, "as for wavetracer run");
  app.add_option("--shared", options.shared, "folder that holds scenes/munich");
  app.add_option("--repeat", options.repeat, "warm frames of which the median counts")->check(CLI::Range(3, 1000));
  CLI11_PARSE(app, argc, argv);
  try {
    bench::run(options, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_arrays: {}\n", error.what());
    return static_cast<int>(error.code());
  }
  return 0;
}
