#pragma once

#include <atomic>
#include <memory>
#include <utility>

namespace bodice::engine {

/// Hands immutable values from background threads to one frame thread, which sees a new one only when it
/// asks at a frame boundary. The frame side never waits, allocates or frees: what it lets go of is freed
/// by the next publish() or by the destructor.
template <class T>
class Published {
 public:
  Published() = default;
  ~Published() {
    free_chain(retired_.load(std::memory_order_relaxed));
    delete pending_.load(std::memory_order_relaxed);
    delete current_;
  }
  Published(const Published&) = delete;
  Published& operator=(const Published&) = delete;

  /// Any thread: offers `value` for the next boundary, in place of one that was not taken yet.
  void publish(std::shared_ptr<const T> value) {
    Node* fresh = new Node{std::move(value), nullptr};
    delete pending_.exchange(fresh, std::memory_order_acq_rel);
    free_chain(retired_.exchange(nullptr, std::memory_order_acquire));
  }

  /// Frame thread, at a boundary: takes the latest value offered. True if there was one.
  bool advance() noexcept {
    Node* fresh = pending_.exchange(nullptr, std::memory_order_acq_rel);
    if (!fresh) return false;
    if (current_) retire(current_);
    current_ = fresh;
    return true;
  }

  /// Frame thread: the value since the last boundary, or null before the first. Valid until advance().
  const T* current() const noexcept { return current_ ? current_->value.get() : nullptr; }
  /// Frame thread: the same, kept alive by the caller.
  std::shared_ptr<const T> share() const noexcept { return current_ ? current_->value : nullptr; }

 private:
  struct Node {
    std::shared_ptr<const T> value;
    Node* next;
  };
  // Pushed by the frame thread only and always taken whole, so that there is no ABA to fear.
  void retire(Node* node) noexcept {
    node->next = retired_.load(std::memory_order_relaxed);
    while (!retired_.compare_exchange_weak(node->next, node, std::memory_order_release)) {
    }
  }
  static void free_chain(Node* node) {
    while (node) delete std::exchange(node, node->next);
  }

  std::atomic<Node*> pending_{nullptr};
  std::atomic<Node*> retired_{nullptr};
  Node* current_ = nullptr;
};

}  // namespace bodice::engine
