// Groups of a link are told by a hash of their steps in 64 bits: of 10,000 groups two have one hash once in 10^11
// links.
#include "radio/path_groups.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <unordered_set>

#include "radio/constants.hpp"
#include "radio/path_power.hpp"
#include "radio/world_records.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t nothing_yet = 0x9E3779B97F4A7C15u;

uint64_t mixed(uint64_t hash, uint64_t value) {  // the finisher of SplitMix64
  hash = (hash ^ value) + nothing_yet;
  hash = (hash ^ (hash >> 30)) * 0xBF58476D1CE4E5B9u;
  hash = (hash ^ (hash >> 27)) * 0x94D049BB133111EBu;
  return hash ^ (hash >> 31);
}

uint64_t step_of(Interaction kind, uint32_t number) { return uint64_t{kind} << 32 | number; }

// The parts of a vertex in the keys of its path.
struct StepChoice {
  uint64_t step;  // 0: none
  double share;
};

bool is_diffracted(const Paths& paths, size_t row) {
  for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k)
    if (paths.vertex_interaction[k] == diffraction) return true;
  return false;
}

// A path, leg by leg.
class Legs {
 public:
  // measured: is the length asked for?
  Legs(const Paths& paths, size_t row, const WorldState& state, const glm::dvec3& origin_m, bool measured)
      : paths_(paths),
        first_(paths.vertex_offset[row]),
        count_(paths.vertex_offset[row + 1] - first_),
        from_(state.transmitters[paths.tx[row]].position_m + origin_m),
        to_(state.receivers[paths.rx[row]].position_m + origin_m) {
    for (size_t k = 0; measured && k <= count_; ++k) length_m += glm::length(leg(k));
  }
  // To vertex k, or to the receiver.
  glm::dvec3 leg(size_t k) const { return point(k + 1) - point(k); }

  double length_m = 0;  // of all

 private:
  const Paths& paths_;
  uint64_t first_, count_;
  glm::dvec3 from_, to_;

  // 0: the transmitter.
  glm::dvec3 point(size_t i) const {
    return i == 0 ? from_ : i > count_ ? to_ : paths_.vertex_position_m[first_ + i - 1];
  }
};

std::vector<uint32_t> planes_of_surfaces(const Scene& scene, std::span<const Scene> models,
                                         std::span<const Instance> instances, std::span<const wt_wedge> wedges) {
  size_t count = scene.surfaces.size();
  for (const Instance& instance : instances) count += models[instance.model].surfaces.size();
  std::vector<uint32_t> planes(count);
  for (uint32_t surface = 0; surface < count; ++surface) planes[surface] = surface;
  for (const wt_wedge& wedge : wedges)
    for (int face = 0; face < 2; ++face) planes[wedge.surfaces[face]] = wedge.planes[face];
  return planes;
}

}  // namespace

PathGrouping::PathGrouping(const Scene& scene, std::span<const Scene> models, std::span<const Instance> instances,
                           double frequency_hz)
    : origin_m_(scene.origin_m),
      wavelength_m_(speed_of_light_m_s / frequency_hz),
      wedges_(wedge_records(scene, models, instances)),
      planes_of_(planes_of_surfaces(scene, models, instances, wedges_)) {
  for (const Instance& instance : instances) {
    first_surface_.push_back(instance.first_surface);
    first_wedge_.push_back(instance.first_wedge);
  }
}

wt_wedge PathGrouping::placed(uint32_t wedge, const WorldState& state) const {
  wt_wedge out = wedges_[wedge];
  place_wedge(out, state);
  return out;
}

