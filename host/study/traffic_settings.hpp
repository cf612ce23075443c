// SPDX-License-Identifier: Apache-2.0
// Names of the settings that figures in traffic compare, as compared_caches.hpp makes them.
#pragma once
#include <string>

namespace wavetracer::study {

inline const std::string none = "no cache", position_uniform = "position uniform", position_morton = "position Morton",
                         position_mixed = "position mixed", precision_uniform = "precision 0.0125 uniform",
                         precision_morton = "precision 0.0125 Morton", precision_mixed = "precision 0.0125 mixed",
                         precision_of_errors = "precision 0.093 mixed";
inline std::string unsorted(const std::string& setting) { return "unsorted " + setting; }
inline std::string printed(const std::string& setting) { return "printed " + setting; }

}  // namespace wavetracer::study
