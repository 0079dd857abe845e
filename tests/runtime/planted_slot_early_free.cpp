// SPDX-License-Identifier: Apache-2.0
// A slot that lets the loader free a model under the cycle: a violation that the thread and the
// address sanitizer must catch.
#include "plumb/runtime/model_slot.hpp"
#include "tests/runtime/slot_hammer.hpp"

namespace {

class ImpatientSlot : public plumb::ModelSlot {
 public:
  using ModelSlot::ModelSlot;
  bool settled() const { return true; }
};

}  // namespace

int main() { return plumb::test::hammer<ImpatientSlot>(2000).wrong == 0 ? 0 : 1; }
