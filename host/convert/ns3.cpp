// SPDX-License-Identifier: Apache-2.0
// Writes a scenario of ns-3's QdChannelModel (https://github.com/signetlabdei/qd-channel), in the form that its reader
// of NodesPosition.csv parses: a channel between every two nodes, a step per frame; angles are in degrees, phases are
// not.
#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>
#include "base/pending_folder.hpp"
#include "base/times.hpp"
#include "convert/convert.hpp"
#include "radio/link_groups.hpp"
#include "wavetracer/error.hpp"

namespace wavetracer {
namespace {

using Rows = std::vector<uint32_t>;

// Turns radio ends into nodes: a node sends with one transmitter, receives with one receiver, or does both at one
// place. The twins of a mounted antenna must have exactly equal positions, as runs write them.
struct Ns3Node {
  std::string name;
  std::optional<size_t> transmitter, receiver;  // rows among the run's ends
  glm::dvec3 position_m{0};                     // position in the first frame in which it is present
  bool late = false;                            // it is absent in the first frame
};

// The positions of each end in every frame. Twins are found by them, and by name if several share those; velocities are
// not compared, since they follow from the positions.
struct Tracks {
  std::vector<std::vector<glm::dvec3>> transmitters, receivers;
};

Tracks read_tracks(const SavedRun& run, const ExportOptions& options) {
  Tracks tracks{std::vector<std::vector<glm::dvec3>>(run.transmitters().size()),
                std::vector<std::vector<glm::dvec3>>(run.receivers().size())};
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    const SavedFrame frame = run.frame(row);
    for (size_t i = 0; i < tracks.transmitters.size(); ++i)
      tracks.transmitters[i].push_back(frame.transmitter_position_m[i]);
    for (size_t i = 0; i < tracks.receivers.size(); ++i) tracks.receivers[i].push_back(frame.receiver_position_m[i]);
  }
  return tracks;
}

bool absent(const glm::dvec3& p) { return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z); }

bool never_present(const std::vector<glm::dvec3>& track) { return std::ranges::all_of(track, absent); }

bool same_track(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  for (size_t i = 0; i < a.size(); ++i)
    if (!(a[i] == b[i]) && !(absent(a[i]) && absent(b[i]))) return false;
  return true;
}

Ns3Node make_node(const std::string& name, const std::vector<glm::dvec3>& track) {
  Ns3Node node;
  node.name = name;
  node.late = absent(track.front());
  for (const glm::dvec3& position : track)
    if (!absent(position)) {
      node.position_m = position;
      break;
    }
  return node;
}

// Returns transmitters in their order, then the receivers without a transmitter. Ends that are never present are left
// out.
std::vector<Ns3Node> find_nodes(const SavedRun& run, const ExportOptions& options) {
  const Tracks tracks = read_tracks(run, options);
  std::vector<Ns3Node> nodes;
  for (size_t i = 0; i < tracks.transmitters.size(); ++i)
    if (!never_present(tracks.transmitters[i]))
      nodes.emplace_back(make_node(run.transmitters()[i].name, tracks.transmitters[i])).transmitter = i;
  const size_t transmitters = nodes.size();
  for (size_t i = 0; i < tracks.receivers.size(); ++i) {
    if (never_present(tracks.receivers[i])) continue;
    const std::string& name = run.receivers()[i].name;
    Ns3Node* twin = nullptr;
    for (size_t k = 0; k < transmitters; ++k)
      if (!nodes[k].receiver && same_track(tracks.transmitters[*nodes[k].transmitter], tracks.receivers[i]) &&
          (twin == nullptr || nodes[k].name == name))
        twin = &nodes[k];
    if (twin == nullptr) twin = &nodes.emplace_back(make_node(name, tracks.receivers[i]));
    twin->receiver = i;
  }
  return nodes;
}

// Each channel is a file, so the number of files grows as the square of the nodes: file systems cope with about a
// thousand nodes.
constexpr uint64_t most_files = 1'000'000;

