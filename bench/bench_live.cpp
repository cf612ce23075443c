// SPDX-License-Identifier: Apache-2.0
// bench_live measures the latency from pose to channel, as a client of `wavetracer serve` sees it over a Unix socket,
// and its stages. It needs POSIX and a quiet machine. "error" is the share of the power of cold frames of ten times the
// rays, at the same poses, that the measured frames miss.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>
#include <map>
#include <memory>

#include "json_line.hpp"
#include "motion/frame_clock.hpp"
#include "scene/city_traffic.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

extern char** environ;

namespace wavetracer::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

struct Options {
  std::string program, device, detail = "paths", encoding = "json";
  std::vector<uint32_t> vehicles{10, 50, 100};
  uint32_t frames = 100, compared = 3;
  uint64_t rays = 100'000, refresh = 3'000, reference_factor = 10;
  double step_s = 0.1;
  bool no_reference = false;
};

std::string config_text(const Options& options, uint32_t vehicles, uint64_t rays) {
  std::string out = fmt::format(
      "[scene]\ngenerate = \"--seed 1 --blocks 6x6\"\n[links]\nmax_distance_m = 150\n[trace]\nrays = {}\n"
      "refresh_rays = {}\nmax_depth = 3\n[live]\nmax_message_bytes = 16777216\n"
      "[[transmitter]]\nname = \"rsu\"\nposition_m = [8.0, 8.0, 6.0]\n",
      rays, std::min(options.refresh, rays));
  for (const auto& [type, height_m] : {std::pair("passenger", 1.6), {"delivery", 3.0}, {"truck", 2.7}})
    out += fmt::format(
        "[[live_vehicle]]\ntype = \"{0}\"\ncount = {1}\n[[mount]]\nname = \"roof-{0}\"\non = \"{0}\"\n"
        "offset_m = [0.0, 0.0, {2}]\n",
        type, vehicles, height_m);
  return out;
}

// A server and a connection to it.
class Server {
 public:
  Server(const Options& options, uint32_t vehicles, uint64_t rays) {
    std::ofstream(folder_ / "live.toml") << config_text(options, vehicles, rays);
    const std::string path = folder_ / "socket";
    std::vector<std::string> words{options.program, "serve", "-c", folder_ / "live.toml", "--listen", "unix:" + path};
    if (!options.device.empty()) words.insert(words.end(), {"--device", options.device});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, (folder_ / "log").c_str(), O_WRONLY | O_CREAT, 0600);
    const int failed = posix_spawn(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed) throw RuntimeError(fmt::format("cannot start {}; --program names it", words[0]));
    connect_to(path);
    device = ask(fmt::format(R"({{"message":"hello","protocol":1,"detail":"{}","encoding":"{}"}})", options.detail,
                             options.encoding))
                 .at("device");
  }
  ~Server() {
    close(socket_);
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Returns the answering line, without parsing it as JSON, and the columns that follow it.
  std::string exchange(const std::string& line) {
    const std::string out = line + "\n";
    for (size_t sent = 0; sent < out.size();) {
      const ssize_t count = send(socket_, out.data() + sent, out.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) throw RuntimeError("the server went away; " + log());
      sent += static_cast<size_t>(count);
    }
    std::string in;
    do {
      const size_t before = in.size();
      in.resize(before + (1 << 18));
      const ssize_t count = recv(socket_, in.data() + before, in.size() - before, 0);
      if (count <= 0) throw RuntimeError("the server went away; " + log());
      in.resize(before + static_cast<size_t>(count));
    } while (!is_whole(in));
    return in;
  }
  // Returns the line alone, or the bytes that follow it.
  static std::string_view line_of(std::string_view answer) { return answer.substr(0, answer.find('\n')); }
  static std::string_view columns_of(std::string_view answer) { return answer.substr(answer.find('\n') + 1); }
  json ask(const std::string& line) { return checked(json::parse(line_of(exchange(line)))); }
  static json checked(json answer) {
    if (answer.at("message") == "error") throw RuntimeError(answer.at("text").get<std::string>());
    return answer;
  }

  std::string device;

 private:
  // The number of bytes that follow the line is in its first 200 bytes.
  static bool is_whole(const std::string& in) {
    const size_t end = in.find('\n'), key = in.substr(0, 200).find("\"bytes\":");
    if (end == in.npos) return false;
    return key == in.npos || in.size() == end + 1 + std::stoull(in.substr(key + 8));
  }
  void connect_to(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path.copy(address.sun_path, sizeof address.sun_path - 1);
    socket_ = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    while (connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
      if (waitpid(process_, nullptr, WNOHANG) != 0) throw RuntimeError("the server did not start: " + log());
      usleep(20'000);
    }
  }
  std::string log() const {
    std::ifstream in(folder_ / "log");
    return {std::istreambuf_iterator<char>(in), {}};
  }

  test::TemporaryFolder folder_;
  pid_t process_ = 0;
  int socket_ = -1;
};

// Returns frame messages of a drive of the built-in traffic.
std::vector<std::string> drive(const Options& options, uint32_t vehicles) {
  const Trajectories traffic =
      generate_traffic(fmt::format("--seed 1 --blocks 6x6 --vehicles {} --seconds {:.3f} --step {:.3f}", vehicles,
                                   options.frames * options.step_s, options.step_s));
  std::vector<std::string> out;
  for (uint32_t k = 0; k < options.frames; ++k) {
    json poses = json::array();
    for (const auto& [track, pose] : vehicles_at(traffic, k * options.step_s)) {
      const auto& [p, q, v, w] = pose;
      poses.push_back({{"id", traffic.tracks[track].id},
                       {"type", traffic.types[traffic.tracks[track].type].name},
                       {"position_m", {p.x, p.y, p.z}},
                       {"orientation", {q.w, q.x, q.y, q.z}},
                       {"velocity_m_s", {v.x, v.y, v.z}},
                       {"angular_velocity_rad_s", {w.x, w.y, w.z}}});
    }
    out.push_back(json{{"message", "frame"}, {"frame", k}, {"time_s", k * options.step_s}, {"vehicles", poses}}.dump());
  }
  return out;
}

std::string cold(const std::string& frame) { return "{\"cold\":true," + frame.substr(1); }

// Returns the smallest value that at most the share 1 - `share` of the values exceeds.
double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const auto last = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
  return values[std::max<size_t>(last, 1) - 1];
}

