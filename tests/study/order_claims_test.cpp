// SPDX-License-Identifier: Apache-2.0
// Tests the paragraphs on rows whose gains are known in advance.
// Factors are chosen so that the results and their order are known by hand.
#include "study/order_claims.hpp"
#include <doctest/doctest.h>
#include <cmath>
#include <functional>
#include "contains.hpp"
#include "study/made_order_rows.hpp"
#include "study/run.hpp"
#include "study/squeezed.hpp"

using namespace wavetracer::study;

namespace {

std::string text_of(const Words& words) { return squeezed(words_text(words)); }

// A million times the seconds: WS 300 whatever its shape, born ordered 60, the others by the factors given; the
// sort 25.
Cost costs(double h3dh, double z) {
  return [h3dh, z](const Series& s, uint64_t) {
    if (s.directions == "hilbert") return std::pair{60e-6, 0.0};
    if (s.method == "none") return std::pair{s.shape == "3d" ? 240e-6 : 300e-6, 0.0};
    const double factor = s.method == "morton" ? z : s.method == "morton-histogram" ? h3dh * 0.99 : h3dh * 0.9;
    return std::pair{300e-6 / (s.method == "hilbert3d-histogram" && s.shape == "1d" ? h3dh : factor), 25e-6};
  };
}

}  // namespace

TEST_CASE("figure-6.1: claims reached and the expected ranks") {
  const Experiment& experiment = find_experiment("figure-6.1");
  const auto rows = made_rows(experiment, {1000, 49000, 1000000}, costs(3, 2));
  const std::string text = text_of(order_words(experiment, rows, "the device"));
  CAPTURE(text);
  // 300 / 100 = 3; 300 / 125 = 2.4
  CHECK(contains(text,
                 "| order | 1,000 rays: sort once | in each frame | 49,000 rays: sort once | in each "
                 "frame | 1,000,000 rays: sort once | in each frame |"));
  CHECK(contains(text, "| H3DH | 3.00 | 2.40 | 3.00 | 2.40 | 3.00 | 2.40 |"));
  CHECK(contains(
      text,
      "| H3DH takes 23% less time than WS at 1,000 rays | exceeded | 16 bins, sort not paid: yes at 1,000 rays "
      "(a factor of 3.00); 16 bins, sort paid: yes at 1,000 rays (a factor of 2.40); 32 bins, "));
  CHECK(contains(
      text,
      "| H3DH is 2.5 times as fast as WS at 49,000 rays | in part | 16 bins, sort not paid: yes at 49,000 rays "
      "(a factor of 3.00); 16 bins, sort paid: no at 49,000 rays (a factor of 2.40); 32 bins, "));
  // The fastest first, those without a sort with two equal numbers.
  const size_t born = text.find("| born ordered | 5.00 | 5.00 | 5.00 | 5.00 | 5.00 | 5.00 |\n"),
               h3dh = text.find("| H3DH | 3.00"), hz = text.find("| HZ | 2.97");
  CHECK(born < h3dh);
  CHECK(h3dh < hz);
  CHECK(hz != std::string::npos);
  CHECK(contains(
      text,
      "| H3DH and HZ are the fastest of the six orders | reproduced | 16 bins, sort not paid: yes at 1,000,000 "
      "rays (a factor of 1.10); 16 bins, sort paid: "));
  CHECK(contains(
      text,
      "| WS is the slowest, at every number of rays | reproduced | 16 bins, sort not paid: yes at 1,000,000 rays"));
  CHECK(contains(text, "| refuted | no at 1,000,000 rays (a factor of 1.25) |"));  // WS in three dimensions: 300 / 240
}

TEST_CASE("figure-6.1: claims not reached, other ranks, counts not measured") {
  const Experiment& experiment = find_experiment("figure-6.1");
  const auto rows = made_rows(experiment, {1000, 2000}, costs(1.01, 1.2));
  const std::string text = text_of(order_words(experiment, rows, "the device"));
  CAPTURE(text);
  // 300 / (300 / 1.01 + 25) = 0.9316
  CHECK(contains(text, "| order | 1,000 rays: sort once | in each frame | 2,000 rays: sort once | in each frame |\n"));
  CHECK(contains(text, "| H3DH | 1.01 | 0.93 | 1.01 | 0.93 |"));
  CHECK(contains(
      text,
      "at 1,000 rays | refuted | 16 bins, sort not paid: no at 1,000 rays (a factor of 1.01); 16 bins, sort paid: "
      "no at 1,000 rays (a factor of 0.93); 32 bins, "));
  const std::string there = "not measured there | measured from 1,000 to 2,000 rays |";
  CHECK(contains(text, "| H3DH is 2.5 times as fast as WS at 49,000 rays | " + there));
  CHECK(contains(text, "| H3DH2DH is not slower than Z up to 50,000,000 rays | " + there));
  CHECK(contains(text, "| WS is the slowest, at every number of rays | " + there));
}

