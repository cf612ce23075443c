// SPDX-License-Identifier: Apache-2.0
// Planes of mirrors and lines of edges are those of the scene at their places in the frame; they pass through the
// vertices of the path.
#include "radio/element_link.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "radio/constants.hpp"
#include "radio/wide_loops.hpp"

namespace wavetracer {
namespace {

glm::dvec3 direction_of(double theta_rad, double phi_rad) {
  return {std::sin(theta_rad) * std::cos(phi_rad), std::sin(theta_rad) * std::sin(phi_rad), std::cos(theta_rad)};
}

std::vector<glm::dvec3> turned(const std::vector<glm::dvec3>& positions_m, const glm::dmat3& rotation) {
  std::vector<glm::dvec3> out;
  for (const glm::dvec3& p : positions_m) out.push_back(rotation * p);
  return out;
}

}  // namespace

ElementPair PathOfElements::between(size_t rx_element, size_t tx_element) const {
  ElementPair out{};
  between(rx_element, tx_element, 1, &out.delay_s, &out.amplitude);
  return out;
}

WAVETRACER_WIDE void PathOfElements::between(size_t rx_element, size_t first, size_t count, double* delay_s,
                                             double* amplitude) const {
  if (plane_) {
    const double heard_m = heard_m_[rx_element];
    for (size_t i = 0; i < count; ++i) {
      delay_s[i] = delay_s_ - (sent_m_[first + i] + heard_m) / speed_of_light_m_s;
      amplitude[i] = 1;
    }
    return;
  }
  path_.between(sent_at_, first, count, heard_at_[rx_element], delay_s, amplitude);
  const double by_centre = 1 / centre_.amplitude;
  for (size_t i = 0; i < count; ++i) {
    delay_s[i] = delay_s_ + (delay_s[i] - centre_.length_m) / speed_of_light_m_s;
    amplitude[i] *= by_centre;
  }
}

ElementLink::ElementLink(const ElementModel& model, const FrameResult& frame, Link link)
    : model_(model), frame_(frame) {
  const EndState &tx = frame.world.transmitters.at(link.tx), &rx = frame.world.receivers.at(link.rx);
  tx_m_ = tx.position_m;
  rx_m_ = rx.position_m;
  sent_m_ = turned(model.transmitters_.at(link.tx).positions_m, tx.rotation);
  heard_m_ = turned(model.receivers_.at(link.rx).positions_m, rx.rotation);
  tx_ports_ = model.tx_ports(link.tx);
  rx_ports_ = model.rx_ports(link.rx);
  const Paths& paths = frame.paths;
  const auto row_at = [&](auto is_before) {
    size_t first = 0, end = paths.size();
    while (first < end) {
      const size_t middle = first + (end - first) / 2;
      if (is_before(Link{paths.tx[middle], paths.rx[middle]}))
        first = middle + 1;
      else
        end = middle;
    }
    return first;
  };
  first_row_ = row_at([&](const Link& other) { return other < link; });
  end_row_ = row_at([&](const Link& other) { return other <= link; });
}

// Mirrors after the last bend belong to the receiver, counted from its end on. If nothing bends the path, all belong to
// the transmitter.
UnfoldedPath ElementLink::unfolded(size_t row) const {
  const Paths& paths = frame_.paths;
  UnfoldedPath out;
  std::vector<std::pair<glm::dvec3, glm::dvec3>> after;  // normals and points of mirrors since the first bend
  const auto image_in_these = [&] {
    Isometry image;
    for (size_t i = after.size(); i-- > 0;) image = mirrored(image, after[i].first, after[i].second);
    return image;
  };
  for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k) {
    const uint32_t instance = paths.vertex_instance[k];
    const bool moves = instance != no_instance;
    const Scene& scene = moves ? model_.models_[model_.instances_.at(instance).model] : model_.scene_;
    const glm::dmat3 rotation = moves ? frame_.world.instances.at(instance).rotation : glm::dmat3(1.0);
    const glm::dvec3 point = paths.vertex_position_m[k] - model_.scene_.origin_m;
    const uint8_t kind = paths.vertex_interaction[k];
    if (kind == reflection) {
      const glm::dvec3 normal = rotation * scene.surfaces.at(paths.vertex_surface[k]).normal;
      if (out.count == 0)
        out.sent = mirrored(out.sent, normal, point);
      else
        after.emplace_back(normal, point);
    } else if (kind == diffraction || kind == scattering || kind == target_point) {
      const glm::dvec3 along =
          kind == diffraction ? rotation * scene.wedges.at(paths.vertex_surface[k]).along : glm::dvec3(0);
      const Isometry image = image_in_these();
      out.bends.at(static_cast<size_t>(out.count++)) = {image(point), image.turn * along};
    }  // a transmission goes straight on
  }
  out.heard = image_in_these();
  return out;
}

PathOfElements ElementLink::path(size_t row) const {
  const Paths& paths = frame_.paths;
  PathOfElements out;
  out.delay_s_ = paths.delay_s.at(row);
  out.plane_ = model_.plane_;
  if (model_.plane_) {
    const auto nearer = [](const std::vector<glm::dvec3>& elements, const glm::dvec3& direction) {
      std::vector<double> lengths;
      for (const glm::dvec3& p : elements) lengths.push_back(glm::dot(p, direction));
      return lengths;
    };
    out.sent_m_ = nearer(sent_m_, direction_of(paths.aod_theta_rad[row], paths.aod_phi_rad[row]));
    out.heard_m_ = nearer(heard_m_, direction_of(paths.aoa_theta_rad[row], paths.aoa_phi_rad[row]));
    return out;
  }
  out.path_ = unfolded(row);
  for (const glm::dvec3& p : sent_m_) out.sent_at_.add(out.path_.coordinates(out.path_.sent(tx_m_ + p)));
  for (const glm::dvec3& p : heard_m_) out.heard_at_.push_back(out.path_.coordinates(out.path_.heard(rx_m_ + p)));
  out.centre_ = out.path_.between(out.path_.sent(tx_m_), out.path_.heard(rx_m_));
  return out;
}

}  // namespace wavetracer
