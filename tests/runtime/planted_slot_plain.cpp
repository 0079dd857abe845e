// SPDX-License-Identifier: Apache-2.0
// A slot of plain pointers: a violation that the thread sanitizer must catch.
#include "plumb/runtime/model_slot.hpp"
#include "tests/runtime/slot_hammer.hpp"

namespace {

class PlainSlot {
 public:
  using Published = plumb::ModelSlot::Published;
  explicit PlainSlot(const plumb::LoadedModel& first) : offered_(&first), taken_(&first) {}

  Published publish(const plumb::LoadedModel& next) {
    offered_ = &next;
    return Published::kDone;
  }
  bool settled() const { return taken_ == offered_; }
  const plumb::LoadedModel& take() { return *(taken_ = offered_); }

 private:
  const plumb::LoadedModel* offered_;
  const plumb::LoadedModel* taken_;
};

}  // namespace

int main() { return plumb::test::hammer<PlainSlot>(2000).wrong == 0 ? 0 : 1; }
