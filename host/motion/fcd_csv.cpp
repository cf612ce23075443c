// SPDX-License-Identifier: Apache-2.0
// A row has the cells of its timestep, and those of one vehicle, person or container, or of a vehicle with a rider.
// Columns may be in any order. A row without ids is a timestep without vehicles.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "motion/fcd_samples.hpp"
#include "motion/input_text.hpp"
#include "motion/readers.hpp"
#include "motion/text_rows.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

constexpr std::string_view sumo_columns_advice =
    "the CSV of SUMO's --fcd-output has timestep_time, vehicle_id, vehicle_x and vehicle_y at least; "
    "if --fcd-output.attributes was given to sumo, it must name x and y";

std::string_view header_of(std::string_view text) {
  const size_t begin = std::min(text.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), text.size());
  return text.substr(begin, text.find_first_of("\r\n", begin) - begin);
}

char separator_of(std::string_view header) {
  const size_t at = header.find_first_of(";,\t|");
  return at == header.npos ? ';' : header[at];
}

class FcdCsvReader {
 public:
  FcdCsvReader(ByteStream& stream, const TrajectoryOptions& options)
      : rows_(stream, separator_of(header_of(stream.peek()))), samples_(stream.file(), options) {}

  Trajectories read() {
    rows_.next();  // there is a header, or this reader would not have been chosen
    read_header();
    while (rows_.next()) add_row();
    return samples_.finish();
  }

 private:
  struct Columns {
    const FcdKind* kind;
    size_t id = absent;
    std::map<std::string, size_t, std::less<>> others = {};  // by name of the attribute
  };
  static constexpr size_t absent = ~size_t{0};

  void read_header() {
    const std::vector<std::string>& names = rows_.cells();
    width_ = names.size();
    for (size_t i = 0; i < width_; ++i) {
      const auto set = [&](size_t& column) {
        if (column != absent) rows_.fail(fmt::format("the header has the column '{}' twice", names[i]));
        column = i;
      };
      if (names[i] == "timestep_time" || names[i] == "time") set(time_);
      for (Columns& of : columns_) {
        const std::string prefix = plain(names) ? "" : fmt::format("{}_", of.kind->name);
        if (!names[i].starts_with(prefix) || (prefix.empty() && of.kind != &fcd_vehicle)) continue;
        const std::string attribute = names[i].substr(prefix.size());
        set(attribute == "id" ? of.id : of.others.try_emplace(attribute, absent).first->second);
      }
    }
    const auto need = [&](bool there, const std::string& name) {
      if (!there) rows_.fail(fmt::format("the header has no column '{}'; {}", name, sumo_columns_advice));
    };
    need(time_ != absent, "timestep_time");
    need(std::ranges::any_of(columns_, [](const Columns& of) { return of.id != absent; }), "vehicle_id");
    for (const Columns& of : columns_)
      for (const char* axis : {"x", "y"})
        need(of.id == absent || of.others.contains(axis), fmt::format("{}_{}", of.kind->name, axis));
  }
  static bool plain(const std::vector<std::string>& names) { return std::ranges::find(names, "id") != names.end(); }

  const std::string& cell(size_t column) const {
    static const std::string none;
    return column == absent ? none : rows_.cells()[column];
  }

  void add_row() {
    if (rows_.cells().size() != width_)
      rows_.fail(fmt::format("the row has {} cells, the header {}", rows_.cells().size(), width_));
    if (const std::string& time = cell(time_); !samples_.started() || time != time_text_) {
      samples_.start(time, rows_.number());
      time_text_ = time;
      carrying_.clear();
    }
    const std::string& vehicle = cell(columns_[0].id);
    size_t riders = 0;
    for (const Columns& of : columns_) {
      const std::string& id = cell(of.id);
      if (id.empty()) continue;
      if (of.kind == &fcd_vehicle || vehicle.empty()) continue;
      samples_.add_rider();
      ++riders;
    }
    // The vehicle appears in one row for each of its riders.
    if (riders > 0 && !carrying_.insert(vehicle).second) return;
    for (const Columns& of : columns_)
      if (!cell(of.id).empty() && (riders == 0 || of.kind == &fcd_vehicle)) add(of);
  }

  void add(const Columns& of) {
    const std::string& id = cell(of.id);
    samples_.add(*of.kind, id, fmt::format("{} '{}'", of.kind->name, id), rows_.number(),
                 [&](std::string_view attribute) -> std::optional<std::string_view> {
                   const auto found = of.others.find(attribute);
                   if (found == of.others.end() || cell(found->second).empty()) return {};
                   return cell(found->second);
                 });
  }

  CsvRows rows_;
  FcdSamples samples_;
  size_t width_ = 0, time_ = absent;
  std::array<Columns, 3> columns_{Columns{&fcd_vehicle}, Columns{&fcd_person}, Columns{&fcd_container}};
  std::string time_text_;
  std::set<std::string> carrying_;  // vehicles of this timestep with riders
};

}  // namespace

bool is_fcd_csv(std::string_view text) {
  const std::string_view header = header_of(text);
  const char separator = separator_of(header);
  std::set<std::string, std::less<>> names;
  for (size_t begin = 0; begin <= header.size();) {
    const size_t end = std::min(header.find(separator, begin), header.size());
    std::string_view name = trimmed(header.substr(begin, end - begin));
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    names.emplace(name);
    begin = end + 1;
  }
  const auto has = [&](const char* name) { return names.contains(name); };
  if (has("timestep_time")) return true;
  // It is another output, which the message names.
  if (!has("id")) return has("vehicle_id") || has("person_id") || has("container_id");
  return separator == ';' && has("time") && has("x") && has("y") &&
         (has("angle") || has("lane") || has("slope") || has("edge"));
}

Trajectories read_fcd_csv(ByteStream& stream, const TrajectoryOptions& options) {
  return FcdCsvReader(stream, options).read();
}

}  // namespace wavetracer
