// join: every path of ends that send and receive is met in the middle, against the image method with all sequences
// listed; nothing is joined for links that are not wanted or ends that do not launch.
#include "passes/join.hpp"

#include <doctest/doctest.h>

#include "passes/exact.hpp"
#include "passes/sort.hpp"
#include "reference/quads.hpp"

using namespace wavetracer;
using namespace wavetracer::test;

namespace {

using Key = std::pair<Sequence, uint32_t>;

struct Met {
  std::set<Key> solved;
  uint32_t joined = 0;
};

// All prefixes of half the depth from every end, joined and solved. Ends are transmitter i and receiver i.
Met meet(const std::vector<reference::Quad>& quads, const std::vector<glm::dvec3>& ends, uint32_t max_depth,
         const std::vector<uint32_t>& receiver_of_transmitter) {
  const DeviceScene scene = make_device_scene(context(), reference::scene_of_quads(quads), false, 20);
  const RadioEnds radio = standing_ends(ends, ends);
  const auto count = static_cast<uint32_t>(ends.size());
  Sequences set(context(), 1 << 16);
  enter(set, scene, all_sequences(count, static_cast<uint32_t>(quads.size()), joined_depth(max_depth)),
        joined_depth(max_depth));
  const uint32_t node_count = set.collect(count);
  Join join(context(), receiver_of_transmitter, max_depth);
  PrefixList& list = join.prefixes(scene, radio, set.table(), set.nodes(), node_count);
  Sort sort(context());
  auto temporary = context().buffer<uint32_t>(sort.temporary_words(list.count), "sort");
  sort(list.keys, list.order, list.count, temporary, Join::key_bits(scene));
  auto candidates = context().buffer<wt_candidate>(16, "candidates");  // it must grow
  Met out;
  out.joined = join(scene, radio, set.nodes(), candidates, 0, set.counters());
  Solve solve(context(), max_depth);
  const SolvedList& solved = solve(scene, radio, set.table(), set.quarters(), candidates, out.joined, set.counters());
  if (solved.count == 0) return out;
  const auto headers = solved.headers.read(0, solved.count);
  const auto surfaces = solved.sequences.read(0, size_t{solved.count} * max_depth);
  for (size_t i = 0; i < headers.size(); ++i) {
    CHECK(headers[i].node == WT_NONE);
    const auto* first = &surfaces[i * max_depth];
    out.solved.insert({{headers[i].transmitter, {first, first + headers[i].depth}}, headers[i].receiver});
  }
  return out;
}

// The same by listing all sequences; only those of three surfaces and more, which is what is joined.
std::set<Key> listed(const std::vector<reference::Quad>& quads, const std::vector<glm::dvec3>& ends,
                     uint32_t max_depth) {
  const auto count = static_cast<uint32_t>(ends.size());
  const Exact exact(reference::scene_of_quads(quads), ends, ends,
                    all_sequences(count, static_cast<uint32_t>(quads.size()), max_depth), max_depth);
  std::set<Key> out;
  for (const SolvedPath& path : exact.solved)
    if (path.sequence.surfaces.size() >= 3) out.insert({path.sequence, path.receiver});
  return out;
}

const std::vector<reference::Quad> room = reference::box_walls({0, 0, 0}, {5, 4, 3});
const std::vector<glm::dvec3> three_ends{{1, 1.1, 1.3}, {4.2, 3.1, 0.7}, {2.3, 0.4, 2.2}};

}  // namespace

TEST_CASE("all paths of three and more interactions are met in the middle") {
  for (const uint32_t depth : {3u, 4u, 5u}) {
    CAPTURE(depth);
    const std::set<Key> wanted = listed(room, three_ends, depth);
    CHECK(wanted.size() > 100);
    CHECK(meet(room, three_ends, depth, {0, 1, 2}).solved == wanted);
  }
}

TEST_CASE("ends that do not launch are not met") {
  const Met met = meet(room, three_ends, 3, {0, WT_NONE, 2});
  CHECK(!met.solved.empty());
  for (const Key& key : met.solved) CHECK(key.second != 1);
}

TEST_CASE("a depth of two leaves nothing to join") { CHECK(meet(room, three_ends, 2, {0, 1, 2}).joined == 0); }
