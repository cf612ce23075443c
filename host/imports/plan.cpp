// SPDX-License-Identifier: Apache-2.0
// The rules are one function each, in the order of plan_city().
// A grid finds which footprints lie inside others.
#include "imports/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "imports/box_index.hpp"
#include "imports/rings.hpp"
#include "imports/straight_walls.hpp"
#include "imports/triangulate.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::imports {
namespace {

constexpr const char* too_many_around = "inside of more than 200 others";

struct Candidate {
  Solid solid;
  const Tags* tags = nullptr;
  Box box;
  bool gone = false;
};

// Returns the same ring for all ways to write it: counter-clockwise, starting at its lowest point.
Ring canonical(Ring ring) {
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  return ring;
}

class Planner {
 public:
  Planner(const Map& map, const std::string& name, const ImportOptions& options)
      : map_(map), name_(name), options_(options) {
    plan_.left_out = map.left_out;
    Extent extent;
    for (const Footprint& footprint : map.footprints)
      for (const glm::dvec2& p : footprint.outer) extent.add(p);
    plan_.offset_m = shift_to_origin(extent, name);
    plan_.traffic = extent_to_reach(map.network, plan_.offset_m, name, options);
  }

  Plan plan() {
    take_footprints();
    drop_repeated_outlines();
    if (map_.nested_are_courtyards) cut_courtyards();
    triangulate_all();
    leave_outlines_to_parts();
    for (Candidate& c : candidates_) {
      if (!c.gone) plan_.solids.push_back(std::move(c.solid));
    }
    return std::move(plan_);
  }

 private:
  void drop(Candidate& candidate, const std::string& reason) {
    candidate.gone = true;
    ++plan_.left_out[reason];
  }

  void take_footprints() {
    const StraightWalls walls = straight_walls(map_.footprints, map_.rounding_m);
    plan_.straightened = walls.moved.size();
    plan_.straightened_by_m = walls.farthest_m;
    for (const Footprint& footprint : map_.footprints) {
      Polygon polygon = walls.polygon_of(footprint, plan_.offset_m);
      if (!fault(polygon).empty())
        polygon = StraightWalls{}.polygon_of(footprint, plan_.offset_m);  // rings thinner than the tolerance collapse
      if (const std::string_view reason = fault(polygon); !reason.empty()) {
        ++plan_.left_out[std::string(reason)];
        continue;
      }
      orient(polygon);
      auto shape = building_shape(footprint.tags, options_, plan_.guessed, plan_.left_out);
      if (!shape) continue;
      const Box box = box_of(polygon.outer);
      candidates_.push_back({{footprint.id,
                              footprint.name,
                              says_yes(footprint.tags, "building:part"),
                              std::move(polygon),
                              {},
                              std::move(*shape),
                              {}},
                             &footprint.tags,
                             box});
    }
  }

  // A multipolygon and its outer way may both be tagged: the one with courtyards is kept.
  void drop_repeated_outlines() {
    std::map<Ring, size_t> seen;
    for (size_t i = 0; i < candidates_.size(); ++i) {
      // Parts may be on top of one another.
      if (candidates_[i].solid.part || !candidates_[i].solid.is_building()) continue;
      const auto [entry, is_new] = seen.try_emplace(canonical(candidates_[i].solid.polygon.outer), i);
      if (is_new) continue;
      const auto courtyards = [this](size_t k) { return candidates_[k].solid.polygon.holes.size(); };
      const size_t earlier = entry->second;
      const bool replaces = courtyards(i) > courtyards(earlier);
      if (replaces) entry->second = i;
      drop(candidates_[replaces ? earlier : i], "outline that occurs twice");
    }
  }

  BoxIndex outlines() const {
    std::vector<BoxIndex::Entry> entries;
    for (size_t i = 0; i < candidates_.size(); ++i)
      if (!candidates_[i].gone && !candidates_[i].solid.part && candidates_[i].solid.is_building())
        entries.push_back({candidates_[i].box, i});
    return BoxIndex(std::move(entries));
  }

