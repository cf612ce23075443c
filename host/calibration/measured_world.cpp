// SPDX-License-Identifier: Apache-2.0
#include "calibration/measured_world.hpp"
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <ranges>
#include <utility>
#include "calibration/fitted_config.hpp"
#include "calibration/measured_ends.hpp"
#include "calibration/spreads.hpp"
#include "radio/grouped_power.hpp"
#include "radio/material_table.hpp"
#include "radio/path_power.hpp"
#include "wavetracer/config_file.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

Config with_places(const std::string& file, const std::vector<std::string>& sets,
                   const std::vector<MeasuredFile>& files, std::vector<Link>& links) {
  Config config = config_of_places(file, sets);
  links = place_receivers(config, file, files);
  config.text = echoed_config(config);
  return config;
}

template <class Value>
std::vector<Value> chosen_values(const std::vector<Value>& values, const std::vector<uint32_t>& rows) {
  std::vector<Value> out;
  if (values.empty()) return out;
  for (const uint32_t row : rows) out.push_back(values[row]);
  return out;
}

// Returns these rows without their vertices.
Paths chosen_paths(const Paths& paths, const std::vector<uint32_t>& rows) {
  Paths out;
  out.rx_ports = paths.rx_ports;
  out.tx_ports = paths.tx_ports;
  const auto choose = [&](auto column) { out.*column = chosen_values(paths.*column, rows); };
  for (const auto column : {&Paths::frame, &Paths::tx, &Paths::rx, &Paths::depth}) choose(column);
  for (const auto column : {&Paths::delay_s, &Paths::gain_db, &Paths::aoa_phi_rad, &Paths::doppler_hz}) choose(column);
  choose(&Paths::a);
  choose(&Paths::group);
  choose(&Paths::group_weight);
  out.vertex_offset.assign(rows.size() + 1, 0);
  return out;
}

NamedRecords named_records(const RunPlan& plan) {
  const double frequency_hz = plan.asked.radio.frequency_hz;
  MaterialTable table =
      make_material_table(plan.scene, plan.world.fleet.models, plan.world.fleet.instances, frequency_hz);
  NamedRecords out{std::move(table.names), std::move(table.materials), {}, frequency_hz, plan.asked.trace.scattering};
  out.in_walls.resize(out.records.size());
  for (const device::wt_material& record : out.records)
    for (uint32_t i = 0; i < (record.layers & WT_LAYER_COUNT); ++i)
      out.in_walls[(record.layers >> WT_LAYER_SHIFT) + i] = true;
  return out;
}

}  // namespace

MeasuredWorld::MeasuredWorld(const std::string& config_file, const std::vector<std::string>& sets,
                             const std::vector<MeasuredFile>& files, const std::string& device)
    : config_(with_places(config_file, sets, files, links_)),
      setup_(make_setup(config_, device)),
      frames_(setup_),
      frame_(frames_.run(FrameTask::of_drive({.frame = 0,
                                              .pose = [this] { return setup_.plan->world.state(0); },
                                              .names = FrameNames::of(setup_.plan->asked),
                                              .timed = false}))),
      materials_(named_records(*setup_.plan)) {
  for (size_t i = 0; i < links_.size(); ++i)
    if (!std::ranges::binary_search(frame_.world.links, links_[i]))
      throw ConfigError(fmt::format("{}: [links] leaves out the link from {} to the place of {}", config_file,
                                    std::as_const(config_.transmitters)[links_[i].tx].name,
                                    std::as_const(config_.receivers)[links_[i].rx].name));
}

std::vector<glm::dvec3> MeasuredWorld::places() const {
  std::vector<glm::dvec3> out;
  for (const Link& link : links_)
    out.push_back(std::as_const(frame_.world.receivers)[link.rx].position_m + setup_.plan->scene.origin_m);
  return out;
}

std::vector<std::string> MeasuredWorld::transmitters() const {
  std::vector<std::string> out;
  for (const Link& link : links_) out.push_back(config_.transmitters[link.tx].name);
  return out;
}

std::vector<std::array<std::complex<double>, 4>> MeasuredWorld::fields(
    const RowChoice& rows, const std::vector<device::wt_material>& materials) {
  setup_.finish.set_materials(materials);
  return frames_.fields_again(rows, frame_).a;
}

// Power in the sense of path_gain_db, and spreads of delays and azimuths, of the rows of a link.
Computed MeasuredWorld::of_link(const Paths& paths, size_t first, size_t end, double rest) const {
  const double power = grouped_power(paths, first, end, setup_.plan->asked.radio.frequency_hz) + rest;
  Spreads spreads(first < end ? paths.delay_s[first] : 0);
  for (size_t row = first; row < end; ++row)
    spreads.add(power_of(paths, row), paths.delay_s[row], paths.aoa_phi_rad[row]);
  return {10 * std::log10(power), spreads.delay_ns(), spreads.azimuth_deg()};
}

