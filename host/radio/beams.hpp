// SPDX-License-Identifier: Apache-2.0
// The gains of the beams of two ends, over the paths between them.
#pragma once
#include <map>
#include <memory>

#include "radio/codebook.hpp"
#include "wavetracer/arrays.hpp"

namespace wavetracer {

class Beams {
 public:
  // Reads each codebook once. Throws ConfigError or InputError.
  explicit Beams(const Config& config);

  // Returns a row for each link of which an end has a codebook, see BeamRows. gain_db: the power of all paths through
  // both beams, as path_gain_db in links.csv with w_rx a w_tx in the place of a (radio/grouped_power.hpp); -inf where
  // nothing arrives.
  BeamRows gains(const ElementModel& model, const FrameResult& frame) const;

 private:
  // The codebooks by name of the array, each once; and that of each end, or null.
  std::map<std::string, Codebook> codebooks_;
  std::vector<const Codebook*> transmitters_, receivers_;

  void find(const Config& config, const std::vector<RadioEnd>& ends, std::vector<const Codebook*>& out);
};

}  // namespace wavetracer