TEST_CASE("figure-6.18: averages over frames") {
  const Experiment& experiment = find_experiment("figure-6.18");
  const std::string text =
      text_of(order_words(experiment, made_rows(experiment, {49000}, costs(2.5, 1)), "the device"));
  CAPTURE(text);
  CHECK(contains(text, "Measured on the device, averaged over 20 frames of traffic whose transmitters move."));
  CHECK(contains(text, "| H3DH | 2.50 | 2.07 |"));
  CHECK(contains(
      text,
      "at 49,000 rays | undecided | 16 bins, sort not paid: undecided at 49,000 rays (a factor of 2.50); 16 bins, sort "
      "paid: no "));
  CHECK(contains(text,
                 "| H3DH takes 23% less time than WS at 1,000 rays | not measured there | measured at 49,000 rays |"));
}

TEST_CASE("numbers have no exponents, tables are aligned") {
  CHECK(plain(0) == "0");
  CHECK(plain(2.3e-6) == "less than 0.001");
  CHECK(plain(-2.3e-6) == "-0.001 to 0");
  CHECK(plain(0.0123456) == "0.0123");
  CHECK(plain(1.23456) == "1.23");
  CHECK(plain(123456.7) == "123457");
  CHECK(plain(12.3456, 2) == "12");
  CHECK(plain(std::nan("")) == "undefined");
  CHECK(plain(INFINITY) == "infinite");
  CHECK(markdown({"Numbers:", {"a", "b"}, {{"long cell", "1"}, {"x|y", "22"}}}) ==
        "Numbers:\n\n| a         | b   |\n| --------- | --- |\n| long cell | 1   |\n| x\\|y      | 22  |");
  CHECK(words_text({"A sentence.", {}, {}}) == "A sentence.");
}

TEST_CASE("a row that is not there is not found") {
  const Experiment& experiment = find_experiment("figure-6.18");
  const auto rows = made_rows(experiment, {1000}, costs(2, 2));
  CHECK(find_row(rows, unordered(), 1000) == &rows[0]);
  CHECK(find_row(rows, unordered(), 2000) == nullptr);
  CHECK(find_row(rows, ordered("morton"), 1000) == nullptr);
}

TEST_CASE("the reason: what the device takes for a few rays already") {
  const Experiment& experiment = find_experiment("figure-6.18");
  const auto with = [&](double few, double many) {
    const auto rows = made_rows(experiment, {1000, 49000}, [&](const Series&, uint64_t rays) {
      return std::pair{rays == 1000 ? few : many, 0.0};
    });
    return text_of(order_words(experiment, rows, "the device"));
  };
  CHECK(contains(with(220e-6, 245e-6), "WS takes 90% of its time at 49,000 rays at 1,000 already, which is what"));
  CHECK(contains(with(30e-6, 300e-6), "WS takes 10% of its time at 49,000 rays at 1,000 already, so most"));
  CHECK(order_fields(made_rows(experiment, {1000, 2000}, costs(2, 2)), "a").at("reason").empty());
}

namespace {

// Rows of figure 6.1 whose orders take the seconds that `time` gives, without the sort.
std::vector<OrderRow> rows_with(const std::vector<uint64_t>& rays,
                                const std::function<double(const std::string& method, uint64_t)>& time) {
  return made_rows(find_experiment("figure-6.1"), rays, [&](const Series& series, uint64_t count) {
    return std::pair{time(series.method, count), 0.0};
  });
}

// Returns "yes no": the answers with the sort not paid at each number of rays.
std::string answers(const Judge<OrderRow>& judge, const std::vector<OrderRow>& rows) {
  std::string text;
  for (const CaseAnswer& one : judge(rows).all) {
    if (one.group == "sort paid") continue;
    const char* word = one.answer == Answer::no ? "no" : one.answer == Answer::undecided ? "undecided" : "yes";
    text += (text.empty() ? "" : " ") + std::string(word);
  }
  return text;
}

}  // namespace