// Links are sorted as rows are.
std::vector<Computed> MeasuredWorld::computed(const Paths& paths, const std::vector<double>& rest) const {
  const std::vector<Link>& all = frame_.world.links;
  std::vector<size_t> first(all.size() + 1, paths.size());
  for (size_t row = paths.size(), link = all.size(); link-- > 0; first[link] = row)
    while (row > 0 && Link{paths.tx[row - 1], paths.rx[row - 1]} >= all[link]) --row;
  std::vector<Computed> of_links(all.size()), out;
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    of_links[i] = of_link(paths, first[i], first[i + 1], rest.empty() ? 0 : rest[i]);
  });
  for (const Link& link : links_)
    out.push_back(of_links[static_cast<size_t>(std::ranges::lower_bound(all, link) - all.begin())]);
  return out;
}

std::vector<Computed> MeasuredWorld::weigh(const std::vector<device::wt_material>& materials, double share_left_out) {
  std::vector<uint32_t> all(frame_.paths.size());
  std::iota(all.begin(), all.end(), 0u);
  frame_.paths.a = fields(frames_.choose_rows(all), materials);
  keep_strong(share_left_out);
  base_ = materials;
  dependents_.clear();
  return computed(frame_.paths, {});
}

void MeasuredWorld::keep_strong(double share_left_out) {
  const Paths& paths = frame_.paths;
  kept_.clear();
  for (size_t first = 0; first < paths.size();) {
    const size_t end = end_of_link(paths, first);
    std::vector<std::pair<double, uint32_t>> weakest;  // power and row
    double power = 0;
    for (size_t row = first; row < end; ++row) {
      weakest.emplace_back(power_of(paths, row), static_cast<uint32_t>(row));
      power += weakest.back().first;
    }
    std::ranges::sort(weakest);
    double left_out = 0;
    for (const auto& [of_path, row] : weakest)
      if ((left_out += of_path) > share_left_out * power) kept_.push_back(row);
    first = end;
  }
  std::ranges::sort(kept_);
  strong_rows_ = frames_.choose_rows(kept_);
  strong_ = chosen_paths(paths, kept_);
  rest_.assign(frame_.world.links.size(), 0);
  for (size_t i = 0; i < rest_.size(); ++i) {
    const auto range = [&](const Paths& of) {
      const auto [begin, end] =
          std::ranges::equal_range(std::views::iota(size_t{0}, of.size()), frame_.world.links[i], {}, [&](size_t row) {
            return Link{of.tx[row], of.rx[row]};
          });
      return grouped_power(of, *begin, *end, setup_.plan->asked.radio.frequency_hz);
    };
    rest_[i] = std::max(0.0, range(paths) - range(strong_));
  }
}

// Paths that depend on a material are found by changing all its properties.
const MeasuredWorld::Dependent& MeasuredWorld::dependent(size_t material) {
  const auto found = dependents_.find(material);
  if (found != dependents_.end()) return found->second;
  std::vector<device::wt_material> changed = base_;
  changed[material].permittivity[0] = 1 + 1.5 * (changed[material].permittivity[0] - 1);
  changed[material].permittivity[1] = 1.5 * changed[material].permittivity[1] - 0.01;
  changed[material].thickness_m *= 1.1;
  changed[material].scattering = 0.5 * changed[material].scattering + 0.1;
  const auto now = fields(strong_rows_, changed);
  Dependent out;
  std::vector<uint32_t> rows;
  for (uint32_t i = 0; i < kept_.size(); ++i)
    if (now[i] != strong_.a[i]) {
      out.places.push_back(i);
      rows.push_back(kept_[i]);
    }
  out.rows = frames_.choose_rows(rows);
  return dependents_.emplace(material, std::move(out)).first->second;
}

// If a single material differs from those of the last evaluation of all strong paths, only the paths that depend on it
// are evaluated: so derivatives take little.
std::vector<Computed> MeasuredWorld::values(const std::vector<device::wt_material>& materials) {
  std::vector<size_t> changed;
  for (size_t i = 0; i < materials.size(); ++i)
    if (std::memcmp(&materials[i], &base_[i], sizeof materials[i]) != 0) changed.push_back(i);
  if (changed.size() > 1) {
    strong_.a = fields(strong_rows_, materials);
    base_ = materials;
  }
  if (changed.size() != 1) return computed(strong_, rest_);
  const Dependent& on = dependent(changed[0]);
  auto now = fields(on.rows, materials);
  const auto exchange = [&] {
    for (size_t i = 0; i < on.places.size(); ++i) std::swap(strong_.a[on.places[i]], now[i]);
  };
  exchange();
  std::vector<Computed> out = computed(strong_, rest_);
  exchange();
  return out;
}

}  // namespace wavetracer::calibration
