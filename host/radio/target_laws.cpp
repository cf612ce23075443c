// SPDX-License-Identifier: Apache-2.0
// Tables have degrees, devices radians. A range of zeniths that ends at 180 degrees contains it.
#include "radio/target_laws.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "radio/target_kinds.hpp"

namespace wavetracer {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::array<double, 4> everywhere{0, 180, 0, 360};

device::wt_target_lobe record_of(const KindLobe& lobe) {
  const auto& [zenith_from, zenith_to, azimuth_from, azimuth_to] = lobe.counts_deg;
  const double span_deg = azimuth_to - azimuth_from;
  return {.azimuth = lobe.azimuth_deg * degree,
          .azimuth_width = lobe.azimuth_width_deg * degree,
          .zenith = lobe.zenith_deg * degree,
          .zenith_width = lobe.zenith_width_deg * degree,
          .peak_db = lobe.peak_dbsm,
          .range_db = lobe.range_db,
          .zenith_from = zenith_from * degree,
          .zenith_to = zenith_to == 180 ? 2 * std::numbers::pi : zenith_to * degree,
          .azimuth_from = azimuth_from * degree,
          .azimuth_span = span_deg == 360 ? 4 * std::numbers::pi : span_deg * degree};
}

// The lobes of a point of a custom model.
std::vector<KindLobe> custom_lobes(const TargetModelConfig& model, size_t point) {
  std::vector<KindLobe> out;
  if (!model.rcs_dbsm.empty()) {
    const double peak = model.rcs_dbsm[model.rcs_dbsm.size() == 1 ? 0 : point];
    out.push_back({"", 0, 0, 0, 0, peak, std::numeric_limits<double>::infinity(), everywhere});
  }
  for (const auto& [of, azimuth, azimuth_width, zenith, zenith_width, peak, range] : model.lobes)
    if (static_cast<size_t>(of) == point)
      out.push_back({"", azimuth, azimuth_width, zenith, zenith_width, peak, range, everywhere});
  return out;
}

void add_law(TargetLaws& to, std::span<const KindLobe> lobes, const std::array<double, 3>& k, double xpr_db) {
  to.laws.push_back({.k = {k[0], k[1], k[2]},
                     .cross = std::pow(10, -xpr_db / 20),
                     .first_lobe = static_cast<uint32_t>(to.lobes.size()),
                     .lobe_count = static_cast<uint32_t>(lobes.size())});
  for (const KindLobe& lobe : lobes) to.lobes.push_back(record_of(lobe));
}

void add_body(TargetLaws& to, std::vector<TargetPiece> pieces) {
  TargetLaws::BodyLaws body{.pieces = std::move(pieces), .first_law = static_cast<uint32_t>(to.laws.size())};
  for (const TargetPiece& piece : body.pieces) {
    to.laws.push_back(
        {.k = {}, .cross = 0, .first_lobe = static_cast<uint32_t>(to.facets.size()), .lobe_count = WT_FACET_LAW});
    to.facets.push_back(piece.facet);
  }
  to.bodies.back().push_back(std::move(body));
}

// Adds the laws of the model's own points, which are no pieces of a body.
void add_points(TargetLaws& to, const TargetModelConfig& model, double xpr_db) {
  if (model.custom()) {
    for (size_t point = 0; point < points_of(model, {}).size(); ++point)
      add_law(to, custom_lobes(model, point), model.bistatic_db, xpr_db);
    return;
  }
  const KindLaw& law = kind_law(model.kind);
  if (!law.points) add_law(to, law.lobes, law.k, xpr_db);
  for (size_t i = 0; law.points && i < law.lobes.size(); ++i) add_law(to, law.lobes.subspan(i, 1), law.k, xpr_db);
}

}  // namespace

TargetLaws target_laws(const std::vector<TargetModelConfig>& models, const std::vector<TargetPartConfig>& parts,
                       std::span<const Scene> vehicles) {
  constexpr double none = std::numeric_limits<double>::infinity();
  TargetLaws out;
  for (const TargetModelConfig& model : models) {
    out.bodies.emplace_back();
    if (model.body())
      for (const Scene& vehicle : vehicles)
        add_body(out, pieces_of_body(vehicle, model.piece_m.value_or(0.25), model.name));
    out.first.push_back(static_cast<uint32_t>(out.laws.size()));
    const bool own = model.custom() || model.body();
    const double xpr_db = model.xpr_db.value_or(own ? none : kind_law(model.kind).xpr_db);
    if (!model.body()) add_points(out, model, xpr_db);
    for (const TargetPartConfig& part : parts)
      if (part.model == model.name)
        add_law(out, std::array{KindLobe{"", 0, 0, 0, 0, part.rcs_dbsm, none, everywhere}}, {}, xpr_db);
  }
  return out;
}

std::vector<glm::dvec3> points_of(const TargetModelConfig& model, const std::optional<glm::dvec3>& size_m) {
  std::vector<glm::dvec3> out;
  for (const std::array<double, 3>& p : model.points_m) out.emplace_back(p[0], p[1], p[2]);
  if (!out.empty()) return out;
  if (model.custom()) return {glm::dvec3(0)};
  if (model.body()) return {};
  glm::dvec3 size = size_m.value_or(kind_law(model.kind).size_m);
  if (model.size_m) size = {(*model.size_m)[0], (*model.size_m)[1], (*model.size_m)[2]};
  return kind_points(model.kind, size);
}

}  // namespace wavetracer
