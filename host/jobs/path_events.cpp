// SPDX-License-Identifier: Apache-2.0
#include "jobs/path_events.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <tuple>

namespace wavetracer {
namespace {

const LivingPaths& paths_of(const LinksAtTime& all, const Link& link) {
  static const LivingPaths none;
  const auto found = all.find(link);
  return found == all.end() ? none : found->second;
}

bool are_same(const LivingPaths& a, const LivingPaths& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) { return x.first == y.first; });
}

// Bounds of the motion from the beginning of a piece of time, and from its end, to each of some times in it.
class Motions {
 public:
  Motions(const EventDrive& drive, double from_s, double to_s) {
    for (size_t k = 0; k < times; ++k) {
      const double time_s = from_s + static_cast<double>(k) * (to_s - from_s) / (times - 1);
      after_m_[k] = k == 0 ? 0 : drive.motion_m(from_s, time_s);
      before_m_[k] = k == times - 1 ? 0 : drive.motion_m(to_s, time_s);
    }
  }
  // Does a path live all the time, with these lifetimes at the beginning and at the end? It does if one lifetime
  // reaches a time from which on the other one does.
  bool covered(double first_m, double last_m) const {
    for (size_t k = 0; k < times; ++k)
      if (first_m >= after_m_[k] && last_m >= before_m_[k]) return true;
    return false;
  }

 private:
  static constexpr size_t times = 9;
  std::array<double, times> after_m_, before_m_;
};

struct Instant {
  double time_s;
  LinksAtTime links;
};

class EventSearch {
 public:
  EventSearch(const EventDrive& drive, const EventChoice& choice) : drive_(drive), choice_(choice) {}

  Instant at(double time_s, const std::vector<Link>* only) {
    ++out_.instants;
    return {time_s, drive_.paths(time_s, only)};
  }

  // step_s: the step of the drive that the piece of time belongs to.
  void search(const Instant& a, const Instant& b, const std::vector<Link>& links, double step_s) {
    const double middle_s = (a.time_s + b.time_s) / 2, length = (b.time_s - a.time_s) / step_s;
    const Motions motions(drive_, a.time_s, b.time_s);
    std::vector<Link> open;
    for (const Link& link : links) {
      const LivingPaths &first = paths_of(a.links, link), &last = paths_of(b.links, link);
      const bool differ = !are_same(first, last);
      const uint64_t uncovered = uncovered_of(first, last, motions, length);
      if ((differ && length > choice_.precision) || (uncovered > 0 && length > choice_.finest)) {
        open.push_back(link);
        continue;
      }
      out_.unsure += uncovered;
      if (differ) add_events(middle_s, link, first, last);
    }
    if (open.empty()) return;
    const Instant middle = at(middle_s, &open);
    search(a, middle, open, step_s);
    search(middle, b, open, step_s);
  }

  EventList take() {
    std::ranges::sort(out_.events, {}, [](const PathEvent& event) {
      return std::tuple(event.time_s, event.link.tx, event.link.rx, event.path);
    });
    return std::move(out_);
  }

 private:
  // Returns how many paths that are at both ends may have died between.
  uint64_t uncovered_of(const LivingPaths& first, const LivingPaths& last, const Motions& motions, double length) {
    uint64_t count = 0;
    for (const auto& [path, lifetime_m] : first) {
      const auto same = last.find(path);
      if (same == last.end()) continue;
      const bool unknown = lifetime_m == 0 && same->second == 0;
      if (unknown) out_.unbounded += length >= 1.0 / choice_.parts - 1e-9;
      count += !unknown && !motions.covered(lifetime_m, same->second);
    }
    return count;
  }

  void add_events(double time_s, const Link& link, const LivingPaths& first, const LivingPaths& last) {
    for (const auto& [path, lifetime_m] : first)
      if (!last.contains(path)) out_.events.push_back({time_s, link, false, path});
    for (const auto& [path, lifetime_m] : last)
      if (!first.contains(path)) out_.events.push_back({time_s, link, true, path});
  }

  const EventDrive& drive_;
  const EventChoice& choice_;
  EventList out_;
};

// The links that have paths at one of two times.
std::vector<Link> links_of(const Instant& a, const Instant& b) {
  std::vector<Link> out;
  for (const Instant* instant : {&a, &b})
    for (const auto& [link, paths] : instant->links) out.push_back(link);
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

EventList find_events(const EventDrive& drive, const std::vector<double>& times_s, const EventChoice& choice) {
  EventSearch search(drive, choice);
  if (times_s.empty()) return search.take();
  Instant before = search.at(times_s.front(), nullptr);
  for (size_t k = 1; k < times_s.size(); ++k) {
    const double step_s = times_s[k] - times_s[k - 1];
    for (uint32_t part = 1; part <= choice.parts; ++part) {
      const double time_s = part == choice.parts ? times_s[k] : times_s[k - 1] + part * step_s / choice.parts;
      Instant after = search.at(time_s, nullptr);
      search.search(before, after, links_of(before, after), step_s);
      before = std::move(after);
    }
  }
  return search.take();
}

EventDrive drive_of(Simulation& simulation) {
  const auto paths_at = [&simulation](double time_s, const std::vector<Link>* only) {
    FrameResult frame = simulation.run_time(time_s, only);
    const Paths& paths = frame.paths;
    LinksAtTime out;
    for (size_t row = 0; row < paths.size(); ++row) {
      Touched touched;
      for (uint64_t k = paths.vertex_offset[row]; k < paths.vertex_offset[row + 1]; ++k)
        touched.push_back({paths.vertex_interaction[k], paths.vertex_surface[k], paths.vertex_instance[k]});
      out[{paths.tx[row], paths.rx[row]}].emplace(std::move(touched), paths.lifetime_m.at(row));
    }
    simulation.give_back(frame);
    return out;
  };
  return {paths_at, [&simulation](double from_s, double to_s) { return simulation.motion_m(from_s, to_s); }};
}

}  // namespace wavetracer