struct Recall {
  size_t reference = 0, found = 0;
  double power = 0, found_power = 0;
};

// Paths of one link are the same if their delays agree within 1e-12 s; each is matched once.
void compare(const json& reference, const json& mine, Recall& recall) {
  using Rows = std::vector<std::pair<double, double>>;  // delay, power
  const auto rows = [](const json& answer) {
    std::map<std::string, Rows> out;
    for (const json& link : answer.at("links")) {
      Rows& to = out[link.at("tx").get<std::string>() + ">" + link.at("rx").get<std::string>()];
      for (size_t i = 0; i < link.at("delay_s").size(); ++i) {
        const double re = link.at("a_re")[i][0], im = link.at("a_im")[i][0];
        to.emplace_back(link.at("delay_s")[i], re * re + im * im);
      }
    }
    return out;
  };
  auto found = rows(mine);
  for (const auto& [link, all] : rows(reference))
    for (const auto& [delay_s, power] : all) {
      Rows& candidates = found[link];
      const auto match = std::ranges::find_if(
          candidates, [&, delay = delay_s](const auto& row) { return std::abs(row.first - delay) <= 1e-12; });
      recall.reference++;
      recall.power += power;
      if (match == candidates.end()) continue;
      recall.found++;
      recall.found_power += power;
      candidates.erase(match);
    }
}

