// SPDX-License-Identifier: Apache-2.0
// A unit is finished once a manifest lists it: files alone may have been left by a killed process.
// Half of the cores compress, at the lowest priority; the host's part of a frame on a GPU takes one or two.
#include "jobs/merge_ahead.hpp"
#include <tbb/info.h>
#include <algorithm>

namespace wavetracer {

namespace fs = std::filesystem;

MergeAhead::MergeAhead(const Config& config, const Units& units, fs::path directory)
    : outputs_(h5_outputs(config)),
      compression_(config.output.compression),
      units_(units),
      directory_(std::move(directory)),
      lines_(directory_ / "shards") {}

void MergeAhead::look() noexcept {
  if (state_ != State::following) return;
  try {
    for (const Shard& shard : lines_.read()) {
      std::vector<std::string>& names = finished_[shard.unit.first];
      names.clear();
      for (const ShardFile& file : shard.files) names.push_back(file.name);
    }
    for (; next_ < units_.count(); ++next_) {
      const auto found = finished_.find(units_.at(next_).first);
      if (found == finished_.end()) break;
      take(found->second);
    }
    if (next_ < units_.count()) finished_.erase(finished_.begin(), finished_.lower_bound(units_.at(next_).first));
  } catch (const std::exception&) {
    state_ = State::failed;
  }
}

void MergeAhead::take(const std::vector<std::string>& files) {
  if (ahead_.empty()) {
    threads_ = std::make_unique<IdleThreads>(std::max(1, tbb::info::default_concurrency() / 2));
    for (const H5Output& output : outputs_)
      ahead_.push_back(std::make_unique<OutputAhead>(output, *threads_,
                                                     directory_ / (std::string(output.name) + ".ahead"), compression_));
  }
  for (size_t i = 0; i < ahead_.size(); ++i) {
    GrowingParts& parts = ahead_[i]->parts;
    parts.add(directory_ / "shards" / files.at(i));
    ahead_[i]->chunks.grow(parts.groups(), parts.parts());
  }
}

size_t MergeAhead::chunks() const {
  size_t count = 0;
  for (const auto& output : ahead_) count += output->chunks.count();
  return count;
}

OutputAhead* MergeAhead::of(size_t output, std::span<const fs::path> parts) {
  if (threads_) threads_->stop();
  if (state_ == State::failed) return nullptr;
  state_ = State::merging;
  if (output >= ahead_.size()) return nullptr;
  const std::vector<fs::path>& known = ahead_[output]->parts.parts();
  const bool same = known.size() <= parts.size() && std::ranges::equal(known, parts.first(known.size()));
  return same ? ahead_[output].get() : nullptr;
}

}  // namespace wavetracer