  // A building inside another one with the same tags is a courtyard in it, and one inside of that is a building again.
  // polyconvert writes inner rings of multipolygons in this way.
  void cut_courtyards() {
    const BoxIndex index = outlines();
    std::vector<size_t> order(candidates_.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::vector<int64_t> areas;
    for (const Candidate& c : candidates_) areas.push_back(twice_area(c.solid.polygon.outer));
    const auto area = [&areas](size_t i) { return areas[i]; };
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return area(a) > area(b); });
    std::vector<bool> is_hole(candidates_.size());
    for (const size_t i : order) {
      if (candidates_[i].gone || candidates_[i].solid.part) continue;
      size_t parent = i;
      const bool all = index.containing(candidates_[i].box, [&](size_t k) {
        if (k == i || (parent != i && area(k) >= area(parent)) || !encloses(candidates_[k], candidates_[i])) return;
        parent = k;
      });
      if (!all) {
        drop(candidates_[i], too_many_around);
        continue;
      }
      if (parent == i || is_hole[parent]) continue;
      is_hole[i] = cut(candidates_[parent].solid.polygon, candidates_[i].solid.polygon.outer);
    }
    for (size_t i = 0; i < candidates_.size(); ++i) {
      if (is_hole[i]) candidates_[i].gone = true;  // counted as a courtyard of another
    }
  }
  static bool encloses(const Candidate& outer, const Candidate& inner) {
    if (*outer.tags != *inner.tags) return false;
    const Ring& ring = inner.solid.polygon.outer;
    return std::all_of(ring.begin(), ring.end(),
                       [&](const Point& p) { return contains(outer.solid.polygon.outer, p); });
  }
  // Returns false, and does nothing, if the hole would touch the border.
  static bool cut(Polygon& polygon, Ring hole) {
    std::reverse(hole.begin(), hole.end());
    if (!fits(polygon, hole)) return false;
    polygon.holes.push_back(std::move(hole));
    return true;
  }

  void triangulate_all() {
    for (Candidate& c : candidates_) {
      if (c.gone) continue;
      c.solid.triangles = triangulate(c.solid.polygon);
      if (c.solid.triangles.empty()) drop(c, "outline that could not be triangulated");
    }
  }

  // By Simple 3D Buildings, the outline is not built if there are parts.
  void leave_outlines_to_parts() {
    const BoxIndex index = outlines();
    std::map<size_t, std::vector<Candidate*>> parts_of;  // parts by the index of their outline
    for (Candidate& part : candidates_) {
      if (part.gone || !part.solid.part) continue;
      const Point inside = point_inside(part.solid);
      const bool all = index.containing({inside, inside}, [&](size_t i) {
        const Polygon& outline = candidates_[i].solid.polygon;
        if (!contains(outline.outer, inside)) return;
        for (const Ring& hole : outline.holes) {
          if (contains(hole, inside)) return;
        }
        part.solid.outline = outline.outer;
        parts_of[i].push_back(&part);
      });
      if (!all) drop(part, too_many_around);
    }
    for (const auto& [i, parts] : parts_of) choose_outline_or_parts(candidates_[i], parts);
    warn_of_gaps();
  }

  // Parts should fill their outline. If they hardly do, such as the chimney alone of a house, the house is built as
  // well. A part that begins in the upper half of the house fills nothing, since it stands on it.
  void choose_outline_or_parts(Candidate& house, const std::vector<Candidate*>& parts) {
    constexpr double full = 0.95, least = 0.5;
    std::vector<const Polygon*> all, filling;
    for (const Candidate* part : parts) {
      if (part->gone) continue;
      all.push_back(&part->solid.polygon);
      if (part->solid.shape.bottom_m < house.solid.shape.top_m / 2) filling.push_back(all.back());
    }
    double share = covered_share(house.solid.polygon, all);
    if (share >= least) share = covered_share(house.solid.polygon, filling);
    if (share >= full) return drop(house, "outline whose parts are built instead");
    Gaps& gaps = share < least ? standing_ : open_;
    ++gaps.outlines;
    if (share < gaps.share) gaps = {gaps.outlines, share, house.solid.id};
    if (share >= least) return drop(house, "outline whose parts are built instead, though they leave gaps in it");
    ++plan_.guessed["outline of which parts fill less than half: built as well as what of its parts is above it"];
    for (Candidate* part : parts) set_onto(house.solid, *part);
  }

