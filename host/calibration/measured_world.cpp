// SPDX-License-Identifier: Apache-2.0
// Rows of paths are sorted by links, as links are.
#include "calibration/measured_world.hpp"
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>
#include "calibration/delay_profile.hpp"
#include "calibration/spreads.hpp"
#include "radio/grouped_power.hpp"
#include "radio/material_table.hpp"
#include "radio/path_power.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::calibration {
namespace {

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

// Returns the first row of each link, and the number of rows.
std::vector<size_t> first_rows(const Paths& paths, const std::vector<Link>& links) {
  std::vector<size_t> out(links.size() + 1, paths.size());
  for (size_t row = paths.size(), link = links.size(); link-- > 0; out[link] = row)
    while (row > 0 && Link{paths.tx[row - 1], paths.rx[row - 1]} >= links[link]) --row;
  return out;
}

bool equal_records(const device::wt_material& a, const device::wt_material& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

bool equal_inputs(const Inputs& a, const Inputs& b) {
  return a.ends == b.ends && std::ranges::equal(a.materials, b.materials, equal_records);
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

// All frames are at one time, so that none but a cold one launches rays.
Config lasting(Config config, bool moves) {
  if (!moves) return config;
  config.trace.reuse = true;
  config.trace.discover_every_s = 1;
  return config;
}

}  // namespace

MeasuredWorld::MeasuredWorld(const Config& config, const std::vector<MeasuredFile>& files, const std::string& device,
                             bool moves, FrameObserver watch, const WorldCheck& check)
    : places_(measured_places(config, files)),
      setup_(make_setup(lasting(places_.config, moves), device, moves,
                        [&check](const RunPlan& plan) {
                          if (check) check(named_records(plan), end_places(plan.world.transmitters.ends));
                        })),
      frames_(setup_),
      ends_(end_places(setup_.plan->world.transmitters.ends)),
      frame_((setup_.frame_watch->set(std::move(watch)), frame_at(ends_))),
      materials_(named_records(*setup_.plan)),
      of_frame_{materials_.records, ends_} {
  for (const Link& link : places_.links)
    if (!std::ranges::binary_search(frame_.world.links, link))
      throw ConfigError(fmt::format("{}: [links] leaves out the link from {} to the place of {}", config.file,
                                    std::as_const(places_.config.transmitters)[link.tx].name,
                                    std::as_const(places_.config.receivers)[link.rx].name));
}

std::vector<glm::dvec3> MeasuredWorld::places() const {
  std::vector<glm::dvec3> out;
  for (const Link& link : places_.links)
    out.push_back(std::as_const(frame_.world.receivers)[link.rx].position_m + setup_.plan->scene.origin_m);
  return out;
}

std::vector<std::string> MeasuredWorld::transmitters() const {
  std::vector<std::string> out;
  for (const Link& link : places_.links) out.push_back(std::as_const(places_.config.transmitters)[link.tx].name);
  return out;
}

WorldState MeasuredWorld::state_at(const EndPlaces& ends) const {
  WorldState out = setup_.plan->world.state(0);
  place_ends(ends, setup_.plan->scene.origin_m, out);
  return out;
}

FrameResult MeasuredWorld::frame_at(const EndPlaces& ends) {
  return frames_.run(FrameTask::of_drive({.frame = 0,
                                          .pose = [&] { return state_at(ends); },
                                          .names = FrameNames::of(setup_.plan->asked),
                                          .timed = false}));
}

void MeasuredWorld::solve(const Inputs& inputs, bool find_anew) {
  if (find_anew) frames_.forget();
  setup_.finish.set_materials(inputs.materials);
  frame_ = frame_at(inputs.ends);
  of_frame_ = inputs;
  found_here_ = find_anew;
  weighed_ = false;
  ++frames_solved_;
}

std::vector<std::array<std::complex<double>, 4>> MeasuredWorld::fields(const RowChoice& rows, const Inputs& inputs) {
  setup_.finish.set_materials(inputs.materials);
  setup_.finish.turn_ends(state_at(inputs.ends));
  return setup_.finish.again(rows).a;
}

double MeasuredWorld::power_of_rows(const Paths& paths, size_t first, size_t end) const {
  return grouped_power(paths, first, end, setup_.plan->asked.radio.frequency_hz);
}

// Power in the sense of path_gain_db, spreads of delays and azimuths, and the profile of the rows of a link.
Computed MeasuredWorld::of_link(const Paths& paths, size_t first, size_t end, double rest) const {
  const double power = power_of_rows(paths, first, end) + rest;
  Spreads spreads(first < end ? paths.delay_s[first] : 0);
  std::vector<DelayPower> components;
  for (size_t row = first; row < end; ++row) {
    const double of_path = power_of(paths, row);
    spreads.add(of_path, paths.delay_s[row], paths.aoa_phi_rad[row]);
    if (profile_bins_ > 0) components.push_back({paths.delay_s[row], of_path});
  }
  return {10 * std::log10(power), spreads.delay_ns(), spreads.azimuth_deg(),
          delay_profile(components, profile_bin_s_, profile_bins_)};
}

std::vector<Computed> MeasuredWorld::computed(const Paths& paths, const std::vector<double>& rest) const {
  const std::vector<Link>& all = frame_.world.links;
  const std::vector<size_t> first = first_rows(paths, all);
  std::vector<Computed> of_links(all.size()), out;
  tbb::parallel_for(size_t{0}, all.size(), [&](size_t i) {
    of_links[i] = of_link(paths, first[i], first[i + 1], rest.empty() ? 0 : rest[i]);
  });
  for (const Link& link : places_.links)
    out.push_back(of_links[static_cast<size_t>(std::ranges::lower_bound(all, link) - all.begin())]);
  return out;
}

std::vector<Computed> MeasuredWorld::weigh(const Inputs& inputs, double share_left_out) {
  share_left_out_ = share_left_out;
  if (!inputs.ends.same_points(of_frame_.ends) || !found_here_) {
    solve(inputs, true);
  } else if (!equal_inputs(inputs, of_frame_)) {
    std::vector<uint32_t> all(frame_.paths.size());
    std::iota(all.begin(), all.end(), 0u);
    frame_.paths.a = fields(setup_.finish.choose(all), inputs);
    of_frame_ = inputs;
  }
  keep_strong();
  return computed(frame_.paths, {});
}

void MeasuredWorld::keep_strong() {
  const Paths& paths = frame_.paths;
  const std::vector<Link>& links = frame_.world.links;
  const std::vector<size_t> first = first_rows(paths, links);
  kept_.clear();
  for (size_t link = 0; link < links.size(); ++link) {
    std::vector<std::pair<double, uint32_t>> weakest;  // power and row
    double power = 0;
    for (size_t row = first[link]; row < first[link + 1]; ++row) {
      weakest.emplace_back(power_of(paths, row), static_cast<uint32_t>(row));
      power += weakest.back().first;
    }
    std::ranges::sort(weakest);
    double left_out = 0;
    for (const auto& [of_path, row] : weakest)
      if ((left_out += of_path) > share_left_out_ * power) kept_.push_back(row);
  }
  std::ranges::sort(kept_);
  strong_rows_ = setup_.finish.choose(kept_);
  strong_ = chosen_paths(paths, kept_);
  const std::vector<size_t> first_strong = first_rows(strong_, links);
  rest_.clear();
  for (size_t i = 0; i < links.size(); ++i)
    rest_.push_back(std::max(0.0, power_of_rows(paths, first[i], first[i + 1]) -
                                      power_of_rows(strong_, first_strong[i], first_strong[i + 1])));
  base_ = of_frame_;
  dependents_.clear();
  weighed_ = true;
}

// Paths that depend on a material are found by changing all its properties.
const MeasuredWorld::Dependent& MeasuredWorld::dependent(size_t material) {
  const auto found = dependents_.find(material);
  if (found != dependents_.end()) return found->second;
  Inputs inputs = base_;
  std::vector<device::wt_material>& changed = inputs.materials;
  changed[material].permittivity[0] = 1 + 1.5 * (changed[material].permittivity[0] - 1);
  changed[material].permittivity[1] = 1.5 * changed[material].permittivity[1] - 0.01;
  changed[material].thickness_m *= 1.1;
  changed[material].scattering = 0.5 * changed[material].scattering + 0.1;
  const auto now = fields(strong_rows_, inputs);
  Dependent out;
  std::vector<uint32_t> rows;
  for (uint32_t i = 0; i < kept_.size(); ++i)
    if (now[i] != strong_.a[i]) {
      out.places.push_back(i);
      rows.push_back(kept_[i]);
    }
  out.rows = setup_.finish.choose(rows);
  return dependents_.emplace(material, std::move(out)).first->second;
}

// If a single material differs from those of the last evaluation of all strong paths, only the paths that depend on it
// are evaluated: so derivatives take little. Places come first, since nothing is known of paths elsewhere.
std::vector<Computed> MeasuredWorld::values(const Inputs& inputs) {
  if (!inputs.ends.same_points(of_frame_.ends)) {
    solve(inputs, false);
    return computed(frame_.paths, {});
  }
  if (!weighed_) keep_strong();
  std::vector<size_t> changed;
  for (size_t i = 0; i < inputs.materials.size(); ++i)
    if (!equal_records(inputs.materials[i], base_.materials[i])) changed.push_back(i);
  const bool turned = inputs.ends != base_.ends;
  if (changed.size() > 1 || turned) {
    strong_.a = fields(strong_rows_, inputs);
    base_ = inputs;
  }
  if (changed.size() != 1 || turned) return computed(strong_, rest_);
  const Dependent& on = dependent(changed[0]);
  auto now = fields(on.rows, inputs);
  const auto exchange = [&] {
    for (size_t i = 0; i < on.places.size(); ++i) std::swap(strong_.a[on.places[i]], now[i]);
  };
  exchange();
  std::vector<Computed> out = computed(strong_, rest_);
  exchange();
  return out;
}

}  // namespace wavetracer::calibration