void run(const Options& options, uint32_t vehicles, const std::string& command) {
  const std::vector<std::string> frames = drive(options, vehicles);
  std::map<std::string, std::vector<double>> seconds;
  std::map<uint32_t, json> compared;
  std::vector<double> cold_s;
  size_t bytes = 0, links = 0, paths = 0;
  std::string device;
  {
    Server server(options, vehicles, options.rays);
    device = server.device;
    const auto timed = [&](const std::string& line, double& total_s) {
      const auto start = Clock::now();
      const std::string answer = server.exchange(line);
      total_s = std::chrono::duration<double>(Clock::now() - start).count();
      bytes = answer.size();
      json read = Server::checked(json::parse(Server::line_of(answer)));
      if (options.encoding == "json") return read;
      const json columns = json::from_cbor(Server::columns_of(answer), true, true, json::cbor_tag_handler_t::ignore);
      read["links"] = json(columns.at("links").at("tx").get_binary().size() / sizeof(uint32_t), json::object());
      if (columns.contains("paths")) paths = columns.at("paths").at("delay_s").get_binary().size() / sizeof(double);
      return read;
    };
    double total_s = 0;
    for (size_t k = 0; k < std::min<size_t>(frames.size(), 5); ++k) {
      timed(cold(frames[k]), total_s);
      if (k > 0) cold_s.push_back(total_s);  // the first one allocates buffers
    }
    timed(cold(frames[0]), total_s);
    for (uint32_t k = 1; k < frames.size(); ++k) {
      json answer = timed(frames[k], total_s);
      double known_s = 0;
      for (const char* stage : {"wait", "solve", "serialise"}) {
        seconds[stage].push_back(answer.at("seconds").at(stage));
        known_s += seconds[stage].back();
      }
      seconds["parse and socket"].push_back(total_s - known_s);
      seconds["all"].push_back(total_s);
      links = answer.at("links").size();
      if (options.encoding == "json") paths = 0;
      for (const json& link : answer.at("links")) paths += link.value("paths", size_t{0});
      const uint32_t spacing = std::max<uint32_t>(options.frames / std::max(options.compared, 1u), 1);
      if (k % spacing == spacing - 1 || k + 1 == frames.size()) compared[k] = std::move(answer);
    }
  }
  Recall recall;
  if (!options.no_reference && options.detail != "links" && options.encoding == "json") {
    Server server(options, vehicles, options.rays * options.reference_factor);
    for (const auto& [k, mine] : compared) compare(server.ask(cold(frames[k])), mine, recall);
  }

  Result line;
  line.bench = "live";
  line.name = fmt::format("city, {} vehicles, {} rays, {} anew{}{}", vehicles, options.rays, options.refresh,
                          options.detail == "links" ? "" : ", " + options.detail,
                          options.encoding == "json" ? "" : ", columns in CBOR");
  line.device = device;
  line.value = percentile(seconds["all"], 0.5);
  line.unit = "s from pose to channel";
  line.better = Better::lower;
  line.baseline = "cold frames";
  line.baseline_value = percentile(cold_s, 0.5);
  line.extra = {{"p99_s", percentile(seconds["all"], 0.99)},
                {"frames", seconds["all"].size()},
                {"links", links},
                {"paths", paths},
                {"answer_bytes", bytes}};
  std::string stages;
  for (const char* stage : {"solve", "serialise", "parse and socket", "wait"}) {
    const double median_s = percentile(seconds[stage], 0.5);
    line.extra["stages_s"][stage] = median_s;
    stages += fmt::format(", {} {:.2g}", stage, median_s);
  }
  line.detail = fmt::format("p99 {:.3g} s; {} links, {} paths, {} bytes an answer{}", percentile(seconds["all"], 0.99),
                            links, paths, bytes, stages);
  if (recall.reference > 0) {
    line.error = recall.power > 0 ? 1 - recall.found_power / recall.power : 0;
    line.extra["path_recall"] = static_cast<double>(recall.found) / static_cast<double>(recall.reference);
    line.extra["reference_paths"] = recall.reference;
    line.detail += fmt::format("; {} of {} paths of cold frames of {} times the rays", recall.found, recall.reference,
                               options.reference_factor);
  } else {
    line.error = std::numeric_limits<double>::quiet_NaN();  // null in JSON
    line.detail += "; error not measured";
  }
  print(line, command);
}

}  // namespace
}  // namespace wavetracer::bench

int main(int argc, char** argv) {
  using namespace wavetracer;
  CLI::App app("Latency from pose to channel of wavetracer serve");
  bench::Options options;
  options.program = (bench::fs::absolute(argv[0]).parent_path() / "../host/app/wavetracer").lexically_normal().string();
  app.add_option("--program", options.program, "the program wavetracer");
  app.add_option("--device", options.device, "as for wavetracer serve");
  app.add_option("--vehicles", options.vehicles, "vehicles in the streets, a line each")->check(CLI::Range(1, 1000));
  app.add_option("--frames", options.frames, "frames of a drive")->check(CLI::Range(6, 100000));
  app.add_option("--step", options.step_s, "seconds from frame to frame")->check(CLI::Range(0.001, 10.0));
  app.add_option("--rays", options.rays, "rays per transmitter of cold frames")->check(CLI::Range(100, 1000000000));
  app.add_option("--refresh", options.refresh, "rays per transmitter of frames that reuse");
  app.add_option("--detail", options.detail, "links, paths or vertices")
      ->check(CLI::IsMember({"links", "paths", "vertices"}));
  app.add_option("--encoding", options.encoding, "json or cbor, of which only json has errors measured")
      ->check(CLI::IsMember({"json", "cbor"}));
  app.add_option("--compared", options.compared, "frames that errors are taken from")->check(CLI::Range(1, 1000));
  app.add_option("--reference-factor", options.reference_factor, "times the rays, of frames that errors refer to");
  app.add_flag("--no-reference", options.no_reference, "do not measure errors");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const uint32_t vehicles : options.vehicles) bench::run(options, vehicles, bench::command_line(argc, argv));
  } catch (const Error& error) {
    fmt::print(stderr, "bench_live: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
