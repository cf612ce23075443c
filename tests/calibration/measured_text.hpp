// SPDX-License-Identifier: Apache-2.0
// Tables of measured values as texts.
#pragma once
#include <string>
#include "calibration/measured.hpp"
#include "temporary_folder.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer::test {

// Reads a text as the file m.csv.
inline calibration::MeasuredFile read_text(const std::string& text, const calibration::MeasuredOptions& options = {}) {
  const TemporaryFolder folder;
  return calibration::read_measured(folder.write("m.csv", text), options);
}

// Returns the error of a text; empty if it is read.
inline std::string mistake(const std::string& text, const calibration::MeasuredOptions& options = {}) {
  try {
    read_text(text, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace wavetracer::test
