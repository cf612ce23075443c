// SPDX-License-Identifier: Apache-2.0
// The largest gains of antennas.
#pragma once
#include <vector>

#include "radio/field_tables.hpp"

namespace wavetracer {

// For each record of tables.antennas: a bound of the sum of the gains of its ports over isotropic in any direction, a
// ratio. Samples of a file are interpolated linearly, so none is exceeded between them.
std::vector<double> most_powers(const FieldTables& tables);

}  // namespace wavetracer
