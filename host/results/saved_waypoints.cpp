// SPDX-License-Identifier: Apache-2.0
// Columns are read by frame; the frames of rows are checked and kept at opening.
// Only one thread may use it, as for SavedRun.
#include "results/saved_waypoints.hpp"
#include <fmt/format.h>
#include <algorithm>
#include "base/input_file.hpp"
#include "output/foreign_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;

// Reads the numbers of a column as an enum.
template <class Enum>
std::vector<Enum> known(const std::vector<uint8_t>& numbers, Enum last, const std::string& column) {
  std::vector<Enum> out;
  out.reserve(numbers.size());
  for (const uint8_t number : numbers) {
    if (number > static_cast<uint8_t>(last))
      throw RuntimeError(fmt::format("{} has the number {}, which stands for nothing", column, number));
    out.push_back(static_cast<Enum>(number));
  }
  return out;
}

}  // namespace

struct SavedWaypoints::State {
  fs::path path;
  hdf5::ForeignFile file;
  double format = 0;
  std::vector<uint32_t> frames;  // frame of each row

  explicit State(const fs::path& where) : path(where), file(where) {
    if (file.root_text("format") != "wavetracer waypoints")
      throw RuntimeError("its format is not \"wavetracer waypoints\"");
    format = file.root_number("format_version");
    if (format != 1 && format != 2)
      throw RuntimeError(fmt::format("it has version {} of the format; this program reads 1 and 2", format));
    frames = file.all_rows<uint32_t>("/waypoints/frame");
    if (!std::ranges::is_sorted(frames)) throw RuntimeError("/waypoints/frame is not sorted");
    for (const char* column : {"tx", "sample", "depth", "kind", "surface", "instance"}) check_length(column);
    if (format >= 2) check_length("source");
    if (file.shape("/waypoints/position_m", {3})[0] != frames.size())
      throw RuntimeError("/waypoints has columns of unequal length");
  }

  void check_length(const char* column) const {
    if (file.shape(std::string("/waypoints/") + column)[0] != frames.size())
      throw RuntimeError("/waypoints has columns of unequal length");
  }

  WaypointRows read(uint32_t number) const {
    const auto [begin, end] = std::ranges::equal_range(frames, number);
    const auto first = static_cast<uint64_t>(begin - frames.begin()), count = static_cast<uint64_t>(end - begin);
    const auto words = [&](const char* name) {
      return file.rows<uint32_t>(std::string("/waypoints/") + name, first, count);
    };
    WaypointRows out;
    out.frame.assign(count, number);
    out.tx = words("tx");
    out.sample = file.rows<uint64_t>("/waypoints/sample", first, count);
    out.depth = words("depth");
    out.kind = known(file.rows<uint8_t>("/waypoints/kind", first, count), WaypointKind::miss, "/waypoints/kind");
    out.surface = words("surface");
    out.instance = words("instance");
    if (format >= 2)
      out.source =
          known(file.rows<uint8_t>("/waypoints/source", first, count), WaypointSource::unknown, "/waypoints/source");
    else
      out.source.assign(count, WaypointSource::unknown);
    const std::vector<double> positions = file.rows<double>("/waypoints/position_m", first, count, {3});
    for (size_t i = 0; i < count; ++i)
      out.position_m.emplace_back(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    return out;
  }
};

SavedWaypoints::SavedWaypoints(const fs::path& file) {
  check_input_file(file, "the waypoints.h5 of a run");
  try {
    state_ = std::make_unique<State>(file);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: cannot be read as the waypoints.h5 of a run: {}", file.string(), e.what()));
  }
}

SavedWaypoints::~SavedWaypoints() = default;
SavedWaypoints::SavedWaypoints(SavedWaypoints&&) noexcept = default;

const fs::path& SavedWaypoints::file() const { return state_->path; }
uint64_t SavedWaypoints::count() const { return state_->frames.size(); }

uint64_t SavedWaypoints::count(uint32_t number) const {
  return std::ranges::equal_range(state_->frames, number).size();
}

WaypointRows SavedWaypoints::frame(uint32_t number) const {
  try {
    return state_->read(number);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: frame {}: {}", state_->path.string(), number, e.what()));
  }
}

std::optional<SavedWaypoints> saved_waypoints(const SavedRun& run) {
  std::error_code ignored;
  const fs::path file = run.file().parent_path() / "waypoints.h5";
  if (!fs::exists(file, ignored)) return std::nullopt;
  return SavedWaypoints(file);
}

}  // namespace wavetracer
