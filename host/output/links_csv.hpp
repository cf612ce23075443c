// SPDX-License-Identifier: Apache-2.0
// Writes links.csv: one row per frame and link, including links without a path.
// RFC 4180 with a header row and "\n" line ends; numbers are the shortest text that reads back to the same double.
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include "base/pending_file.hpp"
#include "wavetracer/output.hpp"

namespace wavetracer {

// tx and rx are the names of the config, or the row number if a name is empty. A link without a path has a gain of
// "-inf", and "nan" as delay, Doppler and missed figures. los is 1 or 0. docs/formats.md defines every column.
class LinksCsv {
 public:
  LinksCsv(const Run& run, const std::filesystem::path& path);
  // written: for each path of the frame, whether paths.h5 has it.
  void add(const FrameResult& frame, std::span<const uint8_t> written);
  // Returns the file, synced but not in place. Nothing can be added afterwards.
  PendingFile finish();

 private:
  // Returns the rows of these links of the frame, at least one.
  std::string rows(const FrameResult& frame, std::span<const LinkFigures> links,
                   std::span<const uint8_t> written) const;

  PendingFile file_;
  RadioConfig radio_;
  SharedList<RadioEnd> tx_, rx_;  // only their names count
};

// Joins the rows of all parts, each written by LinksCsv, under one header. Throws RuntimeError.
void join_links_csv(std::span<const std::filesystem::path> parts, PendingFile& file);

// Throws RuntimeError unless `file` has exactly the content that join_links_csv() makes of the parts.
void prove_links_csv(std::span<const std::filesystem::path> parts, const std::filesystem::path& file);

}  // namespace wavetracer
