// SPDX-License-Identifier: Apache-2.0
// target_bounces: every chain with every link, from both ends, beside images in parallelograms; lit sides, points that
// are absent, ends that ride with the body, and a floor.
#include "passes/target_bounces.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <map>
#include <optional>
#include <tuple>

#include "passes/on_device.hpp"
#include "reference/quads.hpp"

using namespace wavetracer;
using namespace wavetracer::test;
using glm::dvec3;
using reference::Quad;

namespace {

// Four plates that look at each other in part. Surface 3 is lit from above alone.
const std::vector<Quad> plates{{{0, 0, 0}, {1.3, 0.1, 0}, {0, 0, 1.1}},
                               {{0, 0, 0}, {0, 0, 1.2}, {0.1, 1.4, 0}},
                               {{0.1, 0.1, -0.2}, {0, 1.2, 0.1}, {1.1, 0, 0.2}},
                               {{1.6, 1.7, 0.2}, {-0.9, 0.2, 0.1}, {0, 0.1, 0.8}}};

struct Bounced {
  std::vector<dvec3> points;  // on the mirrors, from the end on
  dvec3 image;
};

double above(const Quad& quad, const dvec3& p) {
  return glm::dot(glm::normalize(glm::cross(quad.u, quad.v)), p - quad.corner);
}

// The reflections on the way from an end to a place, if they are inside of their plates and go on on the side that they
// come from.
std::optional<Bounced> bounced(const dvec3& end, const std::vector<uint32_t>& mirrors, const dvec3& place) {
  std::vector<dvec3> images{end};
  for (const uint32_t m : mirrors) {
    const dvec3 normal = glm::normalize(glm::cross(plates[m].u, plates[m].v));
    images.push_back(images.back() - 2 * above(plates[m], images.back()) * normal);
  }
  Bounced out{std::vector<dvec3>(mirrors.size()), images.back()};
  dvec3 to = place;
  for (size_t k = mirrors.size(); k-- > 0;) {
    const Quad& quad = plates[mirrors[k]];
    const dvec3 along = to - images[k + 1];
    const dvec3 at = glm::inverse(glm::dmat3(quad.u, quad.v, -along)) * (images[k + 1] - quad.corner);
    if (at.x < 0 || at.x > 1 || at.y < 0 || at.y > 1 || !(at.z > 0 && at.z < 1)) return {};
    out.points[k] = quad.corner + at.x * quad.u + at.y * quad.v;
    to = out.points[k];
  }
  for (size_t k = 0; k < mirrors.size(); ++k) {
    const double from = above(plates[mirrors[k]], k > 0 ? out.points[k - 1] : end);
    const double on = above(plates[mirrors[k]], k + 1 < mirrors.size() ? out.points[k + 1] : place);
    if (from * on <= 0) return {};
  }
  return out;
}

struct Pieces {
  WorldState world;
  std::vector<wt_target_bounce> bounces;
};

// Nine pieces of each plate on vehicle 2, and all chains of other plates. Piece 4 is absent.
Pieces pieces_of_plates() {
  Pieces out;
  for (uint32_t surface = 0; surface < plates.size(); ++surface)
    for (int i = 0; i < 9; ++i) {
      const Quad& quad = plates[surface];
      out.world.targets.push_back(
          {.position_m = quad.corner + (i % 3 + 0.47) / 3 * quad.u + (i / 3 + 0.52) / 3 * quad.v,
           .instance = 2,
           .present = out.world.targets.size() != 4,
           .surface = surface,
           .lit_above = true,
           .lit_below = surface != 3});
      const auto point = static_cast<uint32_t>(out.world.targets.size() - 1);
      for (uint32_t last = 0; last < plates.size(); ++last) {
        if (last == surface) continue;
        out.bounces.push_back({point, 1, {last, last}});
        for (uint32_t first = 0; first < plates.size(); ++first)
          if (first != last) out.bounces.push_back({point, 2, {first, last}});
      }
    }
  return out;
}

uint32_t side_of(const TargetState& piece, const dvec3& from) {
  const double height = above(plates[piece.surface], from);
  return height > 0 ? (piece.lit_above ? 1 : 0) : (piece.lit_below ? 2 : 0);
}

using BouncedRow = std::tuple<uint32_t, uint32_t, std::vector<uint32_t>>;  // ends and steps

using BouncedRows = std::map<BouncedRow, std::vector<dvec3>>;

BouncedRows bounced_rows_of(const SolvedList& list) {
  const auto headers = list.headers.read(0, list.count);
  const auto steps = list.sequences.read(0, 4 * size_t{list.count});
  const auto xyz = list.vertices.read(0, 3 * steps.size());
  BouncedRows found;
  for (size_t i = 0; i < headers.size(); ++i) {
    CHECK((headers[i].blocked == 0 && headers[i].node == WT_NONE && headers[i].quarters == WT_ALL_QUARTERS));
    BouncedRow row{headers[i].transmitter, headers[i].receiver, {}};
    std::vector<dvec3> points;
    for (size_t k = 4 * i; k < 4 * i + headers[i].depth; ++k) {
      std::get<2>(row).push_back(steps[k]);
      points.emplace_back(xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]);
    }
    CHECK(found.emplace(row, points).second);
  }
  return found;
}

