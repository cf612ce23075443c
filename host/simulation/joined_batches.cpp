// SPDX-License-Identifier: Apache-2.0
// Rows of a transmitter are those of the batches in their order, since batches are ranges of receivers.
#include "simulation/joined_batches.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <utility>

#include "radio/summed_paths.hpp"

namespace wavetracer {
namespace {

// Rows first to end - 1 of a batch.
struct Piece {
  const FrameResult* batch;
  size_t first, end;
};

// The rows of all batches in their order: transmitter by transmitter, and batch after batch.
std::vector<Piece> pieces_of(const std::vector<FrameResult>& batches) {
  std::vector<Piece> out;
  std::vector<size_t> next(batches.size(), 0);  // next row of each batch
  for (uint32_t tx = 0; tx < batches.front().world.transmitters.size(); ++tx)
    for (size_t i = 0; i < batches.size(); ++i) {
      const std::vector<uint32_t>& column = batches[i].paths.tx;
      const size_t first = next[i];
      next[i] = static_cast<size_t>(std::upper_bound(column.begin(), column.end(), tx) - column.begin());
      if (next[i] > first) out.push_back({&batches[i], first, next[i]});
    }
  return out;
}

// Joins columns, each in a task of its own. Columns that a batch lacks stay empty.
class Columns {
 public:
  explicit Columns(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}

  // to: the joined column; column: returns that of a batch.
  template <class T, class Column>
  void rows(std::vector<T>& to, const Column& column) {
    join(to, column, [](const Piece& piece) { return std::pair(piece.first, piece.end); });
  }
  template <class T>
  void rows(Paths& to, std::vector<T> Paths::*column) {
    rows(to.*column, [column](const FrameResult& batch) -> const std::vector<T>& { return batch.paths.*column; });
  }
  // The same for a column with an entry for each vertex.
  template <class T>
  void vertices(Paths& to, std::vector<T> Paths::*column) {
    join(
        to.*column, [column](const FrameResult& batch) -> const std::vector<T>& { return batch.paths.*column; },
        [](const Piece& piece) {
          const std::vector<uint64_t>& offset = piece.batch->paths.vertex_offset;
          return std::pair<size_t, size_t>(offset[piece.first], offset[piece.end]);
        });
  }
  void vertex_offsets(Paths& to) {
    tasks_.run([this, &to] {
      for (const auto& [batch, first, end] : pieces_) {
        const std::vector<uint64_t>& from = batch->paths.vertex_offset;
        const uint64_t before = from[first], start = to.vertex_offset.back();
        for (size_t row = first; row < end; ++row) to.vertex_offset.push_back(start + from[row + 1] - before);
      }
    });
  }
  void wait() { tasks_.wait(); }

 private:
  template <class T, class Column, class Range>
  void join(std::vector<T>& to, const Column& column, const Range& range) {
    tasks_.run([this, &to, column, range] {
      size_t size = 0;
      for (const Piece& piece : pieces_) {
        const auto [first, end] = range(piece);
        if (!column(*piece.batch).empty()) size += end - first;
      }
      to.reserve(size);
      for (const Piece& piece : pieces_) {
        const std::vector<T>& from = column(*piece.batch);
        const auto [first, end] = range(piece);
        if (!from.empty())
          to.insert(to.end(), from.begin() + static_cast<ptrdiff_t>(first), from.begin() + static_cast<ptrdiff_t>(end));
      }
    });
  }

