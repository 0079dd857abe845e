// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <utility>

#include "columns.hpp"
#include "lanes.hpp"
#include "plumb/runtime/chain.hpp"
#include "sin_cos_packed.hpp"
#include "six_joints.hpp"

namespace plumb {

/// Evaluates the chain from the base to the tip, frame by frame.
class Chain::Walk {
 public:
  explicit Walk(const Chain& chain) noexcept : chain_(chain) {}

  /// Calls behind_joint(i, X_BPi) for every joint i and returns X_BT.
  template <class F>
  [[gnu::always_inline]] Columns along(std::span<const double> q,
                                       const F& behind_joint) const noexcept {
    if (chain_.fast_path_) return fast_path(internal::SixJoints(q.data()), behind_joint);
    return general_path(q, behind_joint);
  }

  /// The fast path, for six revolute joints and plain links between them: it tests nothing on its
  /// way.
  bool has_fast_path() const noexcept { return chain_.fast_path_; }
  template <class F>
  [[gnu::always_inline]] Columns fast_path(const internal::SixJoints& q,
                                           const F& behind_joint) const noexcept {
    return turning<true>(q, behind_joint);
  }

  /// The general path, for all other arms. Kept out of line so that the fast path does not save
  /// registers for it.
  template <class F>
  [[gnu::noinline]] Columns general_path(std::span<const double> q,
                                         const F& behind_joint) const noexcept {
    if (chain_.all_turn_) return turning<false>(internal::SixJoints(q.data()), behind_joint);
    return any(q, behind_joint);
  }

 private:
  static constexpr std::make_index_sequence<6> kSix{};

  /// Six revolute joints. Unrolled, so that sines and cosines stay in their registers.
  template <bool kPlain, class F>
  [[gnu::always_inline]] Columns turning(const internal::SixJoints& q,
                                         const F& behind_joint) const noexcept {
    using internal::SixJoints;
    const SixJoints at =
        q * SixJoints::constants(chain_.scale_.data()) + SixJoints::constants(chain_.zero_.data());
    SixJoints sin, cos;
    for (std::size_t r = 0; r < SixJoints::kRegisters; ++r)
      portable::sin_cos_packed(at.at[r], sin.at[r], cos.at[r]);
    return [&]<std::size_t... i>(std::index_sequence<i...>) {
      Columns X(chain_.base_);
      (
          [&] {
            X.turn(sin.broadcast<i>(), cos.broadcast<i>());
            behind_joint(i, X);
            append<kPlain && i + 1 < 6>(i + 1, X);
          }(),
          ...);
      return X;
    }
    (kSix);
  }

  /// Any number and kind of joints.
  template <class F>
  Columns any(std::span<const double> q, const F& behind_joint) const noexcept {
    const auto n = static_cast<std::size_t>(chain_.joints_);
    alignas(32) std::array<double, kRoom> position, sin, cos;
    for (std::size_t i = 0; i < n; i += kPackedLanes) {
      const Packed at = load_some(&q[i], n - i) * load(&chain_.scale_[i]) + load(&chain_.zero_[i]);
      Packed s, c;
      portable::sin_cos_packed(at, s, c);
      store(at, &position[i]);
      store(s, &sin[i]);
      store(c, &cos[i]);
    }
    Columns X(chain_.base_);
    for (std::size_t i = 0; i < n; ++i) {
      if (chain_.revolute_[i])
        X.turn(packed(sin[i]), packed(cos[i]));
      else
        X.slide(position[i]);
      behind_joint(i, X);
      append<false>(i + 1, X);
    }
    return X;
  }

  /// Appends constant i. kPlain: it is known to be a plain link.
  template <bool kPlain>
  void append(std::size_t i, Columns& X) const noexcept {
    const Link& link = chain_.link_[i];
    if (kPlain || link.plain)
      X.append_link(link.d, link.a, link.sin_alpha, link.cos_alpha);
    else
      X.append(chain_.constant_[i]);
  }

  const Chain& chain_;
};

}  // namespace plumb
