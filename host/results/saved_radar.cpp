// SPDX-License-Identifier: Apache-2.0
// Axes are read and checked at opening, maps when they are asked for.
#include "results/saved_radar.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include "base/input_file.hpp"
#include "base/spelling.hpp"
#include "output/foreign_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {

namespace {

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> out;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

}  // namespace

struct SavedRadar::State {
  std::filesystem::path path;
  hdf5::ForeignFile file;
  std::string name, group;
  uint32_t tx = 0, rx = 0;
  std::vector<uint64_t> rows;  // those of the link
  std::vector<uint32_t> frames;
  std::vector<double> times_s, ranges_m, speeds_m_s;

  State(const std::filesystem::path& where, const RadarChoice& choice) : path(where), file(where) {
    if (file.root_text("format") != "wavetracer radar") throw RuntimeError("its format is not \"wavetracer radar\"");
    if (const double version = file.root_number("format_version"); version != 2)
      throw RuntimeError(
          fmt::format("it has version {} of the format, and this program reads 2: make it again, by "
                      "`python3 -m wavetracer.radar` or by a run with [[radar]]",
                      version));
    choose_radar(choice.radar);
    ranges_m = axis("/range_m");
    speeds_m_s = axis("/speed_m_s");
    choose_link(choice);
  }

  void choose_radar(const std::string& asked) {
    const std::vector<std::string> names = split_at_commas(file.root_text("radars"));
    name = asked.empty() ? names.front() : asked;
    if (std::ranges::find(names, name) == names.end())
      throw ConfigError(fmt::format("{} has no radar \"{}\", only {}{}", path.string(), name, fmt::join(names, ", "),
                                    spelling_hint(name, names)));
    group = "/" + name;
  }

  void choose_link(const RadarChoice& choice) {
    const auto numbers = file.all_rows<uint32_t>(group + "/frames/frame"),
               senders = file.all_rows<uint32_t>(group + "/frames/tx"),
               hearers = file.all_rows<uint32_t>(group + "/frames/rx");
    const auto times = file.all_rows<double>(group + "/frames/time_s");
    if (senders.size() != numbers.size() || hearers.size() != numbers.size() || times.size() != numbers.size())
      throw RuntimeError(group + "/frames has columns of unequal length");
    if (file.shape(group + "/maps/power_dbm", {speeds_m_s.size(), ranges_m.size()})[0] != numbers.size())
      throw RuntimeError(group + "/maps/power_dbm has another number of rows than " + group + "/frames");
    for (uint64_t i = 0; i < numbers.size(); ++i) {
      if (rows.empty()) {
        if ((choice.tx && senders[i] != *choice.tx) || (choice.rx && hearers[i] != *choice.rx)) continue;
        tx = senders[i];
        rx = hearers[i];
      }
      if (senders[i] != tx || hearers[i] != rx) continue;
      rows.push_back(i);
      frames.push_back(numbers[i]);
      times_s.push_back(times[i]);
    }
    if (rows.empty() && !numbers.empty() && (choice.tx || choice.rx))
      throw ConfigError(fmt::format("radar \"{}\" has no link of the ends that --tx and --rx name", name));
    if (rows.empty() || std::ranges::adjacent_find(frames, std::greater_equal()) != frames.end())
      throw RuntimeError(group + "/frames/frame is empty or does not ascend");
  }

  std::vector<double> axis(const std::string& of) const {
    std::vector<double> out = file.all_rows<double>(group + of);
    if (out.size() < 2 || std::ranges::adjacent_find(out, std::greater_equal()) != out.end() ||
        !std::isfinite(out[0]) || !std::isfinite(out.back()))
      throw RuntimeError(fmt::format("{}{} has not two numbers or more that ascend", group, of));
    return out;
  }

  RadarMap map(size_t row) const {
    return {speeds_m_s, ranges_m,
            file.rows<double>(group + "/maps/power_dbm", rows.at(row), 1, {speeds_m_s.size(), ranges_m.size()})};
  }

  // Files of Python may have several spectra of a frame; others have one for each row of frames.
  std::optional<RadarMap> spectra() const {
    if (!file.has(group + "/spectrogram")) return std::nullopt;
    // Shifts and speeds are in proportion; the axes of the cube have both.
    const std::vector<double> shifts = axis("/spectrogram_doppler_hz"), own = axis("/doppler_hz");
    if (own.size() != speeds_m_s.size()) throw RuntimeError(group + "/doppler_hz and speed_m_s differ in length");
    const double speed = speeds_m_s.front() / own.front();
    if (!std::isfinite(speed)) throw RuntimeError(group + "/doppler_hz begins with 0");
    const std::string power = group + "/spectrogram/power_dbm";
    const auto times = file.all_rows<double>(group + "/spectrogram/time_s");
    const uint64_t all = file.shape(group + "/frames/frame")[0];
    if (file.shape(power, {0})[0] != times.size())
      throw RuntimeError(group + "/spectrogram has columns of unequal length");
    RadarMap out{times, shifts, {}};
    for (double& shift : out.columns) shift *= speed;
    if (rows.size() == all || times.size() != all) {
      out.power_dbm = file.rows<double>(power, 0, times.size(), {shifts.size()});
      return out;
    }
    out.rows = times_s;
    for (const uint64_t row : rows) {
      const std::vector<double> one = file.rows<double>(power, row, 1, {shifts.size()});
      out.power_dbm.insert(out.power_dbm.end(), one.begin(), one.end());
    }
    return out;
  }
};

SavedRadar::SavedRadar(const std::filesystem::path& file, const RadarChoice& choice) {
  check_input_file(file, "the radar.h5 of a run");
  try {
    state_ = std::make_unique<State>(file, choice);
  } catch (const RuntimeError& e) {
    throw InputError(fmt::format("{}: cannot be read as the radar.h5 of a run: {}", file.string(), e.what()));
  }
}

SavedRadar::~SavedRadar() = default;
SavedRadar::SavedRadar(SavedRadar&&) noexcept = default;

const std::string& SavedRadar::name() const { return state_->name; }
uint32_t SavedRadar::tx() const { return state_->tx; }
uint32_t SavedRadar::rx() const { return state_->rx; }
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

std::optional<SavedRadar> saved_radar(const SavedRun& run, const RadarChoice& choice) {
  std::error_code ignored;
  const std::filesystem::path file = run.file().parent_path() / "radar.h5";
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  SavedRadar out(file, choice);
  if (out.tx() >= run.transmitters().size() || out.rx() >= run.receivers().size())
    throw InputError(fmt::format("{}: it has other transmitters or receivers than {} beside it", file.string(),
                                 run.file().filename().string()));
  return out;
}

}  // namespace wavetracer
