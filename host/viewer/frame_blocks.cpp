// SPDX-License-Identifier: Apache-2.0
// Each frame is one block: counts, then 4-byte, 2-byte and 1-byte columns, so that all are aligned. Coordinates are
// float32 relative to the centre, exact to 0.1 mm in a city; angles have 16 bits, 0.006 degrees.
#include "viewer/frame_blocks.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <span>
#include "results/link_rows.hpp"
#include "viewer/blocks.hpp"
#include "viewer/cell_areas.hpp"
#include "viewer/link_columns.hpp"
#include "viewer/strongest.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t pose_bytes = 4 + 12 + 8, end_bytes = 12, vertex_bytes = 21;
// Links take at most this share of the space: the gain of a link over time is worth less than the paths. If there is a
// map, its colours come first.
constexpr double links_share = 0.25, map_links_share = 0.75;

uint64_t path_bytes(const Paths& paths, size_t path) {
  return 32 + 8 * uint64_t{paths.rx_ports} * paths.tx_ports + vertex_bytes * paths.depth[path];
}

void add_poses(const SavedFrame& frame, const glm::dvec3& centre_m, Packer& wide, Packer& narrow) {
  for (const SavedPose& pose : frame.poses) wide.add(pose.position_m - centre_m);
  for (const SavedPose& pose : frame.poses) wide.add(pose.instance);
  for (const SavedPose& pose : frame.poses) {
    const glm::dquat turn = glm::normalize(glm::quat_cast(pose.rotation));
    for (const double part : {turn.x, turn.y, turn.z, turn.w}) narrow.add_share(part, 1);
  }
}

void add_vertices(const Paths& paths, const std::vector<size_t>& kept, const glm::dvec3& centre_m, Packer& wide,
                  Packer& bytes) {
  const auto each = [&](const auto& action) {
    for (const size_t i : kept)
      for (uint64_t k = paths.vertex_offset[i]; k < paths.vertex_offset[i + 1]; ++k) action(k);
  };
  each([&](uint64_t k) { wide.add(paths.vertex_position_m[k] - centre_m); });
  each([&](uint64_t k) { wide.add(paths.vertex_surface[k]); });
  each([&](uint64_t k) { wide.add(paths.vertex_instance[k]); });
  each([&](uint64_t k) { bytes.add(paths.vertex_interaction[k]); });
}

void add_columns(const Paths& paths, const std::vector<size_t>& kept, Packer& wide, Packer& narrow) {
  const auto values = [&](const std::vector<double>& column) {
    for (const size_t i : kept) wide.add(static_cast<float>(column[i]));
  };
  values(paths.delay_s);
  values(paths.gain_db);
  values(paths.doppler_hz);
  for (const size_t i : kept)
    for (size_t k = 0; k < size_t{paths.rx_ports} * paths.tx_ports; ++k) {
      wide.add(static_cast<float>(paths.a[i][k].real()));
      wide.add(static_cast<float>(paths.a[i][k].imag()));
    }
  for (const size_t i : kept) wide.add(paths.tx[i]);
  for (const size_t i : kept) wide.add(paths.rx[i]);
  uint32_t vertices = 0;
  for (const size_t i : kept) wide.add(vertices += paths.depth[i]);  // index at which the vertices of the path end
  for (const auto* column : {&paths.aod_theta_rad, &paths.aod_phi_rad, &paths.aoa_theta_rad, &paths.aoa_phi_rad})
    for (const size_t i : kept)
      narrow.add_share(std::remainder((*column)[i], glm::two_pi<double>()), glm::pi<double>());
}

Packer pack_frame(const SavedFrame& frame, const std::vector<size_t>& kept, const FrameSelection& selection,
                  const glm::dvec3& centre_m) {
  Packer wide, narrow, bytes;
  uint32_t vertices = 0;
  for (const size_t i : kept) vertices += frame.paths.depth[i];
  for (const size_t count : {kept.size(), size_t{vertices}, frame.poses.size()}) wide.add(static_cast<uint32_t>(count));
  for (const glm::dvec3& position : frame.transmitter_position_m) wide.add(position - centre_m);
  for (size_t rx = 0; rx < frame.receiver_position_m.size(); ++rx)
    if (selection.own_receivers[rx]) wide.add(frame.receiver_position_m[rx] - centre_m);
  add_poses(frame, centre_m, wide, narrow);
  add_columns(frame.paths, kept, wide, narrow);
  add_vertices(frame.paths, kept, centre_m, wide, bytes);
  wide.append(narrow);
  wide.append(bytes);
  return wide;
}

