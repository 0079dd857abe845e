// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "formula/expression.hpp"
#include "plumb/format/formula.hpp"

namespace plumb::offline {
namespace {

using format::FormulaOp;

class Emitter {
 public:
  explicit Emitter(const std::vector<ExpressionNode>& nodes) : nodes_(nodes) {}

  EmittedCode emit() {
    visit(static_cast<int>(nodes_.size()) - 1);
    return std::move(out_);
  }

 private:
  void visit(int index) {
    const ExpressionNode& node = nodes_[static_cast<std::size_t>(index)];
    if (node.constant) {
      put(FormulaOp::kLiteral, literal(*node.constant));
      return;
    }
    for (int i : node.inner) visit(i);
    put(node.op, static_cast<unsigned>(node.operand));
  }

  unsigned literal(double value) {
    auto& all = out_.literals;
    const auto it = std::find(all.begin(), all.end(), value);
    const auto place = static_cast<unsigned>(it - all.begin());
    if (it == all.end()) all.push_back(value);
    return place;
  }

  void put(FormulaOp op, unsigned operand) {
    height_ += 1 - format::taken(op);
    out_.depth = std::max(out_.depth, height_);
    // A formula with too many operands is refused elsewhere. Here a large operand only must not
    // overwrite the bits of the operation.
    out_.code.push_back(format::instruction(op, std::min(operand, 255U)));
  }

  const std::vector<ExpressionNode>& nodes_;
  EmittedCode out_;
  int height_ = 0;
};

}  // namespace

EmittedCode emit(const Expression& expression) { return Emitter(expression.nodes).emit(); }

}  // namespace plumb::offline
