// SPDX-License-Identifier: Apache-2.0
// Offsets and indices of the file are checked once, at opening or with the frame that uses them.
// Only one thread may use it: the child that reads answers one request at a time.
#include "results/saved_run.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include "base/input_file.hpp"
#include "output/foreign_file.hpp"
#include "output/summary_json.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using hdf5::ForeignFile;

std::vector<glm::dvec3> vectors(const std::vector<double>& values) {
  std::vector<glm::dvec3> out(values.size() / 3);
  for (size_t i = 0; i < out.size(); ++i) out[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  return out;
}

// Checks that rows [first[i], first[i + 1]) of a table of `rows` rows belong to i.
void check_offsets(const std::vector<uint64_t>& first, uint64_t rows, const std::string& what) {
  if (first.empty() || first.front() != 0 || first.back() != rows || !std::is_sorted(first.begin(), first.end()))
    throw RuntimeError(what + " does not go up from 0 to the number of rows that it counts");
}

// Returns where the rows of each frame begin in a table that is sorted by frame number.
std::vector<uint64_t> first_rows(const std::vector<uint32_t>& frame, const std::vector<uint32_t>& numbers,
                                 const std::string& what) {
  if (!std::is_sorted(frame.begin(), frame.end())) throw RuntimeError(what + " is not sorted");
  std::vector<uint64_t> first;
  for (const uint32_t number : numbers)
    first.push_back(std::lower_bound(frame.begin(), frame.end(), number) - frame.begin());
  first.push_back(frame.size());
  if (first.front() != 0) throw RuntimeError(what + " names frames that there are not");
  return first;
}

void check_below(const std::vector<uint32_t>& indices, size_t count, const std::string& what) {
  if (std::any_of(indices.begin(), indices.end(), [=](uint32_t i) { return i >= count; }))
    throw RuntimeError(what + " names a row that there is not");
}

fs::path paths_file(const fs::path& path) {
  std::error_code ignored;
  const bool folder = fs::is_directory(path, ignored);
  const fs::path file = folder ? path / "paths.h5" : path;
  if (!fs::exists(file, ignored))
    throw InputError(
        fmt::format("{}: {}; name the folder that `wavetracer run -o` has written to, or the paths.h5 in it{}",
                    path.string(), folder ? "holds no paths.h5" : "there is no such file", backslash_hint(path)));
  check_input_file(file, "the paths.h5 of a run");
  return file;
}

std::vector<RadioEnd> read_ends(const ForeignFile& file, const std::string& group) {
  const std::vector<std::string> names = file.strings(group + "/name");
  std::vector<RadioEnd> ends(names.size());
  const auto texts = [&](const char* name, const auto& assign) {
    const std::vector<std::string> values = file.strings(group + "/" + name);
    if (values.size() != ends.size()) throw RuntimeError(group + "/" + name + " is not as long as name");
    for (size_t i = 0; i < ends.size(); ++i) assign(ends[i], values[i]);
  };
  const auto triples = [&](const char* name, std::array<double, 3> RadioEnd::*field) {
    const std::vector<glm::dvec3> values = vectors(file.all_rows<double>(group + "/" + name, {3}));
    if (values.size() != ends.size()) throw RuntimeError(group + "/" + name + " is not as long as name");
    for (size_t i = 0; i < ends.size(); ++i) ends[i].*field = {values[i].x, values[i].y, values[i].z};
  };
  for (size_t i = 0; i < ends.size(); ++i) ends[i].name = names[i];
  texts("antenna", [](RadioEnd& end, const std::string& text) { end.antenna = text; });
  texts("polarization", [&](RadioEnd& end, const std::string& text) {
    const std::optional<Polarization> known = Polarization::parse(text);
    if (!known)
      throw RuntimeError(fmt::format("{}/polarization has \"{}\", which this version does not know", group, text));
    end.polarization = *known;
  });
  triples("position_m", &RadioEnd::position_m);
  triples("orientation_deg", &RadioEnd::orientation_deg);
  triples("velocity_m_s", &RadioEnd::velocity_m_s);
  return ends;
}

}  // namespace

struct SavedRun::State {
  fs::path path;
  ForeignFile file;
  std::string version, config;
  SummaryFacts summary;
  double frequency_hz = 0;
  std::vector<RadioEnd> transmitters, receivers;
  std::vector<SavedInstance> instances;
  std::vector<InputFile> inputs;
  uint32_t rx_ports = 1, tx_ports = 1;
  std::vector<uint32_t> numbers;
  std::vector<double> times_s;
  std::vector<uint64_t> first_path, first_pose, first_link;

