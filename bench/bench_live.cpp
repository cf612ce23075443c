// SPDX-License-Identifier: Apache-2.0
// bench_live measures the latency from pose to channel, as a client of `wavetracer serve` sees it over a socket, and
// its stages. It needs POSIX and a quiet machine. "error" is the share of the power of cold frames of ten times the
// rays, at the same poses, that the measured frames miss.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "json_line.hpp"
#include "live_peer.hpp"
#include "live_recall.hpp"
#include "live_times.hpp"
#include "live_world.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::bench {
namespace {

using nlohmann::json;
using Seconds = std::vector<double>;

std::string frame_line(const LiveInstant& instant, uint32_t number, bool cold) {
  json out{{"message", "frame"}, {"frame", number}, {"time_s", instant.time_s}, {"vehicles", instant.vehicles}};
  if (cold) out["cold"] = true;
  return out.dump();
}

// The times, counts and answers of a run by the protocol of lines.
struct StreamTimes {
  std::map<std::string, Seconds> seconds;  // by stages
  Seconds cold_s;
  std::map<uint32_t, json> compared;
  size_t bytes = 0, links = 0, paths = 0;
  std::string device;
};

// Reads an answer; with columns, `links` of it has empty entries.
json read_answer(const LiveOptions& options, const std::string& answer, StreamTimes& out) {
  out.bytes = answer.size();
  json read = LiveStream::checked(json::parse(LiveStream::line_of(answer)));
  if (options.encoding == "json") {
    out.paths = 0;
    for (const json& link : read.at("links")) out.paths += link.at("paths").get<size_t>();
  } else {
    const json columns = json::from_cbor(LiveStream::columns_of(answer), true, true, json::cbor_tag_handler_t::ignore);
    const auto& counts = columns.at("links").at("paths").get_binary();  // uint32, the lowest byte first
    read["links"] = json(counts.size() / sizeof(uint32_t), json::object());
    out.paths = 0;
    for (size_t i = 0; i < counts.size(); ++i) out.paths += size_t{counts[i]} << (8 * (i % sizeof(uint32_t)));
  }
  out.links = read.at("links").size();
  return read;
}

StreamTimes time_stream(const LiveOptions& options, const LiveDrive& drive, const std::string& config) {
  StreamTimes out;
  const LiveServer server(options, config);
  const LiveStream stream(server, options);
  out.device = stream.device;
  const auto cold = [&](uint32_t k, Seconds& seconds) {
    const std::string line = frame_line(drive.instants[k], k, true);
    read_answer(options, timed(seconds, [&] { return stream.exchange(line); }), out);
  };
  Seconds ignored;
  cold(0, ignored);  // the first one allocates buffers
  for (uint32_t k = 1; k < std::min<uint32_t>(options.frames, 5); ++k) cold(k, out.cold_s);
  cold(0, ignored);
  const uint32_t spacing = std::max<uint32_t>(options.frames / std::max(options.compared, 1u), 1);
  for (uint32_t k = 1; k < options.frames; ++k) {
    const std::string line = frame_line(drive.instants[k], k, false);
    json answer = read_answer(options, timed(out.seconds["all"], [&] { return stream.exchange(line); }), out);
    double known_s = 0;
    for (const char* stage : {"wait", "solve", "serialise"}) {
      out.seconds[stage].push_back(answer.at("seconds").at(stage));
      known_s += out.seconds[stage].back();
    }
    out.seconds["parse and socket"].push_back(out.seconds["all"].back() - known_s);
    if (k % spacing == spacing - 1 || k + 1 == options.frames) out.compared[k] = std::move(answer);
  }
  return out;
}

LiveRecall recall_of(const LiveOptions& options, const LiveDrive& drive, uint32_t vehicles, const StreamTimes& times) {
  LiveRecall out;
  if (options.no_reference || options.detail == "links" || options.encoding != "json") return out;
  const LiveServer server(options, live_config(options, drive, vehicles, options.rays * options.reference_factor));
  const LiveStream stream(server, options);
  for (const auto& [k, mine] : times.compared) out.add(stream.ask(frame_line(drive.instants[k], k, true)), mine);
  return out;
}

Result empty_row(const LiveOptions& options, uint32_t vehicles) {
  Result line;
  line.bench = "live";
  line.name = fmt::format("city, {} vehicle{}, {} rays, {} anew", vehicles,
                          vehicles == 1 ? " and a road-side unit" : "s", options.rays, options.refresh);
  line.unit = "s from pose to channel";
  line.better = Better::lower;
  line.error = std::numeric_limits<double>::quiet_NaN();  // null in JSON
  return line;
}

void run_stream(const LiveOptions& options, uint32_t vehicles, const std::string& command) {
  const LiveDrive drive = live_drive(options, vehicles);
  StreamTimes times = time_stream(options, drive, live_config(options, drive, vehicles, options.rays));
  const LiveRecall recall = recall_of(options, drive, vehicles, times);
  const Seconds& all = times.seconds["all"];
  Result line = empty_row(options, vehicles);
  if (options.detail != "links") line.name += ", " + options.detail;
  if (options.encoding != "json") line.name += ", columns in CBOR";
  line.device = times.device;
  line.value = percentile(all, 0.5);
  line.baseline = "cold frames";
  line.baseline_value = percentile(times.cold_s, 0.5);
  line.extra = {{"p99_s", percentile(all, 0.99)},
                {"frames", all.size()},
                {"links", times.links},
                {"paths", times.paths},
                {"answer_bytes", times.bytes}};
  std::string stages;
  for (const char* stage : {"solve", "serialise", "parse and socket", "wait"}) {
    const double median_s = percentile(times.seconds[stage], 0.5);
    line.extra["stages_s"][stage] = median_s;
    stages += fmt::format(", {} {:.2g}", stage, median_s);
  }
  line.detail = fmt::format("p99 {:.3g} s; {} links, {} paths, {} bytes an answer{}", percentile(all, 0.99),
                            times.links, times.paths, times.bytes, stages);
  if (recall.reference > 0) {
    line.error = recall.power > 0 ? 1 - recall.found_power / recall.power : 0;
    line.extra["path_recall"] = static_cast<double>(recall.found) / static_cast<double>(recall.reference);
    line.extra["reference_paths"] = recall.reference;
    line.detail += fmt::format("; {} of {} paths of cold frames of {} times the rays", recall.found, recall.reference,
                               options.reference_factor);
  } else {
    line.detail += "; error not measured";
  }
  print(line, command);
}

// The device that the server would take: VaN3Twin's protocol does not tell it.
std::string device_name(LiveOptions options, const std::string& config) {
  options.protocol = "live";
  const LiveServer server(options, config);
  return LiveStream(server, options).device;
}

// Places all vehicles, then asks for figures of all pairs, instant by instant, as VaN3Twin's modules do. The time from
// pose to channel is that of the first question of an instant, for which the channels of all pairs are computed. There
// are at least two vehicles.
void run_datagrams(const LiveOptions& options, uint32_t vehicles, const std::string& command) {
  const LiveDrive drive = live_drive(options, vehicles);
  const std::string config = live_config(options, drive, vehicles, options.rays);
  Result line = empty_row(options, vehicles);
  line.device = device_name(options, config);
  const LiveServer server(options, config);
  const LiveDatagrams client(server);
  Seconds places, firsts, questions;
  size_t links = 0;
  for (uint32_t k = 0; k < options.frames; ++k) {
    links = 0;
    Seconds asked;
    const json& all = drive.instants[k].vehicles;
    for (const json& vehicle : all) {
      const json &at = vehicle.at("position_m"), &q = vehicle.at("orientation");
      const double yaw = 2 * std::atan2(q[3].get<double>(), q[0].get<double>());
      const std::string id = vehicle.at("id");
      const std::string update =
          fmt::format("LOC_UPDATE:{},{:f},{:f},{:f},{:f},0.000000,0.000000,0.000000", id, at[0].get<double>(),
                      at[1].get<double>(), at[2].get<double>(), 90 - yaw * 180 / 3.14159265358979323846);
      timed(places, [&] { return client.ask(update, "LOC_CONFIRM:" + id); });
    }
    for (const json& from : all)
      for (const json& to : all) {
        if (from == to) continue;
        const std::string pair = from.at("id").get<std::string>() + "," + to.at("id").get<std::string>();
        for (const char* figure : {"PATHGAIN", "DELAY", "LOS"}) {
          const std::string answer = timed(asked, [&] {
            return client.ask(fmt::format("CALC_REQUEST_{}:{}", figure, pair), fmt::format("CALC_DONE_{}:", figure));
          });
          links += figure == std::string_view("PATHGAIN") && answer != "300";
        }
      }
    questions.insert(questions.end(), asked.begin(), asked.end());
    if (k > 0 && !asked.empty()) firsts.push_back(asked[0]);  // the first frame is cold
  }
  line.name += ", VaN3Twin";
  line.value = percentile(firsts, 0.5);
  line.extra = {{"p99_s", percentile(firsts, 0.99)},
                {"frames", firsts.size()},
                {"links", links},
                {"questions", questions.size()},
                {"questions_p50_s", percentile(questions, 0.5)},
                {"questions_p99_s", percentile(questions, 0.99)},
                {"places_p99_s", percentile(places, 0.99)}};
  line.detail = fmt::format(
      "p99 {:.3g} s; {} links with a path; of {} questions 99 of 100 within {:.2g} s, p50 {:.2g} s",
      percentile(firsts, 0.99), links, questions.size(), percentile(questions, 0.99), percentile(questions, 0.5));
  print(line, command);
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Latency from pose to channel of wavetracer serve");
  bench::LiveOptions options;
  std::vector<uint32_t> vehicles{1, 20, 100};
  std::vector<std::string> protocols{"live", "van3twin"}, details{"links", "paths", "matrices"},
      encodings{"json", "cbor"};
  options.program =
      (std::filesystem::absolute(argv[0]).parent_path() / "../host/app/wavetracer").lexically_normal().string();
  app.add_option("--program", options.program, "the program wavetracer");
  app.add_option("--device", options.device, "as for wavetracer serve");
  app.add_option("--vehicles", vehicles, "vehicles in the streets, a line each")->check(CLI::Range(1, 1000));
  app.add_option("--frames", options.frames, "frames of a drive")->check(CLI::Range(6, 100000));
  app.add_option("--step", options.step_s, "seconds from frame to frame")->check(CLI::Range(0.001, 10.0));
  app.add_option("--rays", options.rays, "rays per transmitter of cold frames")->check(CLI::Range(100, 1000000000));
  app.add_option("--refresh", options.refresh, "rays per transmitter of frames that reuse");
  app.add_option("--protocol", protocols, "live, and van3twin, whose answers have one figure each; a line each")
      ->check(CLI::IsMember({"live", "van3twin"}));
  app.add_option("--detail", details,
                 "links, paths, vertices, or matrices: paths between antennas of two ports; a line each")
      ->check(CLI::IsMember({"links", "paths", "vertices", "matrices"}));
  app.add_option("--encoding", encodings, "json, and cbor, whose errors are not measured; a line each")
      ->check(CLI::IsMember({"json", "cbor"}));
  app.add_option("--compared", options.compared, "frames that errors are taken from")->check(CLI::Range(1, 1000));
  app.add_option("--reference-factor", options.reference_factor, "times the rays, of frames that errors refer to");
  app.add_flag("--no-reference", options.no_reference, "do not measure errors");
  CLI11_PARSE(app, argc, argv);
  try {
    const std::string command = bench::command_line(argc, argv);
    for (options.protocol = "live"; const uint32_t count : vehicles)
      for (const std::string& detail : details)
        for (const std::string& encoding : encodings) {
          if (std::ranges::count(protocols, "live") == 0) continue;
          options.detail = detail;
          options.encoding = encoding;
          bench::run_stream(options, count, command);
        }
    options.detail = "links";
    for (options.protocol = "van3twin"; const uint32_t count : vehicles)
      if (count > 1 && std::ranges::count(protocols, "van3twin") > 0) bench::run_datagrams(options, count, command);
  } catch (const Error& error) {
    fmt::print(stderr, "bench_live: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