void check_files(size_t nodes) {
  const uint64_t files = uint64_t{nodes} * (nodes - 1);
  if (files > most_files)
    throw InputError(
        fmt::format("ns3: {} nodes would be {} files, one for every two of them and direction, "
                    "and at most {} are written: make a run of fewer transmitters and receivers, each of "
                    "which is a node",
                    nodes, files, most_files));
}

double in_degrees(double radians) { return radians * (180 / std::numbers::pi); }

// Returns one line of comma-separated values, each of which reads back as the same double.
template <typename Value>
std::string line(const Rows& rows, Value value) {
  std::string out;
  for (const uint32_t row : rows) out += fmt::format("{}{}", out.empty() ? "" : ",", value(row));
  return out + "\n";
}

// The model computes 10^(gain / 20) exp(j (phase - 2 pi f delay)), so its phase is that of `a`, without the carrier's
// phase. reversed: the same paths followed from the receiver to the transmitter.
std::string step_text(const Paths& paths, const Rows& rows, bool reversed) {
  if (rows.empty()) return "0\n";
  const auto angle = [&](const std::vector<double>& radians) {
    return line(rows, [&](uint32_t row) { return in_degrees(radians[row]); });
  };
  const std::string departure = angle(paths.aod_theta_rad) + angle(paths.aod_phi_rad),
                    arrival = angle(paths.aoa_theta_rad) + angle(paths.aoa_phi_rad);
  return fmt::format("{}\n", rows.size()) + line(rows, [&](uint32_t row) { return paths.delay_s[row]; }) +
         line(rows, [&](uint32_t row) { return 20 * std::log10(std::abs(paths.a[row][0])); }) +
         line(rows, [&](uint32_t row) { return std::arg(paths.a[row][0]); }) +
         (reversed ? arrival + departure : departure + arrival);
}

// The paths between all pairs of nodes in one frame. A coefficient of exactly zero has no gain in decibels and is left
// out.
class FrameLinks {
 public:
  explicit FrameLinks(const Paths& paths) : paths_(paths) {
    LinkGroups groups = group_by_link(paths.tx, paths.rx);
    for (size_t g = 0; g < groups.size(); ++g) {
      const auto rows = groups.rows(g);
      Rows& kept = rows_[{paths.tx[rows[0]], paths.rx[rows[0]]}];
      for (const uint32_t row : rows)
        if (paths.a[row][0] != 0.0) kept.push_back(row);
    }
  }

  // Returns the link from one node to another, or the reverse link if the forward one was not computed.
  std::string text(const Ns3Node& from, const Ns3Node& to, bool forward_known) const {
    return forward_known ? step_text(paths_, rows(from, to), false) : step_text(paths_, rows(to, from), true);
  }

 private:
  Rows rows(const Ns3Node& from, const Ns3Node& to) const {
    if (!from.transmitter || !to.receiver) return {};
    const auto found = rows_.find({*from.transmitter, *to.receiver});
    return found == rows_.end() ? Rows{} : found->second;
  }

  const Paths& paths_;
  std::map<std::pair<size_t, size_t>, Rows> rows_;
};

// Tells, row by row, whether the link from one node to another was computed in any of the frames.
std::vector<bool> known_links(const SavedRun& run, const ExportOptions& options, const std::vector<Ns3Node>& nodes) {
  std::map<size_t, size_t> node_of_tx, node_of_rx;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].transmitter) node_of_tx[*nodes[i].transmitter] = i;
    if (nodes[i].receiver) node_of_rx[*nodes[i].receiver] = i;
  }
  std::vector<bool> known(nodes.size() * nodes.size());
  for (size_t row = options.first_row; row <= options.last_row; ++row)
    for (const Link& link : run.frame(row).links) {
      const auto from = node_of_tx.find(link.tx), to = node_of_rx.find(link.rx);
      if (from != node_of_tx.end() && to != node_of_rx.end()) known[from->second * nodes.size() + to->second] = true;
    }
  return known;
}