  explicit State(const fs::path& where) : path(where), file(where) {
    read_root();
    read_world();
    read_inputs();
    read_index();
  }

  void read_root() {
    if (file.root_text("format") != "wavetracer paths") throw RuntimeError("its format is not \"wavetracer paths\"");
    version = file.root_text("version");
    if (const double format = file.root_number("format_version"); format != 1)
      throw RuntimeError(fmt::format(
          "it has version {} of the format, written by wavetracer {}; this program reads version 1", format, version));
    summary = read_summary_json(path.parent_path() / "summary.json");
    config = file.root_text("config");
    frequency_hz = file.root_number("frequency_hz");
    if (!(frequency_hz > 0) || !std::isfinite(frequency_hz)) throw RuntimeError("its frequency is not above zero");
  }

  void read_world() {
    transmitters = read_ends(file, "/transmitters");
    receivers = read_ends(file, "/receivers");
    const auto ids = file.strings("/instances/id"), types = file.strings("/instances/type"),
               models = file.strings("/instances/model");
    if (types.size() != ids.size() || models.size() != ids.size())
      throw RuntimeError("/instances has columns of unequal length");
    for (size_t i = 0; i < ids.size(); ++i) instances.push_back({ids[i], types[i], models[i]});
  }

  void read_inputs() {
    if (!file.has("/inputs")) return;
    const auto names = file.strings("/inputs/name"), files = file.strings("/inputs/file");
    const auto bytes = file.all_rows<uint64_t>("/inputs/bytes"), hashes = file.all_rows<uint64_t>("/inputs/hash");
    if (files.size() != names.size() || bytes.size() != names.size() || hashes.size() != names.size())
      throw RuntimeError("/inputs has columns of unequal length");
    for (size_t i = 0; i < names.size(); ++i) inputs.push_back({names[i], files[i], bytes[i], hashes[i]});
  }

  void read_index() {
    numbers = file.all_rows<uint32_t>("/frames/frame");
    times_s = file.all_rows<double>("/frames/time_s");
    first_path = file.all_rows<uint64_t>("/frames/path_offset");
    if (numbers.empty() || times_s.size() != numbers.size() || first_path.size() != numbers.size() + 1)
      throw RuntimeError("/frames has no rows, or columns of unequal length");
    if (std::adjacent_find(numbers.begin(), numbers.end(), std::greater_equal<>()) != numbers.end())
      throw RuntimeError("/frames/frame does not go up");
    check_offsets(first_path, file.shape("/paths/delay_s")[0], "/frames/path_offset");
    first_pose = first_rows(file.all_rows<uint32_t>("/poses/frame"), numbers, "/poses/frame");
    first_link = first_rows(file.all_rows<uint32_t>("/links/frame"), numbers, "/links/frame");
    const std::vector<uint64_t> a = file.shape("/paths/a_re", {0, 0});
    const auto ports = [&](size_t axis) {
      if (a[axis] < 1 || a[axis] > 2) throw RuntimeError("/paths/a_re has no port, or more than two");
      return static_cast<uint32_t>(a[axis]);
    };
    rx_ports = ports(1);
    tx_ports = ports(2);
  }

  SavedFrame read_frame(size_t row) const;
  void read_columns(size_t row, Paths& paths) const;
  void read_coefficients(size_t row, Paths& paths) const;
  void read_groups(size_t row, Paths& paths) const;
  void read_lifetimes(size_t row, Paths& paths) const;
  void read_vertices(size_t row, Paths& paths) const;
  void read_poses(size_t row, SavedFrame& frame) const;
  void read_motion(size_t row, SavedFrame& frame) const;
  void read_links(size_t row, SavedFrame& frame) const;
};

void SavedRun::State::read_columns(size_t row, Paths& paths) const {
  const uint64_t first = first_path[row], count = first_path[row + 1] - first;
  const auto numbers_of = [&](const char* name) {
    return file.rows<uint32_t>(std::string("/paths/") + name, first, count);
  };
  const auto values_of = [&](const char* name) {
    return file.rows<double>(std::string("/paths/") + name, first, count);
  };
  paths.frame = numbers_of("frame");
  paths.tx = numbers_of("tx");
  paths.rx = numbers_of("rx");
  paths.depth = numbers_of("depth");
  paths.delay_s = values_of("delay_s");
  paths.gain_db = values_of("gain_db");
  paths.aod_theta_rad = values_of("aod_theta_rad");
  paths.aod_phi_rad = values_of("aod_phi_rad");
  paths.aoa_theta_rad = values_of("aoa_theta_rad");
  paths.aoa_phi_rad = values_of("aoa_phi_rad");
  paths.doppler_hz = values_of("doppler_hz");
  check_below(paths.tx, transmitters.size(), "/paths/tx");
  check_below(paths.rx, receivers.size(), "/paths/rx");
}

