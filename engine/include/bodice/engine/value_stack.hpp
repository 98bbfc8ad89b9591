#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine::detail {

/// A node of a ValueStack.
template <class T>
struct ValueNode {
  std::shared_ptr<const T> value;
  ValueNode* next = nullptr;
};

/// A stack onto which threads push nodes one by one, and from which one takes all at once, newest first.
/// Taking all leaves no node that another thread could compare with, so that the ABA problem cannot arise.
template <class T>
class ValueStack {
 public:
  using Node = ValueNode<T>;

  ValueStack() = default;
  ~ValueStack() { free_chain(take_all()); }
  ValueStack(const ValueStack&) = delete;
  ValueStack& operator=(const ValueStack&) = delete;

  void push(Node* node) noexcept {
    node->next = top_.load(std::memory_order_relaxed);
    while (!top_.compare_exchange_weak(node->next, node, std::memory_order_release)) {
    }
  }
  Node* take_all() noexcept { return top_.exchange(nullptr, std::memory_order_acquire); }

  static void free_chain(Node* node) {
    while (node) delete std::exchange(node, node->next);
  }

 private:
  std::atomic<Node*> top_{nullptr};
};

}  // namespace bodice::engine::detail
