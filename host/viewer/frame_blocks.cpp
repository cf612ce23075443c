// Each frame is one block: counts, then 4-byte, 2-byte and 1-byte columns, so that all are aligned where they lie.
// float32 relative to the centre is 0.1 mm in a city; angles are 16 bits, 0.006 degrees.
#include "viewer/frame_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <map>
#include "viewer/blocks.hpp"
#include "viewer/strongest.hpp"

namespace wavetracer {
namespace {

constexpr uint64_t link_bytes = 16, pose_bytes = 4 + 12 + 8, end_bytes = 12, vertex_bytes = 21;
// Links take at most this share of the room: the gain over time of a link is worth less than the paths to look at.
constexpr uint64_t links_share = 4;

uint64_t path_bytes(const Paths& paths, size_t path) {
  return 32 + 8 * uint64_t{paths.rx_ports} * paths.tx_ports + vertex_bytes * paths.depth[path];
}

struct LinkRow {
  uint32_t paths = 0;
  double power = 0;
  double gain_db() const { return power > 0 ? 10 * std::log10(power) : -std::numeric_limits<double>::infinity(); }
};

// Of all paths of the frame, those that the page leaves out included.
std::map<Link, LinkRow> link_rows(const SavedFrame& frame) {
  std::map<Link, LinkRow> rows;
  for (const Link& link : frame.links) rows[link];
  for (size_t i = 0; i < frame.paths.size(); ++i) {
    LinkRow& row = rows[{frame.paths.tx[i], frame.paths.rx[i]}];
    ++row.paths;
    row.power += std::pow(10.0, frame.paths.gain_db[i] / 10);
  }
  return rows;
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
  for (const size_t i : kept) wide.add(vertices += paths.depth[i]);  // where the vertices of the path end
  for (const auto* column : {&paths.aod_theta_rad, &paths.aod_phi_rad, &paths.aoa_theta_rad, &paths.aoa_phi_rad})
    for (const size_t i : kept)
      narrow.add_share(std::remainder((*column)[i], glm::two_pi<double>()), glm::pi<double>());
}

Packer pack_frame(const SavedFrame& frame, const std::vector<size_t>& kept, const glm::dvec3& centre_m) {
  Packer wide, narrow, bytes;
  uint32_t vertices = 0;
  for (const size_t i : kept) vertices += frame.paths.depth[i];
  for (const size_t count : {kept.size(), size_t{vertices}, frame.poses.size()}) wide.add(static_cast<uint32_t>(count));
  for (const auto* positions : {&frame.transmitter_position_m, &frame.receiver_position_m})
    for (const glm::dvec3& position : *positions) wide.add(position - centre_m);
  add_poses(frame, centre_m, wide, narrow);
  add_columns(frame.paths, kept, wide, narrow);
  add_vertices(frame.paths, kept, centre_m, wide, bytes);
  wide.append(narrow);
  wide.append(bytes);
  return wide;
}

}  // namespace

FrameBlocks add_frame_blocks(const SavedRun& run, const FrameSelection& selection, const glm::dvec3& centre_m,
                             std::string& elements) {
  Strongest paths, links;
  uint64_t fixed = 0;  // bytes that frames take without paths and links
  for (const size_t row : selection.rows) {
    const SavedFrame frame = run.frame(row);
    for (size_t i = 0; i < frame.paths.size(); ++i) paths.count(frame.paths.gain_db[i], path_bytes(frame.paths, i));
    for (const auto& [link, figures] : link_rows(frame)) links.count(figures.gain_db(), link_bytes);
    fixed += 200 + pose_bytes * frame.poses.size() + end_bytes * (run.transmitters().size() + run.receivers().size());
  }
  const uint64_t room = selection.bytes / 4 * 3 > fixed ? selection.bytes / 4 * 3 - fixed : 0;
  const uint64_t link_room = std::min(links.rows() * link_bytes, room / links_share);
  links.limit(links.rows(), link_room);
  if (selection.max_paths > 0)
    paths.limit(selection.max_paths, std::numeric_limits<uint64_t>::max());
  else
    paths.limit(paths.rows(), room - link_room);

  FrameBlocks out;
  out.frames = nlohmann::json::array();
  double lowest_db = std::numeric_limits<double>::infinity(), highest_db = -lowest_db;
  Packer link_frames, link_tx, link_rx, link_gains, link_block;
  for (size_t f = 0; f < selection.rows.size(); ++f) {
    const SavedFrame frame = run.frame(selection.rows[f]);
    std::vector<size_t> kept;
    for (size_t i = 0; i < frame.paths.size(); ++i) {
      const double gain_db = frame.paths.gain_db[i];
      if (!paths.keep(gain_db, path_bytes(frame.paths, i))) continue;
      kept.push_back(i);
      out.highest_order = std::max(out.highest_order, frame.paths.depth[i]);
      if (!std::isfinite(gain_db)) continue;
      lowest_db = std::min(lowest_db, gain_db);
      highest_db = std::max(highest_db, gain_db);
    }
    // The weakest first: the page draws them in this order, so that the strongest lie on top.
    std::stable_sort(kept.begin(), kept.end(), [&gain_db = frame.paths.gain_db](size_t a, size_t b) {
      return std::isnan(gain_db[a]) ? !std::isnan(gain_db[b]) : gain_db[a] < gain_db[b];
    });
    uint64_t shown_links = 0;
    for (const auto& [link, figures] : link_rows(frame)) {
      if (!links.keep(figures.gain_db(), link_bytes)) continue;
      ++shown_links;
      link_frames.add(static_cast<uint32_t>(f));
      link_tx.add(link.tx);
      link_rx.add(link.rx);
      link_gains.add(static_cast<float>(figures.gain_db()));
    }
    elements += block_element("frame_" + std::to_string(f), pack_frame(frame, kept, centre_m));
    out.frames.push_back({frame.number, frame.time_s, frame.paths.size(), kept.size()});
    out.paths += frame.paths.size();
    out.shown_paths += kept.size();
    out.shown_links += shown_links;
  }
  if (lowest_db <= highest_db) {
    out.lowest_db = lowest_db;
    out.highest_db = highest_db;
  }
  out.links = links.rows();
  for (const Packer* column : {&link_frames, &link_tx, &link_rx, &link_gains}) link_block.append(*column);
  elements += block_element("links", link_block);
  return out;
}

}  // namespace wavetracer