double step_s(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  const size_t steps = options.last_row - options.first_row;
  if (steps == 0) {
    warnings.push_back("ns3: one frame is one step, of 1 s");
    return 1;
  }
  // Rounding of time differences.
  const double last_s = run.time_s(options.last_row), rounding_s = 2 * time_spacing_s(last_s);
  const double step = simplest_decimal((last_s - run.time_s(options.first_row)) / static_cast<double>(steps),
                                       rounding_s / static_cast<double>(steps));
  if (!(step > 0)) throw InputError("ns3: the times of the frames do not go up");
  for (size_t row = options.first_row; row < options.last_row; ++row)
    if (std::abs(run.time_s(row + 1) - run.time_s(row) - step) > std::max(1e-6 * step, rounding_s)) {
      warnings.push_back(
          fmt::format("ns3: its steps are of equal length; frames are not, and become steps of {} s", step));
      break;
    }
  return step;
}

std::string parameters(const SavedRun& run, size_t nodes, size_t steps, double step) {
  return fmt::format(
      "ParameterName\tParameterValue\nmobilitySwitch\t1\nmobilityType\t2\nnumberOfNodes\t{}\n"
      "numberOfTimeDivisions\t{}\ntotalTimeDuration\t{}\ncarrierFrequency\t{}\n",
      nodes, steps, static_cast<double>(steps) * step, run.frequency_hz());
}

std::string positions(const std::vector<Ns3Node>& nodes) {
  std::string out;
  for (const Ns3Node& node : nodes)
    out += fmt::format("{},{},{}\n", node.position_m.x, node.position_m.y, node.position_m.z);
  return out;
}

void warn(const SavedRun& run, const std::vector<Ns3Node>& nodes, bool reversed, Warnings& warnings) {
  const auto say = [&](const std::string& text) { warnings.push_back("ns3: " + text); };
  if (run.rx_ports() > 1 || run.tx_ports() > 1)
    say("it knows one polarisation; the first ports of antennas are written (V, or +45 degrees)");
  bool patterns = false;
  for (const auto* ends : {&run.transmitters(), &run.receivers()})
    for (const RadioEnd& end : *ends) patterns = patterns || end.antenna != "isotropic";
  if (patterns) say("gains include the antennas of the run, and ns-3 adds its own; trace with isotropic ones");
  if (reversed) say("links that were computed one way only are written the other way as well, by reciprocity");
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].late)
      say(fmt::format("{} is absent at first; its position is that of its first frame", nodes[i].name));
    for (size_t k = 0; k < i; ++k)
      if (nodes[k].position_m == nodes[i].position_m) {
        say(fmt::format("{} and {} begin at one place, and ns-3 tells nodes apart by that", nodes[k].name,
                        nodes[i].name));
        break;
      }
  }
  if (!run.instances().empty())
    say("QdChannelModel takes all nodes to stand still: their movement and their Doppler shifts show only in the channels, "
        "which change from step to step");
}

}  // namespace

Written export_ns3(const SavedRun& run, const ExportOptions& options, Warnings& warnings) {
  const std::vector<Ns3Node> nodes = find_nodes(run, options);
  if (nodes.size() < 2) throw InputError("ns3: the run has fewer than two nodes, so no channel");
  check_files(nodes.size());
  const std::vector<bool> known = known_links(run, options, nodes);
  const size_t steps = options.last_row - options.first_row + 1;
  const double step = step_s(run, options, warnings);

  PendingFolder folder(options.output);
  folder.append("Input/paraCfgCurrent.txt", parameters(run, nodes.size(), steps, step));
  folder.append("Output/Ns3/NodesPosition/NodesPosition.csv", positions(nodes));
  bool reversed = false;
  for (size_t row = options.first_row; row <= options.last_row; ++row) {
    options.tell(row);
    const SavedFrame frame = run.frame(row);
    const FrameLinks links(frame.paths);
    for (size_t i = 0; i < nodes.size(); ++i)
      for (size_t k = 0; k < nodes.size(); ++k) {
        if (i == k) continue;
        const bool forward = known[i * nodes.size() + k], back = known[k * nodes.size() + i];
        reversed = reversed || (!forward && back);
        folder.append(fmt::format("Output/Ns3/QdFiles/Tx{}Rx{}.txt", i, k),
                      links.text(nodes[i], nodes[k], forward || !back));
      }
  }
  warn(run, nodes, reversed, warnings);
  return {folder.commit()};
}

}  // namespace wavetracer
