// SPDX-License-Identifier: Apache-2.0
#include "rt/model_swap.hpp"

#include <unistd.h>

#include <utility>

#include "plumb/drivers/time_source.hpp"
#include "program/problem.hpp"
#include "rt/control_reply.hpp"
#include "rt/install_history.hpp"
#include "rt/model_change.hpp"
#include "rt/screen_units.hpp"

namespace plumb::drivers::rt {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
/// Longest times for loading a model and for the cycle to take it. Together they are shorter than
/// the ten seconds that plumb-rt swap waits for the answer.
constexpr std::int64_t kLoad_ns = 5000 * kMillisecond_ns, kTake_ns = 2000 * kMillisecond_ns;

}  // namespace

void put_model(const Deployment& deployment, const std::filesystem::path& file, RunFacts& facts) {
  const std::string& robot = deployment.model.loaded->model().robot_name;
  facts.model_file = file.string();
  facts.model_name = robot.empty() ? file.filename().string() : robot;
  facts.model_sha256 = deployment.model.sha256;
  facts.model_limits = deployment.model.loaded->limits();
  facts.origin = find_run_origin(deployment);
}

ModelSwap::ModelSwap(Deployment& deployment, ModelSlot& slot, RunFacts& facts, Journal& journal)
    : deployment_(deployment),
      slot_(slot),
      facts_(facts),
      journal_(journal),
      own_name_(user_name(::geteuid())) {}

void ModelSwap::begin(Asked asked) {
  const SwapRequest request = read_swap(asked.request.substr(5));
  const std::string by = asked.uid == 0 ? "root" : own_name_;
  std::string why;
  if (swap_) {
    why = "another model is being loaded: " + swap_->request.file;
  } else {
    try {
      ModelLoading loading({.file = request.file,
                            .serial = deployment_.model.loaded->model().serial,
                            .etc = deployment_.etc,
                            .place = facts_.origin.place,
                            .written = written_files(deployment_.config)});
      swap_.emplace(Swap{.peer = std::move(asked.peer),
                         .request = request,
                         .by = by,
                         .loading = std::move(loading),
                         .end_ns = MonotonicTime::now_ns() + kLoad_ns});
      return;
    } catch (const std::exception& error) {
      why = error.what();
    }
  }
  const std::string answer = refusal("E-RT-SWAP", why);
  note(request.file, by, answer);
  reply_to(asked.peer, answer, {});
}

bool ModelSwap::go_on() {
  swapped_ = false;
  if (!swap_) return false;
  const bool late = MonotonicTime::now_ns() >= swap_->end_ns;
  if (swap_->loading.done()) {
    if (swap_->peer.open()) end(swap_loaded());
    swap_.reset();
  } else if (late && swap_->peer.open()) {
    end(refusal("E-RT-SWAP", "the file cannot be read in time: " + swap_->request.file));
  }
  return swapped_;
}

/// Writes down what came of the request, and answers who asked.
void ModelSwap::end(const std::string& answer) {
  note(swap_->request.file, swap_->by, answer);
  reply_to(swap_->peer, answer, {});
  swap_->peer = Descriptor();
}

std::string ModelSwap::swap_loaded() {
  const SwapRequest& request = swap_->request;
  try {
    RunningModel next = swap_->loading.result();
    refuse_wider(request.file, *next.loaded, deployment_.config.ceilings, deployment_.folder);
    return swap(request, std::move(next));
  } catch (const Failure& failure) {
    const Problem& first = failure.problems().front();
    return refusal(first.code.c_str(), first.message);
  } catch (const std::exception& error) {
    return refusal("E-RT-MODEL", error.what());
  }
}

/// If the model fails any check the running model stays in use.
std::string ModelSwap::swap(const SwapRequest& request, RunningModel next) {
  if (const auto short_of = find_short_reach(deployment_, *next.loaded); !short_of.empty())
    return refusal("E-RT-SWAP", short_of.front().what);
  if (!sensors_come(deployment_, *next.loaded))
    return refusal("E-RT-SWAP",
                   "it listens to a sensor that the model before does not: start plumb-rt anew");
  const LoadedModel& running = *deployment_.model.loaded;
  ModelChange change;
  if (find_binding_fault(running.model(), next.loaded->model()) == BindingFault::kNone) {
    change = find_change(running, *next.loaded);
    const Ceilings& ceilings = deployment_.config.ceilings;
    if (const auto fault = change_fault(change, request, ceilings); !fault.empty())
      return refusal("E-RT-CHANGE", fault);
  }
  const auto published = slot_.publish(*next.loaded);
  if (published == ModelSlot::Published::kBusy)
    return refusal("E-RT-SWAP", "the cycle has not taken the model before yet");
  if (published != ModelSlot::Published::kDone)
    return refusal("E-RT-SWAP",
                   to_string(find_binding_fault(running.model(), next.loaded->model())));
  std::swap(deployment_.model, next);
  const std::int64_t end_ns = MonotonicTime::now_ns() + kTake_ns;
  while (!slot_.settled() && MonotonicTime::now_ns() < end_ns)
    std::ignore = MonotonicTime::sleep_until_ns(MonotonicTime::now_ns() + kMillisecond_ns);
  if (!slot_.settled()) before_ = std::move(next);
  put_model(deployment_, request.file, facts_);
  swapped_ = true;
  return reply({{"ok", true},
                {"result",
                 {{"file", request.file},
                  {"sha256", facts_.model_sha256},
                  {"change_mm", 1e3 * change.position_m},
                  {"change_deg", change.rotation_rad / kDegree},
                  {"fingerprint", deployment_.model.loaded->number()}}}});
}

/// One line of the journal.
void ModelSwap::note(const std::string& file, const std::string& by, const std::string& answer) {
  const Json said = Json::parse(answer, nullptr, false);
  Json details{{"file", file}, {"by", by}};
  const bool done = said.is_object() && said.value("ok", false);
  const char* const part = done ? "result" : "error";
  if (said.is_object() && said.contains(part)) details.update(said[part]);
  if (done) details.update(event_details(facts_.origin));
  journal_.note(done ? "swap" : "swap-refused", details);
}

}  // namespace plumb::drivers::rt
