// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "plumb/runtime/detail/tree_view.hpp"
#include "plumb/runtime/detail/tree_walk.hpp"

namespace plumb {

extern template void TreeView::active(std::span<const double>,
                                      ActiveLeaves<double>&) const noexcept;
extern template double TreeView::evaluate(std::span<const double>,
                                          const ActiveLeaves<double>&) const noexcept;
extern template double TreeView::evaluate<double>(std::span<const double>) const noexcept;

}  // namespace plumb
