// Frames follow each other; blocks share one frame, so its row is taken once and the paths it points to are added up.
#include "jobs/merge_outputs.hpp"
#include <fmt/format.h>
#include <algorithm>
#include <cstring>
#include "output/limited_child.hpp"
#include "output/links_csv.hpp"
#include "output/merge_h5.hpp"
#include "output/packed_rows.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

namespace fs = std::filesystem;
using hdf5::File;

// An output on its way: all that the HDF5 library does to it, before the rows are copied.
struct Draft {
  const H5Output& output;
  std::span<const fs::path> parts;
  bool of_one_frame;
  const WriteHead& write_head;
  PendingFile& file;
  uint32_t compression;

  Pieces tables(const BeginPart& begin) const {
    begin(parts.front());
    File head;
    write_head(output, parts.front(), head);
    const auto groups = of_one_frame ? groups_of_blocks(parts, output.growing_groups, begin)
                                     : growing_groups_of(parts, output.growing_groups, begin);
    return make_tables(file, head, groups, parts.size(), compression);
  }
};

// Pieces as bytes: of each part their number, then they themselves.
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
  write_rows(draft.parts, pieces, draft.file, draft.compression);
  draft.file.sync();
  if (proof == Proof::rows) prove_rows(draft.parts, pieces, draft.file.temporary());
}

}  // namespace

std::vector<PendingFile> merge_outputs(const Config& config, const MergeParts& parts, Parts whose, Proof proof,
                                       const fs::path& directory, const WriteHead& write_head) {
  std::vector<PendingFile> files;
  const std::vector<H5Output> outputs = h5_outputs(config);
  for (size_t i = 0; i < outputs.size(); ++i) {
    PendingFile& file = files.emplace_back(directory / outputs[i].name);
    merge_h5({outputs[i], parts.files.at(i), parts.of_one_frame, write_head, file, config.output.compression}, whose,
             proof);
  }
  join_links_csv(parts.files.at(outputs.size()), files.emplace_back(directory / "links.csv"));
  files.back().sync();
  if (proof == Proof::rows) prove_links_csv(parts.files.at(outputs.size()), files.back().temporary());
  return files;
}

}  // namespace wavetracer