// The waves that the path belongs to, with the largest weights and their squares adding up to 1. next: room. Returns
// whether the path is diffracted.
bool PathGrouping::keys_of(const Paths& paths, size_t row, const WorldState& state, Keys& keys, Keys& next) const {
  constexpr size_t kept = 4 * most_groups;  // on the way
  const bool bends = is_diffracted(paths, row);
  const Legs legs(paths, row, state, origin_m_, bends);
  keys.assign(1, {nothing_yet, 1});
  double since_m = 0;
  for (uint64_t k = paths.vertex_offset[row], at = 0; k < paths.vertex_offset[row + 1]; ++k, ++at) {
    const auto kind = static_cast<Interaction>(paths.vertex_interaction[k]);
    const uint32_t instance = paths.vertex_instance[k], local = paths.vertex_surface[k];
    const bool moves = instance != no_instance;
    if (bends) since_m += glm::length(legs.leg(at));
    if (kind == scattering) {
      keys.assign(1, {mixed(row, step_of(kind, local)), 1});
      return bends;
    }
    if (kind == transmission) continue;
    if (kind == reflection) {
      const uint32_t plane = planes_of_[local + (moves ? first_surface_[instance] : 0)];
      for (Key& key : keys) key.hash = mixed(key.hash, step_of(kind, plane));
      continue;
    }
    const uint32_t number = local + (moves ? first_wedge_[instance] : 0);
    const wt_wedge wedge = placed(number, state);
    const EdgeShares shares = edge_shares(wedge, glm::normalize(legs.leg(at)), glm::normalize(legs.leg(at + 1)),
                                          since_m, legs.length_m - since_m, wavelength_m_);
    const StepChoice choices[in_places] = {{step_of(kind, number), shares[0]},
                                           {0, shares[1]},
                                           {step_of(reflection, wedge.planes[0]), shares[2]},
                                           {step_of(reflection, wedge.planes[1]), shares[3]}};
    next.clear();
    for (const StepChoice& choice : choices)
      for (const Key& key : keys)
        if (choice.share > 0)
          next.push_back({choice.step == 0 ? key.hash : mixed(key.hash, choice.step), key.weight * choice.share});
    if (next.size() > kept) {
      std::ranges::stable_sort(next, std::ranges::greater(), &Key::weight);
      next.resize(kept);
    }
    keys.swap(next);
  }
  if (keys.size() > 1) keep_largest(keys);
  return bends;
}

// One of each hash: what leads to one wave in two ways is joined.
void PathGrouping::keep_largest(Keys& keys) {
  for (size_t i = 0; i < keys.size(); ++i)
    for (size_t j = keys.size() - 1; j > i; --j)
      if (keys[j].hash == keys[i].hash) {
        keys[i].weight = std::sqrt(keys[i].weight * keys[i].weight + keys[j].weight * keys[j].weight);
        keys.erase(keys.begin() + static_cast<ptrdiff_t>(j));
      }
  std::ranges::stable_sort(keys, std::ranges::greater(), &Key::weight);
  if (keys.size() > most_groups) keys.resize(most_groups);
  double sum = 0;
  for (const Key& key : keys) sum += key.weight * key.weight;
  for (Key& key : keys) key.weight /= std::sqrt(sum);
}

// Rows first to end - 1 are of one link. keys: of each row.
void PathGrouping::number_link(Paths& paths, size_t first, size_t end, const std::vector<RowKeys>& keys) {
  std::unordered_map<uint64_t, uint32_t> numbers;
  numbers.reserve(2 * (end - first));
  std::unordered_set<uint64_t> taken;  // by geometrical waves
  for (size_t row = first; row < end; ++row) {
    RowKeys own = keys[row];
    if (!own.bends && !taken.insert(own.keys[0].hash).second) own.keys[0].hash = mixed(own.keys[0].hash, row);
    for (size_t i = 0; i < own.count; ++i) {
      const auto at = numbers.try_emplace(own.keys[i].hash, static_cast<uint32_t>(numbers.size())).first;
      paths.group[row][i] = at->second;
      paths.group_weight[row][i] = own.keys[i].weight;
    }
  }
}

void PathGrouping::operator()(Paths& paths, const WorldState& state) const {
  paths.group.assign(paths.size(), only_group(no_group));
  paths.group_weight.assign(paths.size(), GroupWeights{});
  std::vector<RowKeys> keys(paths.size());
  tbb::parallel_for(tbb::blocked_range<size_t>(0, paths.size(), 64), [&](const tbb::blocked_range<size_t>& rows) {
    Keys found, next;
    for (size_t row = rows.begin(); row < rows.end(); ++row) {
      keys[row].bends = keys_of(paths, row, state, found, next);
      keys[row].count = found.size();
      std::ranges::copy(found, keys[row].keys.begin());
    }
  });
  std::vector<size_t> first;
  for (size_t row = 0; row < paths.size(); row = end_of_link(paths, row)) first.push_back(row);
  tbb::parallel_for(size_t{0}, first.size(), [&](size_t link) {
    number_link(paths, first[link], link + 1 < first.size() ? first[link + 1] : paths.size(), keys);
  });
}

}  // namespace wavetracer
