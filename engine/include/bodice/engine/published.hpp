#pragma once

#include <memory>
#include <utility>

#include <bodice/engine/value_stack.hpp>

namespace bodice::engine {

/// Hands immutable values from background threads to one frame thread, which sees a new one only when it
/// asks at a frame boundary. The frame side never waits, allocates or frees: what it lets go of is freed
/// by the next publish() or by the destructor.
template <class T>
class Published {
 public:
  Published() = default;
  ~Published() { delete current_; }
  Published(const Published&) = delete;
  Published& operator=(const Published&) = delete;

  /// Any thread: offers `value` for the next boundary, in place of one that was not taken yet.
  void publish(std::shared_ptr<const T> value) {
    Stack::free_chain(offered_.replace(new Node{std::move(value)}));
    Stack::free_chain(retired_.take_all());
  }

  /// Frame thread, at a boundary: takes the latest value offered. True if there was one.
  bool advance() noexcept {
    Node* fresh = offered_.take_all();
    if (!fresh) return false;
    if (current_) retired_.push(current_);
    current_ = fresh;
    return true;
  }

  /// Frame thread: the value since the last boundary, or null before the first. Valid until advance().
  const T* current() const noexcept { return current_ ? current_->value.get() : nullptr; }
  /// Frame thread: the same, kept alive by the caller.
  std::shared_ptr<const T> share() const noexcept { return current_ ? current_->value : nullptr; }

 private:
  using Stack = detail::ValueStack<T>;
  using Node = detail::ValueNode<T>;

  Stack offered_;
  Stack retired_;
  Node* current_ = nullptr;
};

}  // namespace bodice::engine