void grow(std::optional<PageBounds>& box, const glm::dvec3& point) {
  if (!std::isfinite(point.x + point.y + point.z)) return;
  box = box ? PageBounds{glm::min(box->lower, point), glm::max(box->upper, point)} : PageBounds{point, point};
}

// A first pass over all frames: the strengths of rows, and the bytes that are needed in any case.
struct Survey {
  Strongest paths, links;
  uint64_t fixed_bytes = 0;  // bytes of frames without paths and links
  uint64_t cell_paths = 0;   // paths to cells of grids
  bool areas = false;        // links get values of areas
  double left_out = 0;       // largest share of the power of a cell that paths.h5 lacks

  Survey(const SavedRun& run, const FrameSelection& selection, FrameBlocks& out) {
    const auto own = static_cast<uint64_t>(std::ranges::count(selection.own_receivers, true));
    for (const size_t row : selection.rows) {
      const SavedFrame frame = run.frame(row);
      for (size_t i = 0; i < frame.paths.size(); ++i) {
        paths.count(frame.paths.gain_db[i], path_bytes(frame.paths, i));
        cell_paths += !selection.own_receivers[frame.paths.rx[i]];
      }
      for (const LinkRow& link : link_rows(frame, selection.links, run.first_link(row), run.frequency_hz())) {
        links.count(link.path_gain_db, 1);
        if (!selection.own_receivers[link.link.rx]) left_out = std::max(left_out, link.left_out_power_share);
      }
      fixed_bytes += 200 + pose_bytes * frame.poses.size() + end_bytes * (run.transmitters().size() + own);
      for (const auto* points : {&frame.transmitter_position_m, &frame.receiver_position_m})
        for (const glm::dvec3& point : *points) grow(out.ends_m, point);
      for (const SavedPose& pose : frame.poses) grow(out.ends_m, pose.position_m);
      for (const uint8_t interaction : frame.paths.vertex_interaction) out.interactions |= interaction;
    }
    const uint64_t most = selection.bytes / 4 * 3, room = most > fixed_bytes ? most - fixed_bytes : 0;
    const double share = own < selection.own_receivers.size() ? map_links_share : links_share;
    areas = cell_paths > 0 && cell_paths <= selection.area_paths;
    const std::vector<double>& beams = selection.links.beam_gain_db;
    const bool some_beams = std::ranges::any_of(beams, [](double gain_db) { return !std::isnan(gain_db); });
    const uint64_t link_bytes =
        LinkColumns::bytes + (areas ? LinkColumns::more_bytes : 0) + (some_beams ? LinkColumns::more_bytes : 0);
    const uint64_t link_room =
        std::min(links.rows() * link_bytes, static_cast<uint64_t>(share * static_cast<double>(room)));
    links.limit(link_room / link_bytes, links.rows());
    if (selection.max_paths > 0)
      paths.limit(selection.max_paths, std::numeric_limits<uint64_t>::max());
    else
      paths.limit(paths.rows(), room - link_room);
  }
};

// Says what the areas of cells lack; empty if nothing.
std::string area_warning(const Survey& survey, uint64_t area_paths) {
  constexpr double least_left_out = 1e-9;  // smaller shares of power are rounding errors of links.csv
  if (area_paths == 0 || survey.cell_paths == 0) return "";
  if (survey.cell_paths > area_paths)
    return fmt::format(
        "the map has no cell mean and no fading, which take long for {} paths to its cells; fewer frames (--frames) and "
        "`wavetracer coverage` show them",
        survey.cell_paths);
  if (!(survey.left_out > least_left_out)) return "";
  return fmt::format(
      "the cell mean and the fading of the map are those of the paths in paths.h5, where limits of output ([output] "
      "min_gain_db, dynamic_range_db, max_paths_per_link) have left out up to {:.3g}% of the power of a cell",
      100 * survey.left_out);
}

// Returns the rows of the paths that the page holds, the weakest first: it draws them in this order, so that the
// strongest lie on top.
std::vector<size_t> kept_paths(const Paths& paths, Strongest& strongest) {
  std::vector<size_t> kept;
  for (size_t i = 0; i < paths.size(); ++i)
    if (strongest.keep(paths.gain_db[i], path_bytes(paths, i))) kept.push_back(i);
  std::stable_sort(kept.begin(), kept.end(), [&gain_db = paths.gain_db](size_t a, size_t b) {
    return std::isnan(gain_db[a]) ? !std::isnan(gain_db[b]) : gain_db[a] < gain_db[b];
  });
  return kept;
}

