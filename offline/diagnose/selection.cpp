// SPDX-License-Identifier: Apache-2.0
#include "diagnose/selection.hpp"

#include <algorithm>
#include <utility>

#include "diagnose/alternatives.hpp"
#include "diagnose/effect_list.hpp"
#include "diagnose/effect_words.hpp"
#include "diagnose/found_list.hpp"
#include "diagnose/judged_fit.hpp"
#include "diagnose/model_parts.hpp"
#include "diagnose/unless_refused.hpp"
#include "effects/registry.hpp"

namespace plumb::offline {

Selection::Selection(ForwardStart start, const Calibration& calibration, WhitenedFit whitened,
                     Scan look)
    : start_(std::move(start)),
      now_{{std::make_shared<const Cell>(start_.cell), calibration},
           std::move(whitened),
           std::move(look)} {
  now_.whitened.cell = now_.model.cell.get();
}

bool Selection::leaves_as_remainder(const Found& found) const {
  return is_remainder(cell(), whitened(), calibration(), found);
}

FittedModel Selection::fitted_from(const Calibration& from, const std::vector<EffectEntry>& effects,
                                   Refit how) const {
  Cell with = start_.cell;
  with.effects = effects;
  return {std::make_shared<const Cell>(std::move(with)),
          refitted(start_.cell, start_.measured, start_.fit, effects, from, how)};
}

FittedModel Selection::fitted(const std::vector<EffectEntry>& effects, Refit how) const {
  return fitted_from(calibration(), effects, how);
}

FittedModel Selection::fitted_somehow(const std::vector<EffectEntry>& effects) const {
  FittedModel out;
  if (unless_refused([&] { out = fitted(effects); })) return out;
  return fitted(effects, Refit::kFully);
}

WhitenedFit Selection::whitened_fit_of(const FittedModel& model) const {
  return make_whitened_fit(*model.cell, start_.measured, model.calibration,
                           without_outliers(start_.fit, model.calibration.outliers), {});
}

JudgedModel Selection::without(const std::vector<EffectEntry>& entries,
                               const std::vector<std::string>& banned) const {
  std::vector<EffectEntry> left = cell().effects;
  for (const auto& entry : entries) left = without_effect(std::move(left), entry);
  FittedModel model = fitted(left);
  JudgedFit found = judged(whitened_fit_of(model), start_.not_testable, banned);
  return {std::move(model), std::move(found.whitened), std::move(found.look)};
}

std::vector<Alternative> Selection::alternatives_in(const JudgedModel& without,
                                                    const Found& found) const {
  return alternatives(without.whitened, without.look, found, start_.excluded);
}

void Selection::take(Proposal p) {
  banned_.insert(banned_.end(), p.banned.begin(), p.banned.end());
  if (auto* const judged = std::get_if<JudgedModel>(&p.model)) {
    go_to(std::move(*judged));
    if (!p.banned.empty()) look_again();
  } else {
    auto& fitted = std::get<FittedModel>(p.model);
    if (!p.whitened) p.whitened = whitened_fit_of(fitted);
    look_at(std::move(fitted), std::move(*p.whitened));
  }
  for (const auto& entry : p.out) forget(added, entry);
  if (p.instead) remember_alternatives(key(p.in.front().entry), std::move(*p.instead));
  added.insert(added.end(), p.in.begin(), p.in.end());
}

void Selection::go_to(JudgedModel there) {
  now_ = std::move(there);
  seen_.push_back(now_.model);
}

void Selection::look_at(FittedModel model, WhitenedFit whitened) {
  JudgedFit found = judged(std::move(whitened), start_.not_testable, banned_);
  waiting_.clear();
  go_to({std::move(model), std::move(found.whitened), std::move(found.look)});
}

void Selection::refit_fully() {
  now_.model.calibration = fitted(cell().effects, Refit::kFully).calibration;
}

void Selection::look_again() {
  std::vector<std::string> out = banned_;
  out.insert(out.end(), waiting_.begin(), waiting_.end());
  now_.look = scan(now_.whitened, start_.not_testable, out);
}

void Selection::set_aside(const EffectEntry& entry) {
  const std::string name = key(entry);
  not_judged_["with " + name] = "with " + in_words(cell(), entry);
  (++failed_[name] > 1 ? banned_ : waiting_).push_back(name);
  look_again();
}

void Selection::take_out(const EffectEntry& weak) {
  if (const std::string name = key(weak); !is_wave(weak.name) || ++taken_out_[name] > 2) ban(name);
  forget(added, weak);
}

bool Selection::first_time(const std::string& what, const std::string& key, std::size_t state) {
  const auto [last, fresh] = done_[what].try_emplace(key, state);
  return fresh || std::exchange(last->second, state) != state;
}

std::size_t Selection::times(const std::string& what) const {
  const auto found = done_.find(what);
  return found == done_.end() ? 0 : found->second.size();
}

void Selection::remember_alternatives(const std::string& key, std::vector<Alternative> others) {
  alternatives_[key] = std::move(others);
}

std::vector<Alternative> Selection::alternatives_of(const std::string& key) const {
  const auto found = alternatives_.find(key);
  return found == alternatives_.end() ? std::vector<Alternative>() : found->second;
}

void Selection::carry(const Found& nuisance) {
  FittedModel next = fitted_somehow(with_found(cell().effects, nuisance));
  WhitenedFit whitened = whitened_fit_of(next);
  start_.cell.effects = with_found(std::move(start_.cell.effects), nuisance);
  for (auto& entry : nuisance.entries()) carried_.push_back(std::move(entry));
  look_at(std::move(next), std::move(whitened));
}

void Selection::leave_open(const std::vector<EffectEntry>& findings) {
  open_.insert(open_.end(), findings.begin(), findings.end());
}

bool Selection::is_open(const EffectEntry& entry) const {
  return std::any_of(open_.begin(), open_.end(), [&](const EffectEntry& one) {
    return key(one) == key(entry) || one_finding(one, entry);
  });
}

void Selection::not_compared_without(const EffectEntry& entry) {
  not_judged_["without " + key(entry)] = "without " + in_words(cell(), entry);
}

void Selection::not_refitted_from_the_start() {
  not_judged_["all"] = "with all of them, once more from the start";
}

std::vector<std::string> Selection::not_judged() const {
  std::vector<std::string> out;
  for (const auto& [key, words] : not_judged_) out.push_back(words);
  return out;
}

}  // namespace plumb::offline