TEST_CASE("an order that is no slower than another one, number by number") {
  const auto slow_beyond = [](uint64_t bound) {
    return [bound](const std::string& method, uint64_t rays) { return method == "morton" && rays > bound ? 2.0 : 1.0; };
  };
  const Judge<OrderRow> judge = no_slower("morton", "hilbert3d-histogram");
  CHECK(answers(judge, rows_with({1000, 20000, 50000}, slow_beyond(20000))) == "yes yes no");
  CHECK(answers(judge, rows_with({1000}, [](const std::string& method, uint64_t) {
                  return method == "morton" ? 1.05 : 1.0;
                })) == "undecided");
}

TEST_CASE("claims are judged for each number of bins") {
  const std::vector<OrderRow> rows =
      made_rows(find_experiment("figure-6.1"), {49000}, [](const Series& series, uint64_t) {
        const bool best = series.method == "hilbert3d-histogram" || series.method == "morton-histogram";
        return std::pair{best && series.bins == 64 ? 0.5 : best ? 1.5 : 1.0, 0.0};
      });
  const Judge<OrderRow> fastest =
      fastest_are({"hilbert3d-histogram", "morton-histogram"},
                  {"morton", "hilbert3d-histogram-hilbert2d", "hilbert3d-histogram-hilbert3d"});
  CHECK(answers(fastest, rows) == "no");  // with the 16 bins of the thesis
  const Claim<OrderRow> claim = over_bins({{"H3DH and HZ are the fastest", fastest}}).front();
  const Judgement found = judgement_of(claim, rows, {});
  CHECK(found.outcome == ClaimOutcome::in_part);
  CAPTURE(found.words);
  CHECK(contains(found.words, "16 bins, sort not paid: no at 49,000 rays"));
  CHECK(contains(found.words, "64 bins, sort paid: yes at 49,000 rays (a factor of 2.00)"));
}

TEST_CASE("an order that degrades beyond a number of rays") {
  const auto time = [](const std::string& method, uint64_t rays) {
    return method == "hilbert3d-histogram-hilbert2d" && rays > 50000000 ? 1.5 : 1.0;
  };
  const Judge<OrderRow> judge = degrades_beyond("hilbert3d-histogram-hilbert2d", "hilbert3d-histogram", 50000000);
  CHECK(answers(judge, rows_with({1000000, 50000000, 90000000}, time)) == "yes");
  CHECK(answers(judge, rows_with({1000000, 90000000}, [](const std::string&, uint64_t) { return 1.0; })) == "no");
  CHECK(judge(rows_with({1000000, 50000000}, time)).all.empty());
}

TEST_CASE("a gain that grows with the number of rays") {
  const auto gaining = [](double few, double many) {
    return [=](const std::string& method, uint64_t rays) {
      return method == "none" ? 1.0 : 1 / (rays == 1000 ? few : many);
    };
  };
  const Judge<OrderRow> judge = gain_grows("hilbert3d-histogram");
  CHECK(answers(judge, rows_with({1000, 49000}, gaining(1.3, 2.5))) == "yes");
  CHECK(answers(judge, rows_with({1000, 49000}, gaining(2.5, 1.3))) == "no");
  CHECK(answers(judge, rows_with({1000, 49000}, gaining(1.3, 1.3))) == "undecided");
  CHECK(judge(rows_with({1000}, gaining(1.3, 2.5))).all.empty());
}

TEST_CASE("an order that is slower by little, and one that is slower than WS somewhere") {
  const auto taking = [](double morton) {
    return [=](const std::string& method, uint64_t) {
      return method == "morton" ? morton : method == "none" ? 3.0 : 1.0;
    };
  };
  const Judge<OrderRow> judge = slightly_slower("morton", {"hilbert3d-histogram", "morton-histogram"});
  CHECK(answers(judge, rows_with({1000}, taking(1.2))) == "yes");
  CHECK(answers(judge, rows_with({1000}, taking(1.3))) == "no");
  CHECK(answers(judge, rows_with({1000}, taking(0.9))) == "no");
  CHECK(answers(judge, rows_with({1000}, taking(1))) == "undecided");
  const auto slow_at_first = [](const std::string& method, uint64_t rays) {
    return method == "morton" && rays == 1000 ? 4.0 : method == "none" ? 3.0 : 1.0;
  };
  CHECK(answers(all_faster_than_ws({"morton"}), rows_with({1000, 2000}, slow_at_first)) == "no yes");
  CHECK(answers(all_faster_than_ws({"morton-histogram"}), rows_with({1000, 2000}, slow_at_first)) == "yes yes");
}