void SavedRun::State::read_coefficients(size_t row, Paths& paths) const {
  const uint64_t first = first_path[row], count = first_path[row + 1] - first;
  const size_t ports = size_t{rx_ports} * tx_ports;
  const std::vector<double> re = file.rows<double>("/paths/a_re", first, count, {rx_ports, tx_ports}),
                            im = file.rows<double>("/paths/a_im", first, count, {rx_ports, tx_ports});
  paths.rx_ports = rx_ports;
  paths.tx_ports = tx_ports;
  paths.a.resize(count);
  for (size_t i = 0; i < count; ++i)
    for (size_t k = 0; k < ports; ++k) paths.a[i][k] = {re[i * ports + k], im[i * ports + k]};
}

// Only files of output.lifetimes have them.
void SavedRun::State::read_lifetimes(size_t row, Paths& paths) const {
  if (file.has("/paths/lifetime_m"))
    paths.lifetime_m = file.rows<double>("/paths/lifetime_m", first_path[row], first_path[row + 1] - first_path[row]);
}

// Files of versions without groups have none.
void SavedRun::State::read_groups(size_t row, Paths& paths) const {
  if (!file.has("/paths/group")) return;
  const uint64_t first = first_path[row], count = first_path[row + 1] - first;
  const auto groups = file.rows<uint32_t>("/paths/group", first, count, {most_groups});
  const auto weights = file.rows<double>("/paths/group_weight", first, count, {most_groups});
  paths.group.resize(count);
  paths.group_weight.resize(count);
  for (size_t i = 0; i < groups.size(); ++i) {
    if (groups[i] != no_group && groups[i] >= count * most_groups)
      throw RuntimeError("/paths/group has a number that is larger than there are groups");
    paths.group[i / most_groups][i % most_groups] = groups[i];
    paths.group_weight[i / most_groups][i % most_groups] = weights[i];
  }
}

void SavedRun::State::read_vertices(size_t row, Paths& paths) const {
  const uint64_t first = first_path[row], count = first_path[row + 1] - first;
  paths.vertex_offset = file.rows<uint64_t>("/paths/vertex_offset", first, count + 1);
  const uint64_t base = paths.vertex_offset.front(), end = paths.vertex_offset.back();
  if (end < base) throw RuntimeError("/paths/vertex_offset goes down");
  const uint64_t vertices = end - base;
  for (uint64_t& offset : paths.vertex_offset) offset -= base;
  check_offsets(paths.vertex_offset, vertices, "/paths/vertex_offset");
  for (size_t i = 0; i < count; ++i)
    if (paths.depth[i] != paths.vertex_offset[i + 1] - paths.vertex_offset[i])
      throw RuntimeError("/paths/depth is not the number of vertices of the path");
  paths.vertex_position_m = vectors(file.rows<double>("/vertices/position_m", base, vertices, {3}));
  paths.vertex_interaction = file.rows<uint8_t>("/vertices/interaction", base, vertices);
  paths.vertex_surface = file.rows<uint32_t>("/vertices/surface", base, vertices);
  paths.vertex_instance = file.rows<uint32_t>("/vertices/instance", base, vertices);
  for (const uint32_t instance : paths.vertex_instance)
    if (instance != no_instance && instance >= instances.size())
      throw RuntimeError("/vertices/instance names a row that there is not");
}

void SavedRun::State::read_poses(size_t row, SavedFrame& frame) const {
  const uint64_t first = first_pose[row], count = first_pose[row + 1] - first;
  const std::vector<uint32_t> instance = file.rows<uint32_t>("/poses/instance", first, count);
  check_below(instance, instances.size(), "/poses/instance");
  const std::vector<glm::dvec3> position = vectors(file.rows<double>("/poses/position_m", first, count, {3})),
                                velocity = vectors(file.rows<double>("/poses/velocity_m_s", first, count, {3}));
  const std::vector<double> rotation = file.rows<double>("/poses/rotation", first, count, {3, 3});
  for (size_t i = 0; i < count; ++i) {
    SavedPose pose{instance[i], position[i], velocity[i]};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) pose.rotation[c][r] = rotation[9 * i + 3 * r + c];  // glm stores matrices by column
    frame.poses.push_back(pose);
  }
}

