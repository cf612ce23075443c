// SPDX-License-Identifier: Apache-2.0
// The elements of the two ends of a link in a frame, and its paths between every two of them.
#pragma once
#include <span>
#include <vector>

#include "radio/unfolded_path.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer {

// Values of a path between two elements.
struct ElementPair {
  double delay_s;
  double amplitude;  // relative to that between the centres
};

// A path between all elements.
class PathOfElements {
 public:
  ElementPair between(size_t rx_element, size_t tx_element) const;
  // The same for transmitting elements first to first + count - 1.
  void between(size_t rx_element, size_t first, size_t count, double* delay_s, double* amplitude) const;

 private:
  friend class ElementLink;
  double delay_s_ = 0;  // between the centres
  bool plane_ = false;
  std::vector<double> sent_m_, heard_m_;  // plane: how much nearer elements are than the centres
  PointColumns sent_at_;                  // spherical: images of elements, in the path's coordinates
  std::vector<glm::dvec3> heard_at_;
  UnfoldedPath path_;
  PathSpread centre_{1, 1};
};

class ElementLink {
 public:
  // All arguments must outlive it. Throws std::out_of_range for ends that the frame does not have.
  ElementLink(const ElementModel& model, const FrameResult& frame, Link link);

  uint32_t tx_elements() const { return static_cast<uint32_t>(sent_m_.size()); }
  uint32_t rx_elements() const { return static_cast<uint32_t>(heard_m_.size()); }
  uint32_t tx_ports() const { return tx_ports_; }
  uint32_t rx_ports() const { return rx_ports_; }
  // Rows first_row() to end_row() - 1 of the frame's paths are those of the link.
  size_t first_row() const { return first_row_; }
  size_t end_row() const { return end_row_; }
  PathOfElements path(size_t row) const;

 private:
  UnfoldedPath unfolded(size_t row) const;

  const ElementModel& model_;
  const FrameResult& frame_;
  glm::dvec3 tx_m_, rx_m_;                    // centres, recentred
  std::vector<glm::dvec3> sent_m_, heard_m_;  // elements relative to their centres, in scene axes
  uint32_t tx_ports_, rx_ports_;
  size_t first_row_, end_row_;
};

}  // namespace wavetracer
