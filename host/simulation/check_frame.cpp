// SPDX-License-Identifier: Apache-2.0
// Sequences and points are compared with constants, since only additions, products, quotients and roots compute them.
// Fields are compared with the host's: their tables may depend on the library of the machine.
#include "simulation/check_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "base/digits.hpp"
#include "base/hash.hpp"
#include "radio/fields.hpp"
#include "radio/links.hpp"
#include "simulation/visible_paths.hpp"
#include "simulation/world_targets.hpp"

namespace wavetracer {
namespace {

uint64_t hash_of(const std::vector<uint64_t>& words) {
  return mix64({reinterpret_cast<const char*>(words.data()), words.size() * sizeof(uint64_t)});
}

using FieldBits = std::vector<uint64_t>;

// All values that fields computes for a row.
FieldBits bits_of(const Paths& paths, size_t row) {
  FieldBits out{paths.depth[row]};
  const auto add = [&](double value) { out.push_back(std::bit_cast<uint64_t>(value)); };
  for (const auto* column : {&paths.delay_s, &paths.gain_db, &paths.doppler_hz, &paths.aod_theta_rad,
                             &paths.aod_phi_rad, &paths.aoa_theta_rad, &paths.aoa_phi_rad})
    add((*column)[row]);
  for (const std::complex<double>& a : paths.a[row]) {
    add(a.real());
    add(a.imag());
  }
  for (size_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k) {
    out.insert(out.end(), {paths.vertex_surface[k], paths.vertex_instance[k], paths.vertex_interaction[k]});
    for (int axis = 0; axis < 3; ++axis) add(paths.vertex_position_m[k][axis]);
  }
  return out;
}

std::set<std::tuple<uint32_t, uint32_t, FieldBits>> rows_with_bits(const Paths& paths) {
  std::set<std::tuple<uint32_t, uint32_t, FieldBits>> out;
  for (size_t row = 0; row < paths.size(); ++row) out.emplace(paths.tx[row], paths.rx[row], bits_of(paths, row));
  return out;
}

// Sums of the device and of the host follow other orders.
bool same_sum(double a, double b) {
  return std::isfinite(b) ? std::abs(a - b) <= 1e-6 * std::max(1.0, std::abs(b))
                          : (std::isnan(b) ? std::isnan(a) : a == b);
}

// Has a link the figures of all of its paths?
bool same_figures(const LinkFigures& a, const LinkFigures& b) {
  return a.paths == b.paths && same_sum(a.path_gain_db, b.path_gain_db) &&
         same_sum(a.sum_of_powers_db, b.sum_of_powers_db) && same_sum(1e9 * a.mean_delay_s, 1e9 * b.mean_delay_s) &&
         same_sum(1e9 * a.rms_delay_spread_s, 1e9 * b.rms_delay_spread_s) &&
         same_sum(a.doppler_spread_hz, b.doppler_spread_hz);
}

// Does a link lack no more than `most_db` of the power of all of its paths?
bool lacks_little(const LinkFigures& all, const LinkFigures& some, double most_db) {
  const double lacking_db = all.sum_of_powers_db - some.sum_of_powers_db;
  return some.paths < all.paths && lacking_db > -1e-6 && lacking_db < most_db + 1e-6;
}

}  // namespace

KnownFrame known_of(const Paths& paths) {
  std::vector<uint64_t> sequences, points;
  for (size_t row = 0; row < paths.size(); ++row) {
    sequences.insert(sequences.end(), {paths.tx[row], paths.rx[row], paths.depth[row]});
    for (size_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k) {
      sequences.insert(sequences.end(),
                       {paths.vertex_interaction[k], paths.vertex_surface[k], paths.vertex_instance[k]});
      for (int axis = 0; axis < 3; ++axis) points.push_back(std::bit_cast<uint64_t>(paths.vertex_position_m[k][axis]));
    }
  }
  return {static_cast<uint32_t>(paths.size()), hash_of(sequences), hash_of(points)};
}

CheckResult check_sequences(Setup& setup, const FrameResult& frame) {
  const std::vector<uint64_t> table = setup.discovery->sequences().table().read();
  constexpr uint64_t empty = WT_EMPTY;
  std::set<uint64_t> known;
  size_t used = 0, loose = 0;
  for (const uint64_t word : table) {
    if (word == empty) continue;
    ++used;
    known.insert(word);
    const auto parent = static_cast<uint32_t>(word >> 32);
    if (!(parent & WT_ROOT) && (parent >= table.size() || table[parent] == empty)) ++loose;
  }
  if (used > 0 && known.size() == used && loose == 0 && frame.counts.sequences == used)
    return {"sequences", true, fmt::format("{} sequences are in the set, each once", grouped(used))};
  return {"sequences", false,
          fmt::format("of {} sequences in the set {} stand there twice and {} follow none; {} were counted",
                      grouped(used), grouped(used - known.size()), grouped(loose), grouped(frame.counts.sequences))};
}

CheckResult check_paths(const FrameResult& frame, const CheckedFeatures& features) {
  const KnownFrame found = known_of(frame.paths), right = known_frames[features.frame()];
  if (found == right) return {"paths", true, fmt::format("{} paths are the known ones", found.paths)};
  std::string words = fmt::format("{} paths instead of {}", found.paths, right.paths);
  if (found.paths == right.paths)
    words = found.sequences == right.sequences
                ? fmt::format("{} paths meet the right surfaces at wrong points", found.paths)
                : fmt::format("some of {} paths meet the wrong surfaces", found.paths);
  return {"paths", false, words};
}

CheckResult check_fields(Setup& setup, const FrameResult& frame) {
  const FieldModel host(setup.plan->scene, setup.plan->computed(), setup.plan->world.fleet.models,
                        setup.plan->world.fleet.instances);
  Paths computed = host.compute(frame.frame, read_visible(setup), frame.world);
  name_targets(computed, setup.plan->world.targets);
  const auto expected = rows_with_bits(computed);
  const auto found = rows_with_bits(frame.paths);
  const auto wrong =
      static_cast<size_t>(std::ranges::count_if(found, [&](const auto& row) { return !expected.contains(row); }));
  if (wrong == 0 && !found.empty())
    return {"fields", true, fmt::format("the fields of {} paths are the host's to the last bit", found.size())};
  return {"fields", false, fmt::format("of {} paths {} have other fields than on the host", found.size(), wrong)};
}

CheckResult check_cached(const FrameResult& first, const FrameResult& again) {
  const bool same = known_of(first.paths) == known_of(again.paths);
  // With cache.locking = "mutex" no ray waits for a lock: a device with many rays at once is nearly always refused.
  if (same && again.cache.hits + again.cache.conflicts > 0)
    return {"ray cache", true,
            fmt::format("{} of {} look-ups were answered, {} refused by locks, and the paths are the same",
                        grouped(again.cache.hits), grouped(again.cache.lookups), grouped(again.cache.conflicts))};
  if (!same)
    return {"ray cache", false,
            fmt::format("a frame whose rays the cache answers has other paths: {} instead of {}, or others",
                        again.paths.size(), first.paths.size())};
  return {"ray cache", false, fmt::format("none of {} look-ups was answered", grouped(again.cache.lookups))};
}

CheckResult check_reused(const FrameResult& first, const FrameResult& again) {
  if (known_of(first.paths) == known_of(again.paths))
    return {"reuse", true, "the next frame has the same paths from the sequences of the first"};
  return {"reuse", false,
          fmt::format("a frame that reuses the sequences of another one has other paths: {} instead of {}, or others",
                      again.paths.size(), first.paths.size())};
}

CheckResult check_sums_of_links(const FrameResult& frame, const FrameResult& summed, double frequency_hz) {
  const std::vector<LinkFigures> right = link_figures(frame.paths, frame.frame, frame.world.links, frequency_hz);
  const std::vector<LinkFigures> found = summed.summed ? summed.summed->links : std::vector<LinkFigures>{};
  const double most_db = 10 * std::log10(1 + summed.left_out_at_edges);
  size_t wrong = 0;
  for (size_t i = 0; i < std::min(right.size(), found.size()); ++i) {
    const LinkFigures &a = right[i], &b = found[i];
    const bool same_link = a.tx == b.tx && a.rx == b.rx && a.los == b.los;
    wrong += !(same_link && (same_figures(a, b) || lacks_little(a, b, most_db)));
  }
  if (right.size() == found.size() && wrong == 0 && !right.empty())
    return {"links", true, fmt::format("the sums of {} links are those of their paths", right.size())};
  return {"links", false,
          fmt::format("of {} links {} have other sums than their paths, and {} have none", right.size(), wrong,
                      right.size() - std::min(right.size(), found.size()))};
}

}  // namespace wavetracer
