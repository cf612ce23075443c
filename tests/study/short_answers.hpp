// SPDX-License-Identifier: Apache-2.0
// Short names of answers.
#pragma once
#include "study/measured.hpp"

namespace short_answers {

using wavetracer::study::Answer;
constexpr Answer yes = Answer::yes, no = Answer::no, open = Answer::undecided, absent = Answer::absent,
                 more = Answer::beyond;

}  // namespace short_answers
