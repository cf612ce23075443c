// SPDX-License-Identifier: Apache-2.0
// Axes are read and checked at opening, maps when they are asked for.
#include "results/saved_radar.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include "base/input_file.hpp"
#include "output/foreign_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

struct SavedRadar::State {
  std::filesystem::path path;
  hdf5::ForeignFile file;
  std::vector<uint32_t> frames;
  std::vector<double> times_s, ranges_m, speeds_m_s;

  explicit State(const std::filesystem::path& where) : path(where), file(where) {
    if (file.root_text("format") != "wavetracer radar") throw RuntimeError("its format is not \"wavetracer radar\"");
    if (const double version = file.root_number("format_version"); version != 1)
      throw RuntimeError(fmt::format("it has version {} of the format; this program reads 1", version));
    frames = file.all_rows<uint32_t>("/frames/frame");
    if (frames.empty() || std::ranges::adjacent_find(frames, std::greater_equal()) != frames.end())
      throw RuntimeError("/frames/frame is empty or does not ascend");
    times_s = file.all_rows<double>("/frames/time_s");
    if (times_s.size() != frames.size()) throw RuntimeError("/frames has columns of unequal length");
    ranges_m = axis("/range_m");
    speeds_m_s = axis("/speed_m_s");
    if (file.shape("/power_dbm", {speeds_m_s.size(), ranges_m.size()})[0] != frames.size())
      throw RuntimeError("/power_dbm has another number of frames than /frames");
  }

  std::vector<double> axis(const std::string& name) const {
    std::vector<double> out = file.all_rows<double>(name);
    if (out.size() < 2 || std::ranges::adjacent_find(out, std::greater_equal()) != out.end() ||
        !std::isfinite(out[0]) || !std::isfinite(out.back()))
      throw RuntimeError(fmt::format("{} has not two numbers or more that ascend", name));
    return out;
  }

  RadarMap map(size_t row) const {
    return {speeds_m_s, ranges_m, file.rows<double>("/power_dbm", row, 1, {speeds_m_s.size(), ranges_m.size()})};
  }

  std::optional<RadarMap> spectra() const {
    if (!file.has("spectrogram")) return std::nullopt;
    // Shifts and speeds are in proportion; the axes of the cube have both.
    const std::vector<double> shifts = axis("/spectrogram/doppler_hz"), own = axis("/doppler_hz");
    if (own.size() != speeds_m_s.size()) throw RuntimeError("/doppler_hz and /speed_m_s differ in length");
    const double speed = speeds_m_s.front() / own.front();
    if (!std::isfinite(speed)) throw RuntimeError("/doppler_hz begins with 0");
    RadarMap out{axis_of_times(), shifts, {}};
    for (double& shift : out.columns) shift *= speed;
    out.power_dbm = file.rows<double>("/spectrogram/power_dbm", 0, out.rows.size(), {shifts.size()});
    return out;
  }

  std::vector<double> axis_of_times() const {
    const std::vector<double> times = file.all_rows<double>("/spectrogram/time_s");
    if (file.shape("/spectrogram/power_dbm", {0})[0] != times.size())
      throw RuntimeError("/spectrogram has columns of unequal length");
    return times;
  }
};

SavedRadar::SavedRadar(const std::filesystem::path& file) {
  check_input_file(file, "the radar.h5 of a run");
  try {
    state_ = std::make_unique<State>(file);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: cannot be read as the radar.h5 of a run: {}", file.string(), e.what()));
  }
}

SavedRadar::~SavedRadar() = default;
SavedRadar::SavedRadar(SavedRadar&&) noexcept = default;

const std::vector<uint32_t>& SavedRadar::frames() const { return state_->frames; }
const std::vector<double>& SavedRadar::times_s() const { return state_->times_s; }

RadarMap SavedRadar::range_doppler(size_t row) const {
  try {
    return state_->map(row);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: {}", state_->path.string(), e.what()));
  }
}

std::optional<RadarMap> SavedRadar::spectrogram() const {
  try {
    return state_->spectra();
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: {}", state_->path.string(), e.what()));
  }
}

std::optional<SavedRadar> saved_radar(const SavedRun& run) {
  std::error_code ignored;
  const std::filesystem::path file = run.file().parent_path() / "radar.h5";
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  return SavedRadar(file);
}

}  // namespace wavetracer