  std::vector<Piece> pieces_;
  tbb::task_group tasks_;
};

Paths joined_paths(const std::vector<FrameResult>& batches) {
  static_assert(sizeof(Paths) == 8 + 22 * sizeof(std::vector<int>), "join the column that is new here, too");
  Paths out;
  out.rx_ports = batches.front().paths.rx_ports;
  out.tx_ports = batches.front().paths.tx_ports;
  Columns columns(pieces_of(batches));
  for (auto column : {&Paths::frame, &Paths::tx, &Paths::rx, &Paths::depth}) columns.rows(out, column);
  for (auto column : {&Paths::delay_s, &Paths::gain_db, &Paths::aod_theta_rad, &Paths::aod_phi_rad,
                      &Paths::aoa_theta_rad, &Paths::aoa_phi_rad, &Paths::doppler_hz})
    columns.rows(out, column);
  columns.rows(out, &Paths::a);
  columns.rows(out, &Paths::quarters);
  columns.rows(out, &Paths::target);
  columns.rows(out, &Paths::group);
  columns.rows(out, &Paths::group_weight);
  columns.rows(out, &Paths::lifetime_m);
  columns.vertex_offsets(out);
  columns.vertices(out, &Paths::vertex_position_m);
  columns.vertices(out, &Paths::vertex_interaction);
  columns.vertices(out, &Paths::vertex_surface);
  columns.vertices(out, &Paths::vertex_instance);
  columns.wait();
  return out;
}

std::vector<CarrierFields> joined_carriers(const std::vector<FrameResult>& batches) {
  std::vector<CarrierFields> out(batches.front().carriers.size());
  Columns columns(pieces_of(batches));
  for (size_t k = 0; k < out.size(); ++k) {
    out[k].frequency_hz = batches.front().carriers[k].frequency_hz;
    const auto rows = [&](auto CarrierFields::*column) {
      columns.rows(
          out[k].*column, [ k, column ](const FrameResult& batch) -> const auto& { return batch.carriers[k].*column; });
    };
    rows(&CarrierFields::a);
    rows(&CarrierFields::gain_db);
    rows(&CarrierFields::doppler_hz);
  }
  columns.wait();
  return out;
}

void add_counts(FrameResult& to, const FrameResult& from) {
  add(to.counts, from.counts);
  add_part(to.certificate, from.certificate);
  to.left_out_at_edges = std::max(to.left_out_at_edges, from.left_out_at_edges);
  for (const auto& [stage, seconds] : from.seconds) to.seconds[stage] += seconds;
  for (const auto& [name, kernel] : from.kernels) {
    to.kernels[name].seconds += kernel.seconds;
    to.kernels[name].launches += kernel.launches;
    to.kernels[name].items += kernel.items;
  }
  to.segments_per_depth.resize(std::max(to.segments_per_depth.size(), from.segments_per_depth.size()));
  for (size_t i = 0; i < from.segments_per_depth.size(); ++i) to.segments_per_depth[i] += from.segments_per_depth[i];
  for (const std::string& warning : from.warnings)
    if (std::ranges::find(to.warnings, warning) == to.warnings.end()) to.warnings.push_back(warning);
}

}  // namespace

std::vector<LinkFigures> JoinedBatches::add(FrameResult batch) {
  std::vector<LinkFigures> room;
  if (batch.summed) {
    place(*batch.summed);
    room = std::move(batch.summed->links);
  }
  batch.world.links = std::vector<Link>();  // the frame has them all
  batches_.push_back(std::move(batch));
  return room;
}

void JoinedBatches::place(const SummedPaths& part) {
  if (!summed_) summed_ = SummedPaths{.links = sized_figures(std::exchange(room_, {}), links_.size())};
  for (auto first = part.links.begin(); first != part.links.end();) {
    const auto end = std::ranges::upper_bound(first, part.links.end(), first->tx, {}, &LinkFigures::tx);
    const auto count = static_cast<size_t>(end - first);
    const auto to =
        summed_->links.begin() + (std::ranges::lower_bound(links_, Link{first->tx, first->rx}) - links_.begin());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 4096), [&](const tbb::blocked_range<size_t>& rows) {
      const auto row = [](const auto& list, size_t i) { return list + static_cast<ptrdiff_t>(i); };
      std::copy(row(first, rows.begin()), row(first, rows.end()), row(to, rows.begin()));
    });
    first = end;
  }
  for (size_t kind = 0; kind < summed_->kinds.size(); ++kind) summed_->kinds[kind] += part.kinds[kind];
  summed_->power += part.power;
}

FrameResult JoinedBatches::joined() {
  FrameResult out;
  out.frame = batches_.front().frame;
  out.paths = joined_paths(batches_);
  out.carriers = joined_carriers(batches_);
  out.summed = std::move(summed_);
  for (const FrameResult& batch : batches_) add_counts(out, batch);
  const auto any = [&](uint64_t MissedCounts::*frames) {
    return std::ranges::any_of(batches_, [&](const FrameResult& batch) { return batch.missed.*frames > 0; });
  };
  if (any(&MissedCounts::unknown)) {
    out.missed.unknown = 1;
    out.paths.quarters.clear();
  } else if (out.summed) {
    for (const FrameResult& batch : batches_) add_part(out.missed, batch.missed);
  } else if (any(&MissedCounts::frames)) {
    out.missed = missed_counts(out.paths, 0, out.paths.size());
  }
  out.world = std::move(batches_.front().world);
  out.world.links = std::move(links_);
  return out;
}

}  // namespace wavetracer
