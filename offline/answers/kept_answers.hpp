// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "answers/answers.hpp"
#include "runs/kept_fields.hpp"

/// The answers in a kept file, as runs/kept_fields.hpp describes it.
namespace plumb::offline {

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Answers::Why>& why) {
  fields("text", why.text);
  fields("state", why.state);
}

template <class Fields>
void describe(Fields& fields, typename Fields::template Of<Answers>& answers) {
  fields.named("class", answers.found, Answers::Class::kNotGood);
  fields("sentence", answers.sentence);
  fields("where", answers.where);
  fields("why", answers.why);
  fields("next", answers.next);
}

}  // namespace plumb::offline