constexpr uint64_t bytes_per_point = 15;  // a third more in base64

// Returns the points of each `step`-th ray, without the receivers that it passes.
std::vector<size_t> shown_points(const WaypointRows& rows, uint64_t step) {
  std::vector<size_t> out;
  uint64_t ray = 0;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && (rows.tx[i] != rows.tx[i - 1] || rows.sample[i] != rows.sample[i - 1])) ++ray;
    if (ray % step == 0 && rows.kind[i] != WaypointKind::hit) out.push_back(i);
  }
  return out;
}

}  // namespace

FrameBlocks add_frame_blocks(const SavedRun& run, const FrameSelection& selection, const glm::dvec3& centre_m,
                             std::string& elements) {
  FrameBlocks out;
  Survey survey(run, selection, out);
  double lowest_db = std::numeric_limits<double>::infinity(), highest_db = -lowest_db;
  LinkColumns links;
  for (size_t f = 0; f < selection.rows.size(); ++f) {
    const SavedFrame frame = run.frame(selection.rows[f]);
    const std::vector<size_t> kept = kept_paths(frame.paths, survey.paths);
    for (const size_t i : kept) {
      out.highest_order = std::max(out.highest_order, frame.paths.depth[i]);
      if (!std::isfinite(frame.paths.gain_db[i])) continue;
      lowest_db = std::min(lowest_db, frame.paths.gain_db[i]);
      highest_db = std::max(highest_db, frame.paths.gain_db[i]);
    }
    std::optional<CellAreas> cells;
    if (survey.areas) cells.emplace(selection.grids, frame, run.frequency_hz());
    for (const LinkRow& row :
         link_rows(frame, selection.links, run.first_link(selection.rows[f]), run.frequency_hz())) {
      if (!survey.links.keep(row.path_gain_db, 1)) continue;
      ++out.shown_links;
      links.add(f, row, cells ? cells->levels(row.link) : coverage::AreaLevels());
    }
    elements += block_element("frame_" + std::to_string(f), pack_frame(frame, kept, selection, centre_m));
    out.frames.push_back({frame.number, frame.time_s, frame.paths.size(), kept.size()});
    out.paths += frame.paths.size();
    out.shown_paths += kept.size();
  }
  if (lowest_db <= highest_db) {
    out.lowest_db = lowest_db;
    out.highest_db = highest_db;
  }
  out.links = survey.links.rows();
  out.beams = links.beams();
  out.areas = links.areas();
  out.area_warning = area_warning(survey, selection.area_paths);
  elements += block_element("links", links.block());
  return out;
}

RayBlocks add_ray_blocks(const SavedWaypoints& waypoints, const std::vector<uint32_t>& frames,
                         const glm::dvec3& centre_m, uint64_t bytes, std::string& elements) {
  const uint64_t most = std::max<uint64_t>(bytes * 3 / 4 / bytes_per_point, 1);
  uint64_t rows_of_all = 0;
  for (const uint32_t number : frames) rows_of_all += waypoints.count(number);
  const uint64_t step = std::max<uint64_t>((rows_of_all + most - 1) / most, 1);
  RayBlocks out;
  if (step > 1)
    out.warning =
        fmt::format("the page holds one of every {} sampled rays; fewer frames (--frames) show more of them", step);
  for (size_t row = 0; row < frames.size(); ++row) {
    const WaypointRows rows = waypoints.frame(frames[row]);
    const std::vector<size_t> points = shown_points(rows, step);
    Packer block;
    for (const size_t i : points) block.add(rows.position_m[i] - centre_m);
    for (const size_t i : points) {
      block.add(static_cast<uint8_t>(std::min(rows.depth[i], 255u)));
      out.highest_depth = std::max(out.highest_depth, rows.depth[i]);
    }
    for (const size_t i : points) {
      block.add(static_cast<uint8_t>(rows.source[i]));
      out.sources = out.sources || rows.source[i] == WaypointSource::traced || rows.source[i] == WaypointSource::cache;
    }
    for (const size_t i : points) block.add(static_cast<uint8_t>(rows.kind[i]));
    out.frames.push_back(points.size());
    elements += block_element(fmt::format("rays_{}", row), block);
  }
  return out;
}

}  // namespace wavetracer
