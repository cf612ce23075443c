// SPDX-License-Identifier: Apache-2.0
// Frames follow each other; blocks share one frame, so its row is taken once and the paths that it points to are added
// up. Disk syncs and the text of the links run beside the rest, which is limited by HDF5's one thread.
#include "jobs/merge_outputs.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include <future>
#include <utility>
#include "output/limited_child.hpp"
#include "output/links_csv.hpp"
#include "output/merge_h5.hpp"
#include "output/packed_rows.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using hdf5::File;

// Runs work in a thread of its own; wait() rethrows its exception.
class Beside {
 public:
  template <typename Work>
  explicit Beside(Work work) : done_(std::async(std::launch::async, std::move(work))) {}
  void wait() { done_.get(); }

 private:
  std::future<void> done_;  // its destructor waits, too
};

// An output in progress: all calls of the HDF5 library, before the rows are copied.
struct Draft {
  const H5Output& output;
  std::span<const fs::path> parts;
  bool of_one_frame;
  const WriteHead& write_head;
  PendingFile& file;
  uint32_t compression;
  OutputAhead* ahead;  // prepared for the first parts, or null

  Pieces tables(const BeginPart& begin) const {
    begin(parts.front());
    File head;
    write_head(output, parts.front(), head);
    if (ahead) {
      for (const fs::path& part : parts.subspan(ahead->parts.parts().size())) ahead->parts.add(part);
      return make_tables(file, head, ahead->parts.groups(), parts.size(), compression);
    }
    const auto groups = of_one_frame ? groups_of_blocks(parts, output.growing_groups, begin)
                                     : growing_groups_of(parts, output.growing_groups, begin);
    return make_tables(file, head, groups, parts.size(), compression);
  }
};

// Sends pieces as bytes: for each part the number of its pieces, then the pieces.
void send(const Pieces& pieces, LimitedChild::Reply& reply) {
  for (const std::vector<Piece>& of_part : pieces) {
    const uint64_t count = of_part.size();
    reply.send(&count, sizeof count);
    reply.send(of_part.data(), count * sizeof(Piece));
  }
}

Pieces pieces_in(std::string_view bytes) {
  Pieces pieces;
  const auto take = [&bytes](void* to, uint64_t count, size_t size) {
    if (count > bytes.size() / size) throw RuntimeError("the process that reads the parts ended its answer too early");
    std::memcpy(to, bytes.data(), count * size);
    bytes.remove_prefix(count * size);
  };
  while (!bytes.empty()) {
    uint64_t count = 0;
    take(&count, 1, sizeof count);
    std::vector<Piece>& of_part = pieces.emplace_back(std::min<uint64_t>(count, bytes.size() / sizeof(Piece)));
    take(of_part.data(), count, sizeof(Piece));
  }
  return pieces;
}

Pieces foreign_tables(const Draft& draft) {
  LimitedChild child(draft.parts.front().string(), [&](std::string_view, LimitedChild::Reply& reply) {
    send(draft.tables([&reply](const fs::path& part) { reply.at_file(part.string()); }), reply);
  });
  return pieces_in(child.request("tables"));
}

void merge_h5(const Draft& draft, Parts whose, Proof proof) {
  const Pieces pieces = whose == Parts::own ? draft.tables([](const fs::path&) {}) : foreign_tables(draft);
  const PackedAhead* const chunks = draft.ahead ? &draft.ahead->chunks : nullptr;
  write_rows(draft.parts, pieces, draft.file, draft.compression, chunks);
  Beside synced([&] { draft.file.sync(); });
  if (proof == Proof::rows) prove_rows(draft.parts, pieces, draft.file.temporary(), chunks);
  synced.wait();
}

void merge_links_csv(std::span<const fs::path> parts, Proof proof, PendingFile& file, const ReadLinks& read) {
  join_links_csv(parts, file);
  Beside was_read([&] { read(file.temporary()); });
  Beside synced([&] { file.sync(); });
  if (proof == Proof::rows) prove_links_csv(parts, file.temporary());
  synced.wait();
  was_read.wait();
}

}  // namespace

std::vector<PendingFile> merge_outputs(const Config& config, const MergeParts& parts, Parts whose, Proof proof,
                                       const fs::path& directory, const WriteHead& write_head, MergeAhead* ahead,
                                       const ReadLinks& read_links) {
  const std::vector<H5Output> outputs = h5_outputs(config);
  std::vector<PendingFile> files;
  for (const H5Output& output : outputs) files.emplace_back(directory / output.name);
  PendingFile& csv = files.emplace_back(directory / "links.csv");
  Beside links([&] { merge_links_csv(parts.files.at(outputs.size()), proof, csv, read_links); });
  for (size_t i = 0; i < outputs.size(); ++i)
    merge_h5({outputs[i], parts.files.at(i), parts.of_one_frame, write_head, files[i], config.output.compression,
              ahead ? ahead->of(i, parts.files.at(i)) : nullptr},
             whose, proof);
  links.wait();
  return files;
}

}  // namespace wavetracer