void SavedRun::State::read_motion(size_t row, SavedFrame& frame) const {
  const auto of = [&](const std::string& name, size_t ends) {
    return vectors(file.rows<double>("/frames/" + name, row, 1, {ends, 3}));
  };
  frame.transmitter_position_m = of("transmitter_position_m", transmitters.size());
  frame.transmitter_velocity_m_s = of("transmitter_velocity_m_s", transmitters.size());
  frame.receiver_position_m = of("receiver_position_m", receivers.size());
  frame.receiver_velocity_m_s = of("receiver_velocity_m_s", receivers.size());
}

void SavedRun::State::read_links(size_t row, SavedFrame& frame) const {
  const uint64_t first = first_link[row], count = first_link[row + 1] - first;
  const std::vector<uint32_t> tx = file.rows<uint32_t>("/links/tx", first, count),
                              rx = file.rows<uint32_t>("/links/rx", first, count);
  check_below(tx, transmitters.size(), "/links/tx");
  check_below(rx, receivers.size(), "/links/rx");
  for (size_t i = 0; i < count; ++i) frame.links.push_back({tx[i], rx[i]});
}

SavedFrame SavedRun::State::read_frame(size_t row) const {
  SavedFrame out;
  out.number = numbers.at(row);
  out.time_s = times_s.at(row);
  read_columns(row, out.paths);
  read_coefficients(row, out.paths);
  read_groups(row, out.paths);
  read_lifetimes(row, out.paths);
  if (file.has("/paths/target"))
    out.paths.target = file.rows<uint32_t>("/paths/target", first_path[row], first_path[row + 1] - first_path[row]);
  read_vertices(row, out.paths);
  read_poses(row, out);
  read_motion(row, out);
  read_links(row, out);
  return out;
}

namespace {

bool begins_as_hdf5(const fs::path& file) {
  constexpr std::string_view signature = "\x89HDF";
  std::string begin(signature.size(), '\0');
  std::ifstream(file, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == signature;
}

}  // namespace

SavedRun::SavedRun(const fs::path& path) {
  const fs::path file = paths_file(path);
  try {
    state_ = std::make_unique<State>(file);
  } catch (const RuntimeError& e) {
    if (!begins_as_hdf5(file))
      throw InputError(fmt::format("{}: this is no paths.h5 of a run, which would be a file of HDF5{}", file.string(),
                                   file.extension() == ".toml"
                                       ? "; a configuration is run first: `wavetracer run -c " + file.string() + "`"
                                       : "; name the folder that `wavetracer run -o` has written to"));
    throw InputError(fmt::format("{}: cannot be read as the paths.h5 of a run: {}", file.string(), e.what()));
  }
}

SavedRun::~SavedRun() = default;
SavedRun::SavedRun(SavedRun&&) noexcept = default;
SavedRun& SavedRun::operator=(SavedRun&&) noexcept = default;

const fs::path& SavedRun::file() const { return state_->path; }
const std::string& SavedRun::version() const { return state_->version; }
const std::string& SavedRun::device() const { return state_->summary.device; }
const std::optional<Missed>& SavedRun::missed() const { return state_->summary.missed; }
const std::string& SavedRun::missed_unknown() const { return state_->summary.missed_unknown; }
const std::optional<CertificateFacts>& SavedRun::certificate() const { return state_->summary.certificate; }
const std::string& SavedRun::config_text() const { return state_->config; }
double SavedRun::frequency_hz() const { return state_->frequency_hz; }
const std::vector<RadioEnd>& SavedRun::transmitters() const { return state_->transmitters; }
const std::vector<RadioEnd>& SavedRun::receivers() const { return state_->receivers; }
const std::vector<SavedInstance>& SavedRun::instances() const { return state_->instances; }
const std::vector<InputFile>& SavedRun::inputs() const { return state_->inputs; }
uint32_t SavedRun::rx_ports() const { return state_->rx_ports; }
uint32_t SavedRun::tx_ports() const { return state_->tx_ports; }
size_t SavedRun::frame_count() const { return state_->numbers.size(); }
uint32_t SavedRun::number(size_t row) const { return state_->numbers.at(row); }
double SavedRun::time_s(size_t row) const { return state_->times_s.at(row); }
uint64_t SavedRun::path_count() const { return state_->first_path.back(); }
uint64_t SavedRun::path_count(size_t row) const { return state_->first_path.at(row + 1) - state_->first_path.at(row); }

uint64_t SavedRun::link_count() const { return state_->first_link.back(); }
uint64_t SavedRun::first_link(size_t row) const { return state_->first_link.at(row); }

SavedFrame SavedRun::frame(size_t row) const {
  try {
    return state_->read_frame(row);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: frame {}: {}", state_->path.string(), number(row), e.what()));
  }
}

}  // namespace wavetracer