  // Changes a part of a house that is built itself: the space inside the house is filled already.
  void set_onto(const Solid& house, Candidate& part) {
    constexpr double inside = 0.99;
    const Polygon* const around = &house.polygon;
    if (part.gone || covered_share(part.solid.polygon, {&around, 1}) < inside) return;
    Shape& shape = part.solid.shape;
    if (shape.top_m <= house.shape.top_m) return drop(part, "part inside of its outline, which is built itself");
    shape.bottom_m = std::max(shape.bottom_m, house.shape.top_m);
  }

  void warn_of_gaps() {
    const auto warn = [this](const Gaps& gaps, const char* what, const char* then) {
      if (gaps.outlines == 0) return;
      plan_.warnings.push_back(fmt::format("{}: parts (building:part) fill {} {} {}, as little as {:.1f}% of {}: {}",
                                           name_, what, gaps.outlines, gaps.outlines == 1 ? "outline" : "outlines",
                                           100 * gaps.share, gaps.id, then));
    };
    warn(open_, "only a part of", "the parts alone are built, and nothing stands in the gaps between them");
    warn(standing_, "less than half of", "the whole house is built, and its parts as far as they are above it");
  }

  // Returns the centroid of the largest triangle.
  static Point point_inside(const Solid& solid) {
    std::vector<Point> corners = solid.polygon.outer;
    for (const Ring& hole : solid.polygon.holes) corners.insert(corners.end(), hole.begin(), hole.end());
    const auto area = [&](const Triangle& t) { return turn(corners[t[0]], corners[t[1]], corners[t[2]]); };
    const Triangle t = *std::max_element(solid.triangles.begin(), solid.triangles.end(),
                                         [&](const Triangle& s, const Triangle& u) { return area(s) < area(u); });
    return {(corners[t[0]].x + corners[t[1]].x + corners[t[2]].x) / 3,
            (corners[t[0]].y + corners[t[1]].y + corners[t[2]].y) / 3};
  }

  // Counts outlines that parts do not fill.
  struct Gaps {
    uint64_t outlines = 0;
    double share = 2;  // smallest share that parts cover, and the id of its outline
    std::string id = {};
  };

  const Map& map_;
  const std::string& name_;
  const ImportOptions& options_;
  Plan plan_;
  Gaps open_, standing_;
  std::vector<Candidate> candidates_;
};

}  // namespace

glm::dvec2 shift_to_origin(const Extent& extent, const std::string& name) {
  const glm::dvec2 &lower = extent.lower_m, &upper = extent.upper_m;
  const double reach = std::max({-lower.x, -lower.y, upper.x, upper.y});
  if (!(reach > largest_coordinate_m)) return {0, 0};
  if (!(std::max(upper.x - lower.x, upper.y - lower.y) < 2 * largest_coordinate_m - 2)) {
    throw InputError(
        fmt::format("{}: the buildings span {:.0f} x {:.0f} km; at most {:.0f} km are allowed; cut a part out of it",
                    name, (upper.x - lower.x) / 1000, (upper.y - lower.y) / 1000, 2 * largest_coordinate_m / 1000));
  }
  return {-std::round((lower.x + upper.x) / 2), -std::round((lower.y + upper.y) / 2)};
}

Extent extent_to_reach(const Extent& network, const glm::dvec2& offset_m, const std::string& name,
                       const ImportOptions& options) {
  constexpr double most_m = 2 * largest_coordinate_m;
  Extent out;
  for (const auto& [extent, what] : {std::pair{network, "network"}, {options.traffic, "traffic"}}) {
    if (!options.ground || extent.empty()) continue;
    for (const glm::dvec2& corner : {extent.lower_m, extent.upper_m}) {
      const glm::dvec2 p = corner + offset_m;
      if (!(std::max(std::abs(p.x), std::abs(p.y)) <= most_m)) {
        throw InputError(fmt::format(
            "{}: the {} reaches ({:.0f}, {:.0f}) km in the scene, and the ground must reach as far; "
            "at most {:.0f} km are allowed: do map and network belong together? Cut both, or use --no-ground",
            name, what, p.x / 1000, p.y / 1000, most_m / 1000));
      }
      out.add(p);
    }
  }
  return out;
}

Plan plan_city(const Map& map, const std::string& name, const ImportOptions& options) {
  return Planner(map, name, options).plan();
}

}  // namespace wavetracer::imports