// The rows by bounced(); transmitter 2 rides with the body. weak: counts those below the floor.
BouncedRows wanted_rows(const Pieces& pieces, const std::vector<dvec3>& from, const std::vector<dvec3>& to,
                        const std::vector<Link>& links, double floor, uint64_t& weak) {
  BouncedRows wanted;
  for (const Link& link : links)
    for (const wt_target_bounce& chain : pieces.bounces)
      for (const bool turned : {false, true}) {
        const TargetState& piece = pieces.world.targets[chain.point];
        const dvec3 end = turned ? to[link.rx] : from[link.tx], other = turned ? from[link.tx] : to[link.rx];
        if (!piece.present || link.tx == 2) continue;
        std::vector<uint32_t> mirrors(chain.mirrors, chain.mirrors + chain.count);
        auto way = bounced(end, mirrors, piece.position_m);
        if (!way || !(side_of(piece, way->points.back()) & side_of(piece, other))) continue;
        const double before_m = glm::distance(way->image, piece.position_m),
                     after_m = glm::distance(other, piece.position_m);
        if (floor > 0 && 1.0 < floor * before_m * before_m * after_m * after_m) {
          ++weak;
          continue;
        }
        mirrors.push_back(WT_STEP_TARGET | chain.point);
        way->points.push_back(piece.position_m);
        if (turned) {
          std::ranges::reverse(mirrors);
          std::ranges::reverse(way->points);
        }
        wanted.emplace(BouncedRow{link.tx, link.rx, mirrors}, way->points);
      }
  return wanted;
}

}  // namespace

TEST_CASE("target_bounces: the rows of all chains from both ends, with exact points, and those above a floor") {
  const Pieces pieces = pieces_of_plates();
  const std::vector<dvec3> from{{3.1, 2.6, 1.4}, {2.2, 4.3, 0.9}, {-2, 1.1, 3.4}}, to{{2.7, 3.1, 2.2}, {4.4, 0.8, 0.3}};
  std::vector<EndState> transmitters, receivers;
  for (const dvec3& p : from) transmitters.push_back({.position_m = p});
  for (const dvec3& p : to) receivers.push_back({.position_m = p});
  transmitters[2].instance = 2;
  const std::vector<Link> links{{0, 0}, {0, 1}, {1, 0}, {2, 0}};
  const RadioEnds ends = make_radio_ends(context(), transmitters, receivers, links);
  const DeviceScene scene = make_device_scene(context(), reference::scene_of_quads(plates), false);
  const std::vector<double> powers(pieces.world.targets.size(), 1.0);
  for (const double floor : {0.0, 1.0 / (3.9 * 3.9 * 3.9 * 3.9)}) {
    CAPTURE(floor);
    TargetRows targets(context(), static_cast<uint32_t>(pieces.world.targets.size()), 4, {floor, powers, true});
    targets.place(pieces.world);
    TargetBounces pass(context(), pieces.bounces, 4);
    pass(scene, ends, targets);  // it runs twice: nothing of the first run may remain
    const SolvedList& list = pass(scene, ends, targets);
    const BouncedRows found = bounced_rows_of(list);
    uint64_t weak = 0;
    const BouncedRows wanted = wanted_rows(pieces, from, to, links, floor, weak);
    CHECK(pass.weak() == weak);
    CHECK((floor > 0) == (weak > 0));
    REQUIRE(found.size() == wanted.size());
    CHECK(wanted.size() > (floor > 0 ? 2 : 40));
    size_t twice = 0;
    for (const auto& [row, points] : wanted) {
      REQUIRE(found.contains(row));
      twice += points.size() == 3;
      for (size_t k = 0; k < points.size(); ++k) CHECK(glm::distance(points[k], found.at(row)[k]) < 1e-12);
    }
    if (floor == 0) CHECK(twice > 5);
  }
}

TEST_CASE("target_bounces: frames without links have no rows") {
  const Pieces pieces = pieces_of_plates();
  const RadioEnds ends = make_radio_ends(context(), {{}}, {{}}, {});
  const DeviceScene scene = make_device_scene(context(), reference::scene_of_quads(plates), false);
  TargetRows targets(context(), static_cast<uint32_t>(pieces.world.targets.size()), 3, {0, {}, true});
  targets.place(pieces.world);
  CHECK(TargetBounces(context(), pieces.bounces, 3)(scene, ends, targets).count == 0);
}
